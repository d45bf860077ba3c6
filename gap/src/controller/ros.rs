//! `joint_limits.yaml`, as `ros2_control` and MoveIt read it.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::ControllerError;

/// The limits of the joints by their names, rad and m. Velocities, accelerations and efforts are in no robot file.
///
/// # Errors
/// [`ControllerError::Missing`] if no joint has limits.
pub fn joint_limits(arm: &Arm, names: &[String]) -> Result<String, ControllerError> {
    if arm.joints.iter().all(|joint| joint.limits.is_none()) {
        return Err(ControllerError::Missing("limits".to_owned(), "limits of a joint"));
    }
    let mut text = "joint_limits:\n".to_owned();
    for (joint, name) in arm.joints.iter().zip(names) {
        text.push_str(&format!("  {name}:\n"));
        match joint.limits {
            Some([low, high]) => text.push_str(&format!(
                "    has_position_limits: true\n    min_position: {low:?}\n    max_position: {high:?}\n"
            )),
            None => text.push_str("    has_position_limits: false\n"),
        }
        if joint.motion == Motion::Revolute {
            let around = if joint.limits.is_none() { "true" } else { "false" };
            text.push_str(&format!("    angle_wraparound: {around}\n"));
        }
    }
    Ok(text)
}
