//! What is left of the gap with the true values put in: the noise that was drawn.

use nalgebra::{Isometry3, Vector6};
use stiffarm_gap::effects::{Effect, Forms, Spot};
use stiffarm_gap::gap::{Statistics, row_gap};
use stiffarm_gap::measurement::{Measurements, Row};
use stiffarm_gap::plant::Truth;
use stiffarm_gap::simulate::{Actual, Reading, Sim, moments};
use stiffarm_kernels::generic::Arm;

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
                    for (effect, spot, values) in of_catalogue(&self.arm, &self.data, truth) {
                        effect.alter(&mut actual, row, &when[number], spot, &values);
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

type Known = (&'static dyn Effect, Spot, Vec<f64>);

/// A truth as the diagnosis has it: one entry for each form with a value.
fn of_catalogue(arm: &Arm, data: &Measurements, truth: &Truth) -> Vec<Known> {
    let (effect, place) = (truth.effect, truth.place);
    let forms = match effect.forms_are() {
        Forms::Rows => vec![truth.value("after") as usize],
        _ => effect.forms(arm, place, data),
    };
    let each = forms.into_iter().map(|form| {
        let spot = Spot { place, form };
        let numbers = effect.parameters(arm, spot);
        (effect, spot, numbers.iter().map(|number| truth.value(&number.name)).collect())
    });
    each.filter(|(_, _, values): &Known| values.iter().any(|v| *v != 0.0)).collect()
}
