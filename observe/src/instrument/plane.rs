//! Planes: a plate that is probed, a wall with a dial gauge.

use nalgebra::{Matrix3, Unit, Vector3};

use super::middle;

/// The points at which `normal · p` is `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Towards the side on which readings are above 0.
    pub normal: Unit<Vector3<f64>>,
    /// A point of it, about which it is tilted: in the middle of what is probed, so that tilts and offset
    /// have little to do with each other.
    pub at: Vector3<f64>,
}

impl Plane {
    /// The plane at a distance from the origin.
    pub fn new(normal: Unit<Vector3<f64>>, offset: f64) -> Plane {
        Plane { normal, at: *normal * offset }
    }

    /// Its distance from the origin, along the normal, m.
    pub fn offset(&self) -> f64 {
        self.normal.dot(&self.at)
    }

    /// How far above it a point is, m.
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(&(point - self.at))
    }

    /// Two directions in it, about which it is tilted.
    pub fn axes(&self) -> [Vector3<f64>; 2] {
        // The axis that is farthest from the normal.
        let axis = Vector3::ith(self.normal.iamin(), 1.0);
        let first = Unit::new_normalize(axis - *self.normal * self.normal.dot(&axis));
        [*first, self.normal.cross(&first)]
    }

    /// As [`View::as_shifts`](super::View::as_shifts): two tilts (rad, of the normal towards each axis), and
    /// the shift along the normal (m).
    pub(super) fn as_shifts(&self, point: &Vector3<f64>) -> [Vector3<f64>; 3] {
        let [u, v] = self.axes().map(|axis| *self.normal * axis.dot(&(point - self.at)));
        [u, v, -*self.normal]
    }

    pub(super) fn moved(self, tilts: [f64; 2], shift: f64) -> Plane {
        let [u, v] = self.axes();
        let normal = Unit::new_normalize(*self.normal + u * tilts[0] + v * tilts[1]);
        Plane { normal, at: self.at + *self.normal * shift }
    }

    /// The plane nearest to points at some heights above it: across the direction in which they are spread
    /// least. Of its two normals the one by which the heights fit better, or the higher.
    pub(super) fn through(seen: &[(Vector3<f64>, f64)]) -> Plane {
        let middle = middle(seen);
        let height = seen.iter().map(|(_, h)| h).sum::<f64>() / seen.len() as f64;
        let spread = seen.iter().map(|(p, _)| (p - middle) * (p - middle).transpose());
        let spread = spread.sum::<Matrix3<f64>>().symmetric_eigen();
        let across = spread.eigenvectors.column(spread.eigenvalues.imin()).into_owned();
        let along = seen.iter().map(|(p, h)| (h - height) * across.dot(&(p - middle))).sum::<f64>();
        let up = across[across.iamax()];
        let varies = seen.iter().any(|(_, h)| (h - height).abs() > 0.0);
        let side = if varies && along != 0.0 { along } else { up };
        let normal = Unit::new_normalize(across * side.signum());
        Plane { normal, at: middle - *normal * height }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_found_by_what_was_probed() {
        let plane = Plane::new(Unit::new_normalize(Vector3::new(0.2, -0.1, -1.0)), -0.7);
        let [u, v] = plane.axes();
        for heights in [0.0, 2e-4] {
            let seen: Vec<_> = (0..9)
                .map(|k| {
                    let (a, b) = (f64::from(k).sin(), (1.7 * f64::from(k)).cos());
                    let height = heights * (3.1 * f64::from(k)).sin();
                    (*plane.normal * (height - 0.7) + u * a + v * b, height)
                })
                .collect();
            let found = Plane::through(&seen);
            // Without heights the normal that points up is taken.
            let side = if heights > 0.0 { 1.0 } else { -1.0 };
            // Heights are taken for places in the first guess: to first order they tilt it.
            assert!((*found.normal * side - *plane.normal).norm() < 2.0 * heights + 1e-12);
            assert!((found.offset() * side + 0.7).abs() < 2.0 * heights + 1e-12);
        }
    }
}
