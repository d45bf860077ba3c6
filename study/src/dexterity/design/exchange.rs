//! The tests that say most: one after the other, then exchanged.
//!
//! What they say is a sum of logarithms of determinants, each of some of the unknowns: of all of them
//! (D-optimality), or of one effect's beside another's.

use core::ops::Range;

use nalgebra::DMatrix;

use super::candidates::Block;
use crate::rng::{Rng, Stream};

/// Rounds of exchanges.
const ROUNDS: usize = 8;

/// An exchange that raises the logarithm of the determinant by less is none.
const GAIN: f64 = 1e-6;

/// What is known of each unknown before any test, as a part of what an average test says: without
/// it the first tests, which cannot determine all, would have no determinant.
const BEFORE: f64 = 1e-6;

/// Random designs that a design is compared with.
const DRAWS: usize = 50;

/// A column below this part of the largest of its kind is one that nothing shows.
const EMPTY: f64 = 1e-9;

/// All that may be chosen, each column in units of what an average test says of it; columns that
/// nothing shows are left out.
pub(super) struct Choices<'a> {
    blocks: &'a [Block],
    unknowns: usize,
    /// The columns that are left, and what they were divided by.
    shown: Vec<(usize, f64)>,
    rows: Vec<DMatrix<f64>>,
    terms: Vec<Term>,
}

