//! Where an object is by the directions in which a camera sees points of it.

use core::iter::successors;

use nalgebra::{
    DMatrix, Isometry3, Matrix2x3, Matrix2x6, Matrix3, Matrix3x4, Matrix6, Rotation3, Unit,
    UnitQuaternion, Vector2, Vector3, Vector6,
};

/// Directions that differ by less than this part of an object's size make it flat.
const FLAT: f64 = 1e-3;

/// Points of a flat object that tell its pose, and of any other.
const LEAST: [usize; 2] = [4, 6];

/// Most steps of the least squares, and the size of the last one, m and rad.
const STEPS: usize = 50;
const LAST: f64 = 1e-13;

/// Halvings of a step that leaves more: beyond a million there is nothing to win.
const HALVINGS: usize = 20;

/// Points of an object and where they are seen, told in axes in which a flat object has z = 0.
pub(super) struct Object {
    pub(super) is_flat: bool,
    /// Where these axes stand in the object's own.
    frame: Isometry3<f64>,
    /// Of them per m.
    scale: f64,
    local: Vec<(Vector3<f64>, Vector2<f64>)>,
}

impl Object {
    /// `None` of too few points, or of points on a line.
    pub(super) fn of(seen: &[(Vector3<f64>, Vector2<f64>)]) -> Option<Object> {
        let middle = seen.iter().map(|(p, _)| p).sum::<Vector3<f64>>() / seen.len().max(1) as f64;
        let spread: Matrix3<f64> =
            seen.iter().map(|(p, _)| (p - middle) * (p - middle).transpose()).sum();
        let own = spread.symmetric_eigen();
        // The least spread last, so that a flat object lies in x and y.
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| own.eigenvalues[*b].total_cmp(&own.eigenvalues[*a]));
        let [x, y, _] = order.map(|k| own.eigenvectors.column(k).into_owned());
        let size = order.map(|k| own.eigenvalues[k].max(0.0).sqrt());
        let is_flat = size[2] <= FLAT * size[0];
        if seen.len() < LEAST[usize::from(!is_flat)] || size[1] <= FLAT * size[0] {
            return None;
        }
        let turn = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        let frame =
            Isometry3::from_parts(middle.into(), UnitQuaternion::from_rotation_matrix(&turn));
        let scale = 1.0 / size[0];
        let local = seen
            .iter()
            .map(|(p, d)| (scale * (frame.inverse() * nalgebra::Point3::from(*p)).coords, *d));
        Some(Object { is_flat, frame, scale, local: local.collect() })
    }

    /// How many numbers are seen.
    pub(super) fn numbers(&self) -> usize {
        2 * self.local.len()
    }

    /// The projective matrix that takes its points to where they are seen, up to a factor: by a homography of a flat
    /// object, whose third column is 0, or the direct linear transform of another (Hartley & Zisserman 2004, 4.1 and
    /// 7.1).
    pub(super) fn projected(&self) -> Option<Matrix3x4<f64>> {
        let of = |p: &Vector3<f64>| match self.is_flat {
            true => vec![p.x, p.y, 1.0],
            false => vec![p.x, p.y, p.z, 1.0],
        };
        let rows = self.local.iter().flat_map(|(p, d)| equations(&of(p), d));
        let found = null(&rows.collect::<Vec<_>>())?;
        Some(match self.is_flat {
            true => Matrix3::from_row_slice(&found).insert_column(2, 0.0),
            false => Matrix3x4::from_row_slice(&found),
        })
    }

    /// A pose near that in which it is seen, where what is seen are directions.
    fn first(&self) -> Option<Isometry3<f64>> {
        let found = self.projected()?;
        let [x, y, z, place]: [Vector3<f64>; 4] =
            core::array::from_fn(|k| found.column(k).into_owned());
        // What is seen is in front.
        let (factor, turn) = if self.is_flat {
            let factor = place.z.signum() * 2.0 / (x.norm() + y.norm());
            let [x, y] = [x * factor, y * factor];
            (factor, Matrix3::from_columns(&[x, y, x.cross(&y)]))
        } else {
            let turn = Matrix3::from_columns(&[x, y, z]);
            let factor = turn.determinant().signum() / turn.determinant().abs().cbrt();
            (factor, turn * factor)
        };
        Some(Isometry3::from_parts((place * factor).into(), near(&turn)?))
    }

    /// A pose near that in which an object that is not flat is seen, as if all of it were equally far (DeMenthon & Davis
    /// 1995): where few points, or in two lines, leave a projective matrix undecided this still has one answer.
    fn far(&self) -> Option<Isometry3<f64>> {
        let middle =
            self.local.iter().map(|(_, d)| d).sum::<Vector2<f64>>() / self.local.len() as f64;
        let spread: Matrix3<f64> = self.local.iter().map(|(p, _)| p * p.transpose()).sum();
        let shown: Matrix2x3<f64> =
            self.local.iter().map(|(p, d)| (d - middle) * p.transpose()).sum();
        let slope = shown * spread.try_inverse()?;
        let [x, y]: [Vector3<f64>; 2] = core::array::from_fn(|k| slope.row(k).transpose());
        let depth = 2.0 / (x.norm() + y.norm());
        let [x, y] = [x.normalize(), y.normalize()];
        let turn = Matrix3::from_columns(&[x, y, x.cross(&y)]).transpose();
        Some(Isometry3::from_parts((middle.push(1.0) * depth).into(), near(&turn)?))
    }
}

