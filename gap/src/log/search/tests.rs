//! How often something unrelated is taken for an effect.

use std::collections::BTreeMap;

use stiffarm_draws::few_or_many;
use stiffarm_kernels::generic::Arm;

use super::Search;
use super::case::{Case, Simple};
use super::dictionary::Dictionary;
use super::fit::Links;
use crate::effects::{Facts, InMotion, Law, Parameter, Quantity, Spot};
use crate::fixture::rigid;
use crate::log::scene::{Column, Domain, Scene};
use crate::log::{Clock, Log, Run, Signal, TorqueSide};
use crate::rng::{Rng, Stream};
use crate::signal::Signals;

/// A column that has nothing to do with the torques: it stands in the log's commands.
struct Unrelated;

static UNRELATED: Unrelated = Unrelated;

impl Law for Unrelated {
    fn facts(&self) -> &'static Facts {
        const FACTS: &Facts = &Facts {
            identifier: "unrelated",
            parameters: &[Parameter::free("size", Quantity::Ratio)],
            ..Facts::TORQUE
        };
        FACTS
    }
}

impl InMotion for Unrelated {
    fn spots(&self, _: &Scene<'_>) -> Vec<Spot> {
        vec![Spot::of_joint(0)]
    }

    fn columns(&self, scene: &Scene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        vec![scene.column(0, |k| scene.signals.command[0][k])]
    }
}

const STEP: f64 = 0.05;
const COUNT: usize = 3000;
const TIME: f64 = 0.5;

/// By which nothing was chosen.
const SEEDS: core::ops::Range<u64> = 20_000..20_500;

/// Noise that is correlated over a time: AR(1).
fn noise(rng: &mut Rng, time: f64) -> Vec<f64> {
    let keep = (-STEP / time).exp();
    let mut x = rng.normal();
    let mut next = || {
        x = keep * x + (1.0 - keep * keep).sqrt() * rng.normal();
        x
    };
    (0..COUNT).map(|_| next()).collect()
}

fn log(signals: BTreeMap<Signal, Vec<Vec<f64>>>) -> Log {
    let run = Run {
        name: String::new(),
        t: (0..COUNT).map(|k| STEP * k as f64).collect(),
        signals,
        payload: None,
        contact: vec![false; COUNT],
        holes: Vec::new(),
        clock: Clock { period: STEP, jitter: 0.0, dropped: 0, repeated: 0 },
    };
    Log {
        files: vec!["slow.csv".to_owned()],
        samples: COUNT,
        runs: vec![run],
        side: Some(TorqueSide::Motor),
        damaged: Vec::new(),
        lacking: Vec::new(),
        unknown: Vec::new(),
    }
}

fn trial(seed: u64, arm: &Arm) -> (f64, f64) {
    let mut rng = Rng::new(seed, Stream::Noise);
    let torque = vec![noise(&mut rng, TIME)];
    // It wanders over tens of seconds, as temperatures, loads and postures do.
    let slow = vec![noise(&mut rng, 20.0)];
    // A motion that repeats would be averaged.
    let q = |t: f64| (0.7 * t).sin() + 0.5 * (0.7 * core::f64::consts::SQRT_2 * t).sin();
    let q = vec![(0..COUNT).map(|k| q(STEP * k as f64)).collect()];
    let signals = [(Signal::Q, q), (Signal::Torque, torque), (Signal::QCmd, slow)];
    let log = log(BTreeMap::from(signals));
    let mut signals = Signals::of(&log, Some(Signal::Torque), Some(4.0));
    signals.mark_ways(&[0.0]);
    let case = Case {
        arm,
        signals: &signals,
        kind: (Domain::Torque, Some(TorqueSide::Motor)),
        still: &[0.0],
        base: None,
        known: &[],
        payloads: &[None],
        loaded: &[None],
        late: 0.0,
        left_out: &[],
    };
    let wanted = [(&UNRELATED as &dyn InMotion, Spot::of_joint(0), vec![vec![0.0]])];
    let dict = Dictionary::of(&case, &Simple::default(), &wanted, 1);
    let round = Search::new(&dict, &Links::Free, &[0], seed).round(&[], &[1.0]);
    (round.asked.candidates[0].answer.p_value, round.now.correlation[0])
}

/// By samples it is significant at 5 % in four trials of five (`docs/logs.md`); by blocks of five
/// correlation times in as many as the level says, 5 % of 500, or of 200, and two standard errors.
#[test]
fn a_slow_column_that_is_unrelated_is_seldom_taken_for_an_effect() {
    let arm = rigid();
    let trials: Vec<(f64, f64)> =
        SEEDS.take(few_or_many(200, 500)).map(|seed| trial(seed, &arm)).collect();
    let taken = trials.iter().filter(|(chance, _)| *chance <= 0.05).count();
    assert!(taken <= few_or_many(16, 35), "{taken} of {}", trials.len());
    // And it is no test that never speaks.
    assert!(taken >= few_or_many(4, 10), "{taken} of {}", trials.len());
    let time = trials.iter().map(|(_, time)| time).sum::<f64>() / trials.len() as f64;
    // 150 s hold 150 independent numbers: each estimate is off by a fifth, their mean by a hundredth,
    // and low by the few numbers there are.
    assert!((time / TIME - 1.0).abs() < 0.15, "{time}");
}
