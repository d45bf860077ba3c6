//! The displacement of the tool from three points on it, before and after (Dumas et al., eqs.
//! 27-30).
//!
//! Points are in base axes, m: the first is the origin, the second on x, the third in the plane of
//! x and y. The displacement is the origin's and the rotation from before to after, as a rotation
//! vector in base axes.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3, Vector6};

use super::IdentifyError;
use stiffarm_gap::rng::{Rng, Stream};

/// Below this part of the sides' product three points lie on a line.
const COLLINEAR: f64 = 1e-9;

fn spans(points: &[Vector3<f64>; 3]) -> Result<(), IdentifyError> {
    let (x, y) = (points[1] - points[0], points[2] - points[0]);
    if x.cross(&y).norm() > COLLINEAR * x.norm() * y.norm() {
        return Ok(());
    }
    Err(IdentifyError::Collinear)
}

/// The frame of three points by Gram and Schmidt: origin the first, x to the second, y toward the
/// third.
///
/// # Errors
/// [`IdentifyError::Collinear`].
pub fn frame(points: &[Vector3<f64>; 3]) -> Result<(Rotation3<f64>, Vector3<f64>), IdentifyError> {
    spans(points)?;
    let x = (points[1] - points[0]).normalize();
    let toward = points[2] - points[0];
    let y = (toward - x * x.dot(&toward)).normalize();
    let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    Ok((Rotation3::from_matrix_unchecked(axes), points[0]))
}

/// The displacement as the paper has it: `δp = p' − p` of the first point, `δR = R' Rᵀ` of the
/// frames (eqs. 29-30).
///
/// # Errors
/// [`IdentifyError::Collinear`].
pub fn gram_schmidt(
    before: &[Vector3<f64>; 3],
    after: &[Vector3<f64>; 3],
) -> Result<Vector6<f64>, IdentifyError> {
    let ((r, p), (r_after, p_after)) = (frame(before)?, frame(after)?);
    Ok(stack(p_after - p, &(r_after * r.inverse())))
}

/// The rigid displacement that fits all three points best, least squares (Kabsch, Acta Cryst. A 32,
/// 1976); its translation is that of the first point's place. Noise of one point is shared by all,
/// where Gram and Schmidt put all of the first point's into the translation.
///
/// # Errors
/// [`IdentifyError::Collinear`].
pub fn kabsch(
    before: &[Vector3<f64>; 3],
    after: &[Vector3<f64>; 3],
) -> Result<Vector6<f64>, IdentifyError> {
    spans(before)?;
    spans(after)?;
    let middle = |points: &[Vector3<f64>; 3]| points.iter().sum::<Vector3<f64>>() / 3.0;
    let (from, to) = (middle(before), middle(after));
    let pairs = before.iter().zip(after);
    let spread: Matrix3<f64> =
        pairs.map(|(b, a)| (a - to) * (b - from).transpose()).sum::<Matrix3<f64>>();
    let parts = spread.svd(true, true);
    let (Some(u), Some(v_t)) = (parts.u, parts.v_t) else { return Err(IdentifyError::Collinear) };
    // The smallest singular value belongs to the normal of the plane: a reflection is undone there.
    let smallest = parts.singular_values.imin();
    let mut signs = Vector3::repeat(1.0);
    signs[smallest] = (u * v_t).determinant().signum();
    let rotation = Rotation3::from_matrix_unchecked(u * Matrix3::from_diagonal(&signs) * v_t);
    let translation = to + rotation * (before[0] - from) - before[0];
    Ok(stack(translation, &rotation))
}

/// By the quaternion: the arc cosine of a rotation matrix loses half the digits of a small angle.
fn stack(p: Vector3<f64>, rotation: &Rotation3<f64>) -> Vector6<f64> {
    let r = UnitQuaternion::from_rotation_matrix(rotation).scaled_axis();
    Vector6::new(p.x, p.y, p.z, r.x, r.y, r.z)
}

const BEFORE: [Vector3<f64>; 3] =
    [Vector3::new(1.0, 0.5, -0.3), Vector3::new(1.2, 0.6, -0.3), Vector3::new(0.9, 0.7, -0.2)];

fn moved(twist: &Vector6<f64>) -> [Vector3<f64>; 3] {
    let turn = Rotation3::new(Vector3::new(twist[3], twist[4], twist[5]));
    let shift = Vector3::new(twist[0], twist[1], twist[2]);
    BEFORE.map(|p| BEFORE[0] + shift + turn * (p - BEFORE[0]))
}

#[test]
fn both_give_back_an_exact_displacement() {
    let large = Vector6::new(0.1, -0.2, 0.3, 0.7, -1.1, 0.4);
    for twist in [large, large * 1e-3, Vector6::zeros()] {
        let after = moved(&twist);
        assert!((gram_schmidt(&BEFORE, &after).unwrap() - twist).amax() < 1e-14);
        assert!((kabsch(&BEFORE, &after).unwrap() - twist).amax() < 1e-14);
    }
}

#[test]
fn points_on_a_line_are_refused() {
    let line = [BEFORE[0], BEFORE[1], BEFORE[0] * 2.0 - BEFORE[1]];
    assert_eq!(gram_schmidt(&BEFORE, &line), Err(IdentifyError::Collinear));
    assert_eq!(kabsch(&line, &BEFORE), Err(IdentifyError::Collinear));
    assert_eq!(frame(&[BEFORE[0]; 3]), Err(IdentifyError::Collinear));
}

/// Of a right-angled base of side s, coordinates with noise σ: √2 σ of the translation and 2σ/s
/// of a rotation by Gram and Schmidt; less by least squares.
#[test]
fn the_noise_is_that_of_the_weights() {
    let (s, sigma, draws) = (0.25, 1e-5, 4000);
    let base = [Vector3::zeros(), Vector3::new(s, 0.0, 0.0), Vector3::new(0.0, s, 0.0)];
    let mut rng = Rng::new(1, Stream::Starts);
    let mut squares = [Vector6::zeros(), Vector6::zeros()];
    for _ in 0..draws {
        let before = base.map(|p| p + sigma * rng.normal3());
        let after = base.map(|p| p + sigma * rng.normal3());
        for (sum, twist) in
            squares.iter_mut().zip([gram_schmidt(&before, &after), kabsch(&before, &after)])
        {
            let twist: Vector6<f64> = twist.unwrap();
            *sum += twist.component_mul(&twist) / f64::from(draws);
        }
    }
    let [paper, fitted] = squares.map(|s: Vector6<f64>| s.map(f64::sqrt));
    for k in 0..3 {
        assert!((paper[k] / (2f64.sqrt() * sigma) - 1.0).abs() < 0.05);
        assert!((paper[k + 3] / (2.0 * sigma / s) - 1.0).abs() < 0.05);
        assert!(fitted[k] < paper[k] * 1.02 && fitted[k + 3] < paper[k + 3] * 1.02);
    }
    assert!(fitted[0] < 0.9 * paper[0] && fitted[5] < 0.9 * paper[5]);
}
