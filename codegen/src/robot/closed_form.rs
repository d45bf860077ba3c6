//! Which closed form the inverse kinematics of an arm has, read off its table.
//!
//! Only what is exactly zero counts: an axis that misses another by a micrometre does not meet it. Such an arm has the closed
//! form of the [nearest](super::nearest) table, and steps behind it.

use super::frames::Refused;
use super::model::{Angle, Convention, Joint, Motion, Robot, Value};
use super::nearest::OFF;
use super::sliding::{self, Sliding};

/// The closed form of an arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosedForm {
    /// The joint, from 0, whose value is given: the last or the first of seven.
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
        };
        let each = [("shoulder", shoulder), ("elbow", elbow), ("wrist", wrist)];
        each.into_iter().filter(|(_, has)| *has).map(|(name, _)| name).collect()
    }

    /// The number of branches.
    pub fn branches(self) -> usize {
        1 << self.bits().len()
    }

    /// The joints, from 0, that the closed form finds, of so many.
    pub(crate) fn inner(self, dof: usize) -> core::ops::Range<usize> {
        match self.given {
            None => 0..dof,
            Some(0) => 1..dof,
            Some(_) => 0..dof - 1,
        }
    }

    /// Whether it is one of a spherical wrist, or of three parallel axes, of six joints that turn.
    pub(crate) fn is_of_six(self) -> bool {
        match self.family {
            Family::Wrist { behind, .. } => behind == 3,
            Family::ThreeParallel { behind, .. } => behind == 2,
            Family::TwoParallel => false,
        }
    }
}

/// What of some neighbouring joints and the fixed transforms between them makes a closed form.
pub(super) struct Chain<'r> {
    /// Length along x from each axis to the next.
    pub a: Vec<&'r Value>,
    /// Angle about x from each axis to the next.
    pub alpha: Vec<&'r Angle>,
    pub joints: Vec<&'r Joint>,
    /// Whether the tool's origin is on the last axis, and at the last frame's origin.
    pub tool: [bool; 2],
    /// The arm's size, m, if the table has no parameters.
    size: Option<f64>,
}

impl<'r> Chain<'r> {
    fn new(robot: &'r Robot, joints: core::ops::Range<usize>) -> Chain<'r> {
        let links = &robot.joints[robot.first_link() + joints.start..][..joints.len() - 1];
        Chain {
            a: links.iter().map(|row| &row.a).collect(),
            alpha: links.iter().map(|row| &row.alpha).collect(),
            joints: robot.joints[joints].iter().collect(),
            tool: robot.tool_on_axis(),
            size: robot.symbols().is_empty().then(|| robot.size()),
        }
    }

    fn reversed(mut self) -> Chain<'r> {
        self.a.reverse();
        self.alpha.reverse();
        self.joints.reverse();
        self
    }

    /// Whether axes k and k + 1 are parallel, from 1.
    pub fn parallel(&self, k: usize) -> bool {
        is_half_turns(self.alpha[k - 1])
    }

    /// Whether axes k and k + 1 meet and are not parallel, from 1.
    fn meets(&self, k: usize) -> bool {
        self.a[k - 1].is_zero() && !self.parallel(k)
    }

    /// Whether axes k and k + 1 are nowhere near being parallel or meeting, from 1, in numbers.
    fn general(&self, k: usize) -> bool {
        let (a, alpha) = (self.a[k - 1].number(), self.alpha[k - 1].radians());
        match (self.size, a, alpha) {
            (Some(size), Some(a), Some(alpha)) => {
                a.to_f64().abs() > OFF * size && libm::sin(alpha).abs() > OFF
            }
            _ => false,
        }
    }

    /// Whether the point that the joints behind the third only turn about is on axis 3.
    pub fn point_on_third(&self) -> bool {
        let [on_axis, at_origin] = self.tool;
        match self.joints.len() {
            3 => on_axis,
            4 => self.a[2].is_zero() && (self.parallel(3) || at_origin && self.offset(4)),
            _ => self.a[2].is_zero() && (self.parallel(3) || self.offset(4)),
        }
    }

    /// Whether joint k, from 1, has no offset.
    fn offset(&self, k: usize) -> bool {
        self.joints[k - 1].d.is_zero()
    }

    fn turns(&self, joints: core::ops::RangeInclusive<usize>) -> bool {
        joints.into_iter().all(|k| self.joints[k - 1].motion == Motion::Revolute)
    }
}

