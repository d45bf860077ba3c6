use crate::effects::prelude::*;

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

const BY_MINUTE: &Facts = &Facts {
    identifier: "warm_up",
    reality: "Friction falls while the arm runs warm.",
    signature: "Friction that changes with the time since the start, or with the temperature.",
    confused_with: "Any friction, where the motion changes with time too.",
    separated_by: "The same motion cold and warm.",
    formula: "τ → τ + rate · t f",
    parameters: &[Parameter::free("rate", Quantity::In("1/min"))],
    ..Facts::TORQUE
};

const BY_KELVIN: &Facts = &Facts {
    reality: "Friction falls as the joint warms; of logs with temperatures.",
    formula: "τ → τ + rate · (T − 20 °C) f",
    parameters: &[Parameter::free("rate", Quantity::PerKelvin)],
    ..*BY_MINUTE
};

impl Law for WarmUp {
    fn facts(&self) -> &'static Facts {
        match self {
            WarmUp::ByMinute => BY_MINUTE,
            WarmUp::ByKelvin => BY_KELVIN,
        }
    }
}

impl InMotion for WarmUp {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let (joint, signals) = (spot.row(), scene.signals);
        let warmed = |k: usize| match self {
            WarmUp::ByMinute => signals.t[k] / 60.0,
            WarmUp::ByKelvin => signals.temperature[joint][k] - USUAL,
        };
        let friction = &scene.loads.friction[joint];
        vec![scene.column(joint, |k| friction[k] * warmed(k))]
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        let logged = scene.signals.temperature.iter().all(|rows| !rows.is_empty());
        match self {
            WarmUp::ByMinute => logged.then(|| "temperatures are logged: by kelvin".to_owned()),
            WarmUp::ByKelvin => (!logged).then(|| "no temperature is logged".to_owned()),
        }
    }
}
