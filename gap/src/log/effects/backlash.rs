//! A joint stops short of where it is driven to: teeth with play, or a servo that friction holds back.

use super::latency::ago;
use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Domain, Scene};

/// The joint stands until its servo, which is where it was to be as late as commands are followed, has gone
/// `half_width` ahead of it, and is dragged behind from there (the play of Krasnosel'skii & Pokrovskii 1989).
#[derive(Clone, Copy, Debug)]
pub struct Backlash;

/// Half widths from which the search begins, rad or m.
const WIDTHS: [f64; 6] = [3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1];

/// Part of a half width by which the slope over it is taken.
const STEP: f64 = 0.05;

impl LogEffect for Backlash {
    fn identifier(&self) -> &'static str {
        "backlash"
    }

    fn about(&self) -> About {
        About {
            reality: "A joint stops short of where it is driven to: teeth with play, or a servo that friction holds back.",
            signature: "The joint stands while its command turns round, and then lags by as much either way.",
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

    fn columns(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Vec<Column> {
        let (joint, half_width) = (joint(spot), values[0]);
        let [less, more] =
            [1.0 - STEP, 1.0 + STEP].map(|by| dragged(scene, joint, by * half_width));
        let slope = 1.0 / (2.0 * STEP * half_width);
        vec![scene.column(joint, |k| slope * (more[k] - less[k]))]
    }

    fn bends(&self) -> bool {
        true
    }

    fn value(&self, scene: &Scene<'_>, spot: Spot, values: &[f64]) -> Column {
        let joint = joint(spot);
        let behind = dragged(scene, joint, values[0]);
        scene.column(joint, |k| behind[k])
    }

    fn probes(&self, _: &Scene<'_>, _: Spot) -> Vec<Vec<f64>> {
        WIDTHS.iter().map(|width| vec![*width]).collect()
    }

    fn may_be(&self, values: &[f64]) -> bool {
        values[0] >= 0.0
    }
}

/// By how much the joint is ahead of its servo. Where a span begins it is where it was measured.
fn dragged(scene: &Scene<'_>, joint: usize, half_width: f64) -> Vec<f64> {
    let signals = scene.signals;
    let servo = ago(scene, joint, scene.loads.delay);
    let mut ahead = Vec::with_capacity(servo.len());
    for span in &signals.spans {
        let mut at = signals.q[joint][span.fine.start];
        ahead.extend(servo[span.fine.clone()].iter().map(|servo| {
            at = at.clamp(servo - half_width, servo + half_width);
            at - servo
        }));
    }
    ahead
}
