//! The nearest table that has a closed form, of an arm as it was measured: its axes miss each other by micrometres, its
//! parallel axes are parallel to a part in a thousand.

use num_rational::Ratio;

use super::closed_form::{ClosedForm, Family, Position, Redundancy};
use super::frames::Refused;
use super::model::{Angle, Motion, Output, Robot, Value};

/// What of an arm's size, and of a radian, an entry may differ from that of the nearest table. Makers build to a tenth of
/// it; at all of it, steps still lead from the one arm to the other (`codegen/tests/inverse/steps.rs`).
pub(super) const OFF: f64 = 1e-2;

/// Angles between axes that are so near to quarter turns, rad, count as such in the nearest table: its closed form is then half
/// as long. It is a few times what makers build to; an angle that is meant is left alone.
const SQUARE: f64 = 2e-3;

/// What the steps behind a closed form take.
pub const STEPPED: [Output; 2] = [Output::Pose, Output::Jacobian];

/// What set-points take besides.
pub const DEFLECTION: Output = Output::DeflectionWithGravity;

/// The first three axes of a spherical wrist's arm, the most usual first.
const POSITIONS: [Position; 4] = [
    Position::SecondParallelThird,
    Position::FirstMeetsSecond,
    Position::SecondMeetsThird,
    Position::FirstParallelSecond,
];

impl Robot {
    /// The closed form of its table, or else, where that has numbers alone, of the nearest table which has one, or else a
    /// search.
    ///
    /// # Errors
    /// [`Refused`] where no table with a closed form is near and a search does not do: what stands in the way of its own.
    pub fn nearest_closed_form(&self) -> Result<ClosedForm, Refused> {
        let refused = match self.closed_form() {
            Ok(form) => return Ok(form),
            Err(refused) => refused,
        };
        let given: &[Option<usize>] = match (self.dof(), self.redundancy) {
            (6, None) => &[None],
            (7, None) => &[Some(6), Some(0)],
            (7, Some(Redundancy::Joint(0))) => &[Some(0)],
            (7, Some(Redundancy::Joint(6))) => &[Some(6)],
            _ => &[],
        };
        let elbow = ClosedForm { given: None, reversed: false, family: Family::ElbowAngle };
        let elbow = (self.redundancy == Some(Redundancy::ElbowAngle)).then_some(elbow);
        if !self.symbols().is_empty() {
            return Err(refused);
        }
        let wrist = |position| Family::Wrist { position, behind: 3 };
        let parallel = Family::ThreeParallel { before: true, behind: 2, lift: false };
        let families = POSITIONS.map(wrist).into_iter().chain([parallel]);
        let forms = families
            .flat_map(|family| [false, true].map(|reversed| (reversed, family)))
            .flat_map(|(reversed, family)| {
                let with =
                    move |given: &Option<usize>| ClosedForm { given: *given, reversed, family };
                given.iter().map(with)
            });
        let turns = |form: &ClosedForm| {
            let mut inner = self.joints[form.inner(self.dof())].iter();
            inner.all(|joint| joint.motion == Motion::Revolute)
        };
        let forms = forms.chain(elbow.filter(|_| self.dof() == 7)).filter(turns);
        let near = forms.filter_map(|form| {
            let table = self.nearest(form);
            (table.closed_form() == Ok(form)).then(|| (self.off(&table), form))
        });
        let nearest = near.min_by(|(a, _), (b, _)| a.total_cmp(b));
        let nearest = nearest.filter(|(off, _)| *off < OFF).map(|(_, form)| form);
        match nearest.map_or_else(|| self.searched(), Ok) {
            Ok(form) => Ok(form),
            Err(Some(why)) => {
                Err(Refused { message: format!("{}; {why}", refused.message), ..refused })
            }
            Err(None) => Err(refused),
        }
    }

    /// Whether its readings are its joint values, and its lengths those of its table.
    pub fn is_as_its_table(&self) -> bool {
        self.beyond.moves.is_empty()
    }

