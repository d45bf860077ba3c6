//! Poses as the numbers that a language writes, in SI.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::io::Convention;

/// Below this sine of its distance from ±90°, a middle turn leaves only the sum or difference of the outer two
/// determined.
const LOCKED: f64 = 1e-6;

/// The pose of three coordinates (m) and the orientation's numbers (rad); `None` of an orientation that is none.
pub(crate) fn pose(convention: Convention, n: &[f64]) -> Option<Isometry3<f64>> {
    let rotation = UnitQuaternion::from_scaled_axis(convention.rotation(&n[3..])?);
    let pose = Isometry3::from_parts(Vector3::new(n[0], n[1], n[2]).into(), rotation);
    pose.to_homogeneous().iter().all(|x| x.is_finite()).then_some(pose)
}

/// The numbers of a pose, of those that mean the same the nearest to `near`.
pub(crate) fn numbers(convention: Convention, pose: &Isometry3<f64>, near: &[f64]) -> Vec<f64> {
    let (old, rotation) = (&near[3..], &pose.rotation);
    let turns = match convention {
        Convention::Quaternion => quaternion(rotation, old),
        // KRL's first turn is about z, FANUC's about x: the same turns in the other order.
        Convention::ABC => z_y_x(rotation, old),
        Convention::RPY => {
            let mut turns = z_y_x(rotation, &[old[2], old[1], old[0]]);
            turns.reverse();
            turns
        }
        _ => rotation_vector(rotation, old),
    };
    pose.translation.vector.iter().copied().chain(turns).collect()
}

/// Of `q` and `−q` the nearer to `old`, as long as `old` was.
fn quaternion(rotation: &UnitQuaternion<f64>, old: &[f64]) -> Vec<f64> {
    let new = [rotation.w, rotation.i, rotation.j, rotation.k];
    let along: f64 = new.iter().zip(old).map(|(a, b)| a * b).sum();
    new.iter().map(|x| x * 1.0_f64.copysign(along)).collect()
}

/// Of the vectors that are whole turns apart the nearest to `old`.
fn rotation_vector(rotation: &UnitQuaternion<f64>, old: &[f64]) -> Vec<f64> {
    let old = Vector3::new(old[0], old[1], old[2]);
    let new = rotation.scaled_axis();
    let axis = match new.try_normalize(0.0) {
        Some(axis) => axis,
        None => old.try_normalize(0.0).unwrap_or_default(),
    };
    let angle = new.norm();
    let turns = ((old.dot(&axis) - angle) / core::f64::consts::TAU).round();
    (axis * (angle + turns * core::f64::consts::TAU)).iter().copied().collect()
}

/// `a`, `b`, `c` of `Rz(a) Ry(b) Rx(c)`, of both solutions and all whole turns the nearest to `old`. Where `b` is
/// ±90°, `c` stays what it was.
fn z_y_x(rotation: &UnitQuaternion<f64>, old: &[f64]) -> Vec<f64> {
    let m = rotation.to_rotation_matrix();
    let cosine = m[(0, 0)].hypot(m[(1, 0)]);
    let b = (-m[(2, 0)]).atan2(cosine);
    if cosine < LOCKED {
        // Rz(a) Ry(±90°) Rx(c): a ∓ c alone is in the matrix.
        let c = old[2];
        let a = (-m[(0, 1)]).atan2(m[(1, 1)]) + c.copysign(c * b.signum());
        return near([a, b, c], old).to_vec();
    }
    let (a, c) = (m[(1, 0)].atan2(m[(0, 0)]), m[(2, 1)].atan2(m[(2, 2)]));
    let half = core::f64::consts::PI;
    let [one, other] = [[a, b, c], [a + half, half - b, c + half]].map(|turns| near(turns, old));
    let far = |turns: &[f64; 3]| -> f64 { turns.iter().zip(old).map(|(x, y)| (x - y).abs()).sum() };
    if far(&one) <= far(&other) { one } else { other }.to_vec()
}

fn near(turns: [f64; 3], old: &[f64]) -> [f64; 3] {
    let turn = core::f64::consts::TAU;
    core::array::from_fn(|k| turns[k] + ((old[k] - turns[k]) / turn).round() * turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is written is read again, and stands beside what was there, also past whole turns and where the
    /// middle turn is 90°.
    #[test]
    fn poses_are_written_as_they_were_read() {
        let turned = [
            [179.99, 10.0, -179.99],
            [-179.999, 0.0, 180.0],
            [35.0, 90.0, 12.0],
            [35.0, -90.0, 12.0],
            [35.0, 89.9999999, 12.0],
            [10.0, 170.0, 20.0],
            [0.0, 0.0, 0.0],
            [370.0, 5.0, -400.0],
        ];
        let shift = Isometry3::new(Vector3::new(1e-4, 0.0, -2e-4), Vector3::new(0.0, 0.0, 1e-6));
        for convention in [Convention::ABC, Convention::RPY] {
            for turns in turned.map(|turns| turns.map(f64::to_radians)) {
                let n = [0.5, -0.02, 0.003, turns[0], turns[1], turns[2]];
                let is = pose(convention, &n).unwrap();
                for moved in [is, shift * is] {
                    let back = pose(convention, &numbers(convention, &moved, &n)).unwrap();
                    assert!((back.to_homogeneous() - moved.to_homogeneous()).amax() < 2e-6);
                }
                same(convention, &n, 2e-7);
            }
        }
        for vector in [[0.0, 3.1, 0.1], [2.0, -2.6, 0.0], [0.0, 4.0, 0.0], [0.0; 3]] {
            let n = [0.1, 0.2, 0.3, vector[0], vector[1], vector[2]];
            same(Convention::RotationVector, &n, 1e-12);
        }
        same(Convention::Quaternion, &[1.0, 2.0, 3.0, -0.5, 0.5, -0.5, 0.5], 1e-12);
        assert!(pose(Convention::Quaternion, &[0.0; 7]).is_none());
    }

    #[track_caller]
    fn same(convention: Convention, n: &[f64], within: f64) {
        let again = numbers(convention, &pose(convention, n).unwrap(), n);
        let off = again.iter().zip(n).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < within, "{convention} {again:?} {n:?}");
    }
}
