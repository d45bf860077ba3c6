//! What the data show before anything is found, gathered once: the search begins with it, and what
//! cannot be seen is read from it.

use super::forward::{Explained, Search};
use crate::diagnose::normal_equations::{Candidate, Gathered};
use crate::infer::Columns;

/// What the data show before anything is found: all of the catalogue, and displacements of free form,
/// beside the frames and the geometry.
pub(crate) struct First {
    /// The catalogue's effects, then the free forms.
    pub(crate) candidates: Vec<Candidate>,
    /// Lengths, twists and zeros of the arm, where they are not fitted along.
    pub(crate) geometry: Vec<Candidate>,
    /// The former with the latter along.
    pub(crate) gathered: Gathered,
}

impl Search<'_, '_> {
    /// Gathers what the data show before anything is found.
    pub(crate) fn first(&self, now: &Explained) -> First {
        let apart = self.candidates.iter().filter(|c| is_one(c) && self.problem.along.is_none());
        let geometry: Vec<Candidate> = apart.cloned().collect();
        let mut candidates = self.candidates.to_vec();
        candidates.extend(Candidate::probes(self.problem));
        let gathered = self.gather(now, &geometry, &candidates);
        First { candidates, geometry, gathered }
    }
}

/// Whether it is a zero or a row of the arm's table, or a frame.
fn is_one(candidate: &Candidate) -> bool {
    !candidate.is_tolerated() && candidate.effect().is_some_and(|(effect, _)| effect.is_geometry())
}
