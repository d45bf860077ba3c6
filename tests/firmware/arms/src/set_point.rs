//! One step of a control loop that takes the joint springs' give out of a loaded arm.
//!
//! The motors hold a set-point c; the springs let the links rest at q, where their torques balance
//! those of the wrench w on the tool (Dumas et al. 2011, eq. 3): `K_θ (q − c) = J(q)ᵀ w`. For
//! links that are to rest at a target q_t the set-point is therefore
//!
//! ```text
//! c = q_t − K_θ⁻¹ J(q_t)ᵀ w
//! ```
//!
//! for a load of any size, without iteration: everything stands at the target. Two things are
//! not in it: links that bend, and a wrench that changes on the way there.

use stiffarm::kernels::{Scalar, Unstable};

use crate::Real;
use crate::robots::ur5_springs::{self as arm, N};

/// Stiffness of each joint, N·m/rad, as in the arm's table.
pub const STIFFNESS: [f64; N] = [4e4, 4e4, 2.5e4, 1e4, 1e4, 8e3];

/// What one period of the loop reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading<S> {
    /// Joint angles by the motors' encoders, rad.
    pub encoders: [S; N],
    /// Load on the tool by the wrist's sensor: N, N·m, at the tool origin in tool axes.
    pub wrench: [S; 6],
}

/// What one period of the loop finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction<S> {
    /// Where the tool is off the pose that the encoders tell: m, rad, base axes. Of first order in
    /// the springs' give, with K_C.
    pub deflection: [S; 6],
    /// What the motors are to hold for the links to rest at the target, rad.
    pub set_point: [S; N],
}

/// Why a period has no result; the motors keep what they hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// A reading or a target is infinite, NaN, or an angle beyond all reason.
    NotFinite,
    /// Under this load the arm would buckle.
    Unstable,
}

impl From<Unstable> for Refusal {
    fn from(_: Unstable) -> Self {
        Refusal::Unstable
    }
}

/// The deflection at `reading`, and the set-point for the target, rad.
pub fn correct<S: Real>(reading: &Reading<S>, target: &[S; N]) -> Result<Correction<S>, Refusal> {
    let sane = finite(&reading.encoders) & finite(&reading.wrench) & finite(target);
    if !sane {
        return Err(Refusal::NotFinite);
    }
    let here = in_base_axes(&arm::pose(&reading.encoders).rotation, &reading.wrench);
    let there = in_base_axes(&arm::pose(target).rotation, &reading.wrench);
    // Finite angles beyond what sines are told for turn everything into NaN.
    let sane = finite(&here) & finite(&there);
    if !sane {
        return Err(Refusal::NotFinite);
    }
    let deflection = arm::deflection(&reading.encoders, &here)?;
    let torque = arm::joint_torque(target, &there);
    let mut set_point = *target;
    for ((value, torque), stiffness) in set_point.iter_mut().zip(torque).zip(STIFFNESS) {
        *value = *value - S::lit(1.0 / stiffness) * torque;
    }
    // A load at the end of the range of numbers may still have overflown.
    if finite(&deflection) & finite(&set_point) {
        Ok(Correction { deflection, set_point })
    } else {
        Err(Refusal::NotFinite)
    }
}

/// Of all values, without leaving early: the time does not depend on which one is not.
fn finite<S: Real, const M: usize>(values: &[S; M]) -> bool {
    values.iter().fold(true, |so_far, value| so_far & value.is_finite())
}

/// A wrench in tool axes, turned; `rotation` holds the tool's axes.
pub fn in_base_axes<S: Scalar>(rotation: &[[S; 3]; 3], wrench: &[S; 6]) -> [S; 6] {
    let [x, y, z] = rotation;
    let turned = |a: S, b: S, c: S, row: usize| x[row] * a + y[row] * b + z[row] * c;
    let [fx, fy, fz, mx, my, mz] = *wrench;
    [
        turned(fx, fy, fz, 0),
        turned(fx, fy, fz, 1),
        turned(fx, fy, fz, 2),
        turned(mx, my, mz, 0),
        turned(mx, my, mz, 1),
        turned(mx, my, mz, 2),
    ]
}
