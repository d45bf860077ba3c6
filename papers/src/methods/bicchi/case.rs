//! The case study of Bicchi & Melchiorri with three joints, the arm taken as straight.

use std::f64::consts::PI;

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use super::{Task, compensate};

/// E J of the stated data: 210 GPa and a round bar of 1 cm radius, N·m².
pub const STATED: f64 = 210e9 * PI * 1e-8 / 4.0;

/// E J that the printed force error follows from, N·m²; inferred.
pub const HALF: f64 = 804.87;

/// The arm of 3 or 5 joints of section 5 with a bending stiffness of its links in both planes, N·m².
///
/// # Errors
/// There is no arm of so many joints.
pub fn bending(joints: usize, ej: f64) -> Result<Arm, String> {
    let mut arm = crate::methods::arm(&format!("bicchi_{joints}r"))?;
    for beam in arm.joints.iter_mut().filter_map(|joint| joint.beam.as_mut()) {
        beam.iy = ej / beam.youngs_modulus;
        beam.iz = beam.iy;
    }
    Ok(arm)
}

/// The task of section 5: a load of 10 N at the tip, and as the set-point the same wrench on the rigid
/// straight arm, whose links are 1 m long. P = 1.
pub fn task(arm: &Arm) -> Task<'_> {
    let load = Vector6::new(0.0, 10.0, 0.0, 0.0, 0.0, 0.0);
    let target = Vector6::new(0.0, 10.0, 0.0, 0.0, 0.0, 10.0 * arm.dof() as f64);
    Task { arm, load, target, weights: Vector6::repeat(1.0) }
}

/// The components f_x, f_y and m_z of the force error, N and N·m.
///
/// # Errors
/// Never for the arm that is built in.
pub fn force_error(ej: f64) -> Result<Vec<f64>, String> {
    let arm = bending(3, ej)?;
    let e = task(&arm).error(&[0.0; 3]).map_err(|error| error.to_string())?;
    Ok(vec![e[0], e[1], e[5]])
}

/// Steps of the gradient law, eqs. 12 to 15, until V ≤ 1e-6.
///
/// # Errors
/// Never for the arm that is built in.
pub fn steps() -> Result<Vec<f64>, String> {
    let arm = bending(3, HALF)?;
    let found = compensate(&task(&arm), &[0.0; 3], None, 1e-6, 1000);
    Ok(vec![found.map_err(|error| error.to_string())?.steps as f64])
}
