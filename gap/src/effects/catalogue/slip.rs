//! A frame jumps at one moment: a bumped base, a slipped reflector.
//!
//! The form is the number of rows before the jump.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use crate::displacement::Displacement;
use crate::effects::{
    About, Carrier, Depends, Draw, Effect, Forms, Parameter, Place, Quantity, Scene, Spot, Told,
    displacement, one_after_other,
};
use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment, Site};

/// Displacement of the base (base axes) or the tool (tool axes) from one row on.
#[derive(Clone, Copy, Debug)]
pub struct Slip;

/// Moments that are tried at first.
const MOST: usize = 24;

/// Rows of the session on each side of a jump, at least.
const LEAST: usize = 3;

/// Whether a row is measured after the jump, in its session.
fn is_after(when: &Moment, spot: Spot) -> bool {
    (when.first..=when.index).contains(&spot.form)
}

impl Effect for Slip {
    fn identifier(&self) -> &'static str {
        "slip"
    }

    fn about(&self) -> About {
        About {
            reality: "A frame jumps at one moment: a bumped base, a slipped reflector.",
            signature: "Poses before and after one row differ by a rigid motion. Left out, one \
                        jump invents several effects: whatever differs between the poses before \
                        and after it.",
            confused_with: "`drift` where the jump is small.",
            separated_by: "An early pose repeated now and then.",
        }
    }

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

    fn parameters(&self, _: &Arm, _: Spot) -> Vec<Parameter> {
        displacement([Quantity::Length, Quantity::Angle])
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, when: &Moment, spot: Spot, v: &[f64]) {
        if !is_after(when, spot) {
            return;
        }
        let jump = Vector6::from_column_slice(v);
        if spot.place == Place::Tool {
            *actual.fixed_at(Site::Tool) += jump;
        } else {
            actual.base *= Displacement::new(&jump).transform();
        }
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(if spot.place == Place::Tool { Carrier::Tool } else { Carrier::Base })
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        motions.push(f64::from(is_after(scene.when, spot)));
    }

    fn stepped(&self, spot: Spot, values: &[f64], step: &[f64]) -> Vec<f64> {
        match spot.place {
            Place::Tool => one_after_other(step, values),
            _ => one_after_other(values, step),
        }
    }

    fn idle(&self) -> &'static str {
        "displacements do not show where a frame stands"
    }

    fn depends(&self) -> Depends {
        Depends::Session
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let of = if told.place == "tool" { "the reflector" } else { "the base" };
        format!("{of} jumps by {} after row {}", told.moved(), told.sized(told.first()))
    }

    /// After a quarter of the rows, and before the last one.
    fn draw(&self, from: &mut Draw<'_>) -> Vec<(String, f64)> {
        let rows = from.session.rows.len() as f64;
        let after = (rows * from.between(0.25, 0.75)).round().max(1.0);
        let all = <dyn Effect>::numbers(self, from.arm, from.place);
        let mut values = from.sizes(&all, 1.0);
        values[0].1 = after;
        values
    }
}
