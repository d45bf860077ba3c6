//! Writes a robot as a robot file that reads back as the same robot.

use core::fmt::Write as _;

use super::super::decimal;
use super::super::model::{
    Angle, Beam, Convention, Drive, Effect, Frame, Joint, Motion, NamedFrame, Quantity, Robot,
    Value,
};
use super::super::pi::spell;

impl Robot {
    /// The robot as a robot file. Reading it back gives the same robot: parameters by name, exact
    /// multiples of π as such, every number as the same double.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        // Writing into a `String` cannot fail.
        let _ = write_robot(&mut text, self);
        text
    }
}

fn write_robot(text: &mut String, robot: &Robot) -> core::fmt::Result {
    let convention = match robot.convention {
        Convention::Standard => "standard",
        Convention::Modified => "modified",
    };
    writeln!(text, "name = {}", quoted(&robot.name))?;
    writeln!(text, "convention = \"{convention}\"")?;
    writeln!(text, "gravity = {}", list(robot.gravity.iter().map(value)))?;
    if let Some(side) = robot.torque_side {
        writeln!(text, "torque_side = \"{side}\"")?;
    }
    let asked = robot.asked();
    if !asked.is_empty() {
        writeln!(text, "outputs = {}", list(asked.iter().map(|name| quoted(name))))?;
    }
    for (i, joint) in robot.joints.iter().enumerate() {
        write_joint(text, i, joint)?;
    }
    for (name, frame) in [("base", &robot.base), ("tool", &robot.tool)] {
        if *frame != Frame::default() {
            writeln!(text, "\n[{name}]")?;
            write_frame(text, frame)?;
        }
    }
    for NamedFrame { name, row, frame } in &robot.frames {
        writeln!(text, "\n[[frame]]\nname = {}\njoint = {}", quoted(name), row + 1)?;
        write_frame(text, frame)?;
    }
    for marker in &robot.markers {
        writeln!(text, "\n[[marker]]\nname = {}", quoted(&marker.name))?;
        if let Some(translation) = &marker.translation {
            writeln!(text, "translation = {}", list(translation.iter().map(value)))?;
        }
    }
    robot.effects.iter().try_for_each(|effect| write_effect(text, effect))?;
    for payload in &robot.payloads {
        writeln!(text, "\n[[payload]]\nname = {}", quoted(&payload.name))?;
        writeln!(text, "mass = {}", value(&payload.mass))?;
        writeln!(text, "com = {}", list(payload.com.iter().map(value)))?;
        if let Some(inertia) = &payload.inertia {
            writeln!(text, "inertia = {}", list(inertia.iter().map(value)))?;
        }
    }
    Ok(())
}

fn write_frame(text: &mut String, frame: &Frame) -> core::fmt::Result {
    writeln!(text, "translation = {}", list(frame.translation.iter().map(value)))?;
    writeln!(text, "rotation = {}", list(frame.rotation.iter().map(angle)))
}

fn write_effect(text: &mut String, effect: &Effect) -> core::fmt::Result {
    writeln!(text, "\n[[effect]]\nid = {}", quoted(&effect.id.value))?;
    writeln!(text, "place = {}", quoted(&effect.place.value))?;
    for number in &effect.numbers {
        // A whole number is the number of something.
        let value = match &number.value {
            Quantity::Si(x) if x.fract() == 0.0 && x.abs() < 1e9 => format!("{x:.0}"),
            Quantity::Si(x) => format!("{x:?}"),
            Quantity::Text(text) => quoted(text),
        };
        writeln!(text, "{} = {value}", key(&number.key))?;
    }
    Ok(())
}

/// A key as it may stand, in quotes if it must.
fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { quoted(name) }
}

fn write_joint(text: &mut String, index: usize, joint: &Joint) -> core::fmt::Result {
    let motion = match joint.motion {
        Motion::Revolute => "revolute",
        Motion::Prismatic => "prismatic",
    };
    writeln!(text, "\n[[joint]]\ntype = \"{motion}\"")?;
    if joint.name != format!("joint {}", index + 1) {
        writeln!(text, "name = {}", quoted(&joint.name))?;
    }
    writeln!(text, "theta = {}", angle(&joint.theta))?;
    writeln!(text, "d = {}", value(&joint.d))?;
    writeln!(text, "a = {}", value(&joint.a))?;
    writeln!(text, "alpha = {}", angle(&joint.alpha))?;
    if !joint.beta.is_zero() {
        writeln!(text, "beta = {}", angle(&joint.beta))?;
    }
    if let Some(stiffness) = &joint.stiffness {
        writeln!(text, "stiffness = {}", value(stiffness))?;
    }
    if let Some(mass) = &joint.mass {
        writeln!(text, "mass = {}", value(mass))?;
        writeln!(text, "com = {}", list(joint.com.iter().map(value)))?;
    }
    if let Some(inertia) = &joint.inertia {
        writeln!(text, "inertia = {}", list(inertia.iter().map(value)))?;
    }
    let Drive { gear, rotor_inertia, coulomb, viscous } = &joint.drive;
    let drive = [
        ("gear", gear),
        ("rotor_inertia", rotor_inertia),
        ("coulomb", coulomb),
        ("viscous", viscous),
    ];
    for (key, number) in drive {
        if let Some(number) = number {
            writeln!(text, "{key} = {}", value(number))?;
        }
    }
    if let Some(limits) = &joint.limits {
        writeln!(text, "limits = {}", list(limits.iter().map(|x| limit(joint.motion, *x))))?;
    }
    if let Some(source) = &joint.source {
        writeln!(text, "source = {}", quoted(source))?;
    }
    joint.beam.as_ref().map_or(Ok(()), |beam| write_beam(text, beam))
}

fn write_beam(text: &mut String, beam: &Beam) -> core::fmt::Result {
    writeln!(text, "\n[joint.beam]")?;
    writeln!(text, "youngs_modulus = {}", value(&beam.youngs_modulus))?;
    writeln!(text, "shear_modulus = {}", value(&beam.shear_modulus))?;
    let section = &beam.section;
    let constants =
        [("area", &section.area), ("iy", &section.iy), ("iz", &section.iz), ("j", &section.j)];
    let constants = constants.map(|(key, constant)| format!("{key} = {}", value(constant)));
    writeln!(text, "section = {{ {} }}", constants.join(", "))?;
    if let Some(density) = &beam.density {
        writeln!(text, "density = {}", value(density))?;
    }
    if let Some(coefficient) = &beam.shear_coefficient {
        writeln!(text, "shear_coefficient = {}", value(coefficient))?;
    }
    Ok(())
}

fn list(entries: impl Iterator<Item = String>) -> String {
    format!("[{}]", entries.collect::<Vec<_>>().join(", "))
}

fn quoted(text: &str) -> String {
    ::toml::Value::from(text).to_string()
}

fn value(value: &Value) -> String {
    match value {
        Value::Number(n) => decimal::write(*n),
        Value::Symbol(name) => quoted(name),
    }
}

fn angle(angle: &Angle) -> String {
    match angle {
        Angle::Pi(r) if *r.numer() == 0 => "0.0".to_owned(),
        Angle::Pi(r) => quoted(&spell(*r)),
        Angle::Radians(n) => decimal::write(*n),
        Angle::Symbol(name) => quoted(name),
    }
}

fn limit(motion: Motion, x: f64) -> String {
    match (motion, super::super::pi::exact_multiple(x)) {
        // Written as a multiple only where that reads back as the same double.
        (Motion::Revolute, Some(r)) if Angle::Pi(r).radians() == Some(x) => angle(&Angle::Pi(r)),
        _ => format!("{x:?}"),
    }
}
