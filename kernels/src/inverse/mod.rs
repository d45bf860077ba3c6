//! What an inverse kinematics returns, and which of its branches a controller takes.

#[cfg(feature = "batch")]
pub(crate) mod at_once;
mod search;
mod set_points;
mod steps;

use core::f64::consts::TAU;

use crate::{Arm, Motion, Pose, Scalar, Unstable};

pub use search::Axes;
#[doc(hidden)]
pub use set_points::unloaded;
pub use set_points::{Elastic, Gives, SetPoints};
use steps::missed;
pub use steps::{AtRest, Steps};

/// An arm's readings and the joint values that they mean, which are the same but where an `[[effect]]` moves joints.
pub trait JointValues<const N: usize, S: Scalar = f64>: Arm<N, S> {
    /// The joint values that readings mean, rad.
    #[inline(always)]
    fn joints(&self, readings: &[S; N]) -> [S; N] {
        *readings
    }

    /// The posture at joint values, not at readings.
    #[inline(always)]
    fn at_joints(&self, joints: &[S; N]) -> Self::Posture {
        self.posture(joints)
    }
}

/// An arm of N joints whose inverse kinematics has been generated, in K branches.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has not been generated with its inverse kinematics, or not for these joints and branches",
    note = "ask for it by its name, among the `outputs` of its table, its robot file or on the command line"
)]
pub trait Inverse<const N: usize, const K: usize, S: Scalar = f64>: JointValues<N, S> {
    /// How many steps follow the closed form.
    const STEPS: Steps;

    /// The joint, from 0, whose value every branch has as `near` has it: of seven joints, the pose leaves one free.
    const GIVEN: Option<usize> = None;

    /// Every branch of the closed form at a pose of the tool, base axes: joint values by the arm's table, or by the nearest
    /// table that has a closed form. A joint that the pose leaves free stays where `near`, readings, has it, and so does
    /// [the joint that is given](Inverse::GIVEN).
    fn closed_form(&self, pose: &Pose<S>, near: &[S; N]) -> Solutions<S, N, K>;

    /// Every branch of the rigid arm at a pose of the tool, base axes: the readings at which its tool stands there. It is
    /// the closed form, with [steps](Inverse::STEPS) behind where that is another table's, or tells other values
    /// than readings.
    fn inverse_kinematics(&self, pose: &Pose<S>, near: &[S; N]) -> Solutions<S, N, K>;
}

/// An arm of seven joints that has been generated with its elbow's angle given: the angle of the elbow about the line from
/// shoulder to wrist, rad. It is zero where the elbow is in the plane of axis 1 and that line, on the side to which axis 1
/// points, and grows about the direction from shoulder to wrist.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has not been generated with its elbow's angle given, or not for these joints and branches",
    note = "ask for `inverse_kinematics given elbow_angle` among its `outputs`"
)]
pub trait ElbowAngle<const N: usize, const K: usize, S: Scalar = f64>: Inverse<N, K, S> {
    /// The elbow's angle at readings; [`Inverse::inverse_kinematics`] keeps that of `near`.
    fn elbow_angle(&self, q: &[S; N]) -> S;

    /// [`Inverse::closed_form`] with the elbow at an angle.
    fn closed_form_at(&self, pose: &Pose<S>, near: &[S; N], elbow_angle: S) -> Solutions<S, N, K>;

    /// [`Inverse::inverse_kinematics`] with the elbow at an angle. Steps behind the closed form of another table move it by
    /// about as much as that differs.
    fn inverse_kinematics_at(
        &self,
        pose: &Pose<S>,
        near: &[S; N],
        elbow_angle: S,
    ) -> Solutions<S, N, K>;
}

/// Every branch of an inverse kinematics, whether it reaches the pose or not, in an order that is stable along a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solutions<S, const N: usize, const K: usize> {
    /// Joint values of each branch, rad, from −π to π (prismatic joint: m). Of eight branches shoulder, elbow and wrist are
    /// the bits of the number, from the highest; of fewer those of them that the arm has.
    pub q: [[S; N]; K],
    /// How far the tool's origin is from the pose's, m: rounding where the branch reaches it.
    pub distance: [S; K],
    /// How far the last axis is from the pose's, as the length between unit vectors: rounding where the branch reaches it.
    /// Behind [`Steps`], and of fewer than six joints, it is how far the axes are turned from the pose's, twice the sine of
    /// half the angle.
    pub tilt: [S; K],
    /// Which joints turn: these alone have whole turns.
    pub motion: [Motion; N],
}

