//! Effects of about the size that arms have, drawn for a case that is withheld.

use stiffarm_kernels::generic::Arm;

use super::{Parameter, Place};
use crate::measurement::Measurements;
use crate::rng::Rng;

/// What an effect draws from.
pub struct Draw<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// Where the effect is to act.
    pub place: Place,
    /// The session that is to be measured.
    pub session: &'a Measurements,
    rng: &'a mut Rng,
}

impl<'a> Draw<'a> {
    /// Of this arm, place and session.
    pub fn new(arm: &'a Arm, place: Place, session: &'a Measurements, rng: &'a mut Rng) -> Self {
        Draw { arm, place, session, rng }
    }

    /// A usual size for each parameter, divided by `over`: of the sign that arms have, else of either; a
    /// lone one is not drawn near zero.
    pub fn sizes(&mut self, parameters: &[Parameter], over: f64) -> Vec<(String, f64)> {
        let lone = parameters.len() == 1;
        let mut value = |p: &Parameter| {
            let part = match (p.one_sided, lone) {
                (true, _) => self.rng.between(0.4, 1.0),
                (false, true) => self.rng.sign(),
                (false, false) => self.rng.normal(),
            };
            p.quantity.typical() * part / over
        };
        parameters.iter().map(|p| (p.name.to_string(), value(p))).collect()
    }

    /// A number of mean 0 and variance 1.
    pub fn normal(&mut self) -> f64 {
        self.rng.normal()
    }

    /// −1 or 1.
    pub fn sign(&mut self) -> f64 {
        self.rng.sign()
    }

    /// Evenly from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.rng.between(low, high)
    }

    /// 0 to `n` − 1.
    pub fn below(&mut self, n: usize) -> usize {
        self.rng.below(n)
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
