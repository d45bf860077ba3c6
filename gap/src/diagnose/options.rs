//! What the caller may choose, and what can stand in the way of a diagnosis.

use stiffarm_table::robot::Robot;

use super::prior::Prior;
use super::progress::Stop;
use crate::effects::{BaseFrame, Catalogue, Effect, Geometry, Known, Law, ToolFrame};
use crate::io::nearest;
use crate::measurement::Measurements;
use crate::spring::Spring;

/// A frame that is known to be unknown: fitted and projected out, never a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nuisance {
    /// Where the arm's base stands in the measuring frame.
    BaseFrame,
    /// Where the measured frame is on the tool.
    ToolFrame,
}

impl Nuisance {
    /// Both.
    pub const ALL: [Nuisance; 2] = [Nuisance::BaseFrame, Nuisance::ToolFrame];

    /// The effect that moves the frame.
    pub fn effect(self) -> &'static dyn Effect {
        match self {
            Self::BaseFrame => &BaseFrame,
            Self::ToolFrame => &ToolFrame,
        }
    }

    /// The frame that an effect moves, if that is all it does.
    pub fn of(effect: &dyn Effect) -> Option<Self> {
        Self::ALL.into_iter().find(|frame| frame.effect() == effect)
    }

    /// Those that are fitted along: those `asked` for, and where a camera or its board stands.
    pub(crate) fn unknown(data: &Measurements, asked: &[Self]) -> Vec<Self> {
        let by_data = [data.by_camera, data.by_board];
        let is_unknown = |(frame, by_data): &(Self, bool)| *by_data || asked.contains(frame);
        Self::ALL.into_iter().zip(by_data).filter(is_unknown).map(|(frame, _)| frame).collect()
    }

    /// By its effect's identifier.
    ///
    /// # Errors
    /// [`DiagnoseError::UnknownNuisance`].
    pub fn parse(found: &str) -> Result<Self, DiagnoseError> {
        Self::ALL.into_iter().find(|frame| frame.identifier() == found.trim()).ok_or_else(|| {
            DiagnoseError::UnknownNuisance {
                found: found.to_owned(),
                suggestion: nearest(found, Self::ALL.map(Self::identifier)),
            }
        })
    }

    /// Its effect's identifier.
    pub fn identifier(self) -> &'static str {
        self.effect().identifier()
    }
}

/// To what makers of arms hold lengths and angles, m and rad, if nothing else is known.
pub const TOLERANCE: [f64; 2] = [0.3e-3, 0.5e-3];

/// Choices of a diagnosis. The same choices on the same data give the same bytes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The version that the result names.
    pub version: String,
    /// Number of folds, 2 to the number of poses; by default one per pose up to 30 poses, else 10.
    pub folds: Option<usize>,
    /// Seeds folds, permutations and bootstrap.
    pub seed: u64,
    /// Standard deviation of each measured coordinate, m.
    pub noise_position: Option<f64>,
    /// Standard deviation of each measured component of a rotation, rad.
    pub noise_rotation: Option<f64>,
    /// The effects that there are: stiffarm's, and one's own.
    pub catalogue: Catalogue,
    /// What the robot file says of the arm beyond its table.
    pub known: Vec<Known>,
    /// Identifiers of those to be tried; `None` is all.
    pub effects: Option<Vec<String>>,
    /// Frames that are known to be unknown.
    pub nuisances: Vec<Nuisance>,
    /// Whether every zero, length and twist of the table is fitted along, held to `tolerance`: what
    /// is found then is beyond ordinary calibration.
    pub geometry: bool,
    /// Standard deviations to which makers hold lengths and angles, m and rad; by default
    /// [`TOLERANCE`].
    pub tolerance: Option<[f64; 2]>,
    /// What is usual of effects' numbers, where the caller knows better than the catalogue.
    pub priors: Vec<Prior>,
    /// Whether the search is run again for each fold on the others, and the gap told that it leaves:
    /// as many times the work.
    pub nested: bool,
    /// What a log tells of the joints' springs: further measurements of these, as far as the rows do not contradict them.
    pub springs: Vec<Spring>,
    /// Whether rows that do not fit are fitted and counted all the same.
    pub keep_all: bool,
    /// Prefixes of extra columns that hold another model's predictions of the measured quantities:
    /// `ycd` stands for `ycd_dx` … `ycd_drz`, or `ycd_x` … `ycd_rz`.
    pub rivals: Vec<String>,
    /// Robots that the arm may be in place of the file's, where their joints are of the same kinds.
    pub family: Vec<Robot>,
    /// Ends the search early when it is asked.
    pub stop: Stop,
}

