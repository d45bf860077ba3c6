//! ROS 2: `joint_limits.yaml`, as `ros2_control` and MoveIt read it, and properties of xacro with the origins of joints.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{ControllerError, axes, told};

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

/// A file for `xacro:include`: `NAME_xyz` and `NAME_rpy` of each joint, whose axis is z, and of the tool in the last link.
/// A remark stands above them.
pub fn origins(arm: &Arm, names: &[String], remark: Option<&str>) -> String {
    let mut text = "<?xml version=\"1.0\"?>\n".to_owned();
    if let Some(remark) = remark {
        // Two hyphens would end the comment.
        text.push_str(&format!("<!-- {} -->\n", remark.replace("--", "- -")));
    }
    text.push_str("<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n");
    let (mut places, end) = axes(arm);
    if let Some(first) = places.first_mut() {
        *first = arm.base * *first;
    }
    places.push(end * arm.tool);
    let tool = "tool".to_owned();
    for (place, name) in places.iter().zip(names.iter().chain([&tool])) {
        let [x, y, z, roll, pitch, yaw] = told(place);
        for (what, [a, b, c]) in [("xyz", [x, y, z]), ("rpy", [roll, pitch, yaw])] {
            text.push_str(&format!(
                "  <xacro:property name=\"{name}_{what}\" value=\"{a:?} {b:?} {c:?}\"/>\n"
            ));
        }
    }
    text + "</robot>\n"
}
