//! Inclinometers: by how much two axes of the flange rise against the horizontal.

use nalgebra::{Isometry3, Matrix2x3, Vector2, Vector3};

/// An axis is never taken for nearer to upright than this sine: there its heading is everything.
const UPRIGHT: f64 = 1e-6;

/// The angles of the tool's x and y axes above the horizontal, rad; z of the measuring frame points up.
pub(super) fn tilts(tool: &Isometry3<f64>) -> Vector2<f64> {
    axes(tool).map(|axis| axis.z.clamp(-1.0, 1.0).asin()).into()
}

/// By how much they change with a turn of the tool.
pub(super) fn by_turn(tool: &Isometry3<f64>) -> Matrix2x3<f64> {
    let rows = axes(tool).map(|axis| {
        let level = axis.xy().norm().max(UPRIGHT);
        (axis.cross(&Vector3::z()) / level).transpose()
    });
    Matrix2x3::from_rows(&rows)
}

fn axes(tool: &Isometry3<f64>) -> [Vector3<f64>; 2] {
    [Vector3::x(), Vector3::y()].map(|axis| tool.rotation * axis)
}