/// One branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<S, const N: usize> {
    /// Its number.
    pub branch: usize,
    /// Its joint values, rad (prismatic joint: m).
    pub q: [S; N],
    /// How far the tool's origin is from the pose's, m.
    pub distance: S,
    /// How far the axes are turned from the pose's, as in [`Solutions::tilt`].
    pub tilt: S,
    /// Which joints turn.
    pub motion: [Motion; N],
}

impl<S: Scalar, const N: usize, const K: usize> Solutions<S, N, K> {
    /// Each branch's joint values replaced by readings, and by what they miss the pose ([`AtRest::follow`]). A branch at
    /// which the arm does not bear its load, or that was not found, stays as it is, and misses the pose by an infinite distance.
    pub fn each(mut self, follow: impl Fn([S; N]) -> Result<([S; N], [S; 2]), Unstable>) -> Self {
        (0..K).for_each(|branch| self.follow(branch, &follow));
        self
    }

    /// [`Solutions::each`] of one branch.
    #[inline(always)]
    pub(crate) fn follow(
        &mut self,
        branch: usize,
        follow: impl Fn([S; N]) -> Result<([S; N], [S; 2]), Unstable>,
    ) {
        let infinite = [S::lit(f64::INFINITY); 2];
        let none = (self.distance[branch] - S::lit(f64::from(f32::MAX))).is_positive();
        let followed = if none { Err(Unstable) } else { follow(self.q[branch]) };
        let (q, missed) = followed.unwrap_or((self.q[branch], infinite));
        (self.q[branch], [self.distance[branch], self.tilt[branch]]) = (q, missed);
    }
}

impl<S: Scalar + PartialOrd + Into<f64>, const N: usize, const K: usize> Solutions<S, N, K> {
    /// Every branch.
    pub fn iter(&self) -> impl Iterator<Item = Solution<S, N>> + '_ {
        (0..K).map(|branch| Solution {
            branch,
            q: self.q[branch],
            distance: self.distance[branch],
            tilt: self.tilt[branch],
            motion: self.motion,
        })
    }

    /// The branches that miss the pose by no more than this: m, and rad.
    pub fn reached(&self, distance: f64, tilt: f64) -> impl Iterator<Item = Solution<S, N>> + '_ {
        self.iter().filter(move |s| s.distance.into() <= distance && s.tilt.into() <= tilt)
    }

    /// Of the branches that miss the pose by no more than this (m, rad) that with the least change of the joints from
    /// `near`, by the sum of squares; each joint by whole turns as near as its limits allow. `None` where no branch is within
    /// the limits.
    pub fn nearest(
        &self,
        near: &[S; N],
        limits: &[Option<[f64; 2]>; N],
        (distance, tilt): (f64, f64),
    ) -> Option<Solution<S, N>> {
        nearest_branch(self.reached(distance, tilt), near, limits)
    }

    /// The first, in the order of [`Solutions::nearest`], whose readings by `follow` are within the limits and miss the
    /// pose by no more than this (m, rad).
    pub fn first(
        mut self,
        near: &[S; N],
        limits: &[Option<[f64; 2]>; N],
        (distance, tilt): (f64, f64),
        follow: impl Fn([S; N]) -> Option<([S; N], [S; 2])>,
    ) -> Option<Solution<S, N>> {
        let within = |q: &[S; N]| {
            q.iter().zip(limits).all(|(q, limits)| {
                limits.is_none_or(|[low, high]| (low..=high).contains(&(*q).into()))
            })
        };
        for _ in 0..K {
            let Solution { branch, q, motion, .. } =
                self.nearest(near, limits, (f64::MAX, f64::MAX))?;
            if let Some((q, [d, t])) = follow(q)
                && within(&q)
                && d.into() <= distance
                && t.into() <= tilt
            {
                return Some(Solution { branch, q, distance: d, tilt: t, motion });
            }
            self.distance[branch] = S::lit(f64::INFINITY);
        }
        None
    }
}

impl<S: Scalar + Into<f64>, const N: usize> Solution<S, N> {
    /// Each joint by whole turns as near to `near` as its limits allow; `None` where no turn is within them.
    #[inline(always)]
    pub fn turned(&self, near: &[S; N], limits: &[Option<[f64; 2]>; N]) -> Option<Self> {
        let mut turned = *self;
        let each = turned.q.iter_mut().zip(&self.motion);
        for (((q, motion), near), limits) in each.zip(near).zip(limits) {
            let value: f64 = (*q).into();
            match (motion, limits) {
                (Motion::Revolute, _) => *q = S::lit(unwound(value, (*near).into(), *limits)?),
                (Motion::Prismatic, Some([low, high])) if !(low..=high).contains(&&value) => {
                    return None;
                }
                (Motion::Prismatic, _) => {}
            }
        }
        Some(turned)
    }
}

