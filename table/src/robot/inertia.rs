//! Whether six numbers are the moments of inertia of some body.

/// What published figures may be off by their rounding, relative to the largest moment.
const ROUNDING: f64 = 1e-4;

/// Why no body has this tensor (xx, xy, xz, yy, yz, zz), if none has: about its principal axes a moment is
/// `∫ (y² + z²) dm`, so none is below zero, and none above the sum of the other two.
pub(crate) fn unphysical(tensor: [f64; 6]) -> Option<String> {
    let principal = principal(tensor);
    let [least, middle, largest] = principal;
    let slack = ROUNDING * largest.abs().max(least.abs());
    let wrong = if least < -slack {
        "none can be below zero"
    } else if largest > least + middle + slack {
        "no body has one that is larger than the sum of the others"
    } else {
        return None;
    };
    // As many digits as tell the moments from what they must be.
    let [a, b, c] = principal.map(|x| (x * 1e9).round() / 1e9);
    Some(format!("the principal moments of inertia are {a}, {b} and {c}: {wrong}"))
}

/// Eigenvalues of a symmetric matrix in ascending order, by the cosines of a third of an angle (Smith 1961).
fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> [f64; 3] {
    let mean = (xx + yy + zz) / 3.0;
    let [a, b, c] = [xx - mean, yy - mean, zz - mean];
    let square = (a * a + b * b + c * c) / 6.0 + (xy * xy + xz * xz + yz * yz) / 3.0;
    let half = libm::sqrt(square);
    if half == 0.0 {
        return [mean; 3];
    }
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    let cosine = (determinant / (2.0 * half * square)).clamp(-1.0, 1.0);
    let third = libm::acos(cosine) / 3.0;
    let at = |turn: f64| mean + 2.0 * half * libm::cos(third + turn);
    let turn = 2.0 * core::f64::consts::PI / 3.0;
    let (largest, least) = (at(0.0), at(turn));
    [least, 3.0 * mean - largest - least, largest]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the coefficients of the characteristic polynomial.
    #[test]
    fn principal_moments_are_eigenvalues() {
        for tensor in [
            [2.0, 0.0, 0.0, 2.0, 0.0, 2.0],
            [3.0, 0.2, -0.4, 1.0, 0.7, 2.0],
            [1.0, 0.0, 0.0, 5.0, 0.0, 5.0],
        ] {
            let [xx, xy, xz, yy, yz, zz] = tensor;
            let [a, b, c] = principal(tensor);
            assert!(a <= b && b <= c);
            let minors = xx * yy + xx * zz + yy * zz - xy * xy - xz * xz - yz * yz;
            let determinant =
                xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
            assert!((a + b + c - (xx + yy + zz)).abs() < 1e-14);
            assert!((a * b + a * c + b * c - minors).abs() < 1e-13);
            assert!((a * b * c - determinant).abs() < 1e-13);
        }
    }
}
