//! Sensitivity of the tool's pose to every entry of the table.

use super::chain::{Chain, ROW, Step};
use super::jacobian::{Twist, flatten};
use super::lever::{From, Levers};
use crate::expr::{Expr, Vec3};
use crate::number::Number;
use crate::robot::Tool;

/// Twist of the tool per unit of theta, d, a, alpha of each row, then of the tool's translation and
/// rotation vector; 6×(4n+6), base axes, at the tool origin.
///
/// A turn's column is that of a revolute joint at its place, a slide's that of a prismatic one.
pub(super) fn parameter_jacobian(chain: &mut Chain) -> Vec<Expr> {
    let levers = Levers::to_tool(chain);
    let mut columns = Vec::new();
    for row in 0..chain.dof() {
        let mut entries: [Twist; 4] = [([Expr::ZERO; 3], [Expr::ZERO; 3]); 4];
        for s in ROW * row..ROW * (row + 1) {
            // Turns about an axis may be taken before or after themselves: the axis is the same.
            let (entry, axis, turns) = match chain.steps()[s] {
                Step::TurnZ(_) => (0, chain.z(s), true),
                Step::SlideZ(_) => (1, chain.z(s), false),
                Step::SlideX(_) => (2, chain.axes(s)[0], false),
                Step::TurnX(_) => (3, chain.axes(s)[0], true),
            };
            entries[entry] = column(chain, &levers, From::Step(s), axis, turns);
        }
        columns.extend(entries);
    }
    let last = chain.axes(chain.steps().len());
    columns.extend(last.map(|axis| (axis, [Expr::ZERO; 3])));
    columns.extend(rotation_columns(chain, last).map(|axis| ([Expr::ZERO; 3], axis)));
    let turned: Vec<Twist> =
        columns.into_iter().map(|(v, w)| (chain.in_base(v), chain.in_base(w))).collect();
    flatten(turned)
}

fn column(chain: &mut Chain, levers: &Levers, from: From, axis: Vec3, turns: bool) -> Twist {
    if !turns {
        return (axis, [Expr::ZERO; 3]);
    }
    let lever = levers.from(&mut chain.g, from, Some(axis));
    (chain.g.cross3(axis, lever), axis)
}

/// Rotation of the tool per unit of each entry of its rotation vector: the left Jacobian of SO(3) at
/// the nominal vector, a constant matrix in the last frame.
fn rotation_columns(chain: &mut Chain, last: [Vec3; 3]) -> [Vec3; 3] {
    let vector = rotation_vector(&chain.robot.tool);
    let square: f64 = vector.iter().map(|c| c * c).sum();
    if square == 0.0 {
        return last;
    }
    let angle = libm::sqrt(square);
    let (first, second) =
        ((1.0 - libm::cos(angle)) / square, (angle - libm::sin(angle)) / (square * angle));
    let end = chain.steps().len();
    chain.turned(series(vector, first, second), end)
}

/// The tool's rotation matrix, columns, from its rotation vector (Rodrigues).
pub(super) fn tool_rotation(tool: &Tool) -> [[Number; 3]; 3] {
    let vector = rotation_vector(tool);
    let square: f64 = vector.iter().map(|c| c * c).sum();
    let angle = libm::sqrt(square);
    if angle == 0.0 {
        return series(vector, 0.0, 0.0);
    }
    series(vector, libm::sin(angle) / angle, (1.0 - libm::cos(angle)) / square)
}

fn rotation_vector(tool: &Tool) -> [f64; 3] {
    // The validator lets no symbol stand in a tool's rotation.
    tool.rotation.each_ref().map(|angle| angle.radians().unwrap_or(0.0))
}

/// Columns of `I + first [v]× + second [v]×²`.
fn series(v: [f64; 3], first: f64, second: f64) -> [[Number; 3]; 3] {
    let square: f64 = v.iter().map(|c| c * c).sum();
    let [x, y, z] = v;
    let cross = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
    core::array::from_fn(|column| {
        core::array::from_fn(|row| {
            let identity = if row == column { 1.0 } else { 0.0 };
            let twice = v[row] * v[column] - square * identity;
            Number::rounded(identity + first * cross[column][row] + second * twice)
        })
    })
}
