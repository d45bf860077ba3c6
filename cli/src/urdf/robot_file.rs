//! The table as a robot file.

use nalgebra::{IsometryMatrix3, Point3, Rotation3, UnitQuaternion, Vector3};
use stiffarm_codegen::robot::{Convention, Joint, Robot, Tool, Value};

use super::angle::{angle, value};
use super::chain::{Chain, Step};
use super::table::Table;

/// The robot of a chain and its table, without stiffnesses, which a URDF does not have.
pub fn robot_file(chain: &Chain, table: &Table) -> Robot {
    let [theta, _] = table.lead;
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -theta);
    let gravity = turn * chain.gravity;
    let rotation = UnitQuaternion::from_rotation_matrix(&table.tool.rotation).scaled_axis();
    let joints = (0..chain.steps.len()).map(|k| joint(chain, table, k)).collect();
    Robot {
        name: chain.name.clone(),
        convention: Convention::Modified,
        gravity: [value(gravity.x), value(gravity.y), value(gravity.z)],
        joints,
        tool: Tool {
            translation: core::array::from_fn(|k| length(table.tool.translation.vector[k])),
            rotation: core::array::from_fn(|k| angle(rotation[k])),
        },
        markers: Vec::new(),
    }
}

fn joint(chain: &Chain, table: &Table, k: usize) -> Joint {
    let (step, row): (&Step, _) = (&chain.steps[k], table.rows[k]);
    let centre = step.lump.centre().map(|centre| {
        let rest = rest(chain, k) * centre;
        table.frames[k].inverse_transform_point(&rest)
    });
    let com = centre.unwrap_or(Point3::origin());
    Joint {
        name: step.name.clone(),
        motion: step.motion,
        theta: angle(row.theta),
        d: length(row.d),
        a: length(row.a),
        alpha: angle(row.alpha),
        stiffness: None,
        mass: centre.map(|_| value(step.lump.mass)),
        com: core::array::from_fn(|k| length(com[k])),
        limits: step.limits,
        source: None,
        beam: None,
    }
}

/// A length, none below a picometre.
fn length(x: f64) -> Value {
    if x.abs() < 1e-12 { Value::ZERO } else { value(x) }
}

/// The frame of joint k in the base frame, all joints at 0.
fn rest(chain: &Chain, k: usize) -> IsometryMatrix3<f64> {
    chain.steps[..=k].iter().fold(IsometryMatrix3::identity(), |whole, step| whole * step.before)
}
