//! The models before and after a diagnosis: what predicts other measurements of the same arm, and
//! what the corrected robot is made of.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::spread::Spread;
use crate::diagnose::data::{Problem, Thing};
use crate::diagnose::fit::{Fitted, Model, fitted_thing};
use crate::diagnose::options::{DiagnoseError, Nuisance, Options};
use crate::diagnose::report::Cover;
use crate::effects::{Catalogue, Depends, Known};
use crate::instrument::Aim;
use crate::measurement::{Base, Kind, Measurements, Stands};

/// What a diagnosis knows of the arm.
pub struct Explanation {
    pub(super) nominal: Arm,
    arm: Arm,
    pub(super) file: String,
    pub(super) kind: Kind,
    pub(super) before: Model,
    pub(super) after: Model,
    pub(super) nuisances: Vec<Nuisance>,
    markers: Vec<String>,
    sessions: Vec<String>,
    stands: Stands,
    bench: Vec<Thing>,
    catalogue: Catalogue,
    pub(super) known: Vec<Known>,
    covers: Cover,
    pub(super) spread: Spread,
}

/// Measured minus predicted on other measurements, rows in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// With the frames as they were fitted and nothing else.
    pub before: Vec<Vector6<f64>>,
    /// With the findings.
    pub after: Vec<Vector6<f64>>,
    /// Whether the row lies within the joint ranges and loads of the data that was diagnosed, and what
    /// was fitted is known as well there as at one of its rows (the leverage is no larger).
    pub inside: Vec<bool>,
}

impl Explanation {
    /// The models before and after, and the spread of all that the one after has fitted.
    pub(crate) fn new(
        problem: &Problem<'_>,
        [before, after]: [Model; 2],
        spread: Spread,
        covers: &Cover,
        options: &Options,
    ) -> Self {
        let mut arm = after.arm.clone();
        arm.tool_rotation_vector = arm.tool.rotation.scaled_axis();
        // Of several bases none is the arm's.
        if let [base] = after.bases[..] {
            arm.base = base;
            arm.gravity = after.axes.gravity(&base, &arm.gravity);
        }
        Self {
            nominal: problem.arm.clone(),
            arm,
            file: problem.data.file.clone(),
            before,
            after,
            nuisances: problem.nuisances.clone(),
            markers: problem.markers.clone(),
            sessions: problem.sessions.clone(),
            stands: problem.stands.clone(),
            bench: problem.bench.clone(),
            covers: covers.clone(),
            catalogue: options.catalogue.clone(),
            known: options.known.clone(),
            kind: problem.data.kind,
            spread,
        }
    }

    /// The effects that were found, beyond those that were known.
    pub fn found(&self) -> Vec<Known> {
        self.after.found.iter().map(|found| found.known(&self.file)).collect()
    }

    /// The effects that were known: those of the robot file.
    pub fn known(&self) -> &[Known] {
        &self.known
    }

    /// The markers whose place was fitted, and it, in the tool frame, m.
    pub fn markers(&self) -> impl Iterator<Item = (&str, [f64; 3])> {
        let places = self.after.markers.iter().map(|at| (*at).into());
        self.markers.iter().map(String::as_str).zip(places)
    }

    /// The effects that were known.
    pub fn catalogue(&self) -> &Catalogue {
        &self.catalogue
    }

    /// The arm with base and tool where they were fitted, or as the robot file has them; of several
    /// sessions, each with a base of its own, the base is the robot file's. A board or camera on the tool is beside it:
    /// loads act at the tool.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// The boards or cameras that are on the tool, and where they were fitted, in the tool frame.
    pub fn mounts(&self) -> impl Iterator<Item = (&str, Isometry3<f64>)> {
        self.stands.mounts.iter().map(String::as_str).zip(self.after.mounts.iter().copied())
    }

    /// What is known of other rows.
    pub(super) fn options(&self) -> Options {
        let (nuisances, known) = (self.nuisances.clone(), self.known.clone());
        Options { nuisances, known, ..Options::default() }
    }

