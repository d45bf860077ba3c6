//! How the tool moves with each entry of the table.

use nalgebra::{Matrix3, Matrix6xX, UnitQuaternion, Vector3, Vector6};

use super::arm::{Arm, Convention};
use super::kinematics::origin;
use super::spatial::stack;
use super::textbook::{Textbook, block};
use crate::Output;

/// Left Jacobian of SO(3): a change `dr` of the rotation vector `r` turns the rotated body by
/// `J_l(r) dr` in the fixed axes. `J_l = 1 + (1 − cos φ)/φ² [r]× + (φ − sin φ)/φ³ [r]×²`, φ = |r|.
fn left_jacobian(r: &Vector3<f64>) -> Matrix3<f64> {
    let angle = r.norm();
    let square = angle * angle;
    // 1 − cos φ = 2 sin²(φ/2) does not cancel.
    let first = if angle == 0.0 { 0.5 } else { 2.0 * (angle / 2.0).sin().powi(2) / square };
    // φ − sin φ does: below 0.1 its series, whose next term, φ⁸/11!, is below 3e-16.
    let second = if angle < 0.1 {
        (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0))) / 6.0
    } else {
        (angle - angle.sin()) / (square * angle)
    };
    let cross = r.cross_matrix();
    Matrix3::identity() + cross * first + cross * cross * second
}

/// The outputs of this file.
pub(super) const TEXTBOOK: &[(Output, Textbook)] =
    &[(Output::ParameterJacobian, |arm, q, _| Ok(block(arm.parameter_jacobian(q))))];

impl Arm {
    /// Twist of the tool per unit of each entry of the table, 6×(4n+6), base axes, at the tool
    /// origin. Columns: theta, d, a, alpha of row 1, of row 2, ...; the tool's translation x, y, z,
    /// in the last frame's axes; the three entries of [`Arm::tool_rotation_vector`].
    ///
    /// theta and d turn about and slide along z of frame i−1 (standard) or i (modified). In the standard
    /// convention a slides along and alpha turns about x of frame i before `Ry(beta)`; in the modified
    /// one alpha turns about x of frame i−1, and a slides along it behind `Rx(alpha) Ry(beta)`.
    pub fn parameter_jacobian(&self, q: &[f64]) -> Matrix6xX<f64> {
        let frames = self.frames(q);
        let p = self.tool_origin(q);
        let slide = |axis: Vector3<f64>| stack(axis, Vector3::zeros());
        let turn =
            |axis: Vector3<f64>, through: Vector3<f64>| stack(axis.cross(&(p - through)), axis);

        let n = self.dof();
        let mut jacobian = Matrix6xX::zeros(4 * n + 6);
        let mut set = |column: usize, twist: Vector6<f64>| jacobian.set_column(column, &twist);
        for i in 0..n {
            let joint = &self.joints[i];
            let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), joint.beta);
            let twist = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), joint.alpha);
            let x = Vector3::x();
            let (with_z, with_x, along, x) = match self.convention {
                Convention::Standard => {
                    let before = frames[i + 1].rotation * tilt.inverse() * x;
                    (&frames[i], &frames[i + 1], before, before)
                }
                Convention::Modified => {
                    let turned = frames[i].rotation;
                    (&frames[i + 1], &frames[i], turned * twist * tilt * x, turned * x)
                }
            };
            let z = with_z * Vector3::z();
            set(4 * i, turn(z, origin(with_z)));
            set(4 * i + 1, slide(z));
            set(4 * i + 2, slide(along));
            set(4 * i + 3, turn(x, origin(with_x)));
        }
        let last = frames[n].rotation;
        let spin = left_jacobian(&self.tool_rotation_vector);
        for k in 0..3 {
            set(4 * n + k, slide(last * Vector3::ith(k, 1.0)));
            set(4 * n + 3 + k, turn(last * spin.column(k), p));
        }
        jacobian
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    /// `exp [r]× = 1 + [r]× J_l(r)`, on both sides of the series' limit, to a few roundings.
    #[test]
    fn left_jacobian_integrates_to_the_rotation() {
        let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        for angle in [0.0, 1e-9, 1e-3, 0.05, 0.0999, 0.1001, 1.0, 3.0, 5.0] {
            let r = axis * angle;
            let rotation = Matrix3::identity() + r.cross_matrix() * left_jacobian(&r);
            let error = rotation - Rotation3::new(r).matrix();
            assert!(error.amax() < 4e-15, "{angle}: {}", error.amax());
        }
    }
}
