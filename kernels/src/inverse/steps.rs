//! From the closed form of a table to the arm as it is: steps on what its pose misses, then what its springs give and what
//! its readings are.
//!
//! A step is `θ + (JᵀJ + λ)⁻¹ Jᵀ e`, the error e from the arm's pose to the one that is asked for, J the Jacobian of the rigid
//! arm: of an arm whose links do not bend, each error is about the square of that before. The damping λ is the error's
//! square and what rounding leaves of JᵀJ: nothing is divided by zero where the Jacobian is singular, and the steps lose none
//! of their order elsewhere (Fan & Yuan 2005).

use crate::{Pose, Scalar, Unstable};

/// How many steps follow a closed form, as the generator has found by the arm's own numbers.
///
/// They leave less than 1e-10 m and rad at 9 of 10 postures drawn at random; the others are near singular ones. What they
/// leave is told with each branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Steps {
    /// Of the rigid arm: none where the closed form is that of its own table.
    pub unloaded: usize,
    /// Of the arm under its weights and a load that moves its tool by a thousandth of the arm's size: as many, and more
    /// where more gives than joints.
    pub loaded: usize,
    /// From joint values to readings: of so many the arm's ratios, couplings and waves leave rounding.
    pub readings: usize,
}

impl Steps {
    /// The most that the generator asks for.
    pub const MOST: usize = 8;
}

/// An arm at rest, as the steps see it. Joint values are those of the links: a spring stands between them and what the
/// readings mean.
pub trait AtRest<S, const N: usize> {
    /// Where the tool stands at joint values, base axes, and how the rigid arm's moves.
    ///
    /// # Errors
    /// [`Unstable`] where the arm does not bear its load.
    fn stands(&self, joints: &[S; N]) -> Result<(Pose<S>, [[S; 6]; N]), Unstable>;

    /// What the joints give at these values: the links stand so far from what the readings mean.
    ///
    /// # Errors
    /// [`Unstable`] where the arm does not bear its load.
    fn gives(&self, joints: &[S; N]) -> Result<[S; N], Unstable>;

    /// The joint values that readings mean, of an arm that does not give.
    fn joints(&self, readings: &[S; N]) -> [S; N];

    /// The joint values nearer to those at which the tool stands at a pose.
    ///
    /// # Errors
    /// [`Unstable`] where the arm does not bear its load, or the numbers are not finite.
    #[inline(always)]
    fn step(&self, joints: &[S; N], pose: &Pose<S>) -> Result<[S; N], Unstable>
    where
        S: Scalar,
    {
        let (stands, jacobian) = self.stands(joints)?;
        let by = step(&jacobian, &error(&stands, pose))?;
        Ok(core::array::from_fn(|joint| joints[joint] + by[joint]))
    }

    /// The readings at which the tool stands at a pose, by so many steps from joint values and so many to readings, and
    /// by how much it misses the pose then: distance and turn, as [`Solutions`](super::Solutions) tells them.
    ///
    /// # Errors
    /// As from [`AtRest::step`].
    #[inline]
    fn follow(
        &self,
        mut joints: [S; N],
        pose: &Pose<S>,
        (steps, readings): (usize, usize),
    ) -> Result<([S; N], [S; 2]), Unstable>
    where
        S: Scalar,
    {
        for _ in 0..steps {
            joints = self.step(&joints, pose)?;
        }
        let gives = self.gives(&joints)?;
        let meant = core::array::from_fn(|joint| joints[joint] - gives[joint]);
        let mut q: [S; N] = meant;
        for _ in 0..readings {
            let at = self.joints(&q);
            q = core::array::from_fn(|joint| q[joint] + (meant[joint] - at[joint]));
        }
        let at = self.joints(&q);
        let (stands, _) = self.stands(&core::array::from_fn(|joint| at[joint] + gives[joint]))?;
        Ok((q, missed(&stands, pose)))
    }
}

/// `(JᵀJ + λ)⁻¹ Jᵀ e`.
#[inline(always)]
pub(super) fn step<S: Scalar, const N: usize>(
    jacobian: &[[S; 6]; N],
    error: &[S; 6],
) -> Result<[S; N], Unstable> {
    let mut a = [[S::lit(0.0); N]; N];
    for (row, one) in jacobian.iter().enumerate() {
        for (column, other) in jacobian.iter().enumerate() {
            if column <= row {
                a[row][column] = dot(one, other);
            }
        }
    }
    // 3 (4/3 − 1) − 1 is one unit of rounding, of the numbers that are computed with.
    let unit = S::lit(3.0) * (S::lit(4.0 / 3.0) - S::lit(1.0)) - S::lit(1.0);
    let rounding = unit * unit.sign() * S::lit(8.0);
    let trace = (0..N).fold(S::lit(0.0), |sum, joint| sum + a[joint][joint]);
    let damping = dot(error, error) + rounding * trace;
    solved(a, damping, jacobian.each_ref().map(|column| dot(column, error)))
}

/// `(A + λ)⁻¹ b` by `L D Lᵀ` of the lower triangle, which has to be positive definite. Loops have fixed bounds, so that the
/// compiler writes them out.
#[allow(clippy::needless_range_loop, reason = "a row is changed while another one is read")]
#[inline(always)]
pub(super) fn solved<S: Scalar, const N: usize>(
    mut a: [[S; N]; N],
    damping: S,
    mut by: [S; N],
) -> Result<[S; N], Unstable> {
    let mut inverse = [S::lit(0.0); N];
    let mut definite = true;
    for k in 0..N {
        let pivot = a[k][k] + damping;
        definite &= pivot.is_positive();
        inverse[k] = pivot.recip();
        for row in 0..N {
            if row > k {
                let factor = a[row][k] * inverse[k];
                for column in 0..N {
                    if column > k && column <= row {
                        a[row][column] = a[row][column] - factor * a[column][k];
                    }
                }
                by[row] = by[row] - factor * by[k];
            }
        }
    }
    if !definite {
        return Err(Unstable);
    }
    for k in (0..N).rev() {
        for row in 0..N {
            if row > k {
                by[k] = by[k] - a[row][k] * by[row];
            }
        }
        by[k] = by[k] * inverse[k];
    }
    Ok(by)
}

/// Translation from a pose to another, and `sin φ` about the axis of the turn.
#[inline(always)]
pub(super) fn error<S: Scalar>(from: &Pose<S>, to: &Pose<S>) -> [S; 6] {
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
pub(super) fn missed<S: Scalar>(a: &Pose<S>, b: &Pose<S>) -> [S; 2] {
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
