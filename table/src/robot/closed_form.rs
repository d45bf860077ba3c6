//! Which closed form the inverse kinematics of an arm has, read off its table.
//!
//! Only what is exactly zero counts: an axis that misses another by a micrometre does not meet it. Such an arm has the closed
//! form of the [nearest](super::nearest) table, and steps behind it.

use stiffarm_kernels::Axes;

use super::families::{Chain, elbow_angle, family};
use super::frames::Refused;
use super::model::Robot;
use super::sliding::Sliding;

/// What is chosen to be given of seven joints, of which a pose leaves one free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Redundancy {
    /// The value of a joint, from 0.
    Joint(usize),
    /// The angle of the elbow about the line from shoulder to wrist.
    ElbowAngle,
}

/// The closed form of an arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosedForm {
    /// The joint, from 0, whose value is given: the last or the first of seven, or any where it is found by search.
    pub given: Option<usize>,
    /// Whether it is that of the arm read from tip to base.
    pub reversed: bool,
    /// What of its geometry it is made of.
    pub family: Family,
}

/// What makes a closed form, in the order from base to tip, or from tip to base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Three joints place a point that those behind them only turn about.
    Wrist {
        /// What the first three are.
        position: Position,
        /// Joints behind them, from 0 to 3: the axes of three meet in the point.
        behind: usize,
    },
    /// Three axes are parallel.
    ThreeParallel {
        /// Whether a joint stands before them.
        before: bool,
        /// Joints behind them, from 0 to 2: the axes of two meet.
        behind: usize,
        /// Whether the joint behind them is prismatic and moves along them.
        lift: bool,
    },
    /// Two parallel axes place a point of the plane.
    TwoParallel,
    /// Three axes that meet, an elbow, and three that meet, with [the elbow's angle](Redundancy::ElbowAngle) given.
    ElbowAngle,
    /// None: every solution of six axes is searched for, with the joint `third` of them, from 0, in the middle of
    /// [the equations](stiffarm_kernels::Axes::search).
    Search {
        /// The joint, from 0.
        third: usize,
    },
}

/// What the first three axes of an arm with a wrist are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// 2 and 3 are parallel.
    SecondParallelThird,
    /// 1 and 2 are parallel.
    FirstParallelSecond,
    /// 1 and 2 meet.
    FirstMeetsSecond,
    /// 2 and 3 meet.
    SecondMeetsThird,
    /// None of them is near being parallel to the next or meeting it.
    General,
    /// Some of them are prismatic.
    Sliding(Sliding),
}

impl ClosedForm {
    /// What makes it, in words.
    pub fn sentence(self) -> String {
        let shift = usize::from(self.given == Some(0));
        let axes = |numbers: &[usize]| {
            let each = numbers.iter().map(|k| if self.reversed { 7 - k } else { *k } + shift);
            let mut each: Vec<usize> = each.collect();
            each.sort_unstable();
            each.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
        };
        let shape = match self.family {
            Family::ThreeParallel { before, behind, lift } => {
                let first = 1 + usize::from(before);
                let parallel = axes(&[first, first + 1, first + 2]);
                let along = if lift { ", and the last joint slides along them" } else { "" };
                match behind {
                    2 => format!("axes {parallel} are parallel, {} meet", axes(&[5, 6])),
                    _ => format!("axes {parallel} are parallel{along}"),
                }
            }
            Family::Wrist { position, behind } => {
                let first = match position {
                    Position::SecondParallelThird => format!("{} are parallel", axes(&[2, 3])),
                    Position::FirstParallelSecond => format!("{} are parallel", axes(&[1, 2])),
                    Position::FirstMeetsSecond => format!("{} meet", axes(&[1, 2])),
                    Position::SecondMeetsThird => format!("{} meet", axes(&[2, 3])),
                    Position::General => format!("{} in general position", axes(&[1, 2, 3])),
                    Position::Sliding(sliding) => {
                        format!("{} {}", axes(&[1, 2, 3]), sliding.words())
                    }
                };
                match behind {
                    3 => format!("axes {} meet in a point, {first}", axes(&[4, 5, 6])),
                    2 => format!("axes {} meet, {first}", axes(&[4, 5])),
                    _ => format!("axes {first}"),
                }
            }
            Family::TwoParallel => "axes 1, 2 are parallel".to_owned(),
            Family::ElbowAngle => {
                "the elbow angle is given, axes 1, 2, 3 meet in a point, 5, 6, 7 in another"
                    .to_owned()
            }
            Family::Search { .. } => "a search, not a closed form".to_owned(),
        };
        match self.given {
            Some(joint) => format!("joint {} is given, {shape}", joint + 1),
            None => shape,
        }
    }

