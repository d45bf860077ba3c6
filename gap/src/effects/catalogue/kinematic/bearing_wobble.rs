//! Once in a turn a tilt is a twist of the row, which `link_geometry` has.

use crate::effects::prelude::*;

/// Tilts about the axes across the joint's, which do not turn with it, as cosine and sine of twice its
/// reading.
#[derive(Clone, Copy, Debug)]
pub struct BearingWobble;

const NAMES: [&str; 4] = ["cos_x", "sin_x", "cos_y", "sin_y"];

/// Tilts per unit of each number, in the axes of the joint.
fn tilts(row: &Row, spot: Spot) -> [Vector6<f64>; 4] {
    let (sine, cosine) = (2.0 * row.q[spot.row()]).sin_cos();
    [(3, cosine), (3, sine), (4, cosine), (4, sine)].map(|(axis, part)| Vector6::ith(axis, part))
}

/// The largest tilt in a turn. Its square is `a + b cos(4q − c)`.
fn largest(numbers: &[ParameterReport]) -> f64 {
    let [cx, sx, cy, sy] = NAMES.map(|name| {
        numbers.iter().find(|number| number.name == name).map_or(0.0, |number| number.value)
    });
    let mean = (cx * cx + sx * sx + cy * cy + sy * sy) / 2.0;
    let sway = ((cx * cx - sx * sx + cy * cy - sy * sy) / 2.0).hypot(cx * sx + cy * sy);
    (mean + sway).sqrt()
}

const AT_REST: &Facts = &Facts {
    identifier: "bearing_wobble",
    reality: "The axis of a joint tilts twice to and fro in a turn, for a ring of its bearing is \
        oval.",
    signature: "The tool leaves the circle about the joint's axis, along the axis and across it, \
        with two periods a turn and the same at every load.",
    confused_with: "`link_geometry` of the rows beside the joint where it covers less than half a \
        turn; `transmission_error` of a neighbour whose axis lies across.",
    separated_by: "The joint turned alone through its whole range, orientation measured.",
    formula: "tilt about x: cos_x · cos 2q + sin_x · sin 2q; about y alike",
    parameters: &[
        Parameter::free("cos_x", Quantity::Angle).usually(1e-3),
        Parameter::free("sin_x", Quantity::Angle).usually(1e-3),
        Parameter::free("cos_y", Quantity::Angle).usually(1e-3),
        Parameter::free("sin_y", Quantity::Angle).usually(1e-3),
    ],
    at: At::Revolute,
    idle: "the joint does not turn",
    group: Some(Group::Constant),
    ..Facts::NONE
};

impl Law for BearingWobble {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for BearingWobble {
    fn alter(&self, actual: &mut Actual<'_>, row: &Row, _: &Moment, spot: Spot, v: &[f64]) {
        let tilt: Vector6<f64> = tilts(row, spot).iter().zip(v).map(|(tilt, v)| tilt * *v).sum();
        *actual.fixed_at(Site::Joint(spot.row())) += tilt;
    }

    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        scene.carried(Site::Joint(spot.row()), &tilts(scene.row, spot))
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        format!("the axis of {} wobbles by {}", told.place, told.sized(largest(told.numbers)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_tilt_is_that_of_the_turn() {
        let values = [3e-4, -1e-4, 0.5e-4, 2e-4];
        let number = |(name, value): (&str, f64)| ParameterReport {
            name: name.to_owned().into(),
            value,
            unit: "rad".into(),
            ci95: [value; 2],
            by_command: None,
        };
        let numbers: Vec<_> = NAMES.into_iter().zip(values).map(number).collect();
        let at = |k: i32| {
            let row = Row::new(2, vec![1e-4 * f64::from(k)]);
            let tilt = tilts(&row, Spot::at(Place::Joint(1)));
            tilt.iter().zip(values).map(|(tilt, v)| tilt * v).sum::<Vector6<f64>>().norm()
        };
        let most = (0..31416).map(at).fold(0.0, f64::max);
        // The steps miss the top by the square of 2e-4 at the most.
        assert!((largest(&numbers) / most - 1.0).abs() < 4e-8);
    }
}
