//! What a test would show of effects, before it is measured.

use core::ops::Range;

use nalgebra::{DMatrix, Isometry3, Matrix6xX, Vector6};
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use super::Plan;
use super::suspect::{Number, Suspect};
use crate::effects::{Effect, Scene, Spot};
use crate::measurement::{Kind, Measurements, Row};
use crate::simulate::{Actual, Moment, Sim};
use crate::whole::Whole;

/// The effects of a plan, each at its spot: the two to be told apart, then those that are fitted
/// along.
pub(super) struct LineUp {
    effects: Vec<(&'static dyn Effect, Spot)>,
    pub(super) numbers: Vec<Vec<Number>>,
}

/// A test that has not been made.
#[derive(Clone)]
pub(super) struct Trial<'a> {
    pub(super) whole: Whole<'a>,
    pub(super) plan: &'a Plan,
    pub(super) row: Row,
}

impl LineUp {
    pub(super) fn new<'s>(
        arm: &Arm,
        suspects: impl Iterator<Item = &'s Suspect>,
        rows: Vec<Row>,
    ) -> Result<LineUp, &'s Suspect> {
        let data = planned(rows);
        let mut line_up = LineUp { effects: Vec::new(), numbers: Vec::new() };
        for suspect in suspects {
            let (spot, numbers) = suspect.spotted(arm, &data).ok_or(suspect)?;
            line_up.effects.push((suspect.effect, spot));
            line_up.numbers.push(numbers);
        }
        Ok(line_up)
    }

    /// Columns of the one with this number.
    pub(super) fn columns(&self, index: usize) -> Range<usize> {
        let first: usize = self.numbers[..index].iter().map(Vec::len).sum();
        first..first + self.numbers[index].len()
    }

    /// For each column a number that it shares with those of its effect and unit.
    pub(super) fn kinds(&self) -> Vec<usize> {
        let each = self.numbers.iter().enumerate();
        let names: Vec<(usize, &str)> =
            each.flat_map(|(k, numbers)| numbers.iter().map(move |n| (k, n.unit))).collect();
        names.iter().map(|n| names.iter().position(|m| m == n).unwrap_or(0)).collect()
    }

    /// Sum of squares of what the tests show of the one with this number.
    pub(super) fn squares(&self, index: usize, blocks: &[DMatrix<f64>]) -> f64 {
        let columns = self.columns(index);
        blocks.iter().map(|b| b.columns_range(columns.clone()).norm_squared()).sum()
    }
}

impl Trial<'_> {
    /// What is measured per unit of each number, in units of the noise: of a displacement the
    /// loaded tool minus the unloaded one, else the loaded tool and below it the unloaded one.
    pub(super) fn rows(
        &self,
        line_up: &LineUp,
        displacement: bool,
    ) -> Result<DMatrix<f64>, Unstable> {
        let noise = self.plan.noises();
        if displacement {
            let kind = Kind::Displacement { components: [true; 6] };
            let change = self.change(line_up, kind, &self.row)?;
            return Ok(whitened(&[change], &noise) / core::f64::consts::SQRT_2);
        }
        let kind = Kind::Pose { orientation: noise.len() == 6 };
        let unloaded = Row { wrench: Vector6::zeros(), ..self.row.clone() };
        let loaded = self.change(line_up, kind, &self.row)?;
        Ok(whitened(&[loaded, self.change(line_up, kind, &unloaded)?], &noise))
    }

    fn change(&self, line_up: &LineUp, kind: Kind, row: &Row) -> Result<Matrix6xX<f64>, Unstable> {
        let Whole { arm, known } = self.whole;
        let when = Moment::at_rest(vec![0.0; row.q.len()], 0.0);
        let actual = |loaded: bool| {
            let wrench = if loaded { row.wrench } else { Vector6::zeros() };
            let mut actual = Actual::new(arm, &row.q, &wrench);
            known.iter().for_each(|known| known.alter(&mut actual, row, &when));
            actual
        };
        let sim = Sim::of(kind, Isometry3::identity(), None, actual)?;
        Ok(sim.change(|state, loaded| {
            let actual = actual(loaded);
            let scene = Scene {
                nominal: arm,
                row,
                when: &when,
                actual: &actual,
                state,
                point: sim.point(state),
                base: &sim.base,
            };
            let each = line_up.effects.iter().map(|(effect, spot)| effect.block(&scene, *spot));
            let blocks: Vec<Matrix6xX<f64>> = each.collect();
            let columns: Vec<_> = blocks.iter().flat_map(|block| block.column_iter()).collect();
            Matrix6xX::from_columns(&columns)
        }))
    }
}

/// Rows that are still to be measured, as an effect asks for them.
fn planned(rows: Vec<Row>) -> Measurements {
    Measurements::new("the plan", Kind::Pose { orientation: false }, rows)
}

/// The rows that are measured, one change below the other, in units of the noise.
fn whitened(changes: &[Matrix6xX<f64>], noise: &[f64]) -> DMatrix<f64> {
    let (measured, columns) = (noise.len(), changes.first().map_or(0, Matrix6xX::ncols));
    DMatrix::from_fn(measured * changes.len(), columns, |r, c| {
        changes[r / measured][(r % measured, c)] / noise[r % measured]
    })
}
