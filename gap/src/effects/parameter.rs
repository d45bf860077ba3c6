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
    pub fn free(key: &'static str, quantity: Quantity) -> Self {
        Self {
            name: key.into(),
            key,
            quantity,
            least: f64::NEG_INFINITY,
            usual: f64::INFINITY,
            one_sided: false,
        }
    }

    /// A parameter that is at least `least`.
    pub fn at_least(key: &'static str, quantity: Quantity, least: f64) -> Self {
        Self { least, one_sided: true, ..Self::free(key, quantity) }
    }

    /// The same, with what is usual.
    pub fn usually(self, usual: f64) -> Self {
        Self { usual, ..self }
    }

    /// The same with a name of its own among other forms of the effect.
    pub fn named(self, name: String) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The same, which arms have with one sign only though the other is no nonsense.
    pub fn one_sided(self) -> Self {
        Self { one_sided: true, ..self }
    }
}
