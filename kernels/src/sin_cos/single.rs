//! Sine and cosine in single precision, without a double anywhere: at most 1e-7 off for |angle| ≤ 100,
//! exact at 0.

use super::{Masked, nan_beyond, turn};

/// π/2 in three parts. The first two have 16 bits, so that their products with a multiple below 2^8 are
/// exact; the third is rounded.
const HALF_PI: [f64; 3] = [1.570770263671875, 2.6063062250614166e-05, 6.07710062827671e-11];

/// 1.5 · 2^23.
const SHIFT: f64 = 12582912.0;

/// Largest angle, rad. Beyond 400 the error grows like the spacing of the angles themselves.
pub(crate) const LARGEST: f64 = 1e5;

/// Minimax of `(sin r - r)/r³` in r² over ±π/4, weighted for the sine's error: 1.8e-9.
const SINE: [f64; 3] = [-0.16666650772094727, 0.008331982418894768, -0.00019495957531034946];

/// Minimax of `(cos r - 1 + r²/2)/r⁴` in r² over ±π/4, weighted for the cosine's error: 1.1e-10.
const COSINE: [f64; 3] = [0.04166664555668831, -0.00138873013202101, 2.4430670237052254e-05];

/// Sine and cosine of every lane.
#[inline(always)]
pub(crate) fn sin_cos<F: Masked>(angle: F) -> (F, F) {
    let of = F::of;
    let shifted = angle.mul_add(of(core::f64::consts::FRAC_2_PI), of(SHIFT));
    let multiple = shifted - of(SHIFT);
    let first = multiple.mul_add(of(-HALF_PI[0]), angle);
    let second = multiple.mul_add(of(-HALF_PI[1]), first);
    let reduced = multiple.mul_add(of(-HALF_PI[2]), second);
    let r = nan_beyond(reduced, angle, LARGEST);

    let z = r * r;
    let sine = (r * z).mul_add(polynomial(SINE, z), r);
    let cosine = (z * z).mul_add(polynomial(COSINE, z), of(1.0) - of(0.5) * z);
    turn(shifted, sine, cosine)
}

#[inline(always)]
fn polynomial<F: Masked>(c: [f64; 3], z: F) -> F {
    z.mul_add(z.mul_add(F::of(c[2]), F::of(c[1])), F::of(c[0]))
}
