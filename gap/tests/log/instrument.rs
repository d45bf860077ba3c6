//! Commands as instruments: numbers that the noise of what is differentiated does not draw.

use std::collections::BTreeMap;

use stiffarm_gap::log::{Log, LogOptions, Signal, diagnose};
use stiffarm_gap::rng::{Rng, Stream};

use super::plant::{Path, arm, log, rigid};

const STEP: f64 = 0.01;
const COUNT: usize = 6000;

/// What a rotor adds about joint 2, kg·m².
const ROTOR: f64 = 0.8;

/// Joint values that are read with so much noise, rad; commands that say where the joints are.
fn recorded(reading: f64, commands: bool) -> Log {
    let path = Path::new(5, 1.2);
    let mut rng = Rng::new(5, Stream::Noise);
    let [mut q, mut sent, mut torque] = [(); 3].map(|()| vec![Vec::new(); 2]);
    for k in 0..COUNT {
        let [at, v, a] = path.at(STEP * k as f64);
        let links = rigid(at, v, a);
        for j in 0..2 {
            q[j].push(at[j] + reading * rng.normal());
            sent[j].push(at[j]);
            let rotor = if j == 1 { ROTOR * a[1] } else { 0.0 };
            torque[j].push(links[j] + rotor + 0.1 * rng.normal());
        }
    }
    let mut signals = BTreeMap::from([(Signal::Q, q), (Signal::Torque, torque)]);
    if commands {
        signals.insert(Signal::QCmd, sent);
    }
    log(STEP, signals)
}

/// The rotor: by least squares, half its interval, and by the commands.
fn rotor(log: &Log) -> (f64, f64, Option<f64>) {
    let options = LogOptions {
        band: Some(8.0),
        effects: Some(vec!["rotor_inertia".to_owned()]),
        ..LogOptions::default()
    };
    let found = diagnose(&arm(), log, &options).expect("a diagnosis");
    assert_eq!(found.findings.len(), 1, "{:#?}", found.findings);
    let told = &found.findings[0].parameters[0];
    (told.value, 0.5 * (told.ci95[1] - told.ci95[0]), told.by_command)
}

/// The noise of a second difference in a band of 8 Hz, 450 times a reading's, is a third of these accelerations:
/// least squares lose about a ninth of what goes with them.
#[test]
fn noise_of_the_rates_draws_least_squares_and_not_the_instrument() {
    let (value, half, by_command) = rotor(&recorded(15e-3, true));
    let by_command = by_command.expect("commands");
    assert!(value < ROTOR - half, "{value} ± {half}");
    assert!((by_command - ROTOR).abs() < half, "{by_command} ± {half}");
}

#[test]
fn without_noise_the_instrument_changes_nothing() {
    let (value, half, by_command) = rotor(&recorded(1e-7, true));
    let by_command = by_command.expect("commands");
    assert!((by_command - value).abs() < 0.1 * half, "{by_command}, {value} ± {half}");
    assert_eq!(rotor(&recorded(1e-7, false)).2, None);
}
