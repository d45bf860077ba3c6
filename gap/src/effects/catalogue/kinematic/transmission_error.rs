//! Each order is a form of its own and may be found beside others.

use crate::effects::prelude::*;

/// Amplitudes of the cosine and the sine of `order · q`.
#[derive(Clone, Copy, Debug)]
pub struct TransmissionError;

/// Highest order that is tried.
const HIGHEST: usize = 40;

/// From this order on nothing else in the catalogue comes near.
const FINE: usize = 3;

/// Highest order that is drawn for a case.
const DRAWN: usize = 4;

/// Angles closer than this are one, rad.
const SAME: f64 = 1e-3;

/// Orders with the numbers of their cosine and sine.
fn waves(numbers: &[ParameterReport]) -> Vec<(usize, [f64; 2])> {
    let value = |name: String| numbers.iter().find(|p| p.name == name).map_or(0.0, |p| p.value);
    let orders = numbers.iter().filter_map(|p| p.name.strip_prefix("cos ")?.parse().ok());
    orders.map(|k| (k, ["cos", "sin"].map(|wave| value(format!("{wave} {k}"))))).collect()
}

const AT_REST: &Facts = &Facts {
    identifier: "transmission_error",
    reality: "An error periodic in the joint's angle: an eccentric encoder (order 1), a wavy gear \
        (order 2), the teeth of a stage (10 and more).",
    signature: "A sine of the joint's reading, the same at every load.",
    confused_with: "`joint_offset` and `joint_ratio` of the joint where it covers less than a \
        turn (orders 1 and 2); high orders with each other where poses are few.",
    separated_by: "The joint's angles spread over its range, not on a grid.",
    formula: "q → q + cos · cos(k q) + sin · sin(k q)",
    at: At::Revolute,
    moves: Moves::Joint,
    idle: "the joint does not turn",
    ..Facts::NONE
};

impl Law for TransmissionError {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for TransmissionError {
    fn forms_are(&self) -> Forms {
        Forms::Orders { fine: FINE }
    }

    fn named_forms(&self, _: &Arm, _: Place) -> Vec<usize> {
        vec![1, 2, 3]
    }

    /// The orders that as many different angles can carry, two numbers each.
    fn forms(&self, _: &Arm, place: Place, data: &Measurements) -> Vec<usize> {
        let mut angles: Vec<i64> =
            data.rows.iter().map(|r| (r.q[place.row()] / SAME).round() as i64).collect();
        angles.sort_unstable();
        angles.dedup();
        (1..=HIGHEST.min(angles.len() / 3)).collect()
    }

    fn parameters(&self, _: &Arm, spot: Spot) -> Vec<Parameter> {
        let named = |key: &'static str| {
            let name = format!("{key} {}", spot.form);
            Parameter::free(key, Quantity::Angle).usually(5e-3).named(name)
        };
        vec![named("cos"), named("sin")]
    }

    fn moves_by(&self, row: &Row, _: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        let (sine, cosine) = (spot.form as f64 * row.q[spot.row()]).sin_cos();
        each(cosine);
        each(sine);
    }

    /// Each order from the one before it by the addition theorems: every step rounds once more, 40
    /// at the most, where each cosine and sine by itself would cost as much as all else of a row.
    fn motions_of(&self, scene: &Scene<'_>, spots: &[Spot], motions: &mut Vec<f64>) {
        let Some(first) = spots.first() else { return };
        let q = scene.row.q[first.row()];
        let (s, c) = q.sin_cos();
        let (mut order, (mut sine, mut cosine)) = (first.form, (first.form as f64 * q).sin_cos());
        for spot in spots {
            if spot.form < order {
                (order, (sine, cosine)) = (spot.form, (spot.form as f64 * q).sin_cos());
            }
            while order < spot.form {
                (sine, cosine) = (sine * c + cosine * s, cosine * c - sine * s);
                order += 1;
            }
            motions.extend([cosine, sine]);
        }
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let each = waves(told.numbers).into_iter().map(|(order, [c, s])| (order, c.hypot(s)));
        let mut each: Vec<(usize, f64)> = each.collect();
        each.sort_by(|a, b| b.1.total_cmp(&a.1));
        let Some((largest, amplitude)) = each.first().copied() else {
            return format!("the gear of {} has a periodic error", told.place);
        };
        let size = told.sized(amplitude);
        let periods = if largest == 1 { "period" } else { "periods" };
        let mut others: Vec<usize> = each[1..].iter().map(|(order, _)| *order).collect();
        others.sort_unstable();
        let others: Vec<String> = others.iter().map(usize::to_string).collect();
        let others = match others.as_slice() {
            [] => String::new(),
            [one] => format!(", and less at {one}"),
            [first @ .., last] => format!(", and less at {} and {last}", first.join(", ")),
        };
        format!(
            "the gear of {} has a periodic error of {size} at {largest} {periods} per turn{others}",
            told.place
        )
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let waves = waves(numbers);
        let value = move |q: f64| {
            let each = waves.iter().map(|(order, [c, s])| {
                let (sine, cosine) = (*order as f64 * q).sin_cos();
                c * cosine + s * sine
            });
            each.sum()
        };
        Some(Curve { over: Over::Reading, proportional: false, value: Box::new(value) })
    }

    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let order = 1 + from.below(DRAWN);
        from.sizes(&self.parameters(from.arm, Spot { place: from.place, form: order }), 1.0)
    }
}
