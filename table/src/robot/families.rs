//! What of neighbouring joints makes a closed form: which axes are parallel, meet or slide.

use super::closed_form::{Family, Position};
use super::model::{Angle, Convention, Joint, Motion, Robot, Value};
use super::nearest::OFF;
use super::sliding;

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
    pub fn new(robot: &'r Robot, joints: core::ops::Range<usize>) -> Chain<'r> {
        let links = &robot.joints[robot.first_link() + joints.start..][..joints.len() - 1];
        Chain {
            a: links.iter().map(|row| &row.a).collect(),
            alpha: links.iter().map(|row| &row.alpha).collect(),
            joints: robot.joints[joints].iter().collect(),
            tool: robot.tool_on_axis(),
            size: robot.symbols().is_empty().then(|| robot.size()),
        }
    }

    pub fn reversed(mut self) -> Chain<'r> {
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

/// Three axes that meet, an elbow off them, and three that meet.
pub(super) fn elbow_angle(chain: &Chain) -> Result<Family, &'static str> {
    let meet = |k: usize| chain.meets(k) && chain.meets(k + 1) && chain.offset(k + 1);
    // What axis 4 turns, and what turns it.
    let off =
        |k: usize, d: usize| !chain.a[k - 1].is_zero() || !chain.offset(d) && !chain.parallel(k);
    match () {
        () if !chain.turns(1..=7) => Err("of an arm with prismatic joints no elbow angle is known"),
        () if !meet(1) => Err("axes 1, 2, 3 do not meet in a point, and there is no elbow angle"),
        () if !meet(5) => Err("axes 5, 6, 7 do not meet in a point, and there is no elbow angle"),
        () if chain.offset(3) || !off(3, 3) || !off(4, 5) => {
            Err("the elbow is where the shoulder or the wrist is, and has no angle")
        }
        () => Ok(Family::ElbowAngle),
    }
}

/// What makes a closed form of a chain, with axes in general position or without.
pub(super) fn family(chain: &Chain, general: bool) -> Result<Family, &'static str> {
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
        () => Err(
            "of axes 1, 2, 3 none is parallel to the next or meets it, but one nearly is or does, or has a parameter",
        ),
    }
}
