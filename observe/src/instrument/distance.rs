//! Distances from a place.

use nalgebra::{Matrix3, Vector3};

use super::middle;

/// The unit vector from a place to a point; zero where they are one, since nothing moves them apart to first
/// order.
pub(super) fn line(from: &Vector3<f64>, point: &Vector3<f64>) -> Vector3<f64> {
    (point - from).try_normalize(0.0).unwrap_or_default()
}

/// The place that has given distances from points, by least squares of `|p|² − 2 p·c + |c|² = d²`, which is
/// linear in c and `|c|²`; of points in a plane it is one of the two that are as good.
pub(super) fn equidistant(seen: &[(Vector3<f64>, f64)]) -> Vector3<f64> {
    let middle = middle(seen);
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (point, distance) in seen {
        let arm = point - middle;
        normal += arm * arm.transpose();
        right += arm * (0.5 * (arm.norm_squared() - distance * distance));
    }
    let svd = normal.svd(true, true);
    let least = f64::EPSILON.sqrt() * svd.singular_values.max();
    let foot = middle + svd.solve(&right, least).unwrap_or_default();
    let flat: Vec<usize> = (0..3).filter(|k| svd.singular_values[*k] <= least).collect();
    let (Some(u), [normal]) = (svd.u, &flat[..]) else { return foot };
    let height = seen.iter().map(|(p, d)| d * d - (p - foot).norm_squared()).sum::<f64>();
    foot + u.column(*normal) * (height / seen.len() as f64).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_found_by_its_distances() {
        let centre = Vector3::new(0.7, -0.4, 0.3);
        let at = |k: f64| Vector3::new((1.3 * k).sin(), (2.1 * k).cos(), 0.2 * k);
        let seen = |at: &dyn Fn(f64) -> Vector3<f64>| -> Vec<_> {
            (0..7).map(|k| at(f64::from(k))).map(|p| (p, (p - centre).norm())).collect()
        };
        assert!((equidistant(&seen(&at)) - centre).norm() < 1e-12);
        // Above a plane nothing tells the place from its mirror image.
        let flat = |k: f64| Vector3::new(at(k).x, at(k).y, 0.0);
        let found = equidistant(&seen(&flat));
        let folded = Vector3::new(found.x, found.y, found.z.abs());
        assert!((folded - centre).norm() < 1e-12, "{found}");
    }
}
