//! Arms for the generator's tests, built without a reader.

use num_rational::Ratio;
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Angle, Convention, Joint, Robot, Value};

/// A row: a, alpha in quarter turns, d; millimetres.
pub struct Row(pub i128, pub i64, pub i128);

/// A revolute arm of whole millimetres and quarter turns, every joint 1e6 N·m/rad.
pub fn arm(name: &str, convention: Convention, rows: &[Row]) -> Robot {
    let length = |mm| Value::Number(Number::ratio(mm, 1000));
    let joints = rows.iter().enumerate().map(|(i, Row(a, alpha, d))| Joint {
        name: format!("joint {}", i + 1),
        d: length(*d),
        a: length(*a),
        alpha: Angle::Pi(Ratio::new(*alpha, 2)),
        stiffness: Some(Value::Number(Number::integer(1_000_000))),
        ..Joint::default()
    });
    Robot { name: name.into(), convention, joints: joints.collect(), ..Robot::default() }
}

/// UR5, lengths rounded to millimetres (the counts do not depend on them).
pub fn ur5() -> Robot {
    let rows = [Row(0, 1, 89), Row(-425, 0, 0), Row(-392, 0, 0), Row(0, 1, 109), Row(0, -1, 95)];
    let last = Row(0, 0, 82);
    arm("UR5", Convention::Standard, &rows.into_iter().chain([last]).collect::<Vec<_>>())
}

/// KUKA KR 240-2 (Dumas et al. 2011, Table 3).
pub fn kr240() -> Robot {
    let rows = [
        Row(0, 0, 0),
        Row(350, 1, 0),
        Row(1250, 0, 0),
        Row(55, -1, 1100),
        Row(0, 1, 0),
        Row(0, -1, 230),
    ];
    arm("KUKA KR 240-2", Convention::Modified, &rows)
}
