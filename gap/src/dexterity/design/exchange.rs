//! The tests with the largest determinant: one after the other, then exchanged.

use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::candidates::Block;
use crate::identify::random::uniform;

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
    /// Unknowns, springs before zeros.
    unknowns: usize,
    /// The columns that are left, and what they were divided by.
    shown: Vec<(usize, f64)>,
    rows: Vec<DMatrix<f64>>,
}

impl<'a> Choices<'a> {
    /// Of an arm with so many joints.
    pub(super) fn new(blocks: &'a [Block], joints: usize) -> Choices<'a> {
        let unknowns = blocks.first().map_or(0, |block| block.rows.ncols());
        let count = blocks.len().max(1) as f64;
        let square = |c: usize| blocks.iter().map(|b| b.rows.column(c).norm_squared()).sum::<f64>();
        let norms: Vec<f64> = (0..unknowns).map(|c| (square(c) / count).sqrt()).collect();
        let largest = |c: usize| {
            let kind = norms.iter().skip(c / joints * joints).take(joints);
            kind.copied().fold(0.0, f64::max)
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
        Choices { blocks, unknowns, shown, rows }
    }

    /// `Σ BᵀB` and the little that is known before.
    fn information(&self, chosen: &[usize]) -> DMatrix<f64> {
        let n = self.shown.len();
        let before = DMatrix::identity(n, n) * BEFORE;
        chosen.iter().fold(before, |sum, &k| sum + self.rows[k].tr_mul(&self.rows[k]))
    }

    /// By how much each test raises the logarithm of the determinant: `ln det (1 + B M⁻¹ Bᵀ)`; the
    /// best one whose posture is not in use.
    fn best(&self, information: &DMatrix<f64>, used: &[usize]) -> Option<(usize, f64)> {
        let inverse = information.clone().try_inverse()?;
        let taken: Vec<usize> = used.iter().map(|&k| self.blocks[k].posture).collect();
        let gain = |k: usize| {
            let b = &self.rows[k];
            let inner = b * &inverse * b.transpose() + DMatrix::identity(b.nrows(), b.nrows());
            inner.cholesky().map_or(0.0, |root| 2.0 * root.l().diagonal().map(f64::ln).sum())
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
            let before = self.log_determinant(&chosen);
            for slot in 0..chosen.len() {
                done((round * count + slot) as f64 / steps);
                let mut others = chosen.clone();
                let own = others.remove(slot);
                let information = self.information(&others);
                if let Some((next, gain)) = self.best(&information, &others)
                    && next != own
                    && gain > self.log_determinant(&chosen) - log_determinant(&information) + GAIN
                {
                    chosen[slot] = next;
                }
            }
            if self.log_determinant(&chosen) <= before + GAIN {
                break;
            }
        }
        chosen
    }

    fn log_determinant(&self, chosen: &[usize]) -> f64 {
        log_determinant(&self.information(chosen))
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

    /// The determinant against that of random tests, per unknown.
    pub(super) fn efficiency(&self, chosen: &[usize], seed: u64) -> f64 {
        let n = self.shown.len();
        if n == 0 || chosen.is_empty() {
            return 1.0;
        }
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let draw = |random: &mut ChaCha8Rng| {
            let pick = (uniform(random) * self.rows.len() as f64) as usize;
            pick.min(self.rows.len() - 1)
        };
        let drawn = (0..DRAWS).map(|_| {
            let tests: Vec<usize> = chosen.iter().map(|_| draw(&mut random)).collect();
            self.log_determinant(&tests)
        });
        let mean = drawn.sum::<f64>() / DRAWS as f64;
        ((self.log_determinant(chosen) - mean) / n as f64).exp()
    }
}

fn log_determinant(matrix: &DMatrix<f64>) -> f64 {
    let root = matrix.clone().cholesky();
    root.map_or(f64::NEG_INFINITY, |root| 2.0 * root.l().diagonal().map(f64::ln).sum())
}
