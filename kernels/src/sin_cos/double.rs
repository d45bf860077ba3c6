//! Sine and cosine in double precision: at most 1.5 ulp for |angle| ≤ 1e4, exact at 0.

use super::{Masked, nan_beyond, turn};

/// π/2 in three parts. The first two have 35 bits, so that their products with a multiple below 2^18
/// are exact; the third is rounded.
const HALF_PI: [f64; 3] = [1.5707963267923333, 2.5633441515839558e-12, 1.0562999066987428e-23];

/// 1.5 · 2^52.
const SHIFT: f64 = 6755399441055744.0;

/// Largest angle, rad. To 4e5 the reduction is as good as below 1e4; further out the error grows like
/// the spacing of the angles themselves.
pub(crate) const LARGEST: f64 = 1e9;

/// Minimax of `(sin r - r)/r³` in r² over ±π/4, weighted for the sine's error relative to r: 3.5e-18.
const SINE: [f64; 6] = [
    -0.16666666666666632,
    0.008333333333322484,
    -0.0001984126982985116,
    2.7557313704098867e-06,
    -2.5050759714136158e-08,
    1.5896875188647993e-10,
];

/// Minimax of `(cos r - 1 + r²/2)/r⁴` in r² over ±π/4, weighted for the cosine's error: 5e-20.
const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.001388888888887447,
    2.4801587289666865e-05,
    -2.755731439923815e-07,
    2.0875728988224267e-09,
    -1.1359916899499847e-11,
];

/// Sine and cosine of every lane.
#[inline(always)]
pub(crate) fn sin_cos<F: Masked>(angle: F) -> (F, F) {
    let of = F::of;
    let shifted = angle.mul_add(of(core::f64::consts::FRAC_2_PI), of(SHIFT));
    let multiple = shifted - of(SHIFT);
    // The first difference is exact. The second rounds; what it loses is `lost`, exactly.
    let first = multiple.mul_add(of(-HALF_PI[0]), angle);
    let r = multiple.mul_add(of(-HALF_PI[1]), first);
    let lost = multiple.mul_add(of(-HALF_PI[1]), first - r);
    // Both results take the rest in last, so that it may be what is no number.
    let rest = nan_beyond(multiple, angle, LARGEST).mul_add(of(-HALF_PI[2]), lost);

    // The reduced angle is `r + rest`; `1 - (r + rest)²/2` without the square of the rest is
    // `1 + r·(-r/2 - rest)`.
    let z = r * r;
    let powers = [z, z * z];
    let sine = r + (r * z).mul_add(polynomial(SINE, powers), rest);
    let falls = z.mul_add(polynomial(COSINE, powers), of(-0.5));
    let cosine = r.mul_add(r.mul_add(falls, -rest), of(1.0));
    turn(shifted, sine, cosine)
}

/// `Σ c_k z^k`, in pairs, so that the chain of operations is short.
#[inline(always)]
fn polynomial<F: Masked>(c: [f64; 6], [z, z2]: [F; 2]) -> F {
    let pair = |k: usize| z.mul_add(F::of(c[k + 1]), F::of(c[k]));
    z2.mul_add(z2.mul_add(pair(4), pair(2)), pair(0))
}
