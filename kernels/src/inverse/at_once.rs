//! The branches of an arm behind whose closed form steps stand, several in each call of its functions.

use super::set_points::{at_rest, rigid};
use super::{Inverse, SetPoints, Solutions};
use crate::batch::Number;
use crate::{Pose, Unstable, has};

/// [`Inverse::inverse_kinematics`] of an arm whose closed form is another table's, or tells other values than readings:
/// as many branches at once as [`Number::Lanes`] hold, by the same arm in lanes. The bits are the same.
#[inline]
pub fn inverse_kinematics<T: Number, const N: usize, const K: usize, A, L>(
    arm: &A,
    lanes: &L,
    pose: &Pose<T>,
    near: &[T; N],
) -> Solutions<T, N, K>
where
    A: Inverse<N, K, T> + has::Pose<N, T> + has::Jacobian<N, T>,
    L: Inverse<N, K, T::Lanes> + has::Pose<N, T::Lanes> + has::Jacobian<N, T::Lanes>,
{
    let wide = spread(pose);
    let by_lanes = |joints| rigid(lanes, &wide, joints);
    at_once(arm.closed_form(pose, near), |joints| rigid(arm, pose, joints), by_lanes)
}

/// [`SetPoints::set_points`] with as many branches at once as [`Number::Lanes`] hold, by the same arm in lanes. The bits are the
/// same.
#[inline]
pub fn set_points<T: Number, const N: usize, const K: usize, A, L>(
    arm: &A,
    lanes: &L,
    pose: &Pose<T>,
    near: &[T; N],
    wrench: &[T; 6],
) -> Solutions<T, N, K>
where
    A: SetPoints<N, K, T>,
    L: SetPoints<N, K, T::Lanes>,
{
    let (wide, load) = (spread(pose), wrench.map(|x| T::pack(|_| x)));
    let by_lanes = |joints| at_rest(lanes, &wide, joints, &load);
    at_once(arm.closed_form(pose, near), |joints| at_rest(arm, pose, joints, wrench), by_lanes)
}

/// A pose in every lane.
fn spread<T: Number>(pose: &Pose<T>) -> Pose<T::Lanes> {
    let each = |v: [T; 3]| v.map(|x| T::pack(|_| x));
    Pose { rotation: pose.rotation.map(each), position: each(pose.position) }
}

/// What follows a branch.
type Followed<S, const N: usize> = Result<([S; N], [S; 2]), Unstable>;

/// [`Solutions::each`] by lanes; one by one where the arm does not bear its load in one of them.
#[inline(always)]
fn at_once<T: Number, const N: usize, const K: usize>(
    mut all: Solutions<T, N, K>,
    one: impl Fn([T; N]) -> Followed<T, N>,
    by_lanes: impl Fn([T::Lanes; N]) -> Followed<T::Lanes, N>,
) -> Solutions<T, N, K> {
    for first in (0..K).step_by(T::WIDTH) {
        // Lanes beyond the last branch are that branch.
        let branch = |lane: usize| (first + lane).min(K - 1);
        let q = core::array::from_fn(|joint| T::pack(|lane| all.q[branch(lane)][joint]));
        match by_lanes(q) {
            Ok((q, [distance, tilt])) => {
                for (joint, values) in q.into_iter().enumerate() {
                    T::unpack(values, |(lane, x)| all.q[branch(lane)][joint] = x);
                }
                T::unpack(distance, |(lane, x)| all.distance[branch(lane)] = x);
                T::unpack(tilt, |(lane, x)| all.tilt[branch(lane)] = x);
            }
            Err(Unstable) => {
                let last = (first + T::WIDTH).min(K);
                (first..last).for_each(|branch| all.follow(branch, &one));
            }
        }
    }
    all
}
