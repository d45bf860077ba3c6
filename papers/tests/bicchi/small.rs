//! The frozen and the exact derivative of the wrench on the paper's arms.

use crate::arms::*;

/// Column by column, how far the frozen G is off, relative to the exact column.
fn off(q: &[f64], size: f64) -> Vec<f64> {
    let arm = arm(3, STEEL);
    let loaded = settled(&arm, q, size, DEFORMED);
    let (exact, frozen) = (loaded.wrench_jacobian().unwrap(), loaded.frozen_wrench_jacobian());
    let columns = exact.column_iter().zip(frozen.column_iter());
    columns.map(|(e, f)| (e - f).norm() / e.norm()).collect()
}

/// Column 1 is exact; the others are a tenth of a per cent off for the straight arm, per cents in
/// bent postures and more with the load.
#[test]
fn how_far_the_papers_gradient_is_off() {
    let straight = off(&[0.0; 3], 10.0);
    assert!(straight[0] < 1e-14);
    for column in &straight[1..] {
        assert!((5.5e-4..1.15e-3).contains(column), "{straight:?}");
    }
    let bent = degrees(&[60.0, -45.0, -30.0]);
    for (size, most) in [(10.0, 0.02), (50.0, 0.1)] {
        let columns = off(&bent, size);
        assert!(columns[0] < 1e-14);
        assert!(columns[1..].iter().all(|c| (0.0..most).contains(c)), "{columns:?}");
        assert!(columns[1..].iter().any(|c| *c > most / 4.0), "{columns:?}");
    }
}
