//! All roots of a polynomial in sines and cosines at once.

use core::f64::consts::TAU;

use super::moved::circle;

/// Values of the determinant around the circle. Its seventeen coefficients take seventeen.
const VALUES: usize = 24;

/// Degree of the determinant in cos θ_3 and sin θ_3.
const DEGREE: usize = 8;

/// Steps of Aberth's method at most; nearly all roots take fewer than twenty.
const ROOTS: usize = 60;

/// A complex number.
pub(super) type Complex = [f64; 2];

fn product([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn quotient(a: Complex, [c, d]: Complex) -> Complex {
    let inverse = 1.0 / (c * c + d * d);
    product(a, [c * inverse, -d * inverse])
}

/// The roots of `Σ c_m z^m`, m from −8 to 8, with `c_{−m}` conjugate to `c_m`, all at once.
pub(super) fn roots(c: &[Complex; DEGREE + 1]) -> [Complex; 2 * DEGREE] {
    let coefficient = |k: usize| match k.checked_sub(DEGREE) {
        Some(m) => c[m],
        None => [c[DEGREE - k][0], -c[DEGREE - k][1]],
    };
    let mut z: [Complex; 2 * DEGREE] = core::array::from_fn(|k| {
        // Half of them within the circle, half without.
        let radius = if k % 2 == 0 { 0.9 } else { 1.0 / 0.9 };
        circle(0.3 + TAU * k as f64 / (2 * DEGREE) as f64).map(|x| radius * x)
    });
    for _ in 0..ROOTS {
        let mut moved = 0.0_f64;
        for k in 0..2 * DEGREE {
            let at = z[k];
            // Far from zero by the inverse, of which the polynomial is its own conjugate.
            let inside = at[0] * at[0] + at[1] * at[1] <= 1.0;
            let x = if inside { at } else { quotient([1.0, 0.0], at) };
            let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
            for power in (0..=2 * DEGREE).rev() {
                let next = coefficient(if inside { power } else { 2 * DEGREE - power });
                let (s, v) = (product(slope, x), product(value, x));
                slope = [s[0] + value[0], s[1] + value[1]];
                value = [v[0] + next[0], v[1] + next[1]];
            }
            if value == [0.0; 2] {
                continue;
            }
            // p'/p, of p(z) = z^16 r(1/z): 16/z − r'(1/z)/(z² r(1/z)).
            let mut ratio = quotient(slope, value);
            if !inside {
                let inner = product(ratio, product(x, x));
                ratio = [16.0 * x[0] - inner[0], 16.0 * x[1] - inner[1]];
            }
            for (other, w) in z.iter().enumerate() {
                let by = [at[0] - w[0], at[1] - w[1]];
                if other != k && by != [0.0; 2] {
                    let inverse = quotient([1.0, 0.0], by);
                    ratio = [ratio[0] - inverse[0], ratio[1] - inverse[1]];
                }
            }
            let by = quotient([1.0, 0.0], ratio);
            if by[0].is_finite() && by[1].is_finite() {
                z[k] = [at[0] - by[0], at[1] - by[1]];
                let size = at[0].abs() + at[1].abs() + 1e-300;
                moved = moved.max((by[0].abs() + by[1].abs()) / size);
            }
        }
        if moved < 1e-12 {
            break;
        }
    }
    z
}

/// The coefficients of what has this value at each cosine and sine.
pub(super) fn coefficients(value: impl Fn([f64; 2]) -> f64) -> [Complex; DEGREE + 1] {
    let around: [[f64; 2]; VALUES] =
        core::array::from_fn(|k| circle(TAU * k as f64 / VALUES as f64));
    let values = around.map(value);
    core::array::from_fn(|m| {
        let each = values.iter().enumerate();
        each.fold([0.0; 2], |[a, b], (k, value)| {
            let [c, s] = around[m * k % VALUES];
            [a + value * c, b - value * s]
        })
    })
}
