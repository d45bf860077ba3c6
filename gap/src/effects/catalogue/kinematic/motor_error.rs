//! An error periodic in the motor's angle: eccentric parts of the fast side of a gear, the wave
//! generator of a strain-wave gear, the motor's own poles.
//!
//! The form is the number of periods in a turn of the joint, in thousandths: a gear's ratio need be no
//! whole number, and what turns in it runs with parts of it.

use crate::effects::prelude::*;

/// Amplitudes of the cosine and the sine of `order · q`.
#[derive(Clone, Copy, Debug)]
pub struct MotorError;

/// Steps in a period per turn.
const STEPS: usize = 1000;

/// Turns of the motor, as parts of its own: eccentric once, a wave generator twice.
const TIMES: [f64; 2] = [1.0, 2.0];

/// So far from a multiple of the ratio it is looked for, periods per turn of the joint.
const NEAR: f64 = 3.0;

/// A gear that turns its motor less is none of which the fast side could be told from the slow one.
const LEAST: f64 = 10.0;

/// Periods per turn of the joint.
fn order(spot: Spot) -> f64 {
    spot.form as f64 / STEPS as f64
}

const AT_REST: &Facts = &Facts {
    identifier: "motor_error",
    reality: "An error periodic in the motor's angle: eccentric parts of the fast side of a gear, \
        the wave generator of a strain-wave gear. It is looked for at joints of which the robot \
        file gives the gear, near once and twice that ratio.",
    signature: "A fine sine of the joint's reading, of any number of periods per turn, the same \
        at every load.",
    confused_with: "Noise where poses are few, and orders of its own that the poses do not tell \
        apart; `transmission_error` of high orders.",
    separated_by: "Many poses whose angles are on no grid; a slow sweep of the joint alone, \
        several readings in a turn of the motor.",
    formula: "q → q + cos · cos(order q) + sin · sin(order q)",
    parameters: &[
        Parameter::free("cos", Quantity::Angle).usually(5e-3),
        Parameter::free("sin", Quantity::Angle).usually(5e-3),
    ],
    moves: Moves::Joint,
    idle: "the joint does not turn",
    ..Facts::NONE
};

impl Law for MotorError {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for MotorError {
    fn places(&self, arm: &Arm) -> Vec<Place> {
        let geared = |j: &usize| {
            let joint = &arm.joints[j - 1];
            joint.motion == Motion::Revolute && joint.drive.gear.abs() >= LEAST
        };
        (1..=arm.dof()).filter(geared).map(Place::Joint).collect()
    }

    fn acts_at(&self) -> &'static str {
        "joints that turn and whose `gear`, ten or more, is in the robot file"
    }

    fn forms_are(&self) -> Forms {
        Forms::Searched { key: "order", quantity: Quantity::PerTurn, steps: STEPS }
    }

    /// Near multiples of the ratio, as closely as the joint's range tells orders apart.
    fn forms(&self, arm: &Arm, place: Place, data: &Measurements) -> Vec<usize> {
        let angles = data.rows.iter().map(|row| row.q[place.row()]);
        let (low, high) =
            angles.fold((f64::MAX, f64::MIN), |(low, high), q| (low.min(q), high.max(q)));
        let (gear, apart) = (arm.joints[place.row()].drive.gear.abs(), PI / (high - low));
        if !(apart.is_finite() && apart > 0.0) {
            return Vec::new();
        }
        let side = (NEAR / apart) as i32;
        let about = |times: f64| (-side..=side).map(move |k| times * gear + f64::from(k) * apart);
        let steps = TIMES.into_iter().flat_map(about).map(|order| (order * STEPS as f64).round());
        let mut forms: Vec<usize> = steps.filter(|s| *s >= 1.0).map(|s| s as usize).collect();
        forms.sort_unstable();
        forms.dedup();
        forms
    }

    fn moves_by(&self, row: &Row, _: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        let (sine, cosine) = (order(spot) * row.q[spot.row()]).sin_cos();
        each(cosine);
        each(sine);
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let [size, order] = [told.norm(&["cos", "sin"]), told.value("order")];
        let unit = told.numbers.iter().find(|p| p.name == "cos").map_or("rad", |p| &*p.unit);
        let size = (told.write)(unit, size, size);
        format!(
            "the input side of the gear of {} has a periodic error of {size} at {order} periods per turn",
            told.place
        )
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let value = |name: &str| Some(numbers.iter().find(|p| p.name == name)?.value);
        let (order, cos, sin) = (value("order")?, value("cos")?, value("sin")?);
        let value = Box::new(move |q: f64| {
            let (sine, cosine) = (order * q).sin_cos();
            cos * cosine + sin * sine
        });
        Some(Curve { over: Over::Reading, proportional: false, value })
    }

    /// Half a period per turn from a multiple at most.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let gear = from.arm.joints[from.place.row()].drive.gear.abs();
        let order = TIMES[from.below(TIMES.len())] * gear + from.between(-0.5, 0.5);
        let order = (order * STEPS as f64).round() / STEPS as f64;
        let sizes = from.sizes(&self.parameters(from.arm, Spot::at(from.place)), 1.0);
        core::iter::once(("order".to_owned(), order)).chain(sizes).collect()
    }
}
