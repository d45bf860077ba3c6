//! What is left of the gap with the true values put in: the noise that was drawn.

use nalgebra::{Isometry3, Vector6};
use stiffarm_gap::effects::{CATALOGUE, Spot};
use stiffarm_gap::gap::{Statistics, row_gap};
use stiffarm_gap::plant::{Effect, Truth};
use stiffarm_gap::simulate::{Actual, Sim, moments};

use super::draw::Drawn;

impl Drawn {
    /// Of the plant: measured less what the arm shows at these readings without noise.
    pub fn floor(&self) -> Statistics {
        let gaps = self.data.rows.iter().zip(&self.exact.rows);
        let gap = |(row, exact): (&stiffarm_gap::measurement::Row, _)| self.less(row, exact);
        Statistics::of(&gaps.map(gap).collect::<Vec<_>>())
    }

    fn less(
        &self,
        row: &stiffarm_gap::measurement::Row,
        exact: &stiffarm_gap::measurement::Row,
    ) -> Vector6<f64> {
        row_gap(&self.data, row, &stiffarm_gap::simulate::Reading::from_vector(&exact.measured))
    }

    /// The same by the diagnosis' own simulator and its own laws of the effects.
    pub fn floor_of_the_simulator(&self) -> Statistics {
        let when = moments(&self.data);
        let truths: Vec<&Truth> =
            self.geometry.iter().chain(self.planted.iter().map(|p| &p.truth)).collect();
        let mut arm = self.arm.clone();
        arm.tool *= self.frames.tool;
        let gap = |(number, row): (usize, &stiffarm_gap::measurement::Row)| {
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

type Known = (&'static dyn stiffarm_gap::effects::Effect, Spot, Vec<f64>);

/// A truth as the catalogue has it: one entry for each form with a value.
fn of_catalogue(
    arm: &stiffarm_kernels::generic::Arm,
    data: &stiffarm_gap::measurement::Measurements,
    truth: &Truth,
) -> Vec<Known> {
    let same = |e: &&&'static dyn stiffarm_gap::effects::Effect| {
        e.identifier() == truth.effect.identifier()
    };
    let effect = *CATALOGUE.iter().find(same).expect("an effect of the catalogue");
    let is_here = |p: &stiffarm_gap::effects::Place| p.to_string() == truth.place.to_string();
    let place = effect.places(arm).into_iter().find(is_here).expect("a place of the arm");
    let forms: Vec<usize> = match truth.effect {
        Effect::Slip => vec![truth.value("after") as usize],
        _ => effect.forms(arm, place, data),
    };
    let each = forms.into_iter().map(|form| {
        let spot = Spot { place, form };
        let names = effect.parameters(arm, spot, data);
        let values: Vec<f64> = names.iter().map(|p| truth.value(&p.name)).collect();
        (effect as _, spot, values)
    });
    each.filter(|(_, _, values): &Known| values.iter().any(|v| *v != 0.0)).collect()
}
