//! Where an object is by the directions in which a camera sees points of it.

use nalgebra::{
    DMatrix, Isometry3, Matrix2x3, Matrix3, Matrix6, Rotation3, Unit, UnitQuaternion, Vector2,
    Vector3, Vector6,
};

/// Directions that differ by less than this part of an object's size make it flat.
const FLAT: f64 = 1e-3;

/// Points of a flat object that tell its pose, and of any other.
const LEAST: [usize; 2] = [4, 6];

/// Most steps of the least squares, and the size of the last one, m and rad.
const STEPS: usize = 50;
const LAST: f64 = 1e-13;

/// The pose of an object in the camera's axes, by points of it and the directions `x/z, y/z` in which they are seen:
/// by a homography of a flat object or the direct linear transform of another (Hartley & Zisserman 2004, 4.1 and 7.1),
/// and then by least squares. `None` of too few points, or of points on a line.
pub(crate) fn pose(seen: &[(Vector3<f64>, Vector2<f64>)]) -> Option<Isometry3<f64>> {
    let middle = seen.iter().map(|(p, _)| p).sum::<Vector3<f64>>() / seen.len().max(1) as f64;
    let spread: Matrix3<f64> =
        seen.iter().map(|(p, _)| (p - middle) * (p - middle).transpose()).sum();
    let mut own = spread.symmetric_eigen();
    // The least spread last, so that a flat object lies in x and y.
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| own.eigenvalues[*b].total_cmp(&own.eigenvalues[*a]));
    let axes = order.map(|k| own.eigenvectors.column(k).into_owned());
    let size = order.map(|k| own.eigenvalues[k].max(0.0).sqrt());
    own.eigenvectors = Matrix3::from_columns(&[axes[0], axes[1], axes[0].cross(&axes[1])]);
    let is_flat = size[2] <= FLAT * size[0];
    if seen.len() < LEAST[usize::from(!is_flat)] || size[1] <= FLAT * size[0] {
        return None;
    }
    let turn = Rotation3::from_matrix_unchecked(own.eigenvectors);
    let frame = Isometry3::from_parts(middle.into(), UnitQuaternion::from_rotation_matrix(&turn));
    let scale = 1.0 / size[0];
    let local: Vec<_> = seen
        .iter()
        .map(|(p, d)| (scale * (frame.inverse() * nalgebra::Point3::from(*p)).coords, *d))
        .collect();
    let first = if is_flat { flat(&local)? } else { solid(&local)? };
    let mut starts = vec![first];
    if is_flat {
        starts.push(mirrored(&first));
    }
    let refined = starts.iter().map(|start| refined(&local, *start));
    let (mut best, _) = refined.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    best.translation.vector /= scale;
    let is_finite = best.to_homogeneous().iter().all(|x| x.is_finite());
    Some(best * frame.inverse()).filter(|_| is_finite)
}

/// Nine or twelve numbers, up to a factor, that make equations of two rows for each point 0.
fn null(rows: &[Vec<f64>]) -> Option<Vec<f64>> {
    let columns = rows.first()?.len();
    let matrix = DMatrix::from_fn(rows.len(), columns, |i, k| rows[i][k]);
    let own = matrix.tr_mul(&matrix).symmetric_eigen();
    Some(own.eigenvectors.column(own.eigenvalues.imin()).iter().copied().collect())
}

/// The two equations, linear in the entries of a projective matrix by its rows, by which it takes a point to a direction.
fn equations(point: &[f64], direction: &Vector2<f64>) -> [Vec<f64>; 2] {
    let row = |first: f64, second: f64, by: f64| {
        [first, second, -by].iter().flat_map(|part| point.iter().map(move |x| x * part)).collect()
    };
    [row(1.0, 0.0, direction.x), row(0.0, 1.0, direction.y)]
}

/// By the homography of points with z = 0.
fn flat(seen: &[(Vector3<f64>, Vector2<f64>)]) -> Option<Isometry3<f64>> {
    let rows = seen.iter().flat_map(|(p, d)| equations(&[p.x, p.y, 1.0], d));
    let h = Matrix3::from_row_slice(&null(&rows.collect::<Vec<_>>())?);
    let columns: [Vector3<f64>; 3] = core::array::from_fn(|k| h.column(k).into_owned());
    // What is seen is in front.
    let factor = columns[2].z.signum() * 2.0 / (columns[0].norm() + columns[1].norm());
    let [x, y, place] = columns.map(|column| column * factor);
    Some(Isometry3::from_parts(place.into(), near(&Matrix3::from_columns(&[x, y, x.cross(&y)]))?))
}

