//! The measuring frame creeps with time: a tripod that settles, a floor that warms.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::displacement::Displacement;
use crate::effects::{
    About, Carrier, Depends, Draw, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told,
    displacement,
};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment};

/// Rates of the measuring frame's displacement, base axes.
#[derive(Clone, Copy, Debug)]
pub struct Drift;

impl Effect for Drift {
    fn identifier(&self) -> &'static str {
        "drift"
    }

    fn about(&self) -> About {
        About {
            reality: "The measuring frame creeps with time: a tripod that settles, a floor that \
                      warms.",
            signature: "A rigid motion of all poses in proportion to `time`, or to the number of \
                        the row where there is no time; it begins anew with each `session`.",
            confused_with: "`thermal_growth` where temperature rises evenly; whatever else the \
                            order of the poses follows.",
            separated_by: "The first poses once more at the end.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Base]
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        displacement([Quantity::LengthRate, Quantity::AngleRate])
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, _: Spot, v: &[f64]) {
        let now = Vector6::from_column_slice(v) * when.clock;
        actual.base *= Displacement::new(&now).transform();
    }

    fn carrier(&self, _: Spot) -> Option<Carrier> {
        Some(Carrier::Base)
    }

    fn motions(&self, scene: &Scene<'_>, _: Spot, motions: &mut Vec<f64>) {
        motions.push(scene.when.clock);
    }

    fn idle(&self) -> &'static str {
        "no time passes"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Time)
    }

    fn depends(&self) -> Depends {
        Depends::Session
    }

    fn sentence(&self, _: &Told<'_>) -> String {
        "the measuring frame drifts with time".to_owned()
    }

    /// The usual sizes by the end of the session.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let parameters = self.parameters(from.arm, Spot::at(from.place));
        let elapsed = from.elapsed().max(1.0);
        from.sizes(&parameters, elapsed)
    }
}
