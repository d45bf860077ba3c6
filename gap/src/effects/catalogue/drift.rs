//! The measuring frame creeps with time: a tripod that settles, a floor that warms.
//!
//! In proportion to `time`, or to the number of the row where there is no time. Confused with thermal
//! growth where temperature rises evenly, and with whatever else the order of the poses follows:
//! measure the first poses once more at the end.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::displacement::Displacement;
use crate::effects::{Carrier, Effect, Parameter, Place, Scene, Spot, displacement};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment};

/// Rates of the measuring frame's displacement, base axes.
#[derive(Clone, Copy, Debug)]
pub struct Drift;

impl Effect for Drift {
    fn identifier(&self) -> &'static str {
        "drift"
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Base]
    }

    fn parameters(&self, _: &Arm, _: Spot, data: &Measurements) -> Vec<Parameter> {
        let timed = data.rows.iter().all(|row| row.time.is_some());
        displacement(if timed { ["m/s", "rad/s"] } else { ["m/row", "rad/row"] })
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
}
