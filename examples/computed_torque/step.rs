//! One period of computed-torque control (Craig, *Introduction to Robotics*, section 10.4), written against any arm
//! that has its inverse dynamics: on a workstation in `f64`, on a microcontroller in `f32`.

use stiffarm::kernels::{Scalar, has};

/// Where the joints are to be, how fast, and how they are to accelerate there: rad, rad/s, rad/s² (prismatic joint: m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target<S, const N: usize> {
    /// Joint values.
    pub q: [S; N],
    /// Their rates.
    pub qd: [S; N],
    /// Their accelerations.
    pub qdd: [S; N],
}

/// How each joint is led to its target, as if it had no other mass than one of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains<S> {
    /// 1/s².
    pub stiffness: S,
    /// 1/s.
    pub damping: S,
}

/// Torques of the joints' motors, N·m (prismatic joint: N): `τ = M(q) (q̈_d + K_d ė + K_p e) + b(q, q̇)` with
/// `e = q_d − q`, which is the inverse dynamics of the acceleration in brackets. Of an arm that is as its table says
/// every error then follows `ë + K_d ė + K_p e = 0` by itself.
pub fn step<S: Scalar, const N: usize, A>(
    arm: &A,
    (q, qd): (&[S; N], &[S; N]),
    target: &Target<S, N>,
    gains: &Gains<S>,
) -> [S; N]
where
    A: has::InverseDynamics<N, S>,
{
    let mut qdd = target.qdd;
    for k in 0..N {
        let (error, rate) = (target.q[k] - q[k], target.qd[k] - qd[k]);
        qdd[k] = qdd[k] + (gains.damping * rate + gains.stiffness * error);
    }
    arm.inverse_dynamics(&arm.posture(q), qd, &qdd)
}
