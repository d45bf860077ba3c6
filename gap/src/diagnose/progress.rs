//! How far a diagnosis is, and how it is told to stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::effects::Place;

/// How far a diagnosis is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Simulating the rows and fitting the unknown frames.
    Align,
    /// Looking for effects, with so many found.
    Search(usize),
    /// Fitting an effect at a place beside the others, with so many found.
    Try(usize, &'static str, Place),
    /// Judging so many findings.
    Judge(usize),
}

/// A wish, from another thread or a signal, that a diagnosis end soon: what was found so far is
/// judged and told, and [`Diagnosis::stopped`](super::Diagnosis::stopped) says so. Clones share the
/// wish.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Asks for the end.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the end was asked for.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl PartialEq for Stop {
    /// Whether one ends with the other.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || (!self.is_asked() && !other.is_asked())
    }
}