    /// What the bits of a branch's number choose, from the highest: each one of two.
    pub fn bits(self) -> Vec<&'static str> {
        let (shoulder, elbow, wrist) = match self.family {
            Family::Wrist { position: Position::Sliding(sliding), behind } => {
                let (shoulder, elbow) = sliding.bits();
                (shoulder, elbow, behind == 3)
            }
            Family::Wrist { behind, .. } => (true, true, behind == 3),
            Family::ThreeParallel { before, behind, .. } => (before, true, behind == 2),
            Family::TwoParallel => (false, true, false),
            Family::ElbowAngle => (true, true, true),
            Family::Search { .. } => (false, false, false),
        };
        let each = [("shoulder", shoulder), ("elbow", elbow), ("wrist", wrist)];
        each.into_iter().filter(|(_, has)| *has).map(|(name, _)| name).collect()
    }

    /// The number of branches.
    pub fn branches(self) -> usize {
        match self.family {
            Family::Search { .. } => Axes::<6>::MOST,
            _ => 1 << self.bits().len(),
        }
    }

    /// Whether its solutions are searched for.
    pub fn is_search(self) -> bool {
        matches!(self.family, Family::Search { .. })
    }

    /// The joints, from 0, that the closed form finds, of so many.
    pub(crate) fn inner(self, dof: usize) -> core::ops::Range<usize> {
        match self.given {
            None => 0..dof,
            Some(0) => 1..dof,
            Some(_) => 0..dof.saturating_sub(1),
        }
    }

    /// Whether it is one of a spherical wrist, or of three parallel axes, of six joints that turn.
    pub fn is_of_six(self) -> bool {
        match self.family {
            Family::Wrist { behind, .. } => behind == 3,
            Family::ThreeParallel { behind, .. } => behind == 2,
            Family::ElbowAngle | Family::Search { .. } => true,
            Family::TwoParallel => false,
        }
    }
}

impl Robot {
    /// The closed form of its table's inverse kinematics.
    ///
    /// # Errors
    /// [`Refused`] where it has none that is known: what stands in the way.
    pub fn closed_form(&self) -> Result<ClosedForm, Refused> {
        const FAMILIES: &str = "a closed form is known of six joints, of which the last three axes meet in a point and \
                                the first three turn, or some of them slide; or of which 2, 3, 4 are parallel and 5 meets 6; or the same from tip to base; of seven that \
                                are such an arm without the first or the last; and of fewer (docs/inverse.md)";
        let no = |what: String| {
            let message = format!("no closed form of the inverse kinematics: {what}");
            Refused { message, help: FAMILIES.to_owned() }
        };
        for joint in &self.joints {
            if !joint.beta.is_zero() {
                return Err(no(format!("the row of `{}` has a beta", joint.name)));
            }
        }
        let n = self.dof();
        // Axes in general position take many more operations.
        let form = |general: bool| match (n, self.redundancy) {
            (2..=6, None) => self.form_of(0..n, None, general),
            (7, Some(Redundancy::ElbowAngle)) => {
                let family = elbow_angle(&Chain::new(self, 0..7)).map_err(str::to_owned)?;
                Ok(ClosedForm { given: None, reversed: false, family })
            }
            (7, Some(Redundancy::Joint(given @ 6))) => self.form_of(0..6, Some(given), general),
            (7, Some(Redundancy::Joint(given @ 0))) => self.form_of(1..7, Some(given), general),
            (7, Some(Redundancy::Joint(given))) => {
                let number = given + 1;
                Err(format!("with joint {number} given the other axes stand as that joint does"))
            }
            (2..=6, Some(_)) => Err(format!("a pose leaves none of {n} joints free to be given")),
            (7, None) => self.form_of(0..6, Some(6), general).or_else(|last| {
                self.form_of(1..7, Some(0), general).map_err(|first| {
                    format!("with joint 7 given, {last}; with joint 1 given, {first}")
                })
            }),
            _ => Err(format!("the arm has {n} joints")),
        };
        form(false).or_else(|_| form(true)).map_err(no)
    }

    /// Of neighbouring joints, with another one given.
    fn form_of(
        &self,
        joints: core::ops::Range<usize>,
        given: Option<usize>,
        general: bool,
    ) -> Result<ClosedForm, String> {
        let first = joints.start;
        let chain = || Chain::new(self, joints.clone());
        let six = joints.len() == 6;
        let family = |chain: &Chain| family(chain, general);
        match (family(&chain()), six.then(|| family(&chain().reversed()))) {
            (Ok(family), _) => Ok(ClosedForm { given, reversed: false, family }),
            (_, Some(Ok(family))) => Ok(ClosedForm { given, reversed: true, family }),
            (Err(what), _) if first > 0 => Err(format!("{what} (counted from joint 2)")),
            (Err(what), _) => Err(what.to_owned()),
        }
    }
}
