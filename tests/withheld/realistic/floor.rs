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
    /// Of the plant: measured less what the arm shows at these readings without noise.
    pub fn floor(&self) -> Statistics {
        let gaps = self.data.rows.iter().zip(&self.exact.rows);
        let gap = |(row, exact): (&Row, _)| self.less(row, exact);
        Statistics::of(&gaps.map(gap).collect::<Vec<_>>())
    }

    fn less(&self, row: &Row, exact: &Row) -> Vector6<f64> {
        row_gap(&self.data, row, &Reading::from_vector(&exact.measured))
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
