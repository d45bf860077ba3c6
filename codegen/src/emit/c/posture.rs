//! The posture as a struct of C, and the statements that make it.

use super::super::posture::{Posture, displacement, unit};
use crate::emit::lines::Lines;
use crate::robot::Robot;

/// The struct.
pub(super) fn declaration(
    posture: &Posture,
    out: &mut Lines,
    robot: &Robot,
    (name, real): (&str, &str),
) {
    out.comment(&[
        "The joint values as the kernels need them: sines, cosines, displacements.".to_string()
    ]);
    out.code("typedef struct");
    out.code("{");
    out.indent();
    for pair in &posture.angles {
        out.code(&format!("{real} s{}; /* sine of {} */", pair.suffix, pair.sum));
        out.code(&format!("{real} c{}; /* cosine of {} */", pair.suffix, pair.sum));
    }
    for joint in &posture.prismatic {
        let unit = unit(robot, *joint);
        out.code(&format!("{real} {}; /* q[{joint}], {unit} */", displacement(*joint)));
    }
    out.dedent();
    out.code(&format!("}} {name}_posture_t;"));
}

/// Statements that make every field.
pub(super) fn statements(posture: &Posture) -> impl Iterator<Item = String> {
    let angles = posture
        .angles
        .iter()
        .map(|pair| format!("sin_cos({}, &posture->s{1}, &posture->c{1});", pair.sum, pair.suffix));
    let displacements = posture.prismatic.iter();
    angles.chain(displacements.map(|j| format!("posture->{} = q[{j}];", displacement(*j))))
}
