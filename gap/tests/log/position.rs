//! A servo of the plant's joints: late, soft, and with play.

use std::collections::BTreeMap;

use stiffarm_gap::log::report::LogDiagnosis;
use stiffarm_gap::log::{Log, LogOptions, Signal, diagnose};
use stiffarm_gap::rng::{Rng, Stream};

use super::plant::{Path, arm, gravity, log};

const STEP: f64 = 0.02;
const COUNT: usize = 6000;
const DELAY: f64 = 0.09;
const COMPLIANCE: f64 = 2e-3;
const HALF_WIDTH: f64 = 0.01;

/// The first joint late and soft under weights, the second late and with play.
fn recorded() -> Log {
    let path = Path::new(4, 0.25);
    let mut rng = Rng::new(4, Stream::Noise);
    let (mut q, mut command) = (vec![Vec::new(); 2], vec![Vec::new(); 2]);
    let mut last = f64::NAN;
    for k in 0..COUNT {
        let t = STEP * k as f64;
        let [late, ..] = path.at(t - DELAY);
        // Weights where the arm is: twice through the droop, which contracts by a hundredth.
        let droop = |q: [f64; 2]| [late[0] - COMPLIANCE * gravity(q)[0], late[1]];
        let at = droop(droop(late));
        // Play: the joint stands until its tooth is met.
        let (low, high) = (at[1] - HALF_WIDTH, at[1] + HALF_WIDTH);
        last = if last.is_nan() { low } else { last.clamp(low, high) };
        for (j, at) in [at[0], last].into_iter().enumerate() {
            q[j].push(at + 1e-3 * rng.normal());
            command[j].push(path.at(t)[0][j]);
        }
    }
    log(STEP, BTreeMap::from([(Signal::Q, q), (Signal::QCmd, command)]))
}

fn diagnosed(log: &Log) -> LogDiagnosis {
    let options = LogOptions { band: Some(8.0), ..LogOptions::default() };
    diagnose(&arm(), log, &options).unwrap()
}

/// Whichever of both is turned, it is named; where it is the command, what is found stays as it is.
#[test]
fn a_joint_that_moves_against_its_command_is_named() {
    let right = recorded();
    let turned = |signal: Signal| {
        let mut log = right.clone();
        let rows = &mut log.runs[0].signals.get_mut(&signal).expect("rows")[1];
        rows.iter_mut().for_each(|x| *x = -*x);
        diagnosed(&log)
    };
    let plain = diagnosed(&right);
    assert!(plain.remarks.is_empty(), "{:?}", plain.remarks);
    for signal in [Signal::Q, Signal::QCmd] {
        let found = turned(signal);
        let said = &found.remarks[0];
        assert!(said.contains("q2 moves against q_cmd2: one of them has the wrong sign"), "{said}");
        assert_eq!(found.remarks.len(), 1, "{:?}", found.remarks);
        assert!(signal == Signal::Q || found.findings == plain.findings, "{found:#?}");
    }
}

#[test]
fn delay_droop_and_play_are_told_apart() {
    let found = diagnosed(&recorded());
    let value = |effect: &str, place: &str| {
        let finding = found.findings.iter().find(|f| f.effect == effect && f.place == place);
        finding.unwrap_or_else(|| panic!("{effect} at {place}: {found:#?}")).parameters[0].value
    };
    assert_eq!(found.findings[0].effect, "latency", "{found:#?}");
    // What drags the joint through its play is late by a delay that was fitted alone, and has some milliseconds of the play
    // in it: at 0.5 rad/s a few thousandths of a radian, in the tenth of the time that reversals take.
    for (effect, place, expected, part) in [
        ("latency", "the interface", DELAY, 0.02),
        ("servo_droop", "joint 1", COMPLIANCE, 0.02),
        ("backlash", "joint 2", 2.0 * HALF_WIDTH, 0.04),
    ] {
        let value = value(effect, place);
        assert!((value / expected - 1.0).abs() < part, "{effect}: {value}: {found:#?}");
    }
    // What else is told is of those reversals: the three leave next to nothing.
    assert!(found.findings[2].held_out.after() < 0.02, "{found:#?}");
}
