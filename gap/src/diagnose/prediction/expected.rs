//! What a diagnosis promises at postures that were not measured: how large the gap is there, and
//! how much of it stays because the numbers that were found are uncertain.

use nalgebra::Vector6;

use super::explanation::Explanation;
use crate::diagnose::data::Problem;
use crate::diagnose::options::DiagnoseError;
use crate::measurement::{Kind, Measurements, Row};

/// The gap to be expected at a posture, measured as the diagnosed data was: root mean squares, m;
/// of the rotation, rad, where no position is measured; of the whole position where distances are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// How far the findings move the reading.
    pub moved: f64,
    /// What their uncertainty leaves of that.
    pub uncertain: f64,
    /// What no finding explains: the noise, and whatever else is left on the diagnosed data.
    pub noise: f64,
}

impl Expected {
    /// The gap without the findings.
    pub fn before(self) -> f64 {
        self.moved.hypot(self.after())
    }

    /// The gap with them.
    pub fn after(self) -> f64 {
        self.uncertain.hypot(self.noise)
    }

    /// `1 − after/before`.
    pub fn shrink(self) -> f64 {
        let before = self.before();
        if before > 0.0 { 1.0 - self.after() / before } else { 0.0 }
    }
}

impl Explanation {
    /// At a posture under a load: the findings' whole shift, and to first order their uncertainty.
    /// Nothing is known there of what depends on time, temperature, the last move, or the direction
    /// of approach.
    ///
    /// # Errors
    /// [`DiagnoseError::Unstable`] and others of the posture.
    pub fn expected(&self, q: &[f64], wrench: &Vector6<f64>) -> Result<Expected, DiagnoseError> {
        let row = Row { wrench: *wrench, ..Row::new(0, q.to_vec()) };
        let kind = match self.kind {
            Kind::Distance | Kind::Bench { .. } => Kind::Pose { orientation: false },
            kind => kind,
        };
        let data = Measurements::new("the posture", kind, vec![row]);
        let problem = Problem::new(&self.nominal, &data, &self.options())?;
        let [before, after] = self.without_bench();
        let (without, with) = (before.predict(&problem, None)?, after.predict(&problem, None)?);
        let first = if problem.measures_position() { 0 } else { 3 };
        let shift = (without.gaps[0] - with.gaps[0]).component_mul(&problem.mask);
        let sim = after.state(&problem, &with, 0)?;
        let block = after.change(&problem, &sim, 0, |s| after.block(&problem, 0, s));
        let mut left = block * &self.spread.root;
        for mut column in left.column_iter_mut() {
            column.component_mul_assign(&problem.mask);
        }
        Ok(Expected {
            moved: shift.fixed_rows::<3>(first).norm(),
            uncertain: left.fixed_rows::<3>(first).norm(),
            noise: self.spread.left.fixed_rows::<3>(first).sum().sqrt(),
        })
    }
}
