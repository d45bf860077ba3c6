//! A servo of the plant's joints: late, soft, and with play.

use std::collections::BTreeMap;

use stiffarm_gap::dice::{Dice, Stream};
use stiffarm_gap::log::{LogOptions, Signal, diagnose};

use super::plant::{Path, arm, gravity, log};

const STEP: f64 = 0.02;
const COUNT: usize = 6000;
const DELAY: f64 = 0.09;
const COMPLIANCE: f64 = 2e-3;
const HALF_WIDTH: f64 = 0.01;

#[test]
fn delay_droop_and_play_are_told_apart() {
    let path = Path::new(4, 0.25);
    let mut dice = Dice::new(4, Stream::Noise);
    let (mut q, mut command) = (vec![Vec::new(); 2], vec![Vec::new(); 2]);
    for k in 0..COUNT {
        let t = STEP * k as f64;
        let [late, speed, _] = path.at(t - DELAY);
        // Weights where the arm is: twice through the droop, which contracts by a hundredth.
        let droop = |q: [f64; 2]| [late[0] - COMPLIANCE * gravity(q)[0], late[1]];
        let at = droop(droop(late));
        for j in 0..2 {
            let play = if j == 1 { HALF_WIDTH * speed[j].signum() } else { 0.0 };
            q[j].push(at[j] - play + 1e-3 * dice.normal());
            command[j].push(path.at(t)[0][j]);
        }
    }
    let log = log(STEP, BTreeMap::from([(Signal::Q, q), (Signal::QCmd, command)]));
    let options = LogOptions { band: Some(8.0), ..LogOptions::default() };
    let found = diagnose(&arm(), &log, &options).unwrap();
    let value = |effect: &str, place: &str| {
        let finding = found.findings.iter().find(|f| f.effect == effect && f.place == place);
        finding.unwrap_or_else(|| panic!("{effect} at {place}: {found:#?}")).parameters[0].value
    };
    assert_eq!(found.findings[0].effect, "latency", "{found:#?}");
    // The play turns with the sign of the delayed speed, which the filter rounds: a hundredth of it.
    assert!((value("latency", "the interface") / DELAY - 1.0).abs() < 0.02, "{found:#?}");
    assert!((value("servo_droop", "joint 1") / COMPLIANCE - 1.0).abs() < 0.03, "{found:#?}");
    assert!((value("backlash", "joint 2") / HALF_WIDTH - 1.0).abs() < 0.05, "{found:#?}");
    assert_eq!(found.findings.len(), 3, "{found:#?}");
}
