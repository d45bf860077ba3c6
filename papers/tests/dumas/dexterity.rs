//! κ_F and the characteristic length.

use nalgebra::{DMatrix, Vector6};
use stiffarm_study::dexterity::{
    Search, best_length, characteristic_length, condition_number, influence, inverse_condition,
    normalised_jacobian,
};

use super::{LENGTH, kr240};
use crate::near;

const POSTURE: [f64; 6] = [0.3, 1.1, -1.7, 0.6, -0.9, 2.1];

fn dynamic(m: &nalgebra::Matrix6xX<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(6, m.ncols(), |r, c| m[(r, c)])
}

#[test]
fn a_singular_posture_has_no_dexterity() {
    let arm = kr240();
    let wrist = [0.3, 1.1, -1.7, 0.6, 0.0, 2.1];
    near(inverse_condition(&arm, &wrist, LENGTH).unwrap(), 0.0, 1e-7);
    // The outstretched arm of Fig. 3's horizontal line: tan θ3 = −r4/d4, −87.14°.
    let mut outstretched = POSTURE;
    outstretched[2] = (-1.1_f64).atan2(0.055);
    near(outstretched[2].to_degrees(), -87.14, 5e-3);
    near(inverse_condition(&arm, &outstretched, LENGTH).unwrap(), 0.0, 1e-7);
    assert!(influence(&arm, &outstretched, &Vector6::repeat(100.0)).is_ok());
}

/// By singular values: `κ_F = (1/m) √(Σ σ² Σ σ⁻²)`.
#[test]
fn the_condition_number_is_that_of_the_singular_values() {
    let arm = kr240();
    let normalised = dynamic(&normalised_jacobian(&arm, &POSTURE, LENGTH).unwrap());
    for m in [normalised.clone(), normalised.rows(0, 4).into(), normalised.columns(0, 4).into()] {
        let values = m.singular_values();
        let squares: f64 = values.iter().map(|s| s * s).sum();
        let inverse: f64 = values.iter().map(|s| 1.0 / (s * s)).sum();
        let want = (squares * inverse).sqrt() / values.len() as f64;
        near(condition_number(&m), want, 1e-12 * want);
    }
    let got = inverse_condition(&arm, &POSTURE, LENGTH).unwrap();
    near(got, 1.0 / condition_number(&normalised), 1e-12);
    near(condition_number(&(DMatrix::identity(3, 3) * 7.0)), 1.0, 1e-15);
    assert_eq!(condition_number(&DMatrix::zeros(2, 3)), f64::INFINITY);
}

#[test]
fn the_best_length_of_a_posture_is_a_maximum() {
    let arm = kr240();
    let best = best_length(&arm, &POSTURE).unwrap();
    let at = |length: f64| inverse_condition(&arm, &POSTURE, length).unwrap();
    near(at(best.length), best.inverse_condition, 1e-12);
    for factor in [0.5, 0.9, 0.999, 1.001, 1.1, 2.0] {
        assert!(at(factor * best.length) < best.inverse_condition);
    }
}

/// Printed: 0.682 m. Within the joint limits 0.68215 at (θ2, θ3, |θ5|) = (23.4, −219.9, 99.6)°,
/// θ4 = 0 or 180°.
#[test]
fn the_characteristic_length_is_the_printed_one() {
    let arm = kr240();
    let found = characteristic_length(&arm, Search::default()).unwrap();
    near(found.length, 0.68215, 1e-5);
    near(found.inverse_condition, 0.79523, 1e-5);
    assert!(found.agreeing >= 2, "{}", found.agreeing);
    let degrees: Vec<f64> = found.posture.iter().map(|q| q.to_degrees()).collect();
    near(degrees[1], 23.4, 0.1);
    near(degrees[2], -219.9, 0.1);
    near(degrees[3].to_radians().sin(), 0.0, 1e-3);
    near(degrees[4].abs(), 99.6, 0.1);
    for (value, joint) in found.posture.iter().zip(&arm.joints) {
        let [low, high] = joint.limits.unwrap();
        assert!(low <= *value && *value <= high);
    }
}

/// No posture of a grid over θ2 to θ5 with any length is better than the one that was found.
#[test]
fn no_posture_of_a_grid_is_better() {
    let arm = kr240();
    let steps = |low: f64, high: f64, count: usize| -> Vec<f64> {
        let at = |k: usize| low + (high - low) * k as f64 / (count - 1) as f64;
        (0..count).map(|k| at(k).to_radians()).collect()
    };
    let mut best: f64 = 0.0;
    for q2 in steps(0.0, 146.0, 10) {
        for q3 in steps(-245.0, 29.0, 16) {
            for q4 in steps(-180.0, 180.0, 7) {
                for q5 in steps(-120.0, 120.0, 9) {
                    let found = best_length(&arm, &[0.0, q2, q3, q4, q5, 0.0]);
                    best = best.max(found.map_or(0.0, |b| b.inverse_condition));
                }
            }
        }
    }
    assert!((0.75..0.79523).contains(&best), "{best}");
}

/// Without limits the best posture is another one, and the length would round to 0.683.
#[test]
fn the_limits_decide_the_third_digit() {
    let arm = kr240();
    let free = Search { limits: false, ..Search::default() };
    let found = characteristic_length(&arm, free).unwrap();
    near(found.length, 0.68260, 1e-5);
    near(found.inverse_condition, 0.79903, 1e-5);
}
