//! From the closed form of a table to the arm as it is: steps on what its pose misses.
//!
//! A step is `q + (JᵀJ + λ)⁻¹ Jᵀ e`, the error e from the arm's pose to the one that is asked for. Its Jacobian is that of
//! the rigid arm by joint values: of what the arm gives under its load, and of what makes a reading another than the
//! joint's value, no step knows how they change. What is left of an error is therefore its square, and of it as much as
//! those change with a radian: a part in a thousand of arms as they are built. The damping λ is the error's square
//! and what rounding leaves of JᵀJ: nothing is divided by zero where the Jacobian is singular, and the steps lose
//! none of their order elsewhere (Fan & Yuan 2005).

use super::{Inverse, Solution, Solutions};
use crate::solve::solve;
use crate::{Pose, Scalar, Unstable, has};

/// How many steps follow a closed form: of so many the generator has found, by the arm's own numbers, that they leave less
/// than 1e-10 m and rad at 19 of 20 postures drawn at random; the others are near singular ones. What they
/// leave is told with each branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steps {
    /// Of the rigid arm: none where the closed form is that of its own table.
    pub unloaded: usize,
    /// Of the arm under its weights and a load that moves its tool by a thousandth of the arm's size.
    pub loaded: usize,
}

impl Steps {
    /// The most that the generator asks for.
    pub const MOST: usize = 8;

    /// So many steps from `q` towards a pose of the tool, by pose and Jacobian `at` readings: the readings, and what
    /// they miss the pose by, as [`Solutions`] tells it.
    ///
    /// # Errors
    /// [`Unstable`] from `at`, or where the numbers are not finite.
    #[inline]
    pub fn follow<S: Scalar, const N: usize>(
        mut q: [S; N],
        pose: &Pose<S>,
        steps: usize,
        at: impl Fn(&[S; N]) -> Result<(Pose<S>, [[S; 6]; N]), Unstable>,
    ) -> Result<([S; N], [S; 2]), Unstable> {
        for _ in 0..steps {
            let (stands, jacobian) = at(&q)?;
            let by = step(&jacobian, &error(&stands, pose))?;
            q = core::array::from_fn(|joint| q[joint] + by[joint]);
        }
        Ok((q, missed(&at(&q)?.0, pose)))
    }
}

/// `(JᵀJ + λ)⁻¹ Jᵀ e`.
#[inline(always)]
fn step<S: Scalar, const N: usize>(
    jacobian: &[[S; 6]; N],
    error: &[S; 6],
) -> Result<[S; N], Unstable> {
    let mut normal = jacobian.map(|column| jacobian.each_ref().map(|other| dot(&column, other)));
    // 3 (4/3 − 1) − 1 is one unit of rounding, of the numbers that are computed with.
    let unit = S::lit(3.0) * (S::lit(4.0 / 3.0) - S::lit(1.0)) - S::lit(1.0);
    let rounding = unit * unit.sign() * S::lit(8.0);
    let trace = (0..N).fold(S::lit(0.0), |sum, joint| sum + normal[joint][joint]);
    let damping = dot(error, error) + rounding * trace;
    (0..N).for_each(|joint| normal[joint][joint] = normal[joint][joint] + damping);
    // The matrix is positive definite by its making.
    let definite = S::lit(1.0);
    solve::<S, N, N>(normal, jacobian.each_ref().map(|column| dot(column, error)), definite)
}

/// Translation from a pose to another, and `sin φ` about the axis of the turn.
#[inline(always)]
fn error<S: Scalar>(from: &Pose<S>, to: &Pose<S>) -> [S; 6] {
    let mut error = [S::lit(0.0); 6];
    for k in 0..3 {
        error[k] = to.position[k] - from.position[k];
        let [x, y, z] = from.rotation[k];
        let [u, v, w] = to.rotation[k];
        for (sum, part) in error[3..].iter_mut().zip([y * w - z * v, z * u - x * w, x * v - y * u])
        {
            *sum = *sum + S::lit(0.5) * part;
        }
    }
    error
}

