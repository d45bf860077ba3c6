//! Torques are logged later than positions.

use super::latency::held;
use super::{LogEffect, Number, Spot};
use crate::effects::About;
use crate::log::pace::Pace;
use crate::log::scene::{Column, Scene};
use crate::log::signal::filter::rate;

/// All torques are those of `delay` ago, to first order.
#[derive(Clone, Copy, Debug)]
pub struct TorqueLatency;

impl LogEffect for TorqueLatency {
    fn identifier(&self) -> &'static str {
        "latency"
    }

    fn about(&self) -> About {
        About {
            reality: "Torques are logged later than positions: another bus, another filter.",
            signature: "A torque in proportion to the rate of what the model asks.",
            confused_with: "`viscous_friction`, as weights go with the speed; `rotor_inertia`, `presliding`.",
            separated_by: "Two speeds and reversals.",
        }
    }

    fn spots(&self, _: &Scene<'_>) -> Vec<Spot> {
        vec![Spot::Interface]
    }

    fn numbers(&self) -> &'static [Number] {
        &[("delay", "s")]
    }

    fn too_slow(&self, pace: &Pace<'_>, _: Spot, found: Option<&[f64]>) -> Option<String> {
        held(pace, found)
    }

    fn columns(&self, scene: &Scene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        let signals = scene.signals;
        let of = |joint: usize| {
            let loads = scene.loads.rigid[joint].iter().zip(&scene.loads.friction[joint]);
            let whole: Vec<f64> = loads.map(|(rigid, friction)| -(rigid + friction)).collect();
            // What is filtered has the rate of what it is filtered of; steps have none.
            signals.filtered(&rate(&whole, signals.period))
        };
        vec![Column { parts: (0..signals.joints()).map(|joint| (joint, of(joint))).collect() }]
    }
}
