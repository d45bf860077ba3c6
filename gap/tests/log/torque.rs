//! Torques of the plant with friction.

use std::collections::BTreeMap;

use stiffarm_gap::log::report::{Finding, LogDiagnosis};
use stiffarm_gap::log::{Log, LogOptions, Signal, diagnose};
use stiffarm_gap::rng::{Rng, Stream};

use super::plant::{Path, arm, log, noise, rigid};

const STEP: f64 = 0.01;
const COUNT: usize = 8000;

/// Friction of the two joints, Coulomb and viscous; torques times `scale`.
fn recorded(seed: u64, friction: [[f64; 2]; 2], scale: f64) -> Log {
    let path = Path::new(seed, 0.6);
    let mut rng = Rng::new(seed, Stream::Noise);
    let mut q = vec![Vec::new(); 2];
    let noises = [(); 2].map(|()| noise(&mut rng, COUNT, STEP, 0.05, 0.3));
    let noises = noises[0].iter().zip(&noises[1]).map(|(first, second)| [*first, *second]);
    let mut torque = vec![Vec::new(); 2];
    for (k, noises) in noises.enumerate() {
        let [at, v, a] = path.at(STEP * k as f64);
        let drives = rigid(at, v, a);
        for (j, [coulomb, viscous]) in friction.into_iter().enumerate() {
            q[j].push(at[j] + 1e-6 * rng.normal());
            let friction = coulomb * v[j].signum() + viscous * v[j];
            torque[j].push(scale * (drives[j] + friction + noises[j]));
        }
    }
    log(STEP, BTreeMap::from([(Signal::Q, q), (Signal::Torque, torque)]))
}

fn diagnosed(log: &Log) -> LogDiagnosis {
    let options = LogOptions { band: Some(8.0), ..LogOptions::default() };
    diagnose(&arm(), log, &options).unwrap()
}

fn named<'d>(found: &'d LogDiagnosis, effect: &str, place: &str) -> &'d Finding {
    let is = |f: &&Finding| f.effect == effect && f.place == place;
    found.findings.iter().find(is).unwrap_or_else(|| panic!("{effect} at {place}: {found:#?}"))
}

#[test]
fn friction_is_found_where_it_is_with_its_numbers() {
    let found = diagnosed(&recorded(1, [[6.0, 0.0], [1.5, 2.5]], 1.0));
    for (effect, place, value) in [
        ("coulomb_friction", "joint 1", 6.0),
        ("coulomb_friction", "joint 2", 1.5),
        ("viscous_friction", "joint 2", 2.5),
    ] {
        let finding = named(&found, effect, place);
        let parameter = &finding.parameters[0];
        let half = 0.5 * (parameter.ci95[1] - parameter.ci95[0]);
        // Intervals hold 95 %: twice as wide they hold what is true of all three here.
        assert!((parameter.value - value).abs() < 2.0 * half, "{finding:#?}");
        assert!(half < 0.1 * value && finding.p_value <= 0.05, "{finding:#?}");
    }
    assert_eq!(found.findings.len(), 3, "{found:#?}");
    // What is left is the noise of 0.3 N·m: of a spectrum that falls from 3.2 Hz on three quarters of the
    // power lie below 8 Hz, 0.26 N·m; its 800 independent numbers tell that to a fortieth.
    for gap in &found.gap {
        assert!(gap.after < 0.3 && gap.after > 0.1 && gap.before > 3.0 * gap.after, "{gap:?}");
    }
}

#[test]
fn nothing_is_found_where_nothing_is() {
    let found = diagnosed(&recorded(2, [[0.0; 2]; 2], 1.0));
    assert!(found.findings.is_empty(), "{found:#?}");
}

/// All torques times a factor: with free masses the same is left, part for part.
#[test]
fn a_scale_of_all_torques_is_a_gauge() {
    let friction = [[6.0, 0.0], [1.5, 2.5]];
    let left = |scale: f64| -> Vec<f64> {
        let options = LogOptions { band: Some(8.0), ..LogOptions::default() };
        let found = diagnose(&arm(), &recorded(3, friction, scale), &options).unwrap();
        assert!(found.cannot_see.iter().any(|h| h.effect == "torque_scale"));
        found.gap.iter().map(|g| g.after / g.size).collect()
    };
    let one = left(1.0);
    for scale in [0.75, 1.25] {
        for (scaled, one) in left(scale).iter().zip(&one) {
            assert!((scaled / one - 1.0).abs() < 1e-6, "{scaled} {one}");
        }
    }
}
