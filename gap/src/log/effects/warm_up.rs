//! Friction falls while the arm runs warm.

use super::{LogEffect, Number, Spot, joint};
use crate::effects::About;
use crate::log::scene::{Column, Scene};

/// Where a temperature makes no difference, °C.
const USUAL: f64 = 20.0;

/// A torque `rate · t f` or, where temperatures are logged, `rate · (T − 20 °C) f`: `f` is the friction that
/// the simple model has, and so much of it comes with each minute or kelvin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WarmUp {
    /// No temperature is logged.
    ByMinute,
    /// One is.
    ByKelvin,
}

impl LogEffect for WarmUp {
    fn identifier(&self) -> &'static str {
        "warm_up"
    }

    fn about(&self) -> About {
        About {
            reality: match self {
                WarmUp::ByMinute => "Friction falls while the arm runs warm.",
                WarmUp::ByKelvin => "Friction falls as the joint warms; of logs with temperatures.",
            },
            signature: "Friction that changes with the time since the start, or with the temperature.",
            confused_with: "Any friction, where the motion changes with time too.",
            separated_by: "The same motion cold and warm.",
        }
    }

    fn numbers(&self) -> &'static [Number] {
        match self {
            WarmUp::ByMinute => &[("rate", "1/min")],
            WarmUp::ByKelvin => &[("rate", "1/K")],
        }
    }

    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let (joint, signals) = (joint(spot), scene.signals);
        let warmed = |k: usize| match self {
            WarmUp::ByMinute => signals.t[k] / 60.0,
            WarmUp::ByKelvin => signals.temperature[joint][k] - USUAL,
        };
        let friction = &scene.loads.friction[joint];
        vec![scene.column(joint, |k| friction[k] * warmed(k))]
    }

    fn excluded(&self, scene: &Scene<'_>) -> Option<String> {
        let logged = scene.signals.temperature.iter().all(|rows| !rows.is_empty());
        match self {
            WarmUp::ByMinute => logged.then(|| "temperatures are logged: by kelvin".to_owned()),
            WarmUp::ByKelvin => (!logged).then(|| "no temperature is logged".to_owned()),
        }
    }
}
