//! Deviations relative to an output's scale.

use crate::generic::{Arm, Joint};
use crate::{Input, Output, Part, Side};

/// Terms may cancel to this part of themselves before an output's largest entry is its scale no
/// more: a level arm's weights turn no upright joint, and the textbook says so to rounding.
pub const CANCELLED: f64 = 1e-3;

/// The same in single precision, whose rounding is a thirtieth of its limit.
pub const CANCELLED_SINGLE: f64 = 0.1;

/// The largest difference, relative to the largest expected entry or `floor`; infinite where the
/// two cannot be compared.
pub fn deviation(got: &[f64], expected: &[f64], floor: f64) -> f64 {
    if got.len() != expected.len() || !got.iter().all(|x| x.is_finite()) {
        return f64::INFINITY;
    }
    let largest = expected.iter().fold(floor, |m, x| m.max(x.abs()));
    let worst = got.iter().zip(expected).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    if worst == 0.0 { 0.0 } else { worst / largest }
}

/// The most that the tool can be away from the base, m.
pub fn reach(arm: &Arm, q: &[f64]) -> f64 {
    let rows = arm.joints.iter().zip(q).map(|(j, q)| {
        let slid = if j.motion == crate::Motion::Prismatic { q.abs() } else { 0.0 };
        j.a.abs() + j.d.abs() + slid
    });
    rows.sum::<f64>() + arm.tool.translation.vector.norm()
}

/// The size of the terms that an output is summed of.
pub fn terms(arm: &Arm, output: Output, state: &[f64], w: &[f64; 6]) -> f64 {
    let (q, moving) = state.split_at(arm.dof());
    let reach = reach(arm, q);
    let lever = reach.max(1.0);
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let wrench = norm(&w[..3]) * reach + norm(&w[3..]);
    // Minors of a Jacobian: products of three lengths. The gradient of the root of the sum of their squares is
    // that of the sum over twice the root; and so is the root's own rounding where the sum is a determinant
    // of J Jᵀ, as it is of more than eight joints.
    let minors = lever.powi(3);
    match output {
        Output::Manipulability if arm.dof() <= 8 => return minors,
        Output::Manipulability | Output::ManipulabilityByJoints => {
            return minors * minors / arm.manipulability(q).max(f64::EPSILON * minors);
        }
        _ => {}
    }
    // The moment on a joint, where a load enters; else a unit of whatever loads it.
    let moment = |joint: usize| {
        let (loaded, heavy) = (output.takes(Input::Wrench), output.depends_on(Part::Weights));
        if output.is_of_motion() {
            return inertial(arm, reach, moving, output)
                + if heavy { weight(arm, 0, reach) } else { 0.0 };
        }
        let load = if loaded { wrench } else { 0.0 };
        let weight = if heavy { weight(arm, joint, reach) } else { 0.0 };
        if loaded || heavy { load + weight } else { 1.0 }
    };
    let loaded = match output.depends_on(Part::Stiffness) {
        true => gives(arm, reach, moment),
        false => moment(0),
    };
    if output.takes(Input::Torques) {
        return solved(arm, q, loaded);
    }
    let at_tool = |side: Side| match side {
        Side::Axes | Side::Twist | Side::Wrench => lever,
        _ => 1.0,
    };
    at_tool(output.rows()) * at_tool(output.columns()) * loaded
}

/// The moment that the weights of links `from` to the last may have, N·m.
fn weight(arm: &Arm, from: usize, reach: f64) -> f64 {
    let moment = |j: &Joint| {
        let beam = j.beam.as_ref().map_or(0.0, |b| b.density * b.area * reach);
        j.mass * (reach + j.com.norm()) + beam * reach
    };
    arm.gravity.norm() * arm.joints[from..].iter().map(moment).sum::<f64>()
}

/// The moment that moves the arm, and what holds it back; of the mass matrix, which no motion enters, the
/// moment per unit of acceleration.
fn inertial(arm: &Arm, reach: f64, moving: &[f64], output: Output) -> f64 {
    let (rates, accelerations) = moving.split_at(moving.len().min(arm.dof()));
    let sum = |of: &[f64]| of.iter().map(|x| x.abs()).sum::<f64>();
    let (spin, spin_rate) = (sum(rates), sum(accelerations));
    let level = match output {
        Output::MassMatrix => 1.0,
        Output::InverseDynamicsByRates => 2.0 * spin,
        _ => spin_rate + spin * spin,
    };
    // A unit of each moment, whatever the arm's are.
    if output.columns() == Side::Moments {
        let lever = reach.max(1.0);
        return (level * lever + arm.gravity.norm()) * lever;
    }
    let of_joint = |j: &Joint| {
        let lever = reach.max(1.0) + j.com.norm();
        let beam = j.beam.as_ref().map_or(0.0, |b| b.density * b.area * reach);
        let rotor = j.drive.gear * j.drive.gear * j.drive.rotor_inertia;
        let moved = (j.mass + beam) * lever * lever + j.inertia.norm() + rotor;
        let held = match output {
            Output::MassMatrix | Output::InverseDynamicsByJoints => 0.0,
            Output::InverseDynamicsByRates => j.drive.viscous,
            _ => j.drive.coulomb + j.drive.viscous * spin,
        };
        moved * level + held
    };
    arm.joints.iter().map(of_joint).sum()
}

/// What the rounding of a solve is relative to: `δq̈ = M⁻¹ (δf − δM q̈)`, with f and what M q̈ is summed of.
fn solved(arm: &Arm, q: &[f64], force: f64) -> f64 {
    let moments = arm.mass_matrix(q).symmetric_eigenvalues();
    let (least, largest) = (moments.min(), moments.max());
    let response = force / least;
    (force + largest * response) / least
}

/// What the joints and links give under the moment on each, rad.
fn gives(arm: &Arm, reach: f64, moment: impl Fn(usize) -> f64) -> f64 {
    let soft = |j: &Joint| {
        let bends = j.beam.as_ref().map_or(0.0, |b| {
            reach / (b.youngs_modulus * b.iy.min(b.iz)).min(b.shear_modulus * b.j)
        });
        j.compliance + bends
    };
    arm.joints.iter().enumerate().map(|(k, j)| soft(j) * moment(k)).sum()
}