/// Why there is no diagnosis. Every message that concerns the data names the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message beside each variant and field says what it is")]
pub enum DiagnoseError {
    #[error(
        "{file}: found readings of {found} joints, expected {expected} as the robot has: read the \
         file for this robot"
    )]
    Joints { file: String, found: usize, expected: usize },
    #[error("{file}: found no rows, expected at least one measurement")]
    NoRows { file: String },
    #[error(
        "{file}: found {found} pose{}, expected at least 2: one to fit and one to hold out; \
         measure at more poses", if *found == 1 { "" } else { "s" }
    )]
    TooFewPoses { file: String, found: usize },
    #[error(
        "{file}: found fewer rows than parameters ({rows} rows, {parameters} parameters with those \
         held out): measure more"
    )]
    TooFewRows { file: String, rows: usize, parameters: usize },
    #[error(
        "found {found} fold{}, expected 2 to {poses}, the number of poses in {file}",
        if *found == 1 { "" } else { "s" }
    )]
    Folds { file: String, found: usize, poses: usize },
    #[error(
        "{file}: line {line}: the robot is not in stable equilibrium under this row's load and its \
         weight: check the load, its unit and the stiffness"
    )]
    Unstable { file: String, line: u64 },
    #[error(
        "{file}: line {line}: a reading, the load, the place of the tool or the gap is beyond \
         1e50: \
         check the row's numbers"
    )]
    TooLarge { file: String, line: u64 },
    #[error(
        "found the unknown nuisance `{found}`, expected base_frame, tool_frame or geometry{}",
        suggestion.map_or_else(String::new, |s| format!("; did you mean `{s}`?"))
    )]
    UnknownNuisance { found: String, suggestion: Option<&'static str> },
    #[error(
        "{file}: found the marker `{marker}`, expected one that the diagnosed data had: its place \
         on the tool was never fitted"
    )]
    NewMarker { file: String, marker: String },
    #[error(
        "{file}: found {}, expected one of the diagnosed data ({known}): where the base stood was \
         fitted for each of them",
        if session.is_empty() { "no session".to_owned() } else { format!("the session `{session}`") }
    )]
    NewSession { file: String, session: String, known: String },
    #[error(
        "{file}: found a plan to read the {point}, expected to know it: say in --bench where it is; only readings tell it \
         otherwise"
    )]
    NewPoint { file: String, point: String },
    #[error(
        "{file}: session `{session}` has {poses} pose{} beside those that are held out, expected at \
         least {LEAST_POSES}: where its base stands is fitted; measure more in it, leave it out, or \
         take more folds",
        if *poses == 1 { "" } else { "s" }
    )]
    ShortSession { file: String, session: String, poses: usize },
    #[error(
        "found the unknown effect `{found}`, expected one of {known}{}",
        suggestion.map_or_else(String::new, |s| format!("; did you mean `{s}`?"))
    )]
    UnknownEffect { found: String, known: String, suggestion: Option<&'static str> },
    #[error("found the prior `{found}`, expected {expected}")]
    Prior { found: String, expected: String },
    #[error("found the {what} {found}, expected a number from 1e-30 to 1e30")]
    Scale { what: &'static str, found: f64 },
    #[error(
        "{file}: found no column that predicts what is measured for the rival `{rival}`, expected \
         {expected}{}",
        if known.is_empty() {
            String::new()
        } else {
            format!("; the file has predictions of {known}")
        }
    )]
    NoRival { file: String, rival: String, expected: String, known: String },
    #[error(
        "{file}: line {line}, column {number} `{header}`: found `{found}`, expected a number: a \
         rival predicts every row"
    )]
    RivalCell { file: String, line: u64, number: usize, header: String, found: String },
    #[error(
        "{file}: column {number} `{header}`: found the unit `{found}`, expected one of {expected}"
    )]
    RivalUnit { file: String, number: usize, header: String, found: String, expected: String },
}

