//! Entries of the table that are off by any amount: a zero by 30°, a twist by 20°, a length by a hand.
//!
//! No list of round numbers holds them, and a linear step from the file does not reach them. The amount is looked for
//! over its whole range with the frames in closed form, and the best are fitted as one more unknown.

use core::f64::consts::{PI, TAU};

use rayon::prelude::*;
use stiffarm_kernels::Motion;

use super::kind::{Entry, Mistake};
use super::search::{FEW, FEW_TURNS, Search, Tried};

/// Steps of a turn: least squares converge from half of one, 7.5°.
const ANGLES: usize = 24;

/// Lengths that are tried, as parts of the reach, of either sign. The point moves in proportion to a length: least
/// squares converge from anywhere.
const LENGTHS: [f64; 3] = [0.1, 0.3, 0.7];

/// Of all that were looked for so many are fitted.
const BEST: usize = 12;

/// Of the frames' gap: what an entry that is off explains a half of leaves less on few rows, too.
const WORTH: f64 = 0.8;

/// The least amount that is a mistake, rad and parts of the reach. What is less is an effect of the arm, and the effects'
/// own search is exact up to twice as much (zeros of 10°, lengths of a tenth of the reach).
const LEAST: [f64; 2] = [5.0 * PI / 180.0, 0.05];

impl Mistake {
    /// Whether it is an amount by which arms are off.
    pub(super) fn is_small(&self, reach: f64) -> bool {
        match self {
            Mistake::Off { entry, by, .. } if entry.is_angle() => by.abs() < LEAST[0],
            Mistake::Off { by, .. } => by.abs() < LEAST[1] * reach,
            _ => false,
        }
    }
}

/// Adds what was fitted to the amounts.
pub(super) fn put(mistakes: &mut [Mistake], more: &[f64]) {
    let amounts = mistakes.iter_mut().filter_map(|mistake| match mistake {
        Mistake::Off { entry, by, .. } => Some((entry.is_angle(), by)),
        _ => None,
    });
    for ((is_angle, by), more) in amounts.zip(more) {
        *by += more;
        if is_angle {
            *by -= TAU * (*by / TAU).round();
        }
    }
}

impl Search<'_> {
    /// The best entries that are off beside some mistakes.
    pub(super) fn offs(&self, others: &[Mistake]) -> Vec<Tried> {
        let few = self.rows.fewer(FEW);
        let left = |mistakes: Vec<Mistake>| {
            let fit = self.fit(mistakes, &few, false);
            fit.map_or(f64::INFINITY, |(_, fit)| fit.framed(FEW_TURNS).size)
        };
        let most = WORTH * left(others.to_vec());
        let best_of = |(row, entry): &(usize, Entry)| {
            let amounts = amounts(*entry, self.reach).into_iter();
            let each = amounts.map(|by| {
                let off = Mistake::Off { row: *row, entry: *entry, by };
                (left([others, &[off]].concat()), off)
            });
            each.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let mut found: Vec<(f64, Mistake)> = self
            .entries()
            .par_iter()
            .filter_map(best_of)
            .filter(|(left, _)| *left < most)
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.truncate(BEST);
        let fitted = found.into_par_iter();
        fitted.filter_map(|(_, off)| self.tried([others, &[off]].concat())).collect()
    }

    /// The best pairs of a joint's zero and anything else, another joint's zero among them.
    pub(super) fn pairs_with_zeros(&self) -> Vec<Tried> {
        let few = self.rows.fewer(FEW);
        let coarse = |row: usize| {
            let amounts = amounts(Entry::Theta, self.reach).into_iter().skip(1).step_by(2);
            amounts.map(move |by| Mistake::Off { row, entry: Entry::Theta, by })
        };
        let joints = || self.entries().into_iter().filter(|(_, e)| *e == Entry::Theta);
        let zeros: Vec<Mistake> = joints().flat_map(|(row, _)| coarse(row)).collect();
        let others = self.all.iter().filter(|m| !m.is_of_load() && !m.is_stuck());
        let others: Vec<Mistake> = others.copied().chain(zeros.iter().copied()).collect();
        let best_of = |other: &Mistake| {
            let is_same = |zero: &&Mistake| matches!((zero, other), (Mistake::Off { row: a, .. }, Mistake::Off { row: b, .. }) if a <= b);
            let each = zeros.iter().filter(|zero| !is_same(zero)).filter_map(|zero| {
                let (mistakes, fit) = self.fit(vec![*other, *zero], &few, false)?;
                Some((fit.framed(FEW_TURNS).size, mistakes))
            });
            each.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let mut pairs: Vec<(f64, Vec<Mistake>)> = others.par_iter().filter_map(best_of).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        pairs.truncate(2 * BEST);
        pairs.into_par_iter().filter_map(|(_, pair)| self.tried(pair)).collect()
    }

    /// Rows and their entries that are the arm's own.
    fn entries(&self) -> Vec<(usize, Entry)> {
        let all = [Entry::A, Entry::D, Entry::Theta, Entry::Alpha];
        let joints = self.arm.joints.iter().enumerate();
        let is_own = |slides: bool, entry: Entry| {
            // What the reading is added to is the joint's zero, which slides in a prismatic one.
            !(slides && entry == Entry::Theta)
        };
        let of_row = |(row, joint): (usize, &stiffarm_kernels::generic::Joint)| {
            let slides = joint.motion == Motion::Prismatic;
            all.into_iter().filter(move |entry| is_own(slides, *entry)).map(move |e| (row, e))
        };
        joints.flat_map(of_row).collect()
    }
}

/// What is tried of an entry, rad or m.
fn amounts(entry: Entry, reach: f64) -> Vec<f64> {
    if entry.is_angle() {
        return (1..ANGLES).map(|k| TAU * k as f64 / ANGLES as f64).collect();
    }
    LENGTHS.iter().flat_map(|part| [part * reach, -part * reach]).collect()
}
