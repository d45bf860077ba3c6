//! The base parameters of the rigid links, with intervals and covariance: against those of the arm that moved.

use stiffarm_gap::log::{Log, LogOptions, TorqueSide, diagnose};
use stiffarm_gap::report::log::RigidLinks;

use super::plant::{Recorder, arm};

/// Two links with friction in the first joint.
fn recorded(seed: u64) -> Log {
    Recorder::new(seed, 6000, 0.5)
        .torques(|now| (now.rigid_and([6.0 * now.v[0].signum(), 0.0]), [0.0; 2]))
}

/// As the file is: its masses are a third of the arm's, and what is fitted knows nothing of them.
fn fitted(seed: u64) -> RigidLinks {
    let mut file = arm();
    file.joints.iter_mut().for_each(|joint| joint.mass /= 3.0);
    let side = Some(TorqueSide::Motor);
    let options = LogOptions { band: Some(10.0), side, ..LogOptions::default() };
    let found = diagnose(&file, &recorded(seed), &options).unwrap();
    assert_eq!(found.rigid_parameters, found.rigid.as_ref().map_or(0, |r| r.parameters.len()));
    found.rigid.expect("torques of the motor")
}

/// Intervals of 95 % hold nine of ten true values at least, over seeds that share nothing; the covariance is theirs.
#[test]
fn base_parameters_are_those_of_the_arm_that_moved() {
    let truth = arm();
    let expected: Vec<(String, f64)> = truth
        .base_parameters()
        .iter()
        .map(|sum| (sum.to_string(), sum.of(&truth.moments())))
        .collect();
    let (mut all, mut held) = (0, 0);
    for seed in 301..stiffarm_draws::few_or_many(304, 313) {
        let found = fitted(seed);
        assert_eq!(found.parameters.len(), expected.len());
        assert_eq!(found.covariance.len(), expected.len());
        for (k, (told, (name, value))) in found.parameters.iter().zip(&expected).enumerate() {
            assert_eq!(&told.name, name);
            assert!((told.in_file - value / 3.0).abs() < 1e-12, "{told:?}");
            let [low, high] = told.ci95.expect("a motion that determines both links");
            assert!((told.value - value).abs() < 4.0 * (high - told.value), "{told:?}, {value}");
            (all, held) = (all + 1, held + usize::from(low <= *value && *value <= high));
            let deviation = found.covariance[k][k].sqrt();
            // Student's t between that of many blocks and that of eight.
            assert!((1.9..2.4).contains(&((high - told.value) / deviation)), "{told:?}");
            let correlated = found.covariance[k].iter().zip(0..).all(|(c, l): (&f64, usize)| {
                c.abs() <= deviation * found.covariance[l][l].sqrt() * (1.0 + 1e-9)
                    && (c - found.covariance[l][k]).abs() <= 1e-12 * c.abs()
            });
            assert!(correlated, "{:?}", found.covariance);
        }
    }
    assert!(10 * held >= 9 * all, "{held} of {all}");
}