/// Poses of a session that its base's frame takes: three points that are on no line.
pub(crate) const LEAST_POSES: usize = 3;

impl Options {
    /// The effects to be tried.
    ///
    /// # Errors
    /// [`DiagnoseError::UnknownEffect`] for a name that is not in the catalogue.
    pub(crate) fn effects(&self) -> Result<Vec<&'static dyn Effect>, DiagnoseError> {
        // A frame that is fitted along is no finding.
        let fitted = |e: &&dyn Effect| {
            self.nuisances.iter().any(|n| n.effect() == *e) || self.along().is_some_and(|a| a == *e)
        };
        let all = self.catalogue.iter().filter(|e| !fitted(e));
        let Some(names) = &self.effects else { return Ok(all.collect()) };
        if let Some(found) = names.iter().find(|name| self.catalogue.named(name).is_none()) {
            let known = self.catalogue.identifiers();
            return Err(DiagnoseError::UnknownEffect {
                found: found.clone(),
                suggestion: nearest(found, known.iter().copied()),
                known: known.join(", "),
            });
        }
        Ok(all.filter(|e| names.iter().any(|n| n == e.identifier())).collect())
    }

    /// What is fitted along beside frames.
    pub(crate) fn along(&self) -> Option<&'static dyn Effect> {
        self.geometry.then_some(&Geometry)
    }

    /// Fits these along, by the identifiers of their effects: the frames, and the geometry.
    ///
    /// # Errors
    /// [`DiagnoseError::UnknownNuisance`].
    pub fn fit_along(&mut self, names: &[String]) -> Result<(), DiagnoseError> {
        for name in names {
            if name.trim() == Geometry.identifier() {
                self.geometry = true;
            } else {
                self.nuisances.push(Nuisance::parse(name)?);
            }
        }
        Ok(())
    }

    /// Checks what can be checked without data.
    pub(crate) fn check(&self) -> Result<(), DiagnoseError> {
        let tolerance = |k: usize| self.tolerance.map(|both| both[k]);
        let scales = [
            ("position noise", self.noise_position),
            ("rotation noise", self.noise_rotation),
            ("tolerance of lengths", tolerance(0)),
            ("tolerance of angles", tolerance(1)),
        ];
        for (what, scale) in scales {
            if let Some(found) = scale.filter(|n| !(1e-30..=1e30).contains(n)) {
                return Err(DiagnoseError::Scale { what, found });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_are_chosen_by_name() {
        assert_eq!(
            Options::default().effects().unwrap().len(),
            Catalogue::default().iter().count()
        );
        let only = |name: &str| {
            Options { effects: Some(vec![name.to_owned()]), ..Options::default() }.effects().err()
        };
        assert_eq!(only("joint_compliance"), None);
        let text = only("joint_complience").unwrap().to_string();
        assert!(text.ends_with("did you mean `joint_compliance`?"), "{text}");
    }

    #[test]
    fn noise_is_a_positive_number() {
        for wrong in [0.0, -1.0, 1e-300, f64::NAN, f64::INFINITY] {
            let options = Options { noise_rotation: Some(wrong), ..Options::default() };
            assert!(matches!(options.check(), Err(DiagnoseError::Scale { .. })), "{wrong}");
        }
    }
}
