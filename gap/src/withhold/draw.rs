//! Effects of about the size that arms have, to be scaled to the noise.

use stiffarm_kernels::generic::Arm;

use crate::measurement::Measurements;
use crate::plant::noise::Dice;
use crate::plant::{Effect, Place, Quantity, Truth};

/// One effect at one place, its signs and proportions drawn.
pub fn typical(
    effect: Effect,
    place: Place,
    arm: &Arm,
    design: &Measurements,
    dice: &mut Dice,
) -> Truth {
    let parameters = effect.parameters(arm, place);
    let values = match effect {
        Effect::TransmissionError => {
            let order = 1 + dice.below(4);
            ["cos", "sin"].map(|f| (format!("{f} {order}"), 3e-4 * dice.normal())).to_vec()
        }
        Effect::JointCoupling => {
            let (name, _) = parameters[dice.below(parameters.len())].clone();
            vec![(name, 1e-3 * dice.sign())]
        }
        Effect::GeometricStiffness => vec![("fraction".to_owned(), 1.0)],
        Effect::Drift => {
            let span = elapsed(design).max(1.0);
            scaled(parameters, |quantity| size(quantity) * dice.normal() / span)
        }
        Effect::Slip => {
            let rows = design.rows.len() as f64;
            let after = (rows * dice.between(0.25, 0.75)).round().max(1.0);
            let mut values = scaled(parameters, |quantity| size(quantity) * dice.normal());
            values[0].1 = after;
            values
        }
        _ if one_sided(effect) => {
            scaled(parameters, |quantity| size(quantity) * dice.between(0.4, 1.0))
        }
        _ => {
            // A lone parameter is not drawn near zero.
            let lone = parameters.len() == 1;
            scaled(parameters, |quantity| {
                size(quantity) * if lone { dice.sign() } else { dice.normal() }
            })
        }
    };
    Truth { effect, place, values }
}

fn scaled(
    parameters: Vec<(String, Quantity)>,
    mut size: impl FnMut(Quantity) -> f64,
) -> Vec<(String, f64)> {
    parameters.into_iter().map(|(name, quantity)| (name, size(quantity))).collect()
}

/// Whether nature knows it with one sign only.
fn one_sided(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::JointCompliance
            | Effect::JointHardening
            | Effect::BearingCompliance
            | Effect::LinkCompliance
            | Effect::LinkWeight
            | Effect::BaseCompliance
            | Effect::Backlash
            | Effect::FrictionHysteresis
            | Effect::ThermalGrowth
            | Effect::SettlingLag
    )
}

/// The duration of a session, or the number of its rows.
fn elapsed(design: &Measurements) -> f64 {
    let ends = design.rows.first().zip(design.rows.last());
    match ends.and_then(|(first, last)| first.time.zip(last.time)) {
        Some((first, last)) => last - first,
        None => design.rows.len() as f64,
    }
}

/// About what arms of a metre or two have; the proportions of an effect's parameters.
fn size(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Length | Quantity::Angle | Quantity::LengthRate | Quantity::AngleRate => 3e-4,
        Quantity::AnglePerMoment => 1e-6,
        Quantity::LengthPerForce => 1e-7,
        Quantity::AnglePerMomentCubed => 1e-10,
        Quantity::LengthPerForceCubed => 1e-12,
        Quantity::Flexibility => 1e-6,
        Quantity::Mass => 1.0,
        Quantity::Ratio => 1e-2,
        Quantity::PerKelvin => 12e-6,
        Quantity::Row => 1.0,
    }
}

/// Beyond this no arm is still the arm of its file.
fn largest(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Length | Quantity::Angle => 0.05,
        Quantity::Ratio => 0.5,
        Quantity::Mass => 100.0,
        Quantity::PerKelvin => 1e-3,
        _ => f64::INFINITY,
    }
}

/// The truth with a size so many times as large; `None` beyond what an arm can have.
pub fn resized(truth: &Truth, arm: &Arm, factor: f64) -> Option<Truth> {
    let mut resized = truth.clone();
    for (name, value) in &mut resized.values {
        let quantity = truth.effect.quantity(arm, truth.place, name)?;
        if quantity != Quantity::Row {
            *value *= factor;
            if value.abs() > largest(quantity) {
                return None;
            }
        }
    }
    Some(resized)
}
