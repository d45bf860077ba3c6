//! Tests that tell two effects apart.
//!
//! What of one effect's changes the other cannot imitate is `S = AᵀA − AᵀB(BᵀB)⁻¹BᵀA`, with `A` and
//! `B` what the tests show of the two, in units of the noise. `θᵀSθ` is by how much the fit of the
//! wrong one fails: T-optimality (Atkinson & Fedorov, *The design of experiments for discriminating
//! between two rival models*, Biometrika 62, 1975) makes it large. Either effect may be the true one
//! and its size is not known, so that the geometric mean of both, over all directions of θ, is made
//! largest.

use core::ops::Range;

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::Plan;
use super::candidates::{Block, Posture};
use super::suspect::{Number, Suspect};
use super::trial::{LineUp, Trial};
use crate::dexterity::DexterityError;
use crate::infer::Basis;
use crate::measurement::Row;
use crate::rng::{Rng, Stream};
use crate::whole::Whole;

/// An effect is told from the other where its number is so many of its standard deviations.
pub const DEVIATIONS: f64 = 3.0;

/// An effect shows in displacements if these have more than this part of its squares in poses.
const SHOWS: f64 = 1e-5;

/// A direction in which this part of an effect's information is left beside the other effect is
/// none in which they are told apart.
const ALIKE: f64 = 1e-6;

/// Directions with this part of an effect's information are rounding.
const ROUNDING: f64 = 1e-12;

/// What the tests will say of an effect while the other one may be there as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// In words: `joint compliance at joint 2`.
    pub effect: String,
    /// Its numbers, each with its standard deviation; none where the other effect does the same.
    pub numbers: Vec<(Number, Option<f64>)>,
    /// By how much the effect must move the tool to be told from the other whatever its numbers are,
    /// m, root mean square over the tests; none if it cannot be told in all its forms.
    pub smallest: Option<f64>,
}

/// The tests that may be chosen, and what their columns are.
pub(super) struct Apart {
    pub(super) blocks: Vec<Block>,
    pub(super) displacements: bool,
    line_up: LineUp,
}

impl Apart {
    /// # Errors
    /// [`DexterityError::Idle`] if no test shows anything of one of the two;
    /// [`DexterityError::NoForm`]; [`DexterityError::Unstable`].
    pub(super) fn new(
        whole: Whole<'_>,
        plan: &Plan,
        pair: &[Suspect; 2],
        postures: &[Posture],
    ) -> Result<Apart, DexterityError> {
        let mut rng = Rng::new(plan.seed, Stream::Starts);
        let mut rows = Vec::new();
        for (posture, load) in super::candidates::pairs(postures, plan) {
            let side = |_: &f64| rng.sign() as i8;
            let direction: Vec<i8> = postures[posture].q.iter().map(side).collect();
            let (q, wrench) = (postures[posture].q.clone(), plan.loads[load]);
            let direction = Some(direction);
            rows.push(Row { wrench, direction, group: posture, ..Row::new(0, q) });
        }
        let all = pair.iter().chain(&plan.along);
        let line_up = LineUp::new(whole.arm, all, rows.clone());
        let line_up = line_up.map_err(|s| DexterityError::NoForm { effect: s.to_string() })?;
        let trials: Vec<Trial<'_>> =
            rows.iter().map(|row| Trial { whole, row: row.clone(), plan }).collect();
        let blocks = |displacements: bool| -> Result<Vec<DMatrix<f64>>, DexterityError> {
            let each = trials.iter().map(|t| t.rows(&line_up, displacements));
            Ok(each.collect::<Result<_, _>>()?)
        };
        // Differences need no geometry; what hardly depends on the load shows in poses alone.
        let (differences, poses) = (blocks(true)?, blocks(false)?);
        let ratio = |k: usize| line_up.squares(k, &differences) / line_up.squares(k, &poses);
        let displacements = (0..2).all(|k| ratio(k) > SHOWS);
        let found = if displacements { differences } else { poses };
        if let Some(idle) = (0..2).find(|&k| line_up.squares(k, &found) == 0.0) {
            let (effect, why) = (pair[idle].to_string(), pair[idle].idle());
            return Err(DexterityError::Idle { effect, why });
        }
        let mut directed = false;
        for (trial, block) in trials.iter().zip(&found) {
            let plain = Trial { row: Row { direction: None, ..trial.row.clone() }, ..*trial };
            if plain.rows(&line_up, displacements)? != *block {
                directed = true;
                break;
            }
        }
        let loads = plan.loads.len();
        let blocks = found.into_iter().zip(rows).enumerate().map(|(k, (rows, row))| Block {
            posture: row.group,
            load: k % loads,
            direction: if directed { row.direction } else { None },
            rows,
        });
        Ok(Apart { blocks: blocks.collect(), displacements, line_up })
    }

    /// Columns of the one of the two with this number.
    pub(super) fn columns(&self, index: usize) -> Range<usize> {
        self.line_up.columns(index)
    }

