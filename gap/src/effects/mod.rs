//! The catalogue: what reality does that the sim does not. A new effect is one file that implements
//! [`Effect`], and one line in [`CATALOGUE`].
//!
//! Each file tells the effect's signature, what it is confused with, and what measurement tells
//! them apart.

mod carrier;
mod catalogue;
mod place;
mod scene;
#[cfg(test)]
mod tests;

use std::borrow::Cow;

use nalgebra::Matrix6xX;
use stiffarm_kernels::generic::Arm;

use crate::measurement::{Measurements, Row};
use crate::simulate::{Actual, Moment};

pub use carrier::Carrier;
pub use catalogue::*;
pub use place::{Place, Spot};
pub use scene::Scene;

/// One number of an effect at a spot.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// What it is.
    pub name: Cow<'static, str>,
    /// In SI.
    pub unit: &'static str,
    /// The least value that is physical; −∞ if every one is.
    pub least: f64,
    /// What nobody would be surprised by: far beyond it, other explanations are more likely.
    pub usual: f64,
}

impl Parameter {
    /// A parameter of which every value is physical.
    pub fn free(name: impl Into<Cow<'static, str>>, unit: &'static str) -> Self {
        Self { name: name.into(), unit, least: f64::NEG_INFINITY, usual: f64::INFINITY }
    }

    /// A parameter that is at least `least`.
    pub fn at_least(name: &'static str, unit: &'static str, least: f64) -> Self {
        Self { name: name.into(), unit, least, usual: f64::INFINITY }
    }

    /// The same, with what is usual.
    pub fn usually(self, usual: f64) -> Self {
        Self { usual, ..self }
    }
}

/// An effect of reality at places of the arm.
///
/// [`Effect::alter`] is the exact model: the arm of a row as it is *with* the effect, to be brought
/// to rest like any other. [`Effect::block`] is its linearisation; the fit iterates between the
/// two.
pub trait Effect: Sync {
    /// The identifier that files and options use.
    fn identifier(&self) -> &'static str;

    /// Where on this arm it may act.
    fn places(&self, arm: &Arm) -> Vec<Place>;

    /// The forms that it may take at a place: the orders of a periodic error, the joints that may
    /// turn this one, the moments of a jump. Each is tried by itself.
    fn forms(&self, _: &Arm, _: Place, _: &Measurements) -> Vec<usize> {
        vec![0]
    }

    /// Its parameters; all zero is no effect.
    fn parameters(&self, arm: &Arm, spot: Spot, data: &Measurements) -> Vec<Parameter>;

    /// Puts the effect with these values into the arm of a row.
    fn alter(&self, actual: &mut Actual<'_>, row: &Row, when: &Moment, spot: Spot, values: &[f64]);

    /// What the effect moves, if that is one thing and all that it does is to move it: most effects
    /// turn a joint or shift a frame, each by another law. Such an effect tells its [`Effect::motions`],
    /// any other its [`Effect::block`].
    fn carrier(&self, _: Spot) -> Option<Carrier> {
        None
    }

    /// Adds how far the carrier moves per unit of each parameter; of a frame, of each six.
    fn motions(&self, _: &Scene<'_>, _: Spot, _: &mut Vec<f64>) {}

    /// Adds the motions of several spots of one place.
    fn motions_of(&self, scene: &Scene<'_>, spots: &[Spot], motions: &mut Vec<f64>) {
        spots.iter().for_each(|spot| self.motions(scene, *spot, motions));
    }

    /// Twist of the tool, base axes, at the tool origin, per unit of each parameter, 6×p, to first
    /// order at a state of the arm.
    fn block(&self, scene: &Scene<'_>, spot: Spot) -> Matrix6xX<f64> {
        let mut motions = Vec::new();
        self.motions(scene, spot, &mut motions);
        scene.moved(self.carrier(spot), &motions)
    }

    /// Why data shows nothing of it where its block is zero everywhere.
    fn idle(&self) -> &'static str;

    /// Why data that excites it may still not show it beside all of the arm's geometry.
    fn hidden(&self) -> &'static str {
        "lengths, twists, zeros and frames of the arm do the same on this data"
    }

    /// Whether it is a matter of lengths and angles alone, the same at every load, moment and
    /// direction.
    fn is_geometry(&self) -> bool {
        false
    }

    /// Why it cannot be there at all with this data; `None` if it can.
    fn excluded(&self, _: &Measurements) -> Option<&'static str> {
        None
    }

    /// What a form is as a reported number: name and unit; `None` if the parameters' names tell it.
    fn form_is(&self) -> Option<(&'static str, &'static str)> {
        None
    }
}

/// Names and units of a displacement's six numbers, times whatever `per` divides them by.
fn displacement(units: [&'static str; 2]) -> Vec<Parameter> {
    let names = ["x", "y", "z", "rx", "ry", "rz"];
    let one =
        |(k, name): (usize, &&'static str)| Parameter::free(*name, units[k / 3]).usually(0.05);
    names.iter().enumerate().map(one).collect()
}

/// The joints of an arm as places.
fn joints(arm: &Arm) -> Vec<Place> {
    (1..=arm.dof()).map(Place::Joint).collect()
}

/// The links of an arm as places.
fn links(arm: &Arm) -> Vec<Place> {
    (1..=arm.dof()).map(Place::Link).collect()
}