/// The pose of an object in the camera's axes, by points of it and the directions `x/z, y/z` in which they are seen:
/// from linear guesses by least squares. `None` of too few points, or of points on a line.
pub fn pose(seen: &[(Vector3<f64>, Vector2<f64>)]) -> Option<Isometry3<f64>> {
    let object = Object::of(seen)?;
    let (first, far) = (object.first(), if object.is_flat { None } else { object.far() });
    let turned = (if object.is_flat { &first } else { &far }).as_ref().map(mirrored);
    let starts = [first, far, turned].into_iter().flatten();
    let refined = starts.map(|start| refined(&object.local, start));
    let (mut best, left) = refined.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    best.translation.vector /= object.scale;
    let is_finite = best.to_homogeneous().iter().chain([&left]).all(|x| x.is_finite());
    Some(best * object.frame.inverse()).filter(|_| is_finite)
}

/// The numbers, up to a factor, that make linear equations, a row each, 0.
pub(super) fn null(rows: &[Vec<f64>]) -> Option<Vec<f64>> {
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

fn near(matrix: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let is_finite = matrix.iter().all(|x| x.is_finite());
    // Without a last iteration it hangs on what is far from a rotation.
    let near = UnitQuaternion::identity();
    is_finite.then(|| UnitQuaternion::from_matrix_eps(matrix, f64::EPSILON, 200, near))
}

/// The rotation with the largest trace product with a matrix.
pub fn nearest_rotation(matrix: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let svd = matrix.svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else { return UnitQuaternion::identity() };
    let mut sign = Matrix3::identity();
    // The least singular value pays for a reflection.
    let least = (0..3).min_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]));
    let least = least.unwrap_or(2);
    sign[(least, least)] = (u * v).determinant().signum();
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(u * sign * v))
}

/// The other pose in which a small flat object looks nearly the same: tilted the other way about the line of sight.
fn mirrored(pose: &Isometry3<f64>) -> Isometry3<f64> {
    let normal = pose.rotation * Vector3::z();
    let sight = Unit::new_normalize(pose.translation.vector);
    let other = *sight * (2.0 * sight.dot(&normal)) - normal;
    let turn = UnitQuaternion::rotation_between(&normal, &other).unwrap_or_default();
    Isometry3::from_parts(pose.translation, turn * pose.rotation)
}