/// What is to be large.
pub(super) enum Aim<'a> {
    /// What is said of all unknowns together.
    All,
    /// What is said of two effects' columns, each beside all others.
    Apart([&'a Range<usize>; 2]),
}

/// A part of what is to be large.
struct Term {
    weight: f64,
    /// The unknowns whose information's determinant it is, of those shown.
    columns: Vec<usize>,
}

impl Term {
    fn part(&self, information: &DMatrix<f64>) -> DMatrix<f64> {
        information.select_rows(&self.columns).select_columns(&self.columns)
    }
}

impl<'a> Choices<'a> {
    /// Columns with the same number in `kinds` are compared with each other.
    pub(super) fn new(blocks: &'a [Block], kinds: &[usize], aim: &Aim<'_>) -> Choices<'a> {
        let unknowns = kinds.len();
        let count = blocks.len().max(1) as f64;
        let square = |c: usize| blocks.iter().map(|b| b.rows.column(c).norm_squared()).sum::<f64>();
        let norms: Vec<f64> = (0..unknowns).map(|c| (square(c) / count).sqrt()).collect();
        let largest = |c: usize| {
            let kind = norms.iter().zip(kinds).filter(|(_, kind)| **kind == kinds[c]);
            kind.map(|(norm, _)| *norm).fold(0.0, f64::max)
        };
        let shown: Vec<(usize, f64)> = (0..unknowns)
            .filter(|&c| norms[c] > EMPTY * largest(c))
            .map(|c| (c, norms[c]))
            .collect();
        let scaled = |block: &Block| {
            DMatrix::from_fn(block.rows.nrows(), shown.len(), |r, c| {
                block.rows[(r, shown[c].0)] / shown[c].1
            })
        };
        let rows = blocks.iter().map(scaled).collect();
        let terms = terms(aim, &shown.iter().map(|(column, _)| *column).collect::<Vec<_>>());
        Choices { blocks, unknowns, shown, rows, terms }
    }

    /// `Σ BᵀB` and the little that is known before.
    fn information(&self, chosen: &[usize]) -> DMatrix<f64> {
        let n = self.shown.len();
        let before = DMatrix::identity(n, n) * BEFORE;
        chosen.iter().fold(before, |sum, &k| sum + self.rows[k].tr_mul(&self.rows[k]))
    }

    /// By how much each test raises what is to be large, by `ln det (1 + B M⁻¹ Bᵀ)` for each term;
    /// the best one whose posture is not in use.
    fn best(&self, information: &DMatrix<f64>, used: &[usize]) -> Option<(usize, f64)> {
        let inverses: Vec<DMatrix<f64>> =
            self.terms.iter().map(|t| t.part(information).try_inverse()).collect::<Option<_>>()?;
        let taken: Vec<usize> = used.iter().map(|&k| self.blocks[k].posture).collect();
        let gain = |k: usize| {
            let each = self.terms.iter().zip(&inverses).map(|(term, inverse)| {
                let b = self.rows[k].select_columns(&term.columns);
                let inner = &b * inverse * b.transpose() + DMatrix::identity(b.nrows(), b.nrows());
                term.weight * log_determinant(&inner)
            });
            each.sum::<f64>()
        };
        (0..self.rows.len())
            .filter(|&k| !taken.contains(&self.blocks[k].posture))
            .map(|k| (k, gain(k)))
            .fold(None, |best: Option<(usize, f64)>, next| match best {
                Some(before) if before.1 >= next.1 => Some(before),
                _ => Some(next),
            })
    }

    /// Up to `count` tests, each in another posture.
    pub(super) fn choose(&self, count: usize, done: &dyn Fn(f64)) -> Vec<usize> {
        let mut chosen = Vec::new();
        let steps = (count * (ROUNDS + 1)) as f64;
        while chosen.len() < count {
            match self.best(&self.information(&chosen), &chosen) {
                Some((next, _)) => chosen.push(next),
                None => break,
            }
            done(chosen.len() as f64 / steps);
        }
        for round in 1..=ROUNDS {
            let before = self.value(&self.information(&chosen));
            for slot in 0..chosen.len() {
                done((round * count + slot) as f64 / steps);
                let mut others = chosen.clone();
                let own = others.remove(slot);
                let information = self.information(&others);
                if let Some((next, gain)) = self.best(&information, &others)
                    && next != own
                    && gain
                        > self.value(&self.information(&chosen)) - self.value(&information) + GAIN
                {
                    chosen[slot] = next;
                }
            }
            if self.value(&self.information(&chosen)) <= before + GAIN {
                break;
            }
        }
        chosen
    }

    /// What is to be large.
    fn value(&self, information: &DMatrix<f64>) -> f64 {
        self.terms.iter().map(|t| t.weight * log_determinant(&t.part(information))).sum()
    }

    /// The standard deviation of each unknown that these tests leave; none where no test shows it.
    pub(super) fn deviations(&self, chosen: &[usize]) -> Vec<Option<f64>> {
        let mut all = vec![None; self.unknowns];
        let Some(covariance) = self.information(chosen).try_inverse() else { return all };
        for (k, (column, scale)) in self.shown.iter().enumerate() {
            // What was assumed before must not pass for what the tests say.
            let found = covariance[(k, k)] < 0.01 / BEFORE;
            all[*column] = found.then(|| covariance[(k, k)].sqrt() / scale);
        }
        all
    }

    /// How many times as many random tests would say as much: so many tests add the logarithm of
    /// their number for every unknown of a term.
    pub(super) fn efficiency(&self, chosen: &[usize], seed: u64) -> f64 {
        let n: f64 = self.terms.iter().map(|t| t.weight * t.columns.len() as f64).sum();
        if n <= 0.0 || chosen.is_empty() {
            return 1.0;
        }
        let mut rng = Rng::new(seed, Stream::Starts);
        let drawn = (0..DRAWS).map(|_| {
            let tests: Vec<usize> = chosen.iter().map(|_| rng.below(self.rows.len())).collect();
            self.value(&self.information(&tests))
        });
        let mean = drawn.sum::<f64>() / DRAWS as f64;
        ((self.value(&self.information(chosen)) - mean) / n).exp()
    }
}

/// The parts of an aim, of the columns that are shown.
fn terms(aim: &Aim<'_>, shown: &[usize]) -> Vec<Term> {
    let without = |gone: Option<&Range<usize>>| -> Vec<usize> {
        let stays = |k: &usize| gone.is_none_or(|gone| !gone.contains(&shown[*k]));
        (0..shown.len()).filter(stays).collect()
    };
    let all = without(None);
    let Aim::Apart(pair) = aim else {
        return vec![Term { weight: 1.0, columns: all }];
    };
    // ln det of what is left of an effect is that of all less that of all others: per number, and the
    // mean of both.
    let mut terms = Vec::new();
    for own in pair {
        let others = without(Some(own));
        let weight = 0.5 / (all.len() - others.len()).max(1) as f64;
        terms.push(Term { weight, columns: all.clone() });
        terms.push(Term { weight: -weight, columns: others });
    }
    terms
}

fn log_determinant(matrix: &DMatrix<f64>) -> f64 {
    let root = matrix.clone().cholesky();
    root.map_or(f64::NEG_INFINITY, |root| 2.0 * root.l().diagonal().map(f64::ln).sum())
}
