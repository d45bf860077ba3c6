//! The effects that a log is asked for: stiffarm's, and one's own.

use super::{CATALOGUE, LogEffect};

/// The effects that a diagnosis tries: those that stiffarm knows, and one's own.
#[derive(Clone)]
pub struct Catalogue(Vec<&'static dyn LogEffect>);

impl Default for Catalogue {
    /// [`CATALOGUE`].
    fn default() -> Self {
        Catalogue(CATALOGUE.to_vec())
    }
}

impl Catalogue {
    /// With one more, which is asked for last. One that is made at run time lives as long as the program:
    /// [`Box::leak`].
    ///
    /// # Panics
    /// If there is one with its identifier: findings could not be told apart.
    #[must_use]
    pub fn with(mut self, effect: &'static dyn LogEffect) -> Self {
        let name = effect.identifier();
        assert!(self.named(name).is_none(), "found two effects called `{name}`, expected one");
        self.0.push(effect);
        self
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn LogEffect> {
        self.0.iter().copied()
    }

    /// By its identifier; of several that share one, the first.
    pub fn named(&self, identifier: &str) -> Option<&'static dyn LogEffect> {
        self.iter().find(|effect| effect.identifier() == identifier)
    }

    /// All identifiers.
    pub fn identifiers(&self) -> Vec<&'static str> {
        self.iter().map(LogEffect::identifier).collect()
    }
}

impl PartialEq for Catalogue {
    fn eq(&self, other: &Self) -> bool {
        self.identifiers() == other.identifiers()
    }
}

impl core::fmt::Debug for Catalogue {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self.identifiers()).finish()
    }
}
