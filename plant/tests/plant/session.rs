//! Noise, seeds, and rows of another robot.

use stiffarm_kernels::generic::Convention;
use stiffarm_plant::{Noise, PlantError};

use crate::arms::{EXACT, POSE, loaded, plant, reading, rows, spatial};

const Q: [f64; 5] = [0.7, -0.5, 0.2, 1.1, -0.4];

#[test]
fn noise_is_that_of_the_seed() {
    let arm = spatial(Convention::Standard);
    let design = rows(POSE, vec![reading(&Q, [0.0; 6]); 1000]);
    let noise = Noise { position: 3e-5, rotation: 2e-4 };
    let plant = plant(&arm, &[]);
    let exact = plant.measure(&design, EXACT, 1).unwrap();
    let one = plant.measure(&design, noise, 1).unwrap();
    assert_eq!(one, plant.measure(&design, noise, 1).unwrap());
    assert_ne!(one, plant.measure(&design, noise, 2).unwrap());
    for k in 0..6 {
        let errors = one.rows.iter().zip(&exact.rows).map(|(a, b)| a.measured[k] - b.measured[k]);
        let rms = (errors.map(|e| e * e).sum::<f64>() / 1000.0).sqrt();
        // A rotation vector's components stretch those of a small turn by up to θ/2 / sin(θ/2).
        let expected = if k < 3 { 3e-5 } else { 2e-4 };
        let slack = if k < 3 { 0.09 } else { 0.5 };
        assert!((rms / expected - 1.0).abs() < slack, "{k}: {rms:e}");
    }
}

#[test]
fn rows_of_another_robot_are_refused() {
    let arm = loaded(Convention::Standard);
    let error = plant(&arm, &[]).measure(&rows(POSE, vec![reading(&[0.1], [0.0; 6])]), EXACT, 0);
    let expected = PlantError::Joints { file: "rows".to_owned(), found: 1, expected: 5 };
    assert_eq!(error, Err(expected));
}
