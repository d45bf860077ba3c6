use core::f64::consts::TAU;
use std::collections::BTreeMap;

use super::*;
use crate::log::{Clock, Run};

/// A log of one joint at these times: a sine of 1 Hz and what accelerates a unit of inertia along it.
fn log(runs: &[Vec<f64>]) -> Log {
    let run = |t: &Vec<f64>| Run {
        name: "run".to_owned(),
        t: t.clone(),
        signals: BTreeMap::from([
            (Signal::Q, vec![t.iter().map(|t| (TAU * t).sin()).collect()]),
            (Signal::Torque, vec![t.iter().map(|t| -TAU * TAU * (TAU * t).sin()).collect()]),
        ]),
        payload: None,
        contact: vec![false; t.len()],
        holes: Vec::new(),
        clock: Clock::of(t, 0),
    };
    Log {
        files: vec!["log.csv".to_owned()],
        samples: runs.iter().map(Vec::len).sum(),
        runs: runs.iter().map(run).collect(),
        side: None,
        damaged: Vec::new(),
        lacking: Vec::new(),
        unknown: Vec::new(),
    }
}

fn even(count: usize, step: f64) -> Vec<f64> {
    (0..count).map(|k| step * k as f64).collect()
}

/// What is measured and what is computed of the motion come to the same rows in the same shape, at
/// the log's rate and thinned to a tenth.
#[test]
fn torques_and_accelerations_pass_alike() {
    for step in [1e-2, 1e-3] {
        let signals = Signals::of(
            &log(&[even((20.0 / step) as usize, step)]),
            Some(Signal::Torque),
            Some(10.0),
        );
        let (drive, computed) =
            (signals.filtered(&signals.drive[0]), signals.filtered(&signals.qdd[0]));
        assert_eq!(drive.len(), signals.rows());
        assert!((signals.step() - 0.02).abs() < 6e-3, "{}", signals.step());
        // The differences' fourth-order error at 1 Hz, twice: (ωT)⁴/15; the wider filter takes 2e-11.
        let error = (TAU * signals.period).powi(4) / 15.0 + 1e-6;
        for (k, _) in signals.settled(0.0).iter().enumerate().filter(|(_, settled)| **settled) {
            assert!((drive[k] - computed[k]).abs() < error * TAU * TAU, "{step} {k}");
        }
    }
}

#[test]
fn nothing_is_carried_across_a_gap() {
    let mut t = even(1000, 0.01);
    t.iter_mut().skip(600).for_each(|t| *t += 3.0);
    let signals = Signals::of(&log(&[t, even(500, 0.01)]), None, Some(5.0));
    let spans: Vec<(usize, usize)> =
        signals.spans.iter().map(|span| (span.run, span.fine.len())).collect();
    let thin = (0.01_f64 / signals.period).recip() as usize;
    assert_eq!(spans, [(0, 600 / thin), (0, 400 / thin), (1, 500 / thin)]);
    assert_eq!(signals.rows(), signals.kept(&signals.contact).len());
}

/// Straight lines between samples: an error of T²/8 of the second derivative, 4 T² with short gaps.
#[test]
fn a_clock_that_jitters_comes_to_even_steps() {
    let mut t = even(2000, 0.01);
    t.iter_mut().enumerate().for_each(|(k, t)| *t += 2e-3 * (1.7 * k as f64).sin());
    t.remove(700);
    let signals = Signals::of(&log(&[t]), None, Some(20.0));
    assert_eq!(signals.spans.len(), 1);
    let start = 0.0;
    for (k, t) in signals.t.iter().enumerate() {
        let expected = (TAU * (t + start)).sin();
        let error = 0.015_f64.powi(2) / 2.0 * TAU * TAU;
        assert!((signals.measured[0][k] - expected).abs() < error, "{k}");
    }
}

/// Encoders of 1e-5 rad: the band ends where a motion of 3 Hz does, not at the noise.
#[test]
fn the_band_is_that_of_the_motion() {
    let mut log = log(&[even(6000, 2e-3)]);
    let mut rng = crate::infer::rng::Rng::new(7, crate::infer::rng::Stream::Noise);
    for (q, t) in
        log.runs[0].signals.get_mut(&Signal::Q).unwrap()[0].iter_mut().zip(even(6000, 2e-3))
    {
        *q += 0.3 * (TAU * 3.0 * t).sin() + 1e-5 * rng.normal();
    }
    let band = Signals::of(&log, None, None).band;
    // A window of 512 samples tells frequencies by the Hz; Blackman's main lobe ends three of them
    // beside 3 Hz, and falls from -58 dB by 18 dB an octave: to the noise's -108 dB below 25 Hz. Half
    // the rate is 250 Hz.
    assert!((3.0..25.0).contains(&band), "{band}");
}
