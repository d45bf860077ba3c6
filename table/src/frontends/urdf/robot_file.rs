//! The table as a robot file.

use super::angle::{angle, value};
use super::chain::{Chain, Step};
use super::table::Table;
use crate::robot::space::Frame;
use crate::robot::{Convention, Drive, Frame as Fixed, Joint, Robot, Value};

/// The robot of a chain and its table, without stiffnesses, which a URDF does not have.
pub fn robot_file(chain: &Chain, table: &Table) -> Robot {
    let gravity = table.base.inverse().direction(chain.gravity);
    let joints = (0..chain.steps.len()).map(|k| joint(chain, table, k)).collect();
    Robot {
        name: chain.name.clone(),
        convention: Convention::Modified,
        gravity: gravity.map(value),
        joints,
        base: fixed(&table.base),
        tool: fixed(&table.tool),
        ..Robot::default()
    }
}

fn fixed(frame: &Frame) -> Fixed {
    Fixed { translation: frame.origin.map(length), rotation: frame.rotation_vector().map(angle) }
}

fn joint(chain: &Chain, table: &Table, k: usize) -> Joint {
    let (step, row): (&Step, _) = (&chain.steps[k], table.rows[k]);
    let centre = step.lump.centre().map(|centre| {
        let rest = rest(chain, k).point(centre);
        table.frames[k].inverse().point(rest)
    });
    let com = centre.unwrap_or([0.0; 3]);
    // The row's axes in the joint's, at rest.
    let axes = rest(chain, k).inverse().then(&table.frames[k]).axes;
    let tensor = step.lump.tensor(&axes).map(settled);
    let friction = |x: f64| (x != 0.0).then(|| value(x));
    Joint {
        name: step.name.clone(),
        motion: step.motion,
        theta: angle(row.theta),
        d: length(row.d),
        a: length(row.a),
        alpha: angle(row.alpha),
        beta: angle(row.beta),
        mass: centre.map(|_| value(step.lump.mass)),
        com: com.map(length),
        inertia: tensor.map(|entries| entries.map(value)),
        drive: Drive {
            viscous: friction(step.friction[0]),
            coulomb: friction(step.friction[1]),
            ..Drive::default()
        },
        limits: step.limits,
        ..Joint::default()
    }
}

/// A tensor without what rounding has left of its zeros.
fn settled(tensor: [f64; 6]) -> [f64; 6] {
    let largest = tensor.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    tensor.map(|x| if x.abs() < 1e-12 * largest { 0.0 } else { x })
}

/// A length, none below a picometre.
fn length(x: f64) -> Value {
    if x.abs() < 1e-12 { Value::ZERO } else { value(x) }
}

/// The frame of joint k in the base frame, all joints at 0.
fn rest(chain: &Chain, k: usize) -> Frame {
    chain.steps[..=k].iter().fold(Frame::IDENTITY, |whole, step| whole.then(&step.before))
}
