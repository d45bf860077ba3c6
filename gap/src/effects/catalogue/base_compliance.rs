//! The foundation gives under load: it rocks about x and y by the moment about the base's origin, and
//! shifts by the force.
//!
//! Its turn about z is joint 1's compliance and is left to that. Under loads that hardly change only the
//! rocking shows, which is a form of its own.

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;

use crate::effects::{About, Draw, Effect, Group, Parameter, Place, Quantity, Scene, Spot, Told};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment, Site};

/// The forms: rocking and shift, rocking alone.
const WHOLE: usize = 0;
const ROCKING: usize = 1;

/// Rocking about the base's x and y per moment, and shift per force.
#[derive(Clone, Copy, Debug)]
pub struct BaseCompliance;

impl Effect for BaseCompliance {
    fn identifier(&self) -> &'static str {
        "base_compliance"
    }

    fn about(&self) -> About {
        About {
            reality: "The foundation gives under load: it rocks about x and y by the moment about \
                      the base's origin, and shifts by the force.",
            signature: "The whole arm moves as one, by the load's moment about the base, however \
                        the arm stands.",
            confused_with: "`bearing_compliance` at joint 1, which turns with the joint; under \
                            loads that hardly change only the rocking shows.",
            separated_by: "One load with joint 1 turned through its range: the bearing's tilt \
                           turns along, the rocking does not.",
        }
    }

    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Base]
    }

    fn parameters(&self, _: &Arm, spot: Spot) -> Vec<Parameter> {
        let mut all = vec![
            Parameter::at_least("rock_x", Quantity::AnglePerMoment, 0.0),
            Parameter::at_least("rock_y", Quantity::AnglePerMoment, 0.0),
            Parameter::at_least("give", Quantity::LengthPerForce, 0.0),
        ];
        all.truncate(if spot.form == ROCKING { 2 } else { 3 });
        all
    }

    fn forms(&self, _: &Arm, _: Place, _: &Measurements) -> Vec<usize> {
        vec![WHOLE, ROCKING]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, _: Spot, v: &[f64]) {
        let (x, y, give) = (v[0], v[1], v.get(2).copied().unwrap_or(0.0));
        let law = move |w: &Vector6<f64>| {
            Vector6::new(give * w[0], give * w[1], give * w[2], x * w[3], y * w[4], 0.0)
        };
        actual.laws.push((Site::Base, Box::new(law)));
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let w = scene.state.load(Site::Base);
        let shift = Vector6::new(w[0], w[1], w[2], 0.0, 0.0, 0.0);
        let all = [Vector6::ith(3, w[3]), Vector6::ith(4, w[4]), shift];
        scene.carried(Site::Base, &all[..if spot.form == ROCKING { 2 } else { 3 }])
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the base"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Elastic)
    }

    /// All of it: no foundation rocks alone.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let whole = self.parameters(from.arm, Spot { place: from.place, form: WHOLE });
        from.sizes(&whole, 1.0)
    }

    fn sentence(&self, _: &Told<'_>) -> String {
        "the foundation gives under load".to_owned()
    }
}
