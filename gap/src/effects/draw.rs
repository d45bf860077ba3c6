//! Effects of about the size that arms have, drawn for a case that is withheld.

use stiffarm_kernels::generic::Arm;

use super::{Parameter, Place, Quantity};
use crate::dice::Dice;
use crate::measurement::Measurements;

/// What an effect draws from.
pub struct Draw<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// Where the effect is to act.
    pub place: Place,
    /// The session that is to be measured.
    pub session: &'a Measurements,
    dice: &'a mut Dice,
}

impl<'a> Draw<'a> {
    /// Of this arm, place and session.
    pub fn new(arm: &'a Arm, place: Place, session: &'a Measurements, dice: &'a mut Dice) -> Self {
        Draw { arm, place, session, dice }
    }

    /// A usual size for each parameter, divided by `over`: of the sign that arms have, else of either; a
    /// lone one is not drawn near zero.
    pub fn sizes(&mut self, parameters: &[Parameter], over: f64) -> Vec<(String, f64)> {
        let lone = parameters.len() == 1;
        let mut value = |p: &Parameter| {
            let part = match (p.one_sided, lone) {
                (true, _) => self.dice.between(0.4, 1.0),
                (false, true) => self.dice.sign(),
                (false, false) => self.dice.normal(),
            };
            p.quantity.typical() * part / over
        };
        parameters.iter().map(|p| (p.name.to_string(), value(p))).collect()
    }

    /// A number of mean 0 and variance 1.
    pub fn normal(&mut self) -> f64 {
        self.dice.normal()
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        self.dice.sign()
    }

    /// Evenly from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.dice.between(low, high)
    }

    /// 0 to `n` − 1.
    pub fn below(&mut self, n: usize) -> usize {
        self.dice.below(n)
    }

    /// The duration of the session, s, or the number of its rows.
    pub fn elapsed(&self) -> f64 {
        let ends = self.session.rows.first().zip(self.session.rows.last());
        match ends.and_then(|(first, last)| first.time.zip(last.time)) {
            Some((first, last)) => last - first,
            None => self.session.rows.len() as f64,
        }
    }
}

impl Quantity {
    /// About what arms of a metre or two have; the proportions of an effect's parameters.
    pub fn typical(self) -> f64 {
        match self {
            Quantity::Length | Quantity::Angle | Quantity::LengthRate | Quantity::AngleRate => 3e-4,
            Quantity::AnglePerMoment => 1e-6,
            Quantity::LengthPerForce => 1e-7,
            Quantity::AnglePerMomentCubed => 1e-10,
            Quantity::LengthPerForceCubed => 1e-12,
            Quantity::Flexibility => 1e-6,
            Quantity::Mass => 1.0,
            Quantity::Ratio | Quantity::AnglePerLength | Quantity::LengthPerAngle => 1e-2,
            Quantity::PerKelvin => 12e-6,
            Quantity::Row => 1.0,
        }
    }

    /// Beyond this no arm is still the arm of its file.
    pub fn largest(self) -> f64 {
        match self {
            Quantity::Length | Quantity::Angle => 0.05,
            Quantity::Ratio | Quantity::AnglePerLength | Quantity::LengthPerAngle => 0.5,
            Quantity::Mass => 100.0,
            Quantity::PerKelvin => 1e-3,
            _ => f64::INFINITY,
        }
    }
}
