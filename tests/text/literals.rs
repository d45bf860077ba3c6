//! No residue of rounding among the constants: what is small is a compliance of the table.

use stiffarm_codegen::emit::{RustOptions, rust};
use stiffarm_codegen::robot::{Angle, Beam, Joint, Robot, Value};

use crate::tables::all;

/// Below this a constant must be accounted for.
const SMALL: f64 = 1e-9;

/// An oblique twist turns the axes of a link's springs: the text then has compliances times direction
/// cosines, which may be below any compliance of the table. This bounds the cosines of the tables
/// here; what rounding leaves of numbers near 1 is far below.
const TURNED: f64 = 1e-3;

/// A constant of the text: `S::lit(a)` or `S::lit(a / b)`.
struct Constant {
    text: String,
    parts: Vec<f64>,
}

impl Constant {
    fn value(&self) -> f64 {
        self.parts[1..].iter().fold(self.parts[0], |value, divisor| value / divisor)
    }
}

fn constants(text: &str) -> Vec<Constant> {
    let inner = text.split("S::lit(").skip(1).map(|rest| rest.split(')').next().unwrap_or(""));
    let number = |part: &str| part.trim().parse().unwrap_or_else(|_| panic!("no number: {part}"));
    inner
        .map(|inner| Constant {
            text: inner.to_owned(),
            parts: inner.split('/').map(number).collect(),
        })
        .collect()
}

/// Whether a twist or an offset is no multiple of a right angle.
fn oblique(robot: &Robot) -> bool {
    let right = |angle: &Angle| match angle {
        Angle::Pi(multiple) => multiple.denom() <= &2,
        Angle::Radians(_) | Angle::Symbol(_) => false,
    };
    robot.joints.iter().any(|joint| !right(&joint.alpha) || !right(&joint.theta))
}

/// Every spring of the table worked out from its numbers: 1/k of joints, and L/EA, L³/12EI, L/GJ, L/EI
/// of links.
fn compliances(robot: &Robot) -> Vec<f64> {
    let joint = |joint: &Joint| Some(joint.stiffness.as_ref()?.number()?.to_f64().recip());
    let joints = robot.joints.iter().filter_map(joint);
    let links = robot.joints.iter().filter_map(|joint| beam(joint, joint.beam.as_ref()?));
    joints.chain(links.flatten()).collect()
}

fn beam(joint: &Joint, beam: &Beam) -> Option<[f64; 6]> {
    let number = |value: &Value| Some(value.number()?.to_f64());
    let length = number(&joint.a)?.hypot(number(&joint.d)?);
    let (e, g) = (number(&beam.youngs_modulus)?, number(&beam.shear_modulus)?);
    let section = &beam.section;
    let (area, iy) = (number(&section.area)?, number(&section.iy)?);
    let (iz, j) = (number(&section.iz)?, number(&section.j)?);
    let cube = length.powi(3) / 12.0;
    Some([
        length / (e * area),
        cube / (e * iy),
        cube / (e * iz),
        length / (g * j),
        length / (e * iy),
        length / (e * iz),
    ])
}

#[test]
fn what_is_small_is_a_compliance_of_the_table() {
    for (name, robot) in all() {
        let known = compliances(&robot);
        let smallest = known.iter().copied().fold(1.0, f64::min);
        assert!(TURNED * smallest > 100.0 * f64::EPSILON, "{name}: a residue could hide");
        let text = rust(&robot, &RustOptions::default());
        for constant in constants(&text) {
            for part in &constant.parts {
                assert!(*part == 0.0 || part.abs() >= SMALL, "{name}: S::lit({})", constant.text);
            }
            let value = constant.value().abs();
            let near = |known: &f64| (value / known - 1.0).abs() < 1e-12;
            let turned = oblique(&robot) && value >= TURNED * smallest;
            let explained = value == 0.0 || value >= SMALL || known.iter().any(near) || turned;
            assert!(explained, "{name}: S::lit({}) is none of {known:?}", constant.text);
        }
    }
}

#[test]
fn constants_are_found() {
    let found = constants("x * S::lit(1.0 / 4.0) + S::lit(-2.5e-3)");
    assert_eq!(found.iter().map(Constant::value).collect::<Vec<_>>(), [0.25, -2.5e-3]);
}