    /// What the models make of measurements of the arm. Frames, markers and things of the bench stay where
    /// they were fitted; constants of things that only these measurements have are fitted to them, so that the
    /// gap is what they leave. What happened at a time is carried to no other file.
    ///
    /// # Errors
    /// [`DiagnoseError`] of the data, and [`DiagnoseError::NewMarker`] or [`DiagnoseError::NewSession`] for a
    /// marker or base whose place was never fitted.
    pub fn predict(&self, data: &Measurements) -> Result<Prediction, DiagnoseError> {
        let mut problem = Problem::new(&self.nominal, data, &self.options())?;
        let mut places = Vec::with_capacity(problem.markers.len());
        for name in &problem.markers {
            let known = self.markers.iter().position(|known| known == name);
            places.push(known.ok_or_else(|| DiagnoseError::NewMarker {
                file: data.file.clone(),
                marker: name.clone(),
            })?);
        }
        let sessions: Vec<Option<usize>> =
            problem.sessions.iter().map(|name| self.session(&problem, name)).collect();
        let bases: Vec<Option<usize>> = (0..problem.stands.bases.len())
            .map(|number| self.base(&problem, number))
            .collect::<Result<_, _>>()?;
        let mounts: Vec<usize> = (problem.stands.mounts.iter())
            .map(|name| self.mount(&problem, name))
            .collect::<Result<_, _>>()?;
        // What has no name, in a session without one, may stand otherwise in another file: a level was clamped on again.
        let is_here = data.file == self.file;
        let known_thing = |Thing { aim, session }: &Thing| {
            let names = [&aim.name, &problem.sessions[*session]];
            let is_told = is_here || names.iter().any(|name| !name.is_empty());
            let same = |known: &Thing| {
                let is = (known.aim.seen, &known.aim.name) == (aim.seen, &aim.name);
                is_told && is && sessions[*session] == Some(known.session)
            };
            self.bench.iter().position(same)
        };
        let bench: Vec<Option<usize>> = problem.bench.iter().map(known_thing).collect();
        let lasts = |f: &Fitted| data.file == self.file || f.effect.depends() != Depends::Session;
        let carried = |model: &Model| {
            let mut model = model.clone();
            model.markers = places.iter().map(|k| model.markers[*k]).collect();
            model.bases =
                bases.iter().map(|k| k.map_or(self.nominal.base, |k| model.bases[k])).collect();
            model.mounts = mounts.iter().map(|k| model.mounts[*k]).collect();
            let things = bench.iter().zip(&problem.bench);
            let known =
                |(k, new): (&Option<usize>, &Thing)| k.map_or(new.aim.view, |k| model.bench[k]);
            model.bench = things.map(known).collect();
            model.found.retain(lasts);
            model
        };
        let [mut start, mut model] = [&self.before, &self.after].map(carried);
        // A load far beyond the others may be more than the arm bears.
        let bears =
            |row: usize| [&start, &model].iter().all(|m| m.seen(&problem, row, None).is_ok());
        problem.fits = (0..data.rows.len()).map(|row| problem.fits[row] || bears(row)).collect();
        for thing in (0..bench.len()).filter(|k| bench[*k].is_none()) {
            for model in [&mut start, &mut model] {
                model.bench[thing] = fitted_thing(&problem, model, thing)?;
            }
        }
        let before = start.predict(&problem, None)?.gaps;
        let after = model.predict(&problem, None)?;
        let mut numbers: Vec<usize> = (0..6 * problem.nuisances.len()).collect();
        numbers.extend(self.numbers(lasts));
        let each = data.rows.iter().enumerate();
        let inside = each.map(|(number, row)| {
            self.covers.holds(row) && self.spread.covers(&problem, &model, &after, number, &numbers)
        });
        Ok(Prediction { before, inside: inside.collect(), after: after.gaps })
    }

