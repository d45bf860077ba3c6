//! Cells of a table as text.

use crate::number::Number;
use crate::robot::pi::spell;
use crate::robot::{Angle, Frame, Joint, Motion, Robot, Value};

/// The stiffness of a joint with its unit; `rigid` of one that has none.
pub(super) fn stiffness(joint: &Joint) -> String {
    let unit = match joint.motion {
        Motion::Revolute => "N·m/rad",
        Motion::Prismatic => "N/m",
    };
    joint.stiffness.as_ref().map_or("rigid".to_owned(), |k| format!("{} {unit}", value(k)))
}

/// Where a frame stands: its translation, and the rotation vector by which it is turned.
pub(super) fn place(frame: &Frame) -> String {
    let list = |cells: [String; 3]| cells.join(", ");
    let at = list(frame.translation.each_ref().map(value));
    let turned = list(frame.rotation.each_ref().map(angle));
    format!("at [{at}] m, turned by the rotation vector [{turned}]")
}

/// In which axes results are, where these are not those of the base.
pub(super) fn world(robot: &Robot) -> Option<String> {
    (robot.base != Frame::default()).then(|| {
        format!(
            "What is told in base axes below is told in the world's, in which the base stands {}.",
            place(&robot.base)
        )
    })
}

/// A cell as text.
pub(super) fn value(value: &Value) -> String {
    match value {
        Value::Number(n) => plain(*n),
        Value::Symbol(name) => name.clone(),
    }
}

/// A number without the `.0` of an integer.
fn plain(n: Number) -> String {
    let text = n.to_string();
    text.strip_suffix(".0").map_or(text.clone(), str::to_string)
}

/// An angle cell as text: `-pi/2`, `3*pi/4`, radians, or a symbol.
pub(super) fn angle(angle: &Angle) -> String {
    match angle {
        Angle::Symbol(name) => name.clone(),
        Angle::Radians(n) => plain(*n),
        Angle::Pi(r) => spell(*r),
    }
}
