//! The printer of URDF: the table as links and joints, for simulators and controllers.

use std::fmt::Write as _;

use super::SymbolicTable;
use super::bodies::{Bodies, tensor, words};
use crate::robot::urdf::Frame;
use crate::robot::{Motion, Robot};

/// What a slide without limits is given, for a URDF has to have some, m.
const FAR: f64 = 1e3;

/// The robot as a URDF from the link `base` to the link `tool`. A joint's frame is where the table
/// puts its axis, along z; at q = 0 the arm stands as the table says. Read back it is the same arm to the
/// last digits.
///
/// # Errors
/// [`SymbolicTable`] where a cell of the table is no number.
pub fn urdf(robot: &Robot) -> Result<String, SymbolicTable> {
    let bodies = Bodies::new(robot)?;
    let chain = &bodies.chain;
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<!-- Effort and velocity are not known, and stand at 1e9. Moments of \
         inertia that the robot file does not tell are those of a ball of aluminium. A URDF has neither \
         springs nor rotors nor gravity; the robot file's is {} m/s². -->\n<robot name=\"{}\">\n  <link name=\"base\"/>\n",
        words(chain.gravity),
        bodies.name
    );
    let mut parent = "base".to_owned();
    for (step, names) in chain.steps.iter().zip(&bodies.names) {
        let _ = writeln!(text, "  <link name=\"{}\">", names.link);
        if let Some(centre) = step.lump.centre() {
            let [xx, xy, xz, yy, yz, zz] = tensor(&step.lump);
            let _ = write!(
                text,
                "    <inertial>\n      <origin xyz=\"{}\"/>\n      <mass value=\"{}\"/>\n      <inertia \
                 ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/>\n    \
                 </inertial>\n",
                words(centre),
                step.lump.mass
            );
        }
        let kind = match (step.motion, step.limits) {
            (Motion::Revolute, Some(_)) => "revolute",
            (Motion::Revolute, None) => "continuous",
            (Motion::Prismatic, _) => "prismatic",
        };
        let _ = write!(
            text,
            "  </link>\n  <joint name=\"{}\" type=\"{kind}\">\n{}    <parent link=\"{parent}\"/>\n    \
             <child link=\"{}\"/>\n    <axis xyz=\"0 0 1\"/>\n",
            names.joint,
            origin(&step.before),
            names.link
        );
        let bounds = match (step.motion, step.limits) {
            (Motion::Revolute, None) => String::new(),
            (_, limits) => {
                let [low, high] = limits.unwrap_or([-FAR, FAR]);
                format!("lower=\"{low}\" upper=\"{high}\" ")
            }
        };
        let _ = writeln!(text, "    <limit {bounds}effort=\"1e9\" velocity=\"1e9\"/>");
        let [damping, friction] = step.friction;
        if step.friction != [0.0; 2] {
            let _ = writeln!(text, "    <dynamics damping=\"{damping}\" friction=\"{friction}\"/>");
        }
        text.push_str("  </joint>\n");
        parent.clone_from(&names.link);
    }
    let _ = write!(
        text,
        "  <link name=\"tool\"/>\n  <joint name=\"tool_mount\" type=\"fixed\">\n{}    <parent \
         link=\"{parent}\"/>\n    <child link=\"tool\"/>\n  </joint>\n</robot>\n",
        origin(&chain.end)
    );
    Ok(text)
}

fn origin(frame: &Frame) -> String {
    format!(
        "    <origin xyz=\"{}\" rpy=\"{}\"/>\n",
        words(frame.origin),
        words(frame.roll_pitch_yaw())
    )
}
