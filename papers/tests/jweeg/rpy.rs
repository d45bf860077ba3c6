//! The displacement of a frame as Jweeg & Al-Khafaji write it: roll, pitch and yaw, and its
//! first-order form.
//!
//! Their symbols: `δx δy δz` the translation, `dψ`, `dβ`, `dφ` the turns about x, y and z, rad (the
//! symbol table's "Deg." cannot be used in eqs. 19, 57 and 58). Here they are the six numbers of a
//! [`Displacement`] in that order.

use nalgebra::{Isometry3, Matrix3, Matrix4, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use stiffarm_gap::displacement::Displacement;
use stiffarm_kernels::generic::Arm;

/// `E = T(δ) · Rot(z, dφ) · Rot(y, dβ) · Rot(x, dψ)`, exact (eqs. 11, 16 and 17).
///
/// Eq. 15 is this product; eqs. 4 and 13 print `Rot(y)` with its sines exchanged, and the third
/// element of the first column of eq. 18 must read `−sin dβ` as in eq. 15.
pub fn transform(error: &Displacement) -> Isometry3<f64> {
    let r = error.rotation;
    let rotation = UnitQuaternion::from_euler_angles(r.x, r.y, r.z);
    Isometry3::from_parts(Translation3::from(error.translation), rotation)
}

/// Eq. 18, corrected: the matrix of [`transform`].
pub fn matrix(error: &Displacement) -> Matrix4<f64> {
    transform(error).to_homogeneous()
}

/// Eq. 19, literally: sines are angles, cosines are 1, products are 0. It is not a rotation: its
/// determinant is `1 + dψ² + dβ² + dφ²`.
pub fn first_order(error: &Displacement) -> Matrix4<f64> {
    let mut matrix = Matrix4::identity();
    let turn = Matrix3::identity() + error.rotation.cross_matrix();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&error.translation);
    matrix
}

/// One chain with an error at every place, `T = E_0 · A_1 E_1 · … · A_n E_n · T_tool E_tool` (eq. 20):
/// the tool in the base frame, m. Each error stands in the axes of its nominal frame on the displaced
/// chain before it; its `form` is [`matrix`] for eq. 18, [`first_order`] for eq. 19.
pub fn product(
    arm: &Arm,
    q: &[f64],
    errors: &[Displacement],
    form: impl Fn(&Displacement) -> Matrix4<f64>,
) -> Matrix4<f64> {
    let mut frames = arm.frames(q);
    frames.push(arm.pose(q));
    let nominal = frames.windows(2).map(|pair| (pair[0].inverse() * pair[1]).to_homogeneous());
    let steps = core::iter::once(Matrix4::identity()).chain(nominal);
    steps.zip(errors).map(|(step, error)| step * form(error)).product()
}

fn turned(psi: f64, beta: f64, phi: f64) -> Displacement {
    Displacement {
        translation: Vector3::new(0.1, 0.2, 0.3),
        rotation: Vector3::new(psi, beta, phi),
    }
}

/// Eq. 15 element by element, and eq. 18 with its corrected `A31`.
#[test]
fn the_nine_elements_of_eq_15() {
    let (psi, beta, phi) = (0.3_f64, -0.5_f64, 0.7_f64);
    let ((sx, cx), (sy, cy), (sz, cz)) = (psi.sin_cos(), beta.sin_cos(), phi.sin_cos());
    #[rustfmt::skip]
    let printed = Matrix4::new(
        cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx, 0.1,
        sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx, 0.2,
        -sy,     cy * sx,                cy * cx,                0.3,
        0.0,     0.0,                    0.0,                    1.0,
    );
    assert!((matrix(&turned(psi, beta, phi)) - printed).amax() < 1e-15);
}

/// In space roll-pitch-yaw and rotation vector differ at the second order: `[[−(β²+φ²)/2, βψ,
/// φψ], [0, −(φ²+ψ²)/2, βφ], [0, 0, −(β²+ψ²)/2]]` here, `[r]×²/2` there.
#[test]
fn the_second_order_of_both_forms() {
    let h = 1e-3;
    let (psi, beta, phi) = (0.6 * h, -0.9 * h, 0.8 * h);
    let error = turned(psi, beta, phi);
    let second = |e: Matrix4<f64>| {
        let change = e - first_order(&error);
        change.fixed_view::<3, 3>(0, 0).into_owned()
    };
    #[rustfmt::skip]
    let expected = Matrix3::new(
        -(beta * beta + phi * phi) / 2.0, beta * psi, phi * psi,
        0.0, -(phi * phi + psi * psi) / 2.0, beta * phi,
        0.0, 0.0, -(beta * beta + psi * psi) / 2.0,
    );
    let cube = h * h * h;
    assert!((second(matrix(&error)) - expected).amax() < cube);
    let cross = error.rotation.cross_matrix();
    let vector = error.transform().to_homogeneous();
    assert!((second(vector) - cross * cross / 2.0).amax() < cube);
}

proptest! {
    #[test]
    fn determinant_of_eq_19(r in prop::array::uniform3(-1.0..1.0f64)) {
        let [psi, beta, phi] = r;
        let found = first_order(&turned(psi, beta, phi)).determinant();
        prop_assert!((found - (1.0 + psi * psi + beta * beta + phi * phi)).abs() < 1e-13);
    }

    #[test]
    fn in_the_plane_both_forms_agree(phi in -3.0..3.0f64) {
        let error = turned(0.0, 0.0, phi);
        let difference = matrix(&error) - error.transform().to_homogeneous();
        prop_assert!(difference.amax() < 1e-15);
    }
}