/// Whether an angle is exactly 0 or π.
pub(super) fn is_half_turns(angle: &Angle) -> bool {
    matches!(angle, Angle::Pi(turn) if *turn.denom() == 1) || angle.is_zero()
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
        let form = |general: bool| match n {
            2..=6 => self.form_of(0..n, None, general),
            7 => self.form_of(0..6, Some(6), general).or_else(|last| {
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

    /// The row, from 0, that holds the link from axis 1 to axis 2.
    pub(super) fn first_link(&self) -> usize {
        match self.convention {
            Convention::Standard => 0,
            Convention::Modified => 1,
        }
    }

    /// Whether the tool's origin is on the last axis, and there where the last frame's origin is. Of a parameter it is not known, and
    /// told not to be.
    fn tool_on_axis(&self) -> [bool; 2] {
        let metres = |value: &Value| value.number().map_or(f64::NAN, |n| n.to_f64());
        let [x, y, z] = self.tool.translation.each_ref().map(metres);
        let [x, y, z] = match (self.convention, self.joints.last()) {
            (Convention::Standard, Some(last)) => {
                let alpha = last.alpha.radians().unwrap_or(f64::NAN);
                let (s, c) = (libm::sin(alpha), libm::cos(alpha));
                [x + metres(&last.a), c * y - s * z, s * y + c * z]
            }
            _ => [x, y, z],
        };
        // Rounding of a right angle's cosine.
        let none = |x: f64| x.abs() < 1e-15;
        [none(x) && none(y), none(z)]
    }
}

fn family(chain: &Chain, general: bool) -> Result<Family, &'static str> {
    let n = chain.joints.len();
    if n == 2 {
        let two = chain.turns(1..=2) && chain.parallel(1) && !chain.a[0].is_zero();
        return match two && !chain.tool[0] {
            true => Ok(Family::TwoParallel),
            false => Err("of two joints only parallel axes that turn the tool's origin have one"),
        };
    }
    if let Some(parallel) = three_parallel(chain)? {
        return Ok(parallel);
    }
    match n {
        4..=6 if !chain.turns(4..=n) => return Err("a joint behind the third is prismatic"),
        6 if !(chain.meets(4) && chain.meets(5) && chain.offset(5)) => {
            return Err(
                "axes 4, 5, 6 do not meet in a point, nor are 2, 3, 4 parallel with 5 meeting 6",
            );
        }
        5 if !chain.meets(4) => return Err("axes 4 and 5 do not meet, nor are 2, 3, 4 parallel"),
        _ => {}
    }
    let position = match chain.turns(1..=3) {
        true => turning(chain, general)?,
        false => Position::Sliding(sliding::of(chain)?),
    };
    Ok(Family::Wrist { position, behind: n - 3 })
}

/// Three parallel axes, if the chain has them where they count.
fn three_parallel(chain: &Chain) -> Result<Option<Family>, &'static str> {
    let n = chain.joints.len();
    // Joints before and behind the three, and whether that behind them slides along them.
    let candidates: &[(usize, usize, bool)] = match n {
        3 => &[(0, 0, false)],
        4 => &[(1, 0, false), (0, 0, true), (0, 1, false)],
        5 => &[(1, 1, false)],
        _ => &[(1, 2, false)],
    };
    for (before, behind, lift) in candidates.iter().copied() {
        let first = before + 1;
        let parallel = chain.parallel(first) && chain.parallel(first + 1);
        let along = !lift
            || chain.parallel(first + 2) && chain.joints[first + 2].motion == Motion::Prismatic;
        let turns = chain.turns(1..=before + 3 + behind);
        if !(parallel && along && turns && (behind < 2 || chain.meets(5))) {
            continue;
        }
        let links = [first, first + 1].iter().any(|k| chain.a[k - 1].is_zero());
        let more = before > 0 && chain.parallel(1) || behind > 0 && chain.parallel(first + 2);
        return match links || more {
            true if n == 4 && more && !links => continue,
            true => Err("of axes 1 to 5 more than 2, 3, 4 are parallel, or two of those are one"),
            false => Ok(Some(Family::ThreeParallel { before: before > 0, behind, lift })),
        };
    }
    Ok(None)
}

/// What three joints that turn are.
fn turning(chain: &Chain, general: bool) -> Result<Position, &'static str> {
    if chain.point_on_third() {
        return Err(match chain.joints.len() {
            3 => "the tool's origin is on axis 3",
            4 => "the tool's origin, or the point of axis 4 beside it, is on axis 3",
            5 => "the point where axes 4, 5 meet is on axis 3",
            _ => "the point where axes 4, 5, 6 meet is on axis 3",
        });
    }
    if chain.parallel(1) && chain.parallel(2) {
        return Err("axes 1, 2, 3 are parallel, and the wrist's point cannot leave a plane");
    }
    if [1, 2].iter().any(|k| chain.parallel(*k) && chain.a[k - 1].is_zero()) {
        return Err("two of the first three axes are one");
    }
    if chain.meets(1) && chain.meets(2) && chain.offset(2) {
        return Err("axes 1, 2, 3 meet in a point, from which the wrist's keeps its distance");
    }
    match () {
        () if chain.parallel(2) => Ok(Position::SecondParallelThird),
        () if chain.parallel(1) => Ok(Position::FirstParallelSecond),
        () if chain.meets(1) => Ok(Position::FirstMeetsSecond),
        () if chain.meets(2) => Ok(Position::SecondMeetsThird),
        () if general && chain.general(1) && chain.general(2) => Ok(Position::General),
        () => Err("of axes 1, 2, 3 none is parallel to the next or meets it, but one nearly is or does, or has a parameter"),
    }
}
