//! The form is the number of rows before the jump.

use crate::effects::prelude::*;

/// Displacement of the base (base axes) or the tool (tool axes) from one row on.
#[derive(Clone, Copy, Debug)]
pub struct Slip;

/// Moments that are tried at first.
const MOST: usize = 24;

/// Rows of the session on each side of a jump, at least.
const LEAST: usize = 3;

const AT_REST: &Facts = &Facts {
    identifier: "slip",
    reality: "A frame jumps at one moment: a bumped base, a slipped reflector.",
    signature: "Poses before and after one row differ by a rigid motion. Left out, one jump \
        invents several effects: whatever differs between the poses before and after it.",
    confused_with: "`drift` where the jump is small.",
    separated_by: "An early pose repeated now and then.",
    formula: "T → E T behind the row; of the tool T E",
    parameters: &displacement(Quantity::Length, Quantity::Angle),
    idle: "displacements do not show where a frame stands",
    depends: Depends::Session,
    ..Facts::NONE
};

impl Law for Slip {
    fn facts(&self) -> &'static Facts {
        AT_REST
    }
}

impl AtRest for Slip {
    fn places(&self, _: &Arm) -> Vec<Place> {
        vec![Place::Base, Place::Tool]
    }

    /// Where rows of another pose begin, and between sessions; of many, an even choice that a search
    /// then refines.
    fn forms(&self, _: &Arm, _: Place, data: &Measurements) -> Vec<usize> {
        let (mut inner, mut between) = (Vec::new(), Vec::new());
        let mut first = 0;
        for rows in data.sessions() {
            let within = LEAST.max(1)..(rows.len() + 1).saturating_sub(LEAST);
            let begins = within.filter(|k| rows[*k].group != rows[k - 1].group);
            between.extend((first > 0).then_some(first));
            inner.extend(begins.map(|k| first + k));
            first += rows.len();
        }
        let every = inner.len().div_ceil(MOST).max(1);
        between.extend(inner.into_iter().skip(every / 2).step_by(every));
        between.sort_unstable();
        between
    }

    fn forms_are(&self) -> Forms {
        Forms::Searched { key: "after", quantity: Quantity::Row, steps: 1 }
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(if spot.place == Place::Tool { Carrier::Tool } else { Carrier::Base })
    }

    fn moves_by(&self, _: &Row, when: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        // In its session.
        each(f64::from((when.first..=when.index).contains(&spot.form)));
    }

    fn stepped(&self, spot: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        match spot.place {
            Place::Tool => one_after_other(step, values),
            _ => one_after_other(values, step),
        }
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let of = if told.place == "tool" { "the reflector" } else { "the base" };
        format!("{of} jumps by {} after row {}", told.moved(), told.sized(told.first()))
    }

    /// After a quarter of the rows, and before the last one.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let rows = from.session.rows.len() as f64;
        let after = (rows * from.between(0.25, 0.75)).round().max(1.0);
        let all = <dyn AtRest>::numbers(self, from.arm, from.place);
        let mut values = from.sizes(&all, 1.0);
        values[0].1 = after;
        values
    }
}