    /// Whether the closed form tells its joint values without a step behind.
    pub fn has_closed_form(&self) -> bool {
        !self.beyond.grows() && self.closed_form().is_ok()
    }

    /// Whether set-points under a load are generated: where the inverse kinematics is, and the deflection under weights.
    pub fn has_set_points(&self) -> bool {
        let deflects = || self.generated().contains(&DEFLECTION);
        self.inverse_kinematics.is_some() && deflects()
    }

    /// The nearest table with a closed form: the table itself where it has it, else but for the entries that are zero in it,
    /// parallel or at right angles.
    pub fn nearest(&self, form: ClosedForm) -> Robot {
        let mut table = self.clone();
        if form.is_search() || self.closed_form() == Ok(form) {
            return table;
        }
        let start = form.inner(self.dof()).start;
        let first = self.first_link() + start;
        // Links and offsets as the form counts them, from its own base.
        let link = |k: usize| first + if form.reversed { 5 - k } else { k - 1 };
        let offset = |k: usize| start + if form.reversed { 6 - k } else { k - 1 };
        for joint in &mut table.joints {
            joint.beta = Angle::ZERO;
            snap(&mut joint.alpha, SQUARE);
        }
        let (meeting, parallel): (&[usize], &[usize]) = match form.family {
            Family::ThreeParallel { .. } => (&[5], &[2, 3]),
            Family::TwoParallel => (&[], &[1]),
            Family::ElbowAngle => (&[1, 2, 5, 6], &[]),
            Family::Search { .. } => (&[], &[]),
            Family::Wrist { position, .. } => match position {
                Position::SecondParallelThird => (&[4, 5], &[2]),
                Position::FirstParallelSecond => (&[4, 5], &[1]),
                Position::FirstMeetsSecond => (&[1, 4, 5], &[]),
                Position::SecondMeetsThird => (&[2, 4, 5], &[]),
                Position::General | Position::Sliding(_) => (&[4, 5], &[]),
            },
        };
        meeting.iter().for_each(|k| table.joints[link(*k)].a = Value::ZERO);
        let points: &[usize] = match form.family {
            Family::Wrist { .. } => &[5],
            Family::ElbowAngle => &[2, 6],
            _ => &[],
        };
        points.iter().for_each(|k| table.joints[offset(*k)].d = Value::ZERO);
        parallel.iter().for_each(|k| snap(&mut table.joints[link(*k)].alpha, OFF));
        table
    }

    /// The largest difference of an entry from that of another table: of a length as a part of the arm's size, of an angle
    /// in rad.
    fn off(&self, other: &Robot) -> f64 {
        let size = self.size();
        let rows = self.joints.iter().zip(&other.joints);
        let each = rows.flat_map(|(a, b)| {
            let lengths = [(&a.a, &b.a), (&a.d, &b.d)];
            let angles = [(&a.alpha, &b.alpha), (&a.beta, &b.beta)];
            let lengths = lengths.map(|(a, b)| (a.or_zero() - b.or_zero()) / size);
            let angles = angles.map(|(a, b)| a.or_zero() - b.or_zero());
            lengths.into_iter().chain(angles)
        });
        each.fold(0.0, |most, off| most.max(off.abs()))
    }

    /// The sum of the table's lengths, m; parameters count as none.
    pub fn size(&self) -> f64 {
        let lengths = self.joints.iter().flat_map(|joint| [&joint.a, &joint.d]);
        lengths.map(|length| length.or_zero().abs()).sum()
    }
}

/// Makes an angle within so much of a multiple of a quarter turn that multiple.
fn snap(angle: &mut Angle, within: f64) {
    let Some(radians) = angle.radians() else { return };
    let quarters = (radians / core::f64::consts::FRAC_PI_2).round();
    if (radians - quarters * core::f64::consts::FRAC_PI_2).abs() < within {
        *angle = Angle::Pi(Ratio::new(quarters as i64, 2));
    }
}
