//! Mistakes of any amount: a zero off by 30°, a twist by 20°, a length by a hand, half of a neighbour's reading.
//!
//! No list of round numbers holds them, and a linear step from the file does not reach them. The amount is looked for
//! over its whole range with the frames in closed form, and the best are fitted as one more unknown.

use core::f64::consts::TAU;

use stiffarm_kernels::Motion;

use super::kind::{Entry, Mistake};
use super::search::{FEW, Search, Tried};
use crate::constants::{ABOVE_CHANCE, LEAST_AMOUNT};
use crate::parallel;

/// Steps of a turn: least squares converge from half of one, 7.5°, which is tried itself, too: midway from nothing no
/// amount leaves less.
const ANGLES: usize = 24;

/// Lengths that are tried, as parts of the reach, of either sign. The point moves in proportion to a length: least
/// squares converge from anywhere.
const LENGTHS: [f64; 4] = [0.06, 0.15, 0.35, 0.8];

/// Ratios that are tried, of either sign: over a range of 3 rad half of a step is as much as 17°.
const RATIOS: [f64; 10] = [0.07, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0];

/// Of all that were looked for so many are fitted.
const BEST: usize = 24;

/// Of the frames' gap: what an amount explains a half of leaves less on few rows, too.
const WORTH: f64 = 0.8;

/// What holds zeros and springs where the file has them.
const FAST: f64 = 1e-6;

impl Mistake {
    /// Whether it is an amount by which arms are off.
    pub(super) fn is_small(&self, reach: f64) -> bool {
        match self {
            Mistake::Off { entry, by, .. } if entry.is_angle() => by.abs() < LEAST_AMOUNT[0],
            Mistake::Off { by, .. } => by.abs() < LEAST_AMOUNT[1] * reach,
            Mistake::Geared { ratio, .. } => ratio.abs() < LEAST_AMOUNT[2],
            _ => false,
        }
    }

    /// Whether its amount is fitted.
    fn is_open(&self) -> bool {
        matches!(self, Mistake::Off { .. } | Mistake::Geared { .. })
    }

    fn is_zero(&self) -> bool {
        matches!(self, Mistake::Off { entry: Entry::Theta, .. })
    }
}

/// Adds what was fitted to the amounts.
pub(super) fn put(mistakes: &mut [Mistake], more: &[f64]) {
    for (mistake, more) in mistakes.iter_mut().filter(|m| m.is_open()).zip(more) {
        match mistake {
            Mistake::Off { entry, by, .. } => {
                *by += more;
                if entry.is_angle() {
                    *by -= TAU * (*by / TAU).round();
                }
            }
            Mistake::Geared { joint, of, ratio } if joint == of => {
                *ratio = (1.0 + *ratio) * (1.0 + more) - 1.0;
            }
            Mistake::Geared { ratio, .. } => *ratio += more,
            _ => {}
        }
    }
}

impl Search<'_> {
    /// The best mistakes of any amount beside some others.
    pub(super) fn offs(&self, others: &[Mistake]) -> Vec<Tried> {
        let few = self.rows.fewer(FEW);
        let most = WORTH * self.framed(others.to_vec(), &few);
        let best_of = |amounts: &Vec<Mistake>| {
            let is_new = others.iter().all(|other| other.may_join(amounts[0]));
            if !is_new || self.bench.is_some() && !amounts[0].is_zero() {
                return None;
            }
            let each = amounts.iter().map(|off| {
                let mistakes = [others, &[*off]].concat();
                (self.framed(mistakes.clone(), &few), mistakes)
            });
            each.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(left, _)| *left < most)
        };
        let best = parallel::each(&self.amounts(), &best_of);
        self.refined(best.into_iter().flatten().collect(), BEST)
    }

    /// The best pairs of a joint's zero and anything else, another joint's zero among them.
    pub(super) fn pairs_with_zeros(&self) -> Vec<Tried> {
        let few = self.rows.fewer(FEW);
        // Steps of 30°.
        let zeros = self.amounts().into_iter().filter(|amounts| amounts[0].is_zero());
        let steps = |amounts: Vec<Mistake>| amounts.into_iter().take(ANGLES - 1).skip(1).step_by(2);
        let zeros: Vec<Mistake> = zeros.flat_map(steps).collect();
        let others = self.all.iter().filter(|m| !m.is_of_load() && !m.is_stuck());
        let others: Vec<Mistake> = others.chain(&zeros).copied().collect();
        let best_of = |other: &Mistake| {
            let is_new = |zero: &&Mistake| match (zero, other) {
                (Mistake::Off { row: a, .. }, Mistake::Off { row: b, .. }) => a > b,
                _ => other.may_join(**zero),
            };
            let each = zeros.iter().filter(is_new).map(|zero| {
                let pair = vec![*other, *zero];
                (self.framed(pair.clone(), &few), pair)
            });
            each.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(left, _)| left.is_finite())
        };
        let best = parallel::each(&others, &best_of);
        self.refined(best.into_iter().flatten().collect(), BEST)
    }

    /// The same with amounts that need no zeros and springs beside them, where these explain nothing: what the diagnosis
    /// goes on with has none.
    pub(super) fn polished(&self, mut tried: Tried) -> Tried {
        if self.bench.is_some() || !tried.mistakes.iter().any(Mistake::is_open) {
            return tried;
        }
        let fit = self.fit(tried.mistakes.clone(), &self.rows.chosen, true);
        let Some((_, fit)) = fit else { return tried };
        let (left, more) = fit.tightened(FAST).refined();
        let numbers = 2.0 * self.arm.dof() as f64;
        let measured = self.rows.data.kind.components().iter().filter(|is| **is).count() as f64;
        let chance = ABOVE_CHANCE * numbers / (measured * left.told * left.rows);
        if left.size.powi(2) <= tried.left.size.powi(2) * (1.0 + chance) {
            put(&mut tried.mistakes, &more);
            tried.left = left;
        }
        tried
    }

    /// Of each entry of the table, and of each reading with each joint, the amounts that are tried.
    fn amounts(&self) -> Vec<Vec<Mistake>> {
        let joints = &self.arm.joints;
        let slides = |joint: usize| joints[joint].motion == Motion::Prismatic;
        let step = TAU / ANGLES as f64;
        let turns = || (1..ANGLES).map(|k| step * k as f64).chain([-0.5 * step, 0.5 * step]);
        let lengths = || LENGTHS.iter().flat_map(|p| [p * self.reach, -p * self.reach]);
        let ratios = || RATIOS.iter().flat_map(|ratio| [*ratio, -ratio]);
        let mut all = Vec::new();
        for row in 0..joints.len() {
            for entry in [Entry::A, Entry::D, Entry::Theta, Entry::Alpha] {
                let off = |by| Mistake::Off { row, entry, by };
                all.push(match entry.is_angle() {
                    true => turns().map(off).collect(),
                    false => lengths().map(off).collect(),
                });
            }
            for of in (0..joints.len()).filter(|of| slides(*of) == slides(row)) {
                let geared = |ratio| Mistake::Geared { joint: row, of, ratio };
                all.push(ratios().map(geared).collect());
            }
        }
        all
    }
}
