//! Sensitivity of the tool's pose to every entry of the table.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, Levers, Point, ROW, Step, entries, flatten, left_jacobian};
use crate::expr::{Expr, Twist, Vec3};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] =
    &[(Output::ParameterJacobian, parameter_jacobian)];

/// Twist of the tool per unit of theta, d, a, alpha of each row, then of the tool's translation and
/// rotation vector; 6×(4n+6), base axes, at the tool origin.
///
/// A rotation's column is that of a revolute joint at its place, a translation's that of a prismatic one.
fn parameter_jacobian(chain: &mut Chain) -> Derived {
    let levers = Levers::to_tool(chain);
    let mut columns: Vec<Twist> = Vec::new();
    for row in 0..chain.dof() {
        for s in entries(chain.robot.convention).map(|offset| ROW * row + offset) {
            // Rotations about an axis may be taken before or after themselves: the axis is the same.
            let (axis, revolute) = match chain.steps()[s] {
                Step::RotateZ(_) => (chain.z(s), true),
                Step::TranslateZ(_) => (chain.z(s), false),
                Step::TranslateX(_) => (chain.axes(s)[0], false),
                Step::RotateX(_) => (chain.axes(s)[0], true),
            };
            columns.push(levers.twist(&mut chain.g, Point::Step(s), axis, revolute));
        }
    }
    let last = chain.axes(chain.steps().len());
    columns.extend(last.map(|axis| (axis, [Expr::ZERO; 3])));
    columns.extend(rotation_columns(chain, last).map(|axis| ([Expr::ZERO; 3], axis)));
    flatten(columns.into_iter().map(|twist| chain.twist_in_base(twist))).into()
}

/// Rotation of the tool per unit of each entry of its rotation vector: the left Jacobian of SO(3) at
/// the nominal vector, a constant matrix in the last frame.
fn rotation_columns(chain: &mut Chain, last: [Vec3; 3]) -> [Vec3; 3] {
    let tool = &chain.robot.tool;
    if tool.rotation.iter().all(|angle| angle.is_zero()) {
        return last;
    }
    chain.turned(left_jacobian(tool), chain.steps().len())
}
