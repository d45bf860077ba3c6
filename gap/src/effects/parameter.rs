//! One number of an effect.

use std::borrow::Cow;

use super::Quantity;

/// One number of an effect at a spot.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// What it is, as it is reported: `cos 2`.
    pub name: Cow<'static, str>,
    /// What it is called where the form stands beside it, as in a robot file: `cos`.
    pub key: &'static str,
    /// Of what kind.
    pub quantity: Quantity,
    /// The least value that is physical; −∞ if every one is.
    pub least: f64,
    /// What nobody would be surprised by: far beyond it, other explanations are more likely.
    pub usual: f64,
    /// Whether nature knows it with one sign only, as far as arms have it.
    pub one_sided: bool,
}

impl Parameter {
    /// A parameter of which every value is physical.
    pub const fn free(key: &'static str, quantity: Quantity) -> Self {
        Self {
            name: Cow::Borrowed(key),
            key,
            quantity,
            least: f64::NEG_INFINITY,
            usual: f64::INFINITY,
            one_sided: false,
        }
    }

    /// A parameter that is at least `least`.
    pub const fn at_least(key: &'static str, quantity: Quantity, least: f64) -> Self {
        let mut parameter = Self::free(key, quantity);
        (parameter.least, parameter.one_sided) = (least, true);
        parameter
    }

    /// A parameter that is more than zero.
    pub const fn positive(key: &'static str, quantity: Quantity) -> Self {
        Self::at_least(key, quantity, f64::MIN_POSITIVE)
    }

    /// The same, with what is usual.
    pub const fn usually(mut self, usual: f64) -> Self {
        self.usual = usual;
        self
    }

    /// The same with a name of its own among other forms of the effect.
    pub fn named(self, name: String) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same, which arms have with one sign only though the other is no nonsense.
    pub const fn one_sided(mut self) -> Self {
        self.one_sided = true;
        self
    }

    /// The same of a joint that shifts, where it turns.
    pub fn of_shift(&self) -> Self {
        let quantity = match self.quantity {
            Quantity::Angle => Quantity::Length,
            Quantity::AnglePerMoment => Quantity::LengthPerForce,
            Quantity::AnglePerMomentCubed => Quantity::LengthPerForceCubed,
            Quantity::AnglePerKelvin => Quantity::LengthPerKelvin,
            other => other,
        };
        Self { quantity, ..self.clone() }
    }
}
