//! A servo of the plant's joints: late, soft, and with play.

use stiffarm_gap::log::report::LogDiagnosis;
use stiffarm_gap::log::{Log, Signal};
use stiffarm_gap::rng::{Rng, Stream};

use super::plant::{self, Path, finding, gravity};

const DELAY: f64 = 0.09;
const COMPLIANCE: f64 = 2e-3;
const HALF_WIDTH: f64 = 0.01;

/// The first joint late and soft under weights, the second late and with play.
fn recorded() -> Log {
    let path = Path::new(4, 0.25);
    let mut rng = Rng::new(4, Stream::Noise);
    let mut last = f64::NAN;
    plant::recorded(0.02, 6000, Signal::QCmd, |_, t| {
        let [late, ..] = path.at(t - DELAY);
        // Weights where the arm is: twice through the droop, which contracts by a hundredth.
        let droop = |q: [f64; 2]| [late[0] - COMPLIANCE * gravity(q)[0], late[1]];
        let at = droop(droop(late));
        // Play: the joint stands until its tooth is met.
        let (low, high) = (at[1] - HALF_WIDTH, at[1] + HALF_WIDTH);
        last = if last.is_nan() { low } else { last.clamp(low, high) };
        let (stands, sent) = ([at[0], last], path.at(t)[0]);
        [0, 1].map(|j| [stands[j] + 1e-3 * rng.normal(), sent[j]])
    })
}

fn diagnosed(log: &Log) -> LogDiagnosis {
    plant::diagnosed(log, 8.0)
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
    assert_eq!(found.findings[0].effect, "latency", "{found:#?}");
    // What drags the joint through its play is late by a delay that was fitted alone, and has some milliseconds of the play
    // in it: at 0.5 rad/s a few thousandths of a radian, in the tenth of the time that reversals take.
    for (effect, place, expected, part) in [
        ("latency", "the interface", DELAY, 0.02),
        ("servo_droop", "joint 1", COMPLIANCE, 0.02),
        ("backlash", "joint 2", 2.0 * HALF_WIDTH, 0.04),
    ] {
        let value = finding(&found, effect, place).parameters[0].value;
        assert!((value / expected - 1.0).abs() < part, "{effect}: {value}: {found:#?}");
    }
    // What else is told is of those reversals: the three leave next to nothing.
    assert!(found.findings[2].held_out.after() < 0.02, "{found:#?}");
}