/// Distance of two poses, and twice the sine of half the angle between their axes.
#[inline(always)]
fn missed<S: Scalar>(a: &Pose<S>, b: &Pose<S>) -> [S; 2] {
    let zero = S::lit(0.0);
    let square = |a: &[S; 3], b: &[S; 3]| {
        a.iter().zip(b).fold(zero, |sum, (a, b)| sum + (*a - *b) * (*a - *b))
    };
    let axes = a.rotation.iter().zip(&b.rotation);
    let turned = axes.fold(zero, |sum, (a, b)| sum + square(a, b));
    [square(&a.position, &b.position).sqrt(), (S::lit(0.5) * turned).sqrt()]
}

#[inline(always)]
fn dot<S: Scalar>(a: &[S; 6], b: &[S; 6]) -> S {
    a.iter().zip(b).fold(S::lit(0.0), |sum, (a, b)| sum + *a * *b)
}

/// [`Inverse::inverse_kinematics`] of an arm whose closed form is that of another table.
#[doc(hidden)]
#[inline]
pub fn without_load<S: Scalar, const N: usize, const K: usize, A>(
    arm: &A,
    pose: &Pose<S>,
    near: &[S; N],
) -> Solutions<S, N, K>
where
    A: Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S>,
{
    arm.closed_form(pose, near).followed(pose, A::STEPS.unloaded, |q| {
        let posture = arm.posture(q);
        Ok((arm.pose(&posture), arm.jacobian(&posture)))
    })
}

/// The set-points of an arm that gives under its load and its weights: what is commanded for the tool to stand at a pose. Of
/// every arm that has been generated with `pose`, `jacobian`, `deflection_with_gravity` and `inverse_kinematics`.
///
/// The tool of the loaded arm stands at its `pose`, [displaced](Pose::displaced) by its `deflection_with_gravity`.
pub trait SetPoints<const N: usize, const K: usize, S: Scalar>:
    Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S> + has::DeflectionWithGravity<N, S>
{
    /// Where the loaded tool stands, base axes, and how the rigid arm's moves.
    ///
    /// # Errors
    /// [`Unstable`] where the arm does not bear the load.
    #[inline]
    fn stands(&self, q: &[S; N], wrench: &[S; 6]) -> Result<(Pose<S>, [[S; 6]; N]), Unstable> {
        let posture = self.posture(q);
        let by = self.deflection_with_gravity(&posture, wrench)?;
        Ok((self.pose(&posture).displaced(&by), self.jacobian(&posture)))
    }

    /// Every branch at a pose of the loaded tool, base axes, under a wrench on it; a joint that the pose leaves free
    /// stays near where `near` has it. A branch in which the arm does not bear its load misses the pose by an infinite
    /// distance.
    #[inline]
    fn set_points(&self, pose: &Pose<S>, near: &[S; N], wrench: &[S; 6]) -> Solutions<S, N, K> {
        let at = |q: &[S; N]| self.stands(q, wrench);
        self.closed_form(pose, near).followed(pose, Self::STEPS.loaded, at)
    }

    /// Of the branches that miss the pose by no more than this (m, rad) that with the least change of the joints from
    /// `near`, whole turns and limits as in [`Solutions::nearest`]. The steps are those of one branch, as long as
    /// that next to `near` is one of them; where it is not, the next one is tried.
    #[inline]
    fn set_point(
        &self,
        pose: &Pose<S>,
        near: &[S; N],
        wrench: &[S; 6],
        (distance, tilt): (f64, f64),
    ) -> Option<Solution<S, N>>
    where
        S: PartialOrd + Into<f64>,
    {
        let any = (f64::MAX, f64::MAX);
        let mut left = self.closed_form(pose, near);
        for _ in 0..K {
            let Solution { branch, q, .. } = left.nearest(near, &Self::LIMITS, any)?;
            let at = |q: &[S; N]| self.stands(q, wrench);
            if let Ok((q, [d, t])) = Steps::follow(q, pose, Self::STEPS.loaded, at) {
                let within = q.iter().zip(&Self::LIMITS).all(|(q, limits)| {
                    limits.is_none_or(|[low, high]| (low..=high).contains(&(*q).into()))
                });
                if within && d.into() <= distance && t.into() <= tilt {
                    return Some(Solution { branch, q, distance: d, tilt: t });
                }
            }
            left.distance[branch] = S::lit(f64::INFINITY);
        }
        None
    }
}

impl<const N: usize, const K: usize, S: Scalar, A> SetPoints<N, K, S> for A where
    A: Inverse<N, K, S> + has::Pose<N, S> + has::Jacobian<N, S> + has::DeflectionWithGravity<N, S>
{
}