    /// Columns with the same number are compared with each other.
    pub(super) fn kinds(&self) -> Vec<usize> {
        self.line_up.kinds()
    }

    /// What tests say of both.
    pub(super) fn told(&self, plan: &Plan, pair: &[Suspect; 2], chosen: &[usize]) -> Vec<Told> {
        let blocks: Vec<&DMatrix<f64>> = chosen.iter().map(|&k| &self.blocks[k].rows).collect();
        let each = pair.iter().enumerate().map(|(k, suspect)| {
            let own = self.line_up.columns(k);
            let left = Left::new(&blocks, own.clone(), plan.noises().len());
            let numbers = self.line_up.numbers[k].iter().cloned();
            Told {
                effect: suspect.to_string(),
                numbers: numbers.zip(left.deviations()).collect(),
                smallest: left.smallest(plan.noise_position * self.steps()),
            }
        });
        each.collect()
    }

    /// The noise of a measured number in units of a reading's.
    fn steps(&self) -> f64 {
        if self.displacements { core::f64::consts::SQRT_2 } else { 1.0 }
    }
}

/// What is left of an effect beside the others.
struct Left {
    /// Directions of its numbers, apart in `AᵀA` (there 1 each) and in `S`; each number in units in
    /// which `AᵀA` has a unit diagonal.
    directions: DMatrix<f64>,
    /// What `S` is in each direction: the part of the information that is left.
    parts: DVector<f64>,
    /// Mean square of the tool's displacement, in the same units, noise 1.
    moved: DMatrix<f64>,
    /// Those units.
    scale: DVector<f64>,
}

impl Left {
    fn new(blocks: &[&DMatrix<f64>], own: Range<usize>, measured: usize) -> Left {
        let count = blocks.first().map_or(0, |b| b.ncols());
        let sum = blocks.iter().fold(DMatrix::zeros(count, count), |sum, b| sum + b.tr_mul(b));
        let unit = |k: usize| if sum[(k, k)] > 0.0 { sum[(k, k)].sqrt().recip() } else { 0.0 };
        let scale = DVector::from_fn(count, |k, _| unit(k));
        let sum = DMatrix::from_fn(count, count, |r, c| sum[(r, c)] * scale[r] * scale[c]);
        let others: Vec<usize> = (0..count).filter(|k| !own.contains(k)).collect();
        let own: Vec<usize> = own.collect();
        let part =
            |rows: &[usize], columns: &[usize]| sum.select_rows(rows).select_columns(columns);
        let shared = part(&others, &own);
        let explained = axes(&part(&others, &others)).tr_mul(&shared);
        let mut moved = DMatrix::zeros(own.len(), own.len());
        let mut readings = 0.0;
        for block in blocks {
            for first in (0..block.nrows()).step_by(measured) {
                let shift = block.rows(first, 3).select_columns(&own);
                moved += shift.tr_mul(&shift);
                readings += 1.0;
            }
        }
        let scale = scale.select_rows(&own);
        let moved = DMatrix::from_fn(own.len(), own.len(), |r, c| {
            moved[(r, c)] * scale[r] * scale[c] / f64::max(readings, 1.0)
        });
        let own = part(&own, &own);
        let left = &own - explained.tr_mul(&explained);
        let axes = axes(&own);
        let eigen = SymmetricEigen::new(axes.tr_mul(&left) * &axes);
        Left { directions: axes * eigen.eigenvectors, parts: eigen.eigenvalues, moved, scale }
    }

    /// Standard deviation of each number; none where what is left of it is nothing.
    fn deviations(&self) -> Vec<Option<f64>> {
        let number = |k: usize| {
            if self.scale[k] == 0.0 {
                return None;
            }
            let mut variance = 0.0;
            for (j, left) in self.parts.iter().enumerate() {
                let part = self.directions[(k, j)].powi(2);
                if *left > ALIKE {
                    variance += part / left;
                } else if part > ALIKE {
                    return None;
                }
            }
            Some(variance.sqrt() * self.scale[k])
        };
        (0..self.scale.len()).map(number).collect()
    }

    /// By how much the effect must move the tool to be told, with this noise.
    fn smallest(&self, noise: f64) -> Option<f64> {
        if self.parts.is_empty() || self.parts.min() < ALIKE {
            return None;
        }
        let mut directions = self.directions.clone();
        for (mut direction, left) in directions.column_iter_mut().zip(self.parts.iter()) {
            direction /= left.sqrt();
        }
        let moved = SymmetricEigen::new(directions.tr_mul(&self.moved) * &directions);
        Some(DEVIATIONS * noise * moved.eigenvalues.max().max(0.0).sqrt())
    }
}

/// Axes in which information is 1; what is rounding is left out.
fn axes(information: &DMatrix<f64>) -> DMatrix<f64> {
    Basis::decided(information, &information.diagonal(), ROUNDING).t
}
