//! The data as numbers: what the arm predicts for every row, with and without an effect.

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use super::options::DiagnoseError;
use crate::effects::{Effect, Place};
use crate::gap::{predicted, row_gap};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Reading, Sim, simulate};

/// Readings, loads, places and gaps stay below this, N, N·m, m and rad: their squares, weighted and
/// added up, are then finite.
const LARGEST: f64 = 1e50;

/// An arm, its measurements, and the simulation of every row.
pub(crate) struct Problem<'a> {
    pub(crate) arm: &'a Arm,
    pub(crate) data: &'a Measurements,
    /// 1 where a component is measured, else 0.
    pub(crate) mask: Vector6<f64>,
    /// The arm's simulation of each row.
    sims: Vec<Sim>,
    /// What is compared with the measurement of each row.
    base: Vec<Reading>,
    /// The gap of each row.
    pub(crate) gaps: Vec<Vector6<f64>>,
    /// Largest distance of the tool from the base, m.
    pub(crate) reach: f64,
}

/// The exact model with an effect: what is left of the gap, and how it changes with the parameters.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// One per row.
    pub(crate) gaps: Vec<Vector6<f64>>,
    /// One per row, 6×p, 0 where nothing is measured: the gap falls by this per unit.
    pub(crate) blocks: Vec<Matrix6xX<f64>>,
}

impl<'a> Problem<'a> {
    pub(crate) fn new(arm: &'a Arm, data: &'a Measurements) -> Result<Self, DiagnoseError> {
        let file = || data.file.clone();
        if data.rows.is_empty() {
            return Err(DiagnoseError::NoRows { file: file() });
        }
        let mut sims = Vec::with_capacity(data.rows.len());
        for row in &data.rows {
            let (line, found) = (row.line, row.q.len());
            if found != arm.dof() {
                return Err(DiagnoseError::Joints { file: file(), found, expected: arm.dof() });
            }
            if row.offset.is_none() {
                let marker = row.marker.clone().unwrap_or_default();
                return Err(DiagnoseError::UnknownOffset { file: file(), line, marker });
            }
            let sim = simulate(arm, row, data.kind);
            sims.push(sim.map_err(|_| DiagnoseError::Unstable { file: file(), line })?);
        }
        let base: Vec<Reading> =
            data.rows.iter().zip(&sims).map(|(r, s)| predicted(data, r, &s.reading())).collect();
        let gaps: Vec<_> = data.rows.iter().zip(&base).map(|(r, b)| row_gap(data, r, b)).collect();
        for ((row, sim), gap) in data.rows.iter().zip(&sims).zip(&gaps) {
            let tool = sim.loaded.tool.translation.vector;
            let loads = row.q.iter().chain(sim.loaded.torque.iter());
            let mut numbers = loads.chain(tool.iter()).chain(gap.iter());
            if !numbers.all(|x| x.abs() < LARGEST) {
                return Err(DiagnoseError::TooLarge { file: file(), line: row.line });
            }
        }
        let reach =
            sims.iter().map(|s| s.loaded.tool.translation.vector.norm()).fold(0.0, f64::max);
        let mask = Vector6::from_iterator(data.kind.components().map(f64::from));
        Ok(Problem { arm, data, mask, sims, base, gaps, reach })
    }

    /// Linearisation of the model as it is.
    pub(crate) fn nominal(&self, effect: &dyn Effect, place: Place) -> Point {
        let rows = self.data.rows.iter().zip(&self.sims);
        let blocks = rows.map(|(row, sim)| self.block(effect, place, self.arm, row, sim));
        Point { gaps: self.gaps.clone(), blocks: blocks.collect() }
    }

    /// The same 6×p block as [`Problem::nominal`], but of all six components of each row.
    pub(crate) fn unmasked(&self, effect: &dyn Effect, place: Place) -> Vec<Matrix6xX<f64>> {
        let rows = self.data.rows.iter().zip(&self.sims);
        rows.map(|(row, sim)| sim.change(|s| effect.block(self.arm, row, s, place))).collect()
    }

    /// The exact model with the effect put into it. What a row's prediction was without it, be it
    /// the user's own simulator's, changes by what the arm's changes.
    pub(crate) fn exact(
        &self,
        effect: &dyn Effect,
        place: Place,
        values: &[f64],
    ) -> Result<Point, Unstable> {
        let mut point = Point { gaps: Vec::new(), blocks: Vec::new() };
        for ((row, sim), base) in self.data.rows.iter().zip(&self.sims).zip(&self.base) {
            let (mut arm, mut changed) = (self.arm.clone(), row.clone());
            effect.apply(&mut arm, &mut changed, place, values);
            let with = simulate(&arm, &changed, self.data.kind)?;
            let (without, reading) = (sim.reading(), with.reading());
            let prediction = Reading {
                position: base.position + (reading.position - without.position),
                rotation: reading.rotation * without.rotation.inverse() * base.rotation,
            };
            point.gaps.push(row_gap(self.data, row, &prediction));
            point.blocks.push(self.block(effect, place, &arm, &changed, &with));
        }
        Ok(point)
    }

    fn block(
        &self,
        effect: &dyn Effect,
        place: Place,
        arm: &Arm,
        row: &Row,
        sim: &Sim,
    ) -> Matrix6xX<f64> {
        let mut block = sim.change(|s| effect.block(arm, row, s, place));
        for mut column in block.column_iter_mut() {
            column.component_mul_assign(&self.mask);
        }
        block
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointCompliance;
    use crate::fixture::{row, springy, table};
    use crate::measurement::Kind;

    fn data() -> Measurements {
        let w = Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0);
        let rows = vec![row(&[0.3, -0.7, 0.4], w), row(&[-0.2, 0.5, 1.0], w)];
        table(rows, Kind::Pose { orientation: true })
    }

    #[test]
    fn the_exact_model_without_effect_is_the_model() {
        let (arm, data) = (springy(), data());
        let problem = Problem::new(&arm, &data).unwrap();
        let exact = problem.exact(&JointCompliance, Place::Joint(1), &[0.0]).unwrap();
        for (exact, gap) in exact.gaps.iter().zip(&problem.gaps) {
            assert!((exact - gap).amax() < 1e-14);
        }
    }

    #[test]
    fn rows_that_cannot_be_simulated_are_named() {
        let (arm, mut data) = (springy(), data());
        data.rows[1].line = 9;
        data.rows[1].wrench *= 1e9;
        let unstable = Problem::new(&arm, &data).err().unwrap();
        assert_eq!(unstable, DiagnoseError::Unstable { file: "test.csv".to_owned(), line: 9 });
        data.rows[1].wrench *= 0.0;
        data.rows[1].measured[0] = 1e300;
        let large = Problem::new(&arm, &data).err().unwrap();
        assert_eq!(large, DiagnoseError::TooLarge { file: "test.csv".to_owned(), line: 9 });
        data.rows[1].offset = None;
        data.rows[1].marker = Some("smr".to_owned());
        let unknown = Problem::new(&arm, &data).err().unwrap();
        assert!(matches!(unknown, DiagnoseError::UnknownOffset { line: 9, .. }));
        data.rows[1].q.pop();
        let joints = Problem::new(&arm, &data).err().unwrap();
        assert!(matches!(joints, DiagnoseError::Joints { found: 2, expected: 3, .. }));
        data.rows.clear();
        assert!(matches!(Problem::new(&arm, &data).err(), Some(DiagnoseError::NoRows { .. })));
    }
}
