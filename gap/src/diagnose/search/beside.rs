//! Candidates beside a model: gathered in one pass over the data for each fit, and asked as often as
//! is needed, with some of the model taken out or not.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::evidence::Flips;
use super::first::First;
use super::forward::{Explained, Search};
use crate::diagnose::data::Folds;
use crate::diagnose::fit::normal_equations;
use crate::diagnose::sums::{Candidate, Gathered, Kept, Score, Screen, Wanted};

impl<'s> Search<'s, '_> {
    /// All candidates beside the model, gathered when first asked for.
    pub(crate) fn gathered(&self, now: &Explained) -> Arc<Gathered> {
        let gather = || Arc::new(self.gather(now, &[], self.candidates));
        Arc::clone(now.gathered.get_or_init(gather))
    }

    /// Normal matrix of all parameters of the model, each loosely held to what is usual.
    pub(crate) fn normal(&self, now: &Explained) -> DMatrix<f64> {
        let Some(gathered) = now.gathered.get() else {
            return normal_equations(self.problem, &now.fit, &now.weights).0;
        };
        let mut normal = gathered.total.zz.clone();
        for (at, held) in now.fit.model.held(self.problem).iter().enumerate() {
            normal[(at, at)] += held * held;
        }
        normal
    }

    /// Lets the search go on from what was gathered before it began.
    pub(crate) fn begin_with(&self, begun: &Explained, first: First) {
        let parameters = begun.fit.model.parameters(self.problem);
        begun
            .gathered
            .get_or_init(|| Arc::new(first.gathered.narrowed(parameters, self.candidates)));
    }

    /// Columns of `along` and `candidates` beside the model.
    pub(crate) fn gather(
        &self,
        now: &Explained,
        along: &[Candidate],
        candidates: &[Candidate],
    ) -> Gathered {
        let wanted = Wanted { problem: self.problem, fit: &now.fit, along, candidates };
        Gathered::new(&wanted, self.folds, &now.weights)
    }

    /// The chance that the best of what follows time explains as much as `best` of a gap whose signs
    /// are flipped by stretches of time, beside the model without some of its effects: errors that
    /// linger stay together in it, as they do not where signs are flipped by poses.
    pub(crate) fn chance_in_time(&self, now: &Explained, without: &[usize], best: &Score) -> f64 {
        let ordered: Vec<Candidate> =
            self.candidates.iter().filter(|c| c.follows_time()).cloned().collect();
        let folds = &Folds::in_time(&self.problem.visits);
        let by_time = Search { folds, candidates: &ordered, ..*self };
        let gathered = by_time.gather(now, &[], &ordered);
        let screen =
            by_time.screen_of(now, &gathered, Kept { without, ..Kept::default() }, &ordered);
        let tried: Vec<usize> = (0..ordered.len()).collect();
        Flips::new(&screen, &tried, &self.scale(now), self.options.seed).chance(best)
    }

    /// All candidates beside what is kept of the model.
    pub(crate) fn screen(&self, now: &Explained, kept: Kept<'_>) -> Screen<'s> {
        self.screen_of(now, &self.gathered(now), kept, self.candidates)
    }

    /// The first candidates of those that were gathered beside what is kept of the model.
    pub(crate) fn screen_of<'c>(
        &self,
        now: &Explained,
        gathered: &Gathered,
        kept: Kept<'_>,
        candidates: &'c [Candidate],
    ) -> Screen<'c> {
        Screen::new(self.problem, self.folds, gathered, &now.fit.model, kept, candidates)
    }
}
