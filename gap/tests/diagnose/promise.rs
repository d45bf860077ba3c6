//! How far off a corrected model is said to be, and how far off it is.

use nalgebra::Vector6;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::simulate::equilibrium;
use stiffarm_gap::{Options, diagnose_with};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, Plant, Truth};

use crate::fixture::{row, springy, table};

/// Over many measurements of one arm the distance of the corrected model from the arm is the
/// promised one on average, at postures near and far; the arm itself is another program's.
#[test]
fn the_promise_is_kept_on_average() {
    let arm = springy();
    let truth = Truth::parse("joint_compliance@joint 2=4e-6", &arm).unwrap();
    let plant = Plant::new(&arm, std::slice::from_ref(&truth)).unwrap();
    let load = Vector6::new(40.0, -30.0, -150.0, 0.0, 0.0, 0.0);
    let postures = [[0.3, 0.4, -0.9], [-1.2, 1.1, 0.5], [2.0, -0.3, 1.4]];
    let rows: Vec<_> = postures.iter().map(|q| row(q, load)).collect();
    let there = table(rows, Kind::Pose { orientation: false });
    let real: Vec<Vector6<f64>> =
        plant.exact(&there).unwrap().rows.iter().map(|r| r.measured).collect();
    let draws = 60;
    let (mut squares, mut promised) = ([0.0; 3], [0.0; 3]);
    for seed in 0..draws {
        let design = Design {
            shape: Shape::Force,
            poses: 8,
            repeats: 1,
            payload: 15.0,
            kind: Kind::Pose { orientation: false },
            seed,
        };
        let noise = Noise { position: 2e-4, rotation: 0.0 };
        let data = plant.measure(&design.rows(&arm), noise, seed).unwrap();
        let options = Options {
            effects: Some(vec!["joint_compliance".to_owned()]),
            noise_position: Some(2e-4),
            ..Options::default()
        };
        let found = diagnose_with(&arm, &data, &options, &|_| {}).unwrap();
        assert_eq!(found.diagnosis.findings.len(), 1, "seed {seed}");
        let model = found.explanation;
        let mut actual = arm.clone();
        actual.joints[1].compliance += model.found()[0].values[0];
        for (k, q) in postures.iter().enumerate() {
            let expected = model.expected(q, &load).unwrap();
            let tool = equilibrium(&actual, q, &load).unwrap().tool;
            let off = tool.translation.vector - real[k].fixed_rows::<3>(0);
            squares[k] += off.norm_squared() / f64::from(draws as u32);
            promised[k] += expected.uncertain.powi(2) / f64::from(draws as u32);
            assert!((expected.noise / (2e-4 * 3f64.sqrt()) - 1.0).abs() < 0.3, "{expected:?}");
            let nominal = equilibrium(&arm, q, &load).unwrap().tool;
            let gap = (nominal.translation.vector - real[k].fixed_rows::<3>(0)).norm();
            assert!((expected.moved - gap).abs() < 5.0 * expected.uncertain, "{expected:?} {gap}");
            let before = (expected.moved.powi(2) + expected.after().powi(2)).sqrt();
            let shrink = 1.0 - expected.after() / before;
            assert!((expected.shrink() - shrink).abs() < 1e-14);
        }
    }
    for (actual, promised) in squares.iter().zip(promised) {
        // A mean of 60 squares of one normal number is within 4 of its deviations, √(2/60).
        assert!((actual / promised - 1.0).abs() < 4.0 * (2.0 / 60.0_f64).sqrt());
    }
}
