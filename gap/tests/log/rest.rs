//! How often something is said to be left where nothing is, and where something is that no effect explains.

use stiffarm_gap::log::report::LogDiagnosis;
use stiffarm_gap::log::{Domain, Log, LogOptions, Signal, diagnose};
use stiffarm_gap::rng::{Rng, Stream};

use super::plant::{Path, arm, gravity, noise, recorded};

const STEP: f64 = 0.04;
const COUNT: usize = 1500;

/// Standard deviation of a reading, rad.
const NOISE: f64 = 1e-3;

/// By which nothing was chosen.
const SEEDS: core::ops::Range<u64> = 30_000..30_100;

/// Servos that follow their commands, and readings of them with noise of so much memory, s. Joint 1 droops, which
/// spreads so many times as much as the noise.
fn followed(seed: u64, memory: f64, times: f64) -> Log {
    let path = Path::new(seed, 0.4);
    let mut rng = Rng::new(seed, Stream::Noise);
    let noises = [(); 2].map(|()| noise(&mut rng, COUNT, STEP, memory, NOISE));
    let at: Vec<[f64; 2]> = (0..COUNT).map(|k| path.at(STEP * k as f64)[0]).collect();
    let weights: Vec<f64> = at.iter().map(|q| gravity(*q)[0]).collect();
    let mean = weights.iter().sum::<f64>() / COUNT as f64;
    let square = weights.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    let compliance = times * NOISE / (square / COUNT as f64).sqrt();
    recorded(STEP, COUNT, Signal::QCmd, |k, _| {
        let droop = [compliance * weights[k], 0.0];
        [0, 1].map(|j| [at[k][j] - droop[j] + noises[j][k], at[k][j]])
    })
}

/// Without the effect that droop is.
fn diagnosed(log: &Log, seed: u64) -> LogDiagnosis {
    let known = ["latency", "tracking_lag", "backlash"].map(str::to_owned).to_vec();
    let rows = Some(Domain::Position);
    let options = LogOptions { effects: Some(known), rows, seed, ..LogOptions::default() };
    diagnose(&arm(), log, &options).expect("a diagnosis")
}

fn told(memory: f64, times: f64) -> usize {
    let is_told =
        |seed: &u64| diagnosed(&followed(*seed, memory, times), *seed).unexplained.present;
    SEEDS.filter(is_told).count()
}

/// It remembers as long as the motion does, and the minute holds some ten numbers of it; but other times foretell it.
#[test]
fn a_droop_that_nothing_explains_is_left_over() {
    let flagged = told(0.01, 1.2);
    assert!(flagged >= 90, "{flagged} of 100");
}

/// Readings of joint 2 that count from another zero than its commands, by half of the noise: nothing in the catalogue
/// does that.
#[test]
fn a_zero_that_is_wrong_is_left_over() {
    is_left_over(2, "mean", |q| *q += 0.5 * NOISE);
}

/// What is done to the readings of a joint is said to be left, and on what it depends.
fn is_left_over(joint: usize, of: &str, done: impl Fn(&mut f64)) {
    let is_told = |seed: &u64| {
        let mut log = followed(*seed, 0.01, 0.0);
        let q = log.runs[0].signals.get_mut(&Signal::Q).expect("positions");
        q[joint - 1].iter_mut().for_each(&done);
        let left = diagnosed(&log, *seed).unexplained.depends_on;
        left.iter().any(|rest| rest.place == format!("joint {joint}") && rest.of == of)
    };
    let flagged = SEEDS.filter(is_told).count();
    assert!(flagged >= 90, "{flagged} of 100");
}

/// An encoder with six waves a radian, half as large as the noise: neighbours in angle are alike.
#[test]
fn waves_that_nothing_explains_are_left_over() {
    is_left_over(1, "angle, finely", |q| {
        *q += 0.5 * NOISE * 2.0_f64.sqrt() * (6.0 * *q).sin();
    });
}

/// 5 of 100, and two standard errors; of noise that forgets at once, and of noise as slow as the motion.
#[test]
fn where_nothing_is_left_nothing_is_told() {
    for memory in stiffarm_draws::few_or_many(&[1.0][..], &[0.01, 1.0]) {
        let flagged = told(*memory, 0.0);
        assert!(flagged <= 9, "{flagged} of 100 at {memory} s");
    }
}
