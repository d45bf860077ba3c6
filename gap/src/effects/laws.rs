//! The laws that a diagnosis tries: stiffarm's, and one's own.

use core::fmt;

use super::{AtRest, InMotion, Law, catalogue};

/// Laws of one kind, in the order in which equally good explanations are preferred.
pub struct Laws<L: ?Sized + 'static>(Vec<&'static L>);

impl Default for Laws<dyn AtRest> {
    /// Those of [`AT_REST`](catalogue::AT_REST).
    fn default() -> Self {
        Laws(catalogue::AT_REST.to_vec())
    }
}

impl Default for Laws<dyn InMotion> {
    /// Those of [`IN_MOTION`](catalogue::IN_MOTION).
    fn default() -> Self {
        Laws(catalogue::IN_MOTION.to_vec())
    }
}

impl<L: Law + ?Sized> Laws<L> {
    /// With one more, which of equally good explanations is preferred last. One that is made at run
    /// time lives as long as the program: [`Box::leak`].
    ///
    /// # Panics
    /// If there is one with its identifier: findings could not be told apart.
    #[must_use]
    pub fn with(mut self, law: &'static L) -> Self {
        let name = law.identifier();
        assert!(self.named(name).is_none(), "found two effects called `{name}`, expected one");
        self.0.push(law);
        self
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &'static L> {
        self.0.iter().copied()
    }

    /// By its identifier; of several that share one, the first.
    pub fn named(&self, identifier: &str) -> Option<&'static L> {
        self.iter().find(|law| law.identifier() == identifier)
    }

    /// All identifiers.
    pub fn identifiers(&self) -> Vec<&'static str> {
        self.iter().map(|law| law.identifier()).collect()
    }
}

impl<L: ?Sized> Clone for Laws<L> {
    fn clone(&self) -> Self {
        Laws(self.0.clone())
    }
}

impl<L: Law + ?Sized> PartialEq for Laws<L> {
    fn eq(&self, other: &Self) -> bool {
        self.identifiers() == other.identifiers()
    }
}

impl<L: Law + ?Sized> fmt::Debug for Laws<L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.identifiers()).finish()
    }
}

/// One effect of the catalogue, with its laws.
#[derive(Clone)]
pub struct Entry {
    /// Its identifier.
    pub identifier: &'static str,
    /// How it acts at rest.
    pub at_rest: Option<&'static dyn AtRest>,
    /// How it acts in motion: on torques, on positions.
    pub in_motion: Vec<&'static dyn InMotion>,
}

impl Entry {
    /// All effects of the catalogue: those that act at rest, then those that act in motion alone.
    pub fn all() -> Vec<Entry> {
        let entry = |law: &&'static dyn AtRest| Entry {
            identifier: law.facts().effect(),
            at_rest: Some(*law),
            in_motion: Vec::new(),
        };
        let mut all: Vec<Entry> = catalogue::AT_REST.iter().map(entry).collect();
        for law in catalogue::IN_MOTION {
            let identifier = law.facts().effect();
            match all.iter_mut().find(|entry| entry.identifier == identifier) {
                Some(entry) => entry.in_motion.push(law),
                None => all.push(Entry { identifier, at_rest: None, in_motion: vec![law] }),
            }
        }
        all
    }

    /// Its laws.
    pub fn laws(&self) -> impl Iterator<Item = &'static dyn Law> {
        let at_rest = self.at_rest.into_iter().map(|law| law as &dyn Law);
        at_rest.chain(self.in_motion.iter().map(|law| *law as &dyn Law))
    }

    /// Whether it, or one of its laws, is called so.
    pub fn is_called(&self, name: &str) -> bool {
        self.identifier == name || self.laws().any(|law| law.identifier() == name)
    }
}