    /// The models without the findings and with them, of an arm that nothing is read of but its tool.
    pub(super) fn without_bench(&self) -> [Model; 2] {
        [&self.before, &self.after].map(|model| {
            let mut model = model.clone();
            model.markers.clear();
            model.bench.clear();
            model
        })
    }

    /// The numbers of those effects that are wanted, as the spread has them.
    pub(super) fn numbers(&self, is_wanted: impl Fn(&Fitted) -> bool) -> Vec<usize> {
        let (mut numbers, mut first) = (Vec::new(), 6 * self.nuisances.len());
        for found in &self.after.found {
            let own = first..first + found.values.len();
            first = own.end;
            numbers.extend(own.filter(|_| is_wanted(found)));
        }
        numbers
    }

    /// Which of the diagnosed sessions a session of other data is measured in; `None` is another one.
    fn session(&self, other: &Problem<'_>, name: &str) -> Option<usize> {
        let is_one = |names: &[String]| matches!(names, [one] if one.is_empty());
        // A file without the column is of the one session that there is.
        let only = self.sessions.len() == 1 && other.sessions.len() == 1;
        let only = only && (is_one(&self.sessions) || is_one(&other.sessions));
        self.sessions.iter().position(|known| known == name).or(only.then_some(0))
    }

    /// Where the arm stood then; `None` is elsewhere, where the base is known.
    fn base(&self, other: &Problem<'_>, number: usize) -> Result<Option<usize>, DiagnoseError> {
        let bases = &self.stands.bases;
        let Base { session, beside } = &other.stands.bases[number];
        let found = self.session(other, session).and_then(|session| {
            let mut own = (0..bases.len()).filter(|k| bases[*k].session == self.sessions[session]);
            let named = own.clone().find(|k| bases[*k].beside == *beside);
            // Where there is one thing beside the arm, its name says nothing.
            named.or_else(|| {
                own.next().filter(|_| bases.len() == 1 && other.stands.bases.len() == 1)
            })
        });
        // Of a file without sessions a camera stands where the one of its name stood.
        let same = |k: &usize| bases[*k].beside == *beside && session.is_empty();
        let mut named = (0..bases.len()).filter(|k| same(k) && !beside.is_empty());
        let found = found.or_else(|| named.next().filter(|_| named.next().is_none()));
        // Places that are fitted to these rows alone take up where the arm stands.
        let takes_base = |aim: &Aim| aim.seen.has_place() && aim.free.starts_with(&[0, 1, 2]);
        let rows = other.data.rows.iter().zip(&other.stands.base_of);
        let mut own = rows.filter(|(_, base)| **base == number).map(|(row, _)| row);
        let mut is_free = || own.all(|row| row.aim.as_deref().is_some_and(takes_base));
        if found.is_none() && other.is_unknown(Nuisance::BaseFrame) && !is_free() {
            return Err(self.new_frame(other, other.stands.base(number).unwrap_or(session.clone())));
        }
        Ok(found)
    }

    /// Where on the tool it was then.
    fn mount(&self, other: &Problem<'_>, name: &String) -> Result<usize, DiagnoseError> {
        let (mounts, others) = (&self.stands.mounts, &other.stands.mounts);
        let found = mounts.iter().position(|known| known == name);
        let only = mounts.len() == 1 && others.len() == 1;
        found.or(only.then_some(0)).ok_or_else(|| self.new_frame(other, name.clone()))
    }

    fn new_frame(&self, other: &Problem<'_>, session: String) -> DiagnoseError {
        let bases = (0..self.stands.bases.len()).filter_map(|k| self.stands.base(k));
        let known = bases.chain((0..self.stands.mounts.len()).filter_map(|k| self.stands.mount(k)));
        let known: Vec<String> = known.collect();
        let known = if known.is_empty() { &self.sessions } else { &known };
        let file = other.data.file.clone();
        DiagnoseError::NewSession { file, session, known: known.join(", ") }
    }
}
