//! One step of a control loop that commands what brings the real tool to its target: written against any arm that
//! has a pose, a Jacobian and a deflection, on a workstation in `f64`, on a microcontroller in `f32`.

use stiffarm::kernels::{Pose, Scalar, Unstable, has, solve};

/// Readings, rad (prismatic joint: m), at which the tool under `wrench` and the links' weights is nearer to
/// `target` than at `q`: `q + (JᵀJ + λ)⁻¹ Jᵀ e`, the error `e` from where pose and deflection say that it stands.
///
/// The columns of the Jacobian are told by joint values, not by readings. Where these go together to a part in a
/// thousand, each step leaves a thousandth of the error; so does the damping λ, away from singular postures.
///
/// # Errors
/// [`Unstable`] where the arm does not bear the load.
pub fn step<S: Scalar, const N: usize, A>(
    arm: &A,
    q: &[S; N],
    target: &Pose<S>,
    wrench: &[S; 6],
) -> Result<[S; N], Unstable>
where
    A: has::Pose<N, S> + has::Jacobian<N, S> + has::DeflectionWithGravity<N, S>,
{
    let posture = arm.posture(q);
    let (rigid, jacobian) = (arm.pose(&posture), arm.jacobian(&posture));
    let sag = arm.deflection_with_gravity(&posture, wrench)?;
    let zero = S::lit(0.0);
    let mut error = [zero; 6];
    for k in 0..3 {
        error[k] = target.position[k] - rigid.position[k];
        // sin φ about the axis from where the tool is turned to where it should be.
        for (sum, part) in error[3..].iter_mut().zip(cross(rigid.rotation[k], target.rotation[k])) {
            *sum = *sum + S::lit(0.5) * part;
        }
    }
    for (error, sag) in error.iter_mut().zip(sag) {
        *error = *error - sag;
    }
    let dot = |a: &[S; 6], b: &[S; 6]| a.iter().zip(b).fold(zero, |sum, (a, b)| sum + *a * *b);
    let mut normal = [[zero; N]; N];
    for (i, column) in normal.iter_mut().enumerate() {
        for (entry, of) in column.iter_mut().zip(&jacobian) {
            *entry = dot(of, &jacobian[i]);
        }
        column[i] = column[i] + S::lit(DAMPING);
    }
    let by = solve::<S, N, N>(normal, jacobian.map(|column| dot(&column, &error)), zero)?;
    Ok(core::array::from_fn(|j| q[j] + by[j]))
}

/// λ, m²: what it leaves of the error is its part of the Jacobian's smallest squared singular value.
const DAMPING: f64 = 1e-5;

fn cross<S: Scalar>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
