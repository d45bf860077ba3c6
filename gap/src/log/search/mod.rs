//! Looking for effects in a log: forwards, by held-out blocks of time.
//!
//! Each round fits the model, divides the time by the correlation of what is left, and asks of every
//! effect at every place what it leaves of the blocks that its fit has not seen, and how likely chance
//! among as many is to do as well. The best that chance does not explain is added. At the end every
//! finding is asked again beside all others, and what else would do instead is told.

pub mod blocks;
pub mod candidates;
pub mod fit;
pub mod judge;
pub mod sums;

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use blocks::Blocks;
use candidates::{Candidate, Ground};
use fit::{Fitted, Problem, Term};

use super::effects::{CATALOGUE, LogEffect, Spot};
use super::scene::{Loads, Scene};
use super::signal::Signals;

/// A chance above this is not told from accident.
const CHANCE: f64 = 0.05;

/// No log shows more.
const MOST: usize = 80;

/// How large what is left is, and how the drives are loaded.
#[derive(Clone, Debug)]
pub struct State {
    /// Size of what the model leaves in each joint.
    pub sizes: Vec<f64>,
    /// What it asks of the drives.
    pub loads: Loads,
}

impl State {
    fn of(problem: &Problem<'_>, fit: &Fitted) -> State {
        State { sizes: problem.sizes(&fit.residual), loads: fit.loads(problem.base.len()) }
    }
}

/// One round: a model, and what could be added to it.
pub struct Round {
    /// The model.
    pub fit: Fitted,
    /// What it leaves, and asks of the drives.
    pub state: State,
    /// Correlation time of that, of each joint, s.
    pub correlation: Vec<f64>,
    /// How the time is divided.
    pub blocks: Blocks,
    /// Who was asked, and what they said.
    pub asked: Asked,
}

/// What could be added to a model.
pub struct Asked {
    /// Squares that the model leaves of each block, held out, in the sizes.
    pub squares: Vec<f64>,
    /// All that were asked.
    pub candidates: Vec<Candidate>,
    /// Of each the chance that something unrelated does as well.
    pub chances: Vec<f64>,
}

/// Effects and places that are asked for.
pub fn wanted(
    problem: &Problem<'_>,
    only: Option<&[String]>,
) -> Vec<(&'static dyn LogEffect, Spot)> {
    let scene = &problem.scene;
    let named = |e: &&&dyn LogEffect| {
        only.is_none_or(|names| names.iter().any(|name| name == e.identifier()))
    };
    let asked = CATALOGUE.iter().filter(|e| e.domain() == scene.domain).filter(named);
    let asked = asked.filter(|e| e.excluded(scene).is_none());
    asked.flat_map(|e| e.spots(scene).into_iter().map(|spot| (*e, spot))).collect()
}

impl Round {
    /// Fits the terms and asks for others among those wanted.
    pub fn of(
        problem: &Problem<'_>,
        terms: &[Term],
        before: &State,
        wanted: &[(&'static dyn LogEffect, Spot)],
        seed: u64,
    ) -> Round {
        let fit = problem.fit(terms, &before.sizes, &before.loads);
        // Once more, each joint told in what is left of it.
        let sizes = problem.sizes(&fit.residual);
        let fit = problem.fit(&fit.terms, &sizes, &fit.loads(problem.base.len()));
        let state = State::of(problem, &fit);
        let correlation = problem.correlation(&fit.residual);
        let longest = correlation.iter().copied().fold(0.0, f64::max);
        let blocks = Blocks::of(problem.scene.signals, longest);
        let asked = Asked::of(problem, &fit, &state, &blocks, wanted, seed);
        Round { fit, state, correlation, blocks, asked }
    }

    /// The candidate that takes most of what is held out by each of its numbers, of those that chance
    /// does not explain.
    pub fn best(&self) -> Option<&Candidate> {
        let Asked { squares, candidates, chances } = &self.asked;
        let whole: f64 = squares.iter().sum();
        let left = |c: &Candidate| c.squares.iter().sum::<f64>();
        let gain = |c: &Candidate| (whole - left(c)) / c.term.effect.numbers().len() as f64;
        let told = candidates.iter().zip(chances).filter(|(_, p)| **p <= CHANCE).map(|(c, _)| c);
        let told = told.filter(|c| left(c) < whole && c.term.effect.may_be(&c.term.values));
        told.max_by(|a, b| gain(a).total_cmp(&gain(b)))
    }
}

impl Asked {
    /// Asks a model for those of the wanted that it lacks.
    fn of(
        problem: &Problem<'_>,
        fit: &Fitted,
        state: &State,
        blocks: &Blocks,
        wanted: &[(&'static dyn LogEffect, Spot)],
        seed: u64,
    ) -> Asked {
        let scene = Scene { loads: &state.loads, ..problem.scene };
        let ground = Ground::of(scene, &problem.counts, fit, &state.sizes, blocks);
        let has = |name: &str, spot: Spot| {
            fit.terms.iter().any(|t| t.effect.identifier() == name && t.spot == spot)
        };
        let asked = wanted.iter().filter(|(e, spot)| {
            !has(e.identifier(), *spot) && e.beside().is_none_or(|other| has(other, *spot))
        });
        let terms: Vec<Term> = asked
            .map(|(effect, spot)| Term { effect: *effect, spot: *spot, values: Vec::new() })
            .collect();
        let candidates: Vec<Candidate> = terms.par_iter().map(|t| ground.candidate(t)).collect();
        let chances = ground.chances(&candidates, seed);
        Asked { squares: ground.squares, candidates, chances }
    }
}

/// Looks for effects among those wanted, one after the other. `each` is told every round; the last, in
/// which none was added, is returned.
pub fn search(
    problem: &Problem<'_>,
    wanted: &[(&'static dyn LogEffect, Spot)],
    seed: u64,
    each: &mut dyn FnMut(&Round),
) -> Round {
    let mut state =
        State { sizes: problem.sizes(&problem.target), loads: problem.scene.loads.clone() };
    let mut terms: Vec<Term> = Vec::new();
    loop {
        let round = Round::of(problem, &terms, &state, wanted, seed);
        each(&round);
        let Some(best) = round.best().filter(|_| terms.len() < MOST) else { return round };
        let added = best.term.clone();
        terms = round.fit.terms;
        terms.push(added);
        state = round.state;
    }
}

/// Whether what one leaves of the blocks is told from what another leaves: the larger, by more than the
/// blocks scatter, one-sided at 5 %.
pub fn is_worse(other: &[f64], best: &[f64]) -> bool {
    let differences: Vec<f64> = other.iter().zip(best).map(|(o, b)| o - b).collect();
    let n = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0) / n;
    let limit = StudentsT::new(0.0, 1.0, n - 1.0).map_or(f64::INFINITY, |t| t.inverse_cdf(0.95));
    mean > limit * variance.sqrt()
}

/// Independent numbers that the rows of the joints hold.
pub fn effective(counts: &[Vec<bool>], correlation: &[f64], signals: &Signals) -> f64 {
    let rows = |counts: &Vec<bool>| counts.iter().filter(|c| **c).count() as f64;
    let pairs = counts.iter().zip(correlation);
    pairs.map(|(c, time)| rows(c) * signals.step() / (2.0 * time)).sum()
}
