//! The printer of MJCF: the table as nested bodies, for MuJoCo.

use std::fmt::Write as _;

use super::SymbolicTable;
use super::bodies::{Bodies, tensor, words};
use crate::number::Number;
use crate::robot::urdf::Frame;
use crate::robot::{Drive, Motion, Robot, Value};

/// The robot as an MJCF model with the site `tool`. At rest under gravity and a load the joints' springs
/// give as the robot file says: a spring rests at `qpos_spring`, which is what the joint is commanded to.
///
/// # Errors
/// [`SymbolicTable`] where a cell of the table is no number.
pub fn mjcf(robot: &Robot) -> Result<String, SymbolicTable> {
    let bodies = Bodies::new(robot)?;
    let chain = &bodies.chain;
    let mut text = format!(
        "<!-- The spring of a joint rests at its commanded reading: set qpos_spring to it. Moments of \
         inertia that the robot file does not tell are those of a ball of aluminium, and weightless links have the \
         least that MuJoCo takes. -->\n<mujoco model=\"{}\">\n  <compiler angle=\"radian\" \
         autolimits=\"true\" boundmass=\"1e-9\" boundinertia=\"1e-12\"/>\n  <option gravity=\"{}\"/>\n  \
         <worldbody>\n",
        bodies.name,
        words(chain.gravity)
    );
    for (k, (step, names)) in chain.steps.iter().zip(&bodies.names).enumerate() {
        let indent = "  ".repeat(k + 2);
        let kind = match step.motion {
            Motion::Revolute => "hinge",
            Motion::Prismatic => "slide",
        };
        let range =
            step.limits.map_or(String::new(), |[low, high]| format!(" range=\"{low} {high}\""));
        let stiffness = robot.joints[k].stiffness.as_ref().and_then(Value::number);
        let spring = stiffness.map_or(String::new(), |k| format!(" stiffness=\"{}\"", k.to_f64()));
        let _ = write!(
            text,
            "{indent}<body name=\"{}\"{}>\n{indent}  <joint name=\"{}\" type=\"{kind}\" axis=\"0 0 \
             1\"{range}{spring}{}/>\n",
            names.link,
            place(&step.before),
            names.joint,
            drive(&robot.joints[k].drive)
        );
        let (centre, mass) = (step.lump.centre().unwrap_or_default(), step.lump.mass.max(1e-9));
        let [xx, xy, xz, yy, yz, zz] = tensor(&step.lump);
        let [xx, yy, zz] = [xx, yy, zz].map(|moment| moment.max(1e-12));
        let _ = writeln!(
            text,
            "{indent}  <inertial pos=\"{}\" mass=\"{mass}\" fullinertia=\"{xx} {yy} {zz} {}\"/>",
            words(centre),
            words([xy, xz, yz])
        );
    }
    let depth = chain.steps.len();
    let _ = writeln!(text, "{}<site name=\"tool\"{}/>", "  ".repeat(depth + 2), place(&chain.end));
    for k in (0..depth).rev() {
        let _ = writeln!(text, "{}</body>", "  ".repeat(k + 2));
    }
    text.push_str("  </worldbody>\n</mujoco>\n");
    Ok(text)
}

/// Friction, and the rotor's inertia as the joint feels it.
fn drive(drive: &Drive) -> String {
    let number = |value: &Option<Value>, none: f64| {
        value.as_ref().and_then(Value::number).map_or(none, Number::to_f64)
    };
    let armature = number(&drive.gear, 1.0).powi(2) * number(&drive.rotor_inertia, 0.0);
    let (viscous, dry) = (number(&drive.viscous, 0.0), number(&drive.coulomb, 0.0));
    let each = [("damping", viscous), ("frictionloss", dry), ("armature", armature)].into_iter();
    each.filter(|(_, x)| *x != 0.0).map(|(name, x)| format!(" {name}=\"{x}\"")).collect()
}

fn place(frame: &Frame) -> String {
    let turn = frame.rotation_vector();
    let angle = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (s, c) = (0.5 * angle).sin_cos();
    let [x, y, z] = if angle == 0.0 { [0.0; 3] } else { turn.map(|t| t / angle * s) };
    format!(" pos=\"{}\" quat=\"{c} {}\"", words(frame.origin), words([x, y, z]))
}
