//! A campaign with noise of the arm that bends, for the tests.

use nalgebra::Vector6;

use crate::fixture::{bent, row, table};
use crate::measurement::{Kind, Measurements, Row};
use crate::rng::{Rng, Stream};
use crate::simulate::simulate;

pub(crate) const POSE: Kind = Kind::Pose { orientation: true };

/// Roughly normal, standard deviation 1.
pub(crate) fn normal(generator: &mut Rng) -> f64 {
    (0..12).map(|_| generator.unit()).sum::<f64>() - 6.0
}

/// `poses` poses, each measured twice, of a plant whose joint compliances are raised by `added`,
/// with noise of `sd` m and rad.
pub(crate) fn data(poses: usize, added: [f64; 3], sd: f64, seed: u64) -> Measurements {
    let mut plant = bent();
    for (joint, more) in plant.joints.iter_mut().zip(added) {
        joint.compliance += more;
    }
    let mut generator = Rng::new(seed, Stream::Folds);
    let mut rows = Vec::new();
    for group in 0..poses {
        let mut any = |scale: f64| scale * normal(&mut generator);
        let q = [any(1.0), any(0.7), any(0.7)];
        let w = Vector6::new(any(300.0), any(300.0), any(300.0) - 500.0, any(20.0), 0.0, any(20.0));
        for _ in 0..2 {
            let mut row = Row { group, line: rows.len() as u64 + 2, ..row(&q, w) };
            let exact = simulate(&plant, &row, POSE).unwrap().reading().vector();
            row.measured = exact.map(|x| x + sd * normal(&mut generator));
            rows.push(row);
        }
    }
    table(rows, POSE)
}
