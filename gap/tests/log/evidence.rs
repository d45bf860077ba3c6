//! How often something unrelated is taken for an effect.

use std::collections::BTreeMap;

use stiffarm_gap::dice::{Dice, Stream};
use stiffarm_gap::effects::About;
use stiffarm_gap::log::effects::{LogEffect, Number, Spot};
use stiffarm_gap::log::scene::{Column, Domain, Loads, Scene};
use stiffarm_gap::log::search::Round;
use stiffarm_gap::log::search::fit::Problem;
use stiffarm_gap::log::search::{State, blocks::correlation_time};
use stiffarm_gap::log::signal::Signals;
use stiffarm_gap::log::{Signal, TorqueSide};
use stiffarm_kernels::generic::Arm;

use super::plant::{arm, log, noise};

/// A column that has nothing to do with the torques: it stands in the log's commands.
struct Unrelated;

static UNRELATED: Unrelated = Unrelated;

impl LogEffect for Unrelated {
    fn identifier(&self) -> &'static str {
        "unrelated"
    }

    fn about(&self) -> About {
        About::default()
    }

    fn domain(&self) -> Domain {
        Domain::Torque
    }

    fn spots(&self, _: &Scene<'_>) -> Vec<Spot> {
        vec![Spot::Joint(0)]
    }

    fn numbers(&self) -> &'static [Number] {
        &[("size", "1")]
    }

    fn columns(&self, scene: &Scene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        vec![scene.column(0, |k| scene.signals.command[0][k])]
    }
}

const STEP: f64 = 0.05;
const COUNT: usize = 3000;
const TIME: f64 = 0.5;

fn trial(seed: u64, arm: &Arm) -> (f64, f64) {
    let mut dice = Dice::new(seed, Stream::Noise);
    let torque = vec![noise(&mut dice, COUNT, STEP, TIME, 1.0)];
    // It wanders over tens of seconds, as temperatures, loads and postures do.
    let slow = vec![noise(&mut dice, COUNT, STEP, 20.0, 1.0)];
    let q = vec![(0..COUNT).map(|k| (0.7 * STEP * k as f64).sin()).collect()];
    let signals = [(Signal::Q, q), (Signal::Torque, torque), (Signal::QCmd, slow)];
    let log = log(STEP, BTreeMap::from(signals));
    let signals = Signals::of(&log, Some(Signal::Torque), Some(4.0));
    let loads = Loads { rigid: Vec::new(), whole: Vec::new() };
    let scene = Scene {
        arm,
        signals: &signals,
        domain: Domain::Torque,
        side: Some(TorqueSide::Motor),
        weights: &[],
        loads: &loads,
        still: &[0.0],
    };
    let (target, counts) = (scene.target(), scene.rows());
    let time = correlation_time(&target[0], &counts[0], &signals);
    let problem = Problem { scene, target, counts, base: Vec::new() };
    let state = State { sizes: vec![1.0], loads: loads.clone() };
    let round = Round::of(&problem, &[], &state, &[(&UNRELATED, Spot::Joint(0))], seed);
    (round.asked.chances[0], time)
}

/// By samples it is significant at 5 % in four trials of five (`docs/logs.md`); by blocks of five
/// correlation times in as many as the level says, 5 % of 500 and two standard errors.
#[test]
fn a_slow_column_that_is_unrelated_is_seldom_taken_for_an_effect() {
    let arm = arm();
    let trials: Vec<(f64, f64)> = (0..500).map(|seed| trial(seed, &arm)).collect();
    let taken = trials.iter().filter(|(chance, _)| *chance <= 0.05).count();
    assert!(taken <= 35, "{taken} of 500");
    // And it is no test that never speaks.
    assert!(taken >= 10, "{taken} of 500");
    let time = trials.iter().map(|(_, time)| time).sum::<f64>() / 500.0;
    // 150 s hold 150 independent numbers: each estimate is off by a fifth, their mean by a hundredth,
    // and low by the few numbers there are.
    assert!((time / TIME - 1.0).abs() < 0.15, "{time}");
}
