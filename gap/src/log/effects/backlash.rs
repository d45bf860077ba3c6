//! A joint stops short of where it is driven to: teeth with play, or a servo that friction holds back.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// The joint lags by half the play behind the way it moved last.
#[derive(Clone, Copy, Debug)]
pub struct Backlash;

impl LogEffect for Backlash {
    fn identifier(&self) -> &'static str {
        "backlash"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint stops short of where it is driven to: teeth with play, or a servo that friction holds back.",
            signature: "An offset that goes with the way of the last move, also at rest.",
            confused_with: "`tracking_lag` of a joint that always moves equally fast.",
            separated_by: "Approaches from both sides, at two speeds.",
        }
    }

    fn domain(&self) -> Domain {
        Domain::Position
    }

    fn numbers(&self) -> &'static [Number] {
        &[("half_width", "rad")]
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = joint(spot);
        let ways = &scene.signals.ways[joint];
        vec![scene.column(joint, |k| -f64::from(ways[k]))]
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}
