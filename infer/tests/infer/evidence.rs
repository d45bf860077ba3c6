//! The chance of a drop of known noise, and the scale of numbers that are larger than is usual.

use nalgebra::{Cholesky, DMatrix, DVector};
use stiffarm_infer::rng::{Rng, Stream};
use stiffarm_infer::{Scale, Score, likely_scale};

#[test]
fn known_noise_gives_the_chi_squared_chance() {
    let scale = Scale { known: true, numbers: 100, independent: 1.0 };
    let values = DVector::zeros(1);
    let score = Score { drop: 3.841_458_8, values, rank: 1, own: 1.0 };
    let p_value = scale.p_value(&score, 90.0, 0, 1);
    assert!((p_value - 0.05).abs() < 1e-6, "{p_value}");
    assert_eq!(scale.p_value(&score, 90.0, 0, 100), 1.0);
}

/// Of forty numbers that are three times as large as is usual the scale is that of the largest
/// density of what was measured, written down as such and searched by tenths of a per cent.
#[test]
fn the_likely_scale_is_that_of_the_largest_density() {
    let mut rng = Rng::new(4, Stream::Noise);
    let sees = DMatrix::from_fn(60, 40, |_, k| rng.normal() * 0.3_f64.powi(k as i32 / 8));
    let drawn = DVector::from_fn(40, |_, _| 3.0 * rng.normal());
    let read = &sees * drawn + DVector::from_fn(60, |_, _| rng.normal());
    let is_now = 1.7;
    let spread = (&sees * sees.transpose()).symmetric_eigen();
    let parts = spread.eigenvectors.tr_mul(&read);
    let against = |scale: f64| {
        let one = |(part, own): (&f64, &f64)| {
            let variance = own.max(0.0) * scale.powi(2) + 1.0;
            part.powi(2) / variance + variance.ln()
        };
        parts.iter().zip(&spread.eigenvalues).map(one).sum::<f64>() + 2.0 * scale.powi(2).ln_1p()
    };
    let scales: Vec<f64> = (0..3000).map(|k| 0.5 * 1.001_f64.powi(k)).collect();
    let best = scales.into_iter().min_by(|a, b| against(*a).total_cmp(&against(*b))).unwrap();
    let precision = sees.tr_mul(&sees) * (is_now * is_now) + DMatrix::identity(40, 40);
    let values = Cholesky::new(precision.clone()).unwrap().solve(&(sees.tr_mul(&read) * is_now));
    let found = likely_scale(precision, &values, is_now);
    assert!((found / best - 1.0).abs() < 1e-3, "{found} {best}");
}
