//! Positions and readings of one row were not taken at one time.

use nalgebra::{DVector, Matrix6xX};
use stiffarm_kernels::generic::Arm;

use crate::effects::{
    About, Depends, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told,
};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment, is_stream};

/// How much older than the readings beside it a measured position is: it shows the arm at
/// `q(t − delay)`, which is read from the stream of readings.
#[derive(Clone, Copy, Debug)]
pub struct Latency;

impl Effect for Latency {
    fn identifier(&self) -> &'static str {
        "latency"
    }

    fn about(&self) -> About {
        About {
            reality: "Positions and readings of one row were not taken at one time: two clocks, a \
                      filter, a buffer.",
            signature: "An error along the path, in proportion to the speed of the joints, and none \
                        where they rest.",
            confused_with: "`settling_lag` where rows are evenly spaced, since the last move is the \
                            speed then; a wrong ratio of a joint that swings about one angle.",
            separated_by: "One path at two speeds, forth and back; a pause on the way.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Instrument]
    }

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        vec![Parameter::free("delay", Quantity::Time).usually(0.5)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, _: Spot, v: &[f64]) {
        let Some(stream) = &when.stream else { return };
        for (joint, moved) in stream.moved(when.clock, when.clock - v[0]).into_iter().enumerate() {
            actual.turn(joint, moved);
        }
    }

    fn block(&self, scene: &Scene<'_>, _: Spot) -> Matrix6xX<f64> {
        let Some(stream) = &scene.when.stream else { return Matrix6xX::zeros(1) };
        let rates = DVector::from_vec(stream.rates(scene.when.clock));
        Matrix6xX::from_columns(&[-(scene.state.jacobian() * rates)])
    }

    fn excluded(&self, data: &Measurements) -> Option<&'static str> {
        if data.kind.is_difference() {
            return Some("a displacement is measured at rest: nothing moves between two clocks");
        }
        (!data.sessions().all(is_stream)).then_some(
            "the rows are no stream: it takes rows in the order of their `time`, most of them \
             within a second of the one before",
        )
    }

    fn idle(&self) -> &'static str {
        "the joints do not move while they are measured"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Direction)
    }

    fn depends(&self) -> Depends {
        Depends::LastMove
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let side = told.by_sign("younger", "older");
        format!("positions are {} {side} than the joint readings beside them", told.size())
    }
}