/// By Gauss and Newton, each step halved until it leaves less, and the squares that are left.
fn refined(seen: &[(Vector3<f64>, Vector2<f64>)], start: Isometry3<f64>) -> (Isometry3<f64>, f64) {
    let mut now = (start, left(seen, &start));
    for _ in 0..STEPS {
        let Some(step) = step(seen, &now.0) else { break };
        let halved = successors(Some(1.0), |part| Some(part / 2.0)).take(HALVINGS);
        let moved = halved.map(|part| moved(&now.0, &(step * part)));
        let mut better = moved.map(|pose| (pose, left(seen, &pose)));
        let Some(next) = better.find(|(_, then)| *then < now.1) else { break };
        now = next;
        if step.amax() < LAST {
            break;
        }
    }
    now
}

/// A step of Gauss and Newton, m and rad.
fn step(seen: &[(Vector3<f64>, Vector2<f64>)], pose: &Isometry3<f64>) -> Option<Vector6<f64>> {
    let (mut normal, mut right) = (Matrix6::zeros(), Vector6::zeros());
    for (point, direction) in seen {
        let arm = pose.rotation * point;
        let place = arm + pose.translation.vector;
        let left = direction - place.xy() / place.z;
        let slope =
            Matrix2x3::new(1.0, 0.0, -place.x / place.z, 0.0, 1.0, -place.y / place.z) / place.z;
        let block = by_pose(&slope, &arm);
        normal += block.tr_mul(&block);
        right += block.tr_mul(&left);
    }
    normal.cholesky().map(|factor| factor.solve(&right))
}

/// By how much what is seen changes with the pose, by its change with the place of a point that is `arm` away from the
/// pose's origin: m and rad, as [`moved`] takes them.
pub(super) fn by_pose(by_place: &Matrix2x3<f64>, arm: &Vector3<f64>) -> Matrix2x6<f64> {
    let mut block = Matrix2x6::zeros();
    block.fixed_columns_mut::<3>(0).copy_from(by_place);
    block.fixed_columns_mut::<3>(3).copy_from(&(by_place * -arm.cross_matrix()));
    block
}

pub(super) fn moved(pose: &Isometry3<f64>, step: &Vector6<f64>) -> Isometry3<f64> {
    let place = pose.translation.vector + step.fixed_rows::<3>(0);
    let turn = UnitQuaternion::from_scaled_axis(step.fixed_rows::<3>(3).into_owned());
    Isometry3::from_parts(place.into(), turn * pose.rotation)
}

/// Squares that a pose leaves; without end where a point would be behind the camera.
fn left(seen: &[(Vector3<f64>, Vector2<f64>)], pose: &Isometry3<f64>) -> f64 {
    let of = |(point, direction): &(Vector3<f64>, Vector2<f64>)| {
        let place = pose.rotation * point + pose.translation.vector;
        if place.z > 0.0 {
            (direction - place.xy() / place.z).norm_squared()
        } else {
            f64::INFINITY
        }
    };
    seen.iter().map(of).sum()
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

    /// Corners of a box in two planes, shown by a lens that is told 2 % too long: the best pose, not one without end.
    #[test]
    fn few_corners_of_a_box_tell_its_pose_near_where_it_is() {
        let all = |k: usize| {
            let (x, y) = ((k % 4) as f64, (k / 4) as f64);
            Vector3::new(0.06 * x, 0.06 * y, 0.05 * (k % 2) as f64)
        };
        for left_out in 0..12 {
            let corners: Vec<_> = (0..8).map(|k| all((left_out + 5 * k) % 12)).collect();
            for turn in (0..20).map(f64::from) {
                let turn = Vector3::new(0.6 * (1.7 * turn).sin(), 0.6 * (2.3 * turn).cos(), turn);
                let pose = Isometry3::new(Vector3::new(0.2, 0.3, 0.8), turn);
                for (scale, near) in [(1.0, 1e-9), (0.98, 0.05)] {
                    let seen = seen(&corners, &pose).into_iter().map(|(p, d)| (p, d * scale));
                    let found = super::pose(&seen.collect::<Vec<_>>()).expect("a pose");
                    let off = found.inverse() * pose;
                    assert!(
                        off.translation.vector.norm() < near,
                        "{left_out} {turn} {scale} {off}"
                    );
                }
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
