//! What is left of the gap with the true values put in: the noise that was drawn.

use nalgebra::{Isometry3, Vector6};
use stiffarm_gap::gap::{Statistics, row_gap};
use stiffarm_gap::measurement::{Measurements, Row};
use stiffarm_gap::simulate::{Actual, Reading, Sim, moments};
use stiffarm_plant::Truth;

use super::draw::Drawn;

impl Drawn {
    /// Of the plant: measured less what the arm shows at these readings without noise; without the
    /// rows of some lines.
    pub fn floor(&self, left_out: &[u64]) -> Statistics {
        let rows = self.data.rows.iter().zip(errors(&self.data, &self.exact));
        let kept = rows.filter(|(row, _)| !left_out.contains(&row.line)).map(|(_, error)| error);
        Statistics::of(&kept.collect::<Vec<_>>())
    }

    /// The same by the diagnosis' own simulator and its own laws of the effects.
    pub fn floor_of_the_simulator(&self) -> Statistics {
        let when = moments(&self.data);
        let truths: Vec<&Truth> =
            self.geometry.iter().chain(self.planted.iter().map(|p| &p.truth)).collect();
        let mut arm = self.arm.clone();
        arm.tool *= self.frames.tool;
        let gap = |(number, row): (usize, &Row)| {
            let actual = |_: bool| {
                let mut actual = Actual::new(&arm, &row.q, &row.wrench);
                actual.base = self.frames.base;
                for truth in &truths {
                    for (spot, values) in truth.effect.spots(&self.arm, truth.place, &truth.values)
                    {
                        truth.effect.alter(&mut actual, row, &when[number], spot, &values);
                    }
                }
                actual
            };
            let sim = Sim::of(self.data.kind, Isometry3::identity(), None, actual);
            row_gap(&self.data, row, &sim.expect("an arm that carries its load").reading())
        };
        Statistics::of(&self.data.rows.iter().enumerate().map(gap).collect::<Vec<_>>())
    }
}

/// Measured less what the arm shows without noise.
pub fn errors(data: &Measurements, exact: &Measurements) -> Vec<Vector6<f64>> {
    let error =
        |(row, exact): (&Row, &Row)| row_gap(data, row, &Reading::from_vector(&exact.measured));
    data.rows.iter().zip(&exact.rows).map(error).collect()
}
