//! The inverse of a generated arm as it is: unloaded, and at rest under a load.

use super::steps::AtRest;
use super::{Inverse, JointValues, Solution, Solutions};
use crate::solve::margin;
use crate::{Pose, Scalar, Unstable, has};

/// What gives in an arm at rest under a wrench and its weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gives<S, const N: usize> {
    /// The joints' springs, with what friction winds up, rad.
    pub joints: [S; N],
    /// The tool's displacement by everything else (links, bearings, the base), to first order, base axes, m and rad.
    pub tool: [S; 6],
}

/// An arm that has been generated with what gives in it at rest: with `inverse_kinematics` and `deflection_with_gravity`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has not been generated with its inverse kinematics and its deflection, or not for these joints",
    note = "ask for `inverse_kinematics` and `deflection_with_gravity` by name among its `outputs`"
)]
pub trait Elastic<const N: usize, S: Scalar = f64>: has::DeflectionWithGravity<N, S> {
    /// Whether more gives than joints.
    const LINKS: bool;

    /// Force and moment, N and N·m, within whose ellipsoid the arm bears every load in every posture, where its table says
    /// them.
    const BEARS: Option<[f64; 2]>;

    /// What gives at the posture in which the loaded arm is at rest.
    fn gives(&self, posture: &Self::Posture, wrench: &[S; 6]) -> Gives<S, N>;
}

/// A rigid arm, and the joint that its steps hold.
struct Rigid<'a, A>(&'a A, Option<usize>);

impl<S: Scalar, const N: usize, A> AtRest<S, N> for Rigid<'_, A>
where
    A: JointValues<N, S> + has::Pose<N, S> + has::Jacobian<N, S>,
{
    #[inline(always)]
    fn stands(&self, joints: &[S; N]) -> Result<(Pose<S>, [[S; 6]; N]), Unstable> {
        let posture = self.0.at_joints(joints);
        Ok((self.0.pose(&posture), held(self.0.jacobian(&posture), self.1)))
    }

    #[inline(always)]
    fn gives(&self, _: &[S; N]) -> Result<[S; N], Unstable> {
        Ok([S::lit(0.0); N])
    }

    #[inline(always)]
    fn joints(&self, readings: &[S; N]) -> [S; N] {
        self.0.joints(readings)
    }
}

/// A Jacobian of which a joint moves nothing.
#[inline(always)]
fn held<S: Scalar, const N: usize>(mut jacobian: [[S; 6]; N], joint: Option<usize>) -> [[S; 6]; N] {
    if let Some(column) = joint.and_then(|joint| jacobian.get_mut(joint)) {
        *column = [S::lit(0.0); 6];
    }
    jacobian
}

/// An arm under a wrench and its weights, and the joint that its steps hold.
struct Loaded<'a, A, S>(&'a A, &'a [S; 6], Option<usize>);

impl<S: Scalar, const N: usize, A> AtRest<S, N> for Loaded<'_, A, S>
where
    A: JointValues<N, S> + has::Pose<N, S> + has::Jacobian<N, S> + Elastic<N, S>,
{
    #[inline(always)]
    fn stands(&self, joints: &[S; N]) -> Result<(Pose<S>, [[S; 6]; N]), Unstable> {
        let Loaded(arm, wrench, joint) = self;
        let posture = arm.at_joints(joints);
        let pose = match A::LINKS {
            true => arm.pose(&posture).displaced(&arm.gives(&posture, wrench).tool),
            false => arm.pose(&posture),
        };
        Ok((pose, held(arm.jacobian(&posture), *joint)))
    }

    #[inline(always)]
    fn gives(&self, joints: &[S; N]) -> Result<[S; N], Unstable> {
        let Loaded(arm, wrench, _) = self;
        let posture = arm.at_joints(joints);
        // Where the arm is at rest is where it has to bear the load.
        let surely = |most: [f64; 2]| margin(wrench, most.map(S::lit)).is_positive();
        if !A::BEARS.is_some_and(surely) {
            arm.deflection_with_gravity(&posture, wrench)?;
        }
        Ok(arm.gives(&posture, wrench).joints)
    }

    #[inline(always)]
    fn joints(&self, readings: &[S; N]) -> [S; N] {
        self.0.joints(readings)
    }
}

/// [`Inverse::inverse_kinematics`] of an arm whose closed form tells joint values, or is that of another table.
#[doc(hidden)]
#[inline]
pub fn unloaded<S: Scalar, const N: usize, const K: usize, A>(
    arm: &A,
    pose: &Pose<S>,
    closed: Solutions<S, N, K>,
) -> Solutions<S, N, K>
where
    A: Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S>,
{
    closed.each(|joints| rigid(arm, pose, joints))
}

/// The readings of a rigid arm near joint values, and what it misses the pose by.
#[inline]
pub(super) fn rigid<S: Scalar, const N: usize, const K: usize, A>(
    arm: &A,
    pose: &Pose<S>,
    joints: [S; N],
) -> Result<([S; N], [S; 2]), Unstable>
where
    A: Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S>,
{
    Rigid(arm, A::GIVEN).follow(joints, pose, (A::STEPS.unloaded, A::STEPS.readings))
}

/// The set-points of an arm that gives under its load and its weights: the readings at which its tool, at rest, stands at a
/// pose. Of every arm that is generated with `pose`, `jacobian`, `deflection_with_gravity` and `inverse_kinematics`.
///
/// The joints' springs are at rest where the links stand, under loads of any size: `q = θ − Kθ⁻¹ τ(θ)`. What else gives is
/// of first order, as in the deflection.
pub trait SetPoints<const N: usize, const K: usize, S: Scalar>:
    Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S> + Elastic<N, S> + Sized
{
    /// Every branch at a pose of the loaded tool, base axes, under a wrench on it; a joint that the pose leaves free
    /// stays near where `near` has it. A branch in which the arm does not bear its load misses the pose by an infinite
    /// distance.
    #[inline]
    fn set_points(&self, pose: &Pose<S>, near: &[S; N], wrench: &[S; 6]) -> Solutions<S, N, K> {
        self.closed_form(pose, near).each(|joints| at_rest(self, pose, joints, wrench))
    }

    /// Of the branches that miss the pose by no more than this (m, rad) that with the least change of the joints from
    /// `near`, by whole turns and within [the limits](crate::Arm::LIMITS) as in [`Solutions::nearest`]. The cost is that of one
    /// branch where the nearest one is it, as it nearly always is.
    #[inline]
    fn set_point(
        &self,
        pose: &Pose<S>,
        near: &[S; N],
        wrench: &[S; 6],
        within: (f64, f64),
    ) -> Option<Solution<S, N>>
    where
        S: PartialOrd + Into<f64>,
    {
        let at_rest = |joints| at_rest(self, pose, joints, wrench).ok();
        self.closed_form(pose, near).first(near, &Self::LIMITS, within, at_rest)
    }
}

impl<const N: usize, const K: usize, S: Scalar, A> SetPoints<N, K, S> for A where
    A: Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S> + Elastic<N, S>
{
}

/// The readings at which the loaded arm is at rest near joint values, and what it misses the pose by.
#[inline]
pub(super) fn at_rest<S: Scalar, const N: usize, const K: usize, A>(
    arm: &A,
    pose: &Pose<S>,
    joints: [S; N],
    wrench: &[S; 6],
) -> Result<([S; N], [S; 2]), Unstable>
where
    A: SetPoints<N, K, S>,
{
    Loaded(arm, wrench, A::GIVEN).follow(joints, pose, (A::STEPS.loaded, A::STEPS.readings))
}