/// Of some branches that with the least change of the joints from `near`, by the sum of squares; each joint by whole turns as
/// near as its limits allow. `None` where no branch is within the limits.
#[inline(always)]
pub fn nearest_branch<S: Scalar + Into<f64>, const N: usize>(
    branches: impl IntoIterator<Item = Solution<S, N>>,
    near: &[S; N],
    limits: &[Option<[f64; 2]>; N],
) -> Option<Solution<S, N>> {
    let mut best: Option<(f64, Solution<S, N>)> = None;
    for solution in branches {
        let Some(turned) = solution.turned(near, limits) else { continue };
        let change = turned.q.iter().zip(near).fold(0.0, |sum, (q, near)| {
            let by: f64 = (*q - *near).into();
            sum + by * by
        });
        if best.is_none_or(|(least, _)| change < least) {
            best = Some((change, turned));
        }
    }
    best.map(|(_, solution)| solution)
}

/// Whole turns from an angle to near another.
fn turns(q: f64, near: f64) -> f64 {
    // The spacing of numbers of this size is 1: what is added and taken off again is rounded.
    const WHOLE: f64 = 1.5 / f64::EPSILON;
    ((near - q) / TAU + WHOLE) - WHOLE
}

/// The angle that is so by whole turns, within the limits, nearest to another.
fn unwound(q: f64, near: f64, limits: Option<[f64; 2]>) -> Option<f64> {
    let turns = turns(q, near);
    let nearest = q + turns * TAU;
    match limits {
        Some([low, high]) if !(low <= nearest && nearest <= high) => {
            let (least, most) = (libm::ceil((low - q) / TAU), libm::floor((high - q) / TAU));
            (least <= most).then(|| q + turns.max(least).min(most) * TAU)
        }
        _ => Some(nearest),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOLUTIONS: Solutions<f64, 2, 3> = Solutions {
        q: [[0.1, 3.0], [-3.1, 0.2], [0.0, 0.0]],
        distance: [0.0, 1e-12, 0.3],
        tilt: [0.0, 0.0, 0.0],
        motion: [Motion::Revolute; 2],
    };

    #[test]
    fn the_nearest_is_within_the_limits_by_whole_turns() {
        let nearest = |near, limits| SOLUTIONS.nearest(&near, &limits, (1e-9, 1e-9));
        let branch = |near| nearest(near, [None; 2]).map(|s| (s.branch, s.q));
        assert_eq!(branch([0.0, 2.9]), Some((0, [0.1, 3.0])));
        // Across the half turn.
        assert_eq!(branch([3.1, 0.2]), Some((1, [-3.1 + TAU, 0.2])));
        assert_eq!(branch([0.1, 3.0 - 4.0 * TAU]), Some((0, [0.1, 3.0 - 4.0 * TAU])));
        let limits = [Some([-4.0, 3.0]), Some([-1.0, 1.0])];
        assert_eq!(nearest([3.1, 0.2], limits).map(|s| s.q), Some([-3.1, 0.2]));
        assert_eq!(nearest([0.0; 2], [Some([1.0, 2.0]), None]), None);
    }

    #[test]
    fn prismatic_joints_have_no_whole_turns() {
        let slides = Solutions { motion: [Motion::Revolute, Motion::Prismatic], ..SOLUTIONS };
        let nearest = |limits| slides.nearest(&[0.0, 40.0], &[None, limits], (0.0, 0.0));
        assert_eq!(nearest(None).map(|s| s.q), Some([0.1, 3.0]));
        assert_eq!(nearest(Some([4.0, 50.0])), None);
    }

    #[test]
    fn what_is_not_reached_is_left_out() {
        let branches = |distance| SOLUTIONS.reached(distance, 0.0).map(|s| s.branch);
        assert!(branches(1e-9).eq([0, 1]) && branches(0.0).eq([0]) && branches(1.0).eq([0, 1, 2]));
    }

    #[test]
    fn no_number_is_no_solution() {
        let unreal = Solutions { distance: [f64::NAN; 3], ..SOLUTIONS };
        assert_eq!(unreal.nearest(&[0.0; 2], &[None; 2], (1.0, 1.0)), None);
    }
}
