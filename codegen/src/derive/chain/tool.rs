//! The tool's constant rotation.

use crate::number::Number;
use crate::robot::Tool;

/// The tool's rotation matrix, columns, from its rotation vector (Rodrigues).
pub fn tool_rotation(tool: &Tool) -> [[Number; 3]; 3] {
    let vector = rotation_vector(tool);
    let square: f64 = vector.iter().map(|c| c * c).sum();
    let angle = libm::sqrt(square);
    if angle == 0.0 {
        return series(vector, 0.0, 0.0);
    }
    series(vector, libm::sin(angle) / angle, (1.0 - libm::cos(angle)) / square)
}

pub fn rotation_vector(tool: &Tool) -> [f64; 3] {
    // The validator lets no symbol stand in a tool's rotation.
    tool.rotation.each_ref().map(|angle| angle.radians().unwrap_or(0.0))
}

/// Columns of `I + first [v]× + second [v]×²`.
pub fn series(v: [f64; 3], first: f64, second: f64) -> [[Number; 3]; 3] {
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
