//! One period of impedance control, written against any arm that has a pose and a Jacobian: on a
//! workstation in `f64`, on a microcontroller in `f32`.

use stiffarm::kernels::{Pose, Scalar, has};

/// How the tool is to be held, along and about the base's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impedance<S> {
    /// N/m, then N·m/rad.
    pub stiffness: [S; 6],
    /// N·s/m, then N·m·s/rad.
    pub damping: [S; 6],
}

/// Joint torques, N·m (prismatic joint: N), that hold the tool at `target` as by springs and dampers: `τ = Jᵀ (K e −
/// D J q̇)`. Of the rotation the error is half the sum of the axes' cross products, sin φ about the axis that leads to
/// the target, so that it is right to the third order in a small angle.
pub fn step<S: Scalar, const N: usize, A>(
    arm: &A,
    (q, rates): (&[S; N], &[S; N]),
    target: &Pose<S>,
    impedance: &Impedance<S>,
) -> [S; N]
where
    A: has::Pose<N, S> + has::Jacobian<N, S>,
{
    let posture = arm.posture(q);
    let (here, jacobian) = (arm.pose(&posture), arm.jacobian(&posture));
    let zero = S::lit(0.0);
    let mut error = [zero; 6];
    for k in 0..3 {
        error[k] = target.position[k] - here.position[k];
        let turned = cross(here.rotation[k], target.rotation[k]);
        for (sum, part) in error[3..].iter_mut().zip(turned) {
            *sum = *sum + S::lit(0.5) * part;
        }
    }
    let mut twist = [zero; 6];
    for (column, rate) in jacobian.iter().zip(rates) {
        for (sum, entry) in twist.iter_mut().zip(column) {
            *sum = *sum + *entry * *rate;
        }
    }
    let mut wrench = [zero; 6];
    for k in 0..6 {
        wrench[k] = impedance.stiffness[k] * error[k] - impedance.damping[k] * twist[k];
    }
    jacobian.map(|column| {
        let powers = column.into_iter().zip(wrench).map(|(v, w)| v * w);
        powers.fold(zero, |sum, power| sum + power)
    })
}

fn cross<S: Scalar>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