/// By the direct linear transform.
fn solid(seen: &[(Vector3<f64>, Vector2<f64>)]) -> Option<Isometry3<f64>> {
    let rows = seen.iter().flat_map(|(p, d)| equations(&[p.x, p.y, p.z, 1.0], d));
    let m = nalgebra::Matrix3x4::from_row_slice(&null(&rows.collect::<Vec<_>>())?);
    let turn: Matrix3<f64> = m.fixed_columns::<3>(0).into_owned();
    let factor = turn.determinant().signum() / turn.determinant().abs().cbrt();
    let rotation = near(&(turn * factor))?;
    Some(Isometry3::from_parts((m.column(3) * factor).into_owned().into(), rotation))
}

fn near(matrix: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let is_finite = matrix.iter().all(|x| x.is_finite());
    is_finite.then(|| UnitQuaternion::from_matrix(matrix))
}

/// The other pose in which a small flat object looks nearly the same: tilted the other way about the line of sight.
fn mirrored(pose: &Isometry3<f64>) -> Isometry3<f64> {
    let normal = pose.rotation * Vector3::z();
    let sight = Unit::new_normalize(pose.translation.vector);
    let other = *sight * (2.0 * sight.dot(&normal)) - normal;
    let turn = UnitQuaternion::rotation_between(&normal, &other).unwrap_or_default();
    Isometry3::from_parts(pose.translation, turn * pose.rotation)
}

/// By Gauss and Newton, and the squares that it leaves.
fn refined(seen: &[(Vector3<f64>, Vector2<f64>)], start: Isometry3<f64>) -> (Isometry3<f64>, f64) {
    let mut pose = start;
    for _ in 0..STEPS {
        let (mut normal, mut right) = (Matrix6::zeros(), Vector6::zeros());
        for (point, direction) in seen {
            let arm = pose.rotation * point;
            let place = arm + pose.translation.vector;
            let left = direction - place.xy() / place.z;
            let slope = Matrix2x3::new(1.0, 0.0, -place.x / place.z, 0.0, 1.0, -place.y / place.z)
                / place.z;
            let mut block = nalgebra::Matrix2x6::zeros();
            block.fixed_columns_mut::<3>(0).copy_from(&slope);
            block.fixed_columns_mut::<3>(3).copy_from(&(slope * -arm.cross_matrix()));
            normal += block.tr_mul(&block);
            right += block.tr_mul(&left);
        }
        let Some(step) = normal.cholesky().map(|factor| factor.solve(&right)) else { break };
        pose.translation.vector += step.fixed_rows::<3>(0);
        let turn = UnitQuaternion::from_scaled_axis(step.fixed_rows::<3>(3).into_owned());
        pose.rotation = turn * pose.rotation;
        if step.amax() < LAST {
            break;
        }
    }
    let left = |(point, direction): &(Vector3<f64>, Vector2<f64>)| {
        let place = pose.rotation * point + pose.translation.vector;
        if place.z > 0.0 {
            (direction - place.xy() / place.z).norm_squared()
        } else {
            f64::INFINITY
        }
    };
    (pose, seen.iter().map(left).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(points: &[Vector3<f64>], pose: &Isometry3<f64>) -> Vec<(Vector3<f64>, Vector2<f64>)> {
        let of = |p: &Vector3<f64>| {
            let place = pose * nalgebra::Point3::from(*p);
            (*p, Vector2::new(place.x / place.z, place.y / place.z))
        };
        points.iter().map(of).collect()
    }

    #[test]
    fn a_board_and_a_body_are_found_where_they_are() {
        let board: Vec<_> = (0..24)
            .map(|k| Vector3::new(f64::from(k % 6) * 0.03, f64::from(k / 6) * 0.03, 0.0))
            .collect();
        let body: Vec<_> = (0..9)
            .map(f64::from)
            .map(|k| Vector3::new((1.3 * k).sin(), (2.1 * k).cos(), 0.2 * k))
            .collect();
        for turn in [
            Vector3::new(0.3, -0.5, 1.0),
            Vector3::new(2.9, 0.2, 0.1),
            Vector3::new(-0.7, 0.0, 3.0),
        ] {
            for (points, far) in [(&board, 0.8), (&body, 6.0)] {
                let pose = Isometry3::new(Vector3::new(0.1, -0.05, far), turn);
                let found = super::pose(&seen(points, &pose)).expect("a pose");
                let off = (found.inverse() * pose).to_homogeneous() - nalgebra::Matrix4::identity();
                assert!(off.amax() < 1e-10, "{off}");
            }
        }
    }

    #[test]
    fn too_little_tells_no_pose() {
        let line: Vec<_> = (0..8).map(|k| Vector3::new(f64::from(k), 0.0, 0.0)).collect();
        let pose = Isometry3::translation(0.0, 0.0, 5.0);
        assert_eq!(super::pose(&seen(&line, &pose)), None);
        assert_eq!(super::pose(&[]), None);
    }
}
