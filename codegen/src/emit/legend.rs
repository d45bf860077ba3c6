//! What the names in generated text mean.

use std::collections::BTreeSet;

use crate::ir::{Module, Statement};

/// A name as an example, and what it is; other joints' numbers and other axes are named alike.
const MEANINGS: [(&str, &str); 38] = [
    ("z5x", "x of the axis of joint 5"),
    ("x5x", "x of the x axis of frame 5"),
    ("y5x", "x of the y axis of frame 5"),
    ("p5x", "x of the origin of frame 5"),
    ("nx", "x of the tool's x axis"),
    ("ox", "x of the tool's y axis"),
    ("ax", "x of the tool's z axis"),
    ("px", "x of the tool's origin"),
    ("xtx", "x of the tool's x axis in the axes that the function is worked out in"),
    ("ytx", "x of the tool's y axis in these axes"),
    ("ztx", "x of the tool's z axis in these axes"),
    ("r3x", "x of the lever from joint 3 to the tool"),
    ("v4x", "x of the tool's velocity per unit of joint 4's rate"),
    ("fwx", "x of the force on the tool in the axes that the function is worked out in"),
    ("mwx", "x of the moment on the tool in these axes"),
    ("gwx", "x of gravity in these axes"),
    ("s2_x", "x of the first moment of the mass beyond joint 2"),
    ("tau2", "torque of the wrench on joint 2"),
    ("tau_2", "torque that moves joint 2"),
    ("tg2", "torque of the links' weights on joint 2"),
    ("kc_31", "row 3, column 1 of K_C"),
    ("kg_31", "row 3, column 1 of the stiffness of the links' weights"),
    ("k_31", "row 3, column 1 of the stiffness of the loaded joints"),
    ("dq2", "deflection of joint 2"),
    ("dqg2", "deflection of joint 2 under wrench and weights"),
    ("compliance2", "1 / stiffness of joint 2"),
    ("len2", "length of link 2"),
    ("axial2", "compliance of link 2 along its axis"),
    ("across_y2", "compliance of link 2 across its axis, along y"),
    ("across_z2", "compliance of link 2 across its axis, along z"),
    ("torsion2", "compliance of link 2 about its axis"),
    ("bend_y2", "compliance of link 2 about y"),
    ("bend_z2", "compliance of link 2 about z"),
    ("m_31", "row 3, column 1 of the mass matrix"),
    ("ddq2", "acceleration of joint 2"),
    (
        "w2x, dw2x, a2x",
        "x of link 2's angular velocity and acceleration, and of its origin's acceleration",
    ),
    ("f2x, n2x", "x of the force and the moment on link 2 and all beyond"),
    ("t1", "what is used more than once, or too long for a line"),
];

/// A name without its numbers and its axis.
fn kind(name: &str) -> String {
    let axis = name.ends_with(['x', 'y', 'z']);
    let name = if axis { &name[..name.len() - 1] } else { name };
    let mut kind = String::new();
    for c in name.chars() {
        match c.is_ascii_digit() {
            true if kind.ends_with('#') => {}
            true => kind.push('#'),
            false => kind.push(c),
        }
    }
    if axis { kind + "x" } else { kind }
}

/// What the names in the functions of a module mean, as far as they occur, in one sentence.
pub(super) fn legend(module: &Module) -> String {
    let body = module.functions().flat_map(|function| &function.body);
    let occur: BTreeSet<String> =
        body.flat_map(Statement::defines).map(|name| kind(&name)).collect();
    let sines = module.posture.angles.last().map(|angle| {
        let suffix = &angle.suffix;
        format!("s{suffix}, c{suffix}: sine, cosine of θ{suffix}")
    });
    let occurs = |names: &str| names.split(", ").any(|name| occur.contains(&kind(name)));
    let each = MEANINGS.iter().filter(|(names, _)| occurs(names));
    let each = each.map(|(names, meaning)| format!("{names}: {meaning}"));
    let all: Vec<String> = sines.into_iter().chain(each).collect();
    format!("Names, by example: {}.", all.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Output, Robot};

    /// No name of an arm with all effects of the table is left without a meaning.
    #[test]
    fn every_name_has_a_meaning() {
        let known: BTreeSet<String> =
            MEANINGS.iter().flat_map(|(names, _)| names.split(", ")).map(kind).collect();
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../c/arm.toml");
        let text = std::fs::read_to_string(file).expect("the file is here");
        let (mut robot, _) = Robot::from_toml(&text, file).expect("a valid file");
        robot.outputs = Output::EACH.to_vec();
        let module = Module::new(&robot, &[], false);
        let mut found = 0;
        for name in module.functions().flat_map(|f| &f.body).flat_map(Statement::defines) {
            // The second of two that are called alike has a number behind `_`.
            let first = name.rsplit_once('_').map_or(&*name, |(first, _)| first);
            let known = [&name, first].iter().any(|name| known.contains(&kind(name)));
            assert!(known, "{name}: {}", kind(&name));
            found += 1;
        }
        assert!(found > 1000 && legend(&module).contains("z5x: x of the axis of joint 5"));
    }
}
