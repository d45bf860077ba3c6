//! Candidates beside a model: gathered in one pass over the data for each fit, and asked as often as
//! is needed, with some of the model taken out or not.

use std::sync::{Arc, OnceLock};

use nalgebra::Vector6;

use super::first::First;
use super::forward::{Explained, Search};
use crate::diagnose::data::Problem;
use crate::diagnose::fit::Fit;
use crate::diagnose::normal_equations::{Candidate, Gathered, Kept, Screen, Wanted};
use crate::diagnose::options::DiagnoseError;
use crate::infer::{Autoregression, Observations};

/// Steps of time, at most: of more visits neighbours are one step, so that the cost is bounded.
const MOST_STEPS: usize = 1024;

impl<'s> Search<'s, '_> {
    /// All candidates beside the model, gathered when first asked for.
    pub(crate) fn gathered(&self, now: &Explained) -> Arc<Gathered> {
        let gather = || Arc::new(self.gather(now, &[], self.candidates));
        Arc::clone(now.gathered.get_or_init(gather))
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

    /// The chance that errors as autocorrelated as what `fit` leaves make as much of a pattern as an effect that
    /// follows time does, which is `asked` for, all its forms.
    pub(crate) fn chance_in_time(
        &self,
        now: &Explained,
        fit: &Fit,
        asked: &[usize],
    ) -> Result<f64, DiagnoseError> {
        let problem = self.problem;
        let white = |(row, gap): (usize, Vector6<f64>)| {
            gap.component_mul(&problem.weights(row, &now.weights))
        };
        let left = || fit.predicted.gaps.iter().copied().enumerate().map(white);
        let mean = problem.data.rows.iter().map(|_| Vector6::repeat(1.0));
        let mut told = vec![by_steps(problem, left()), by_steps(problem, mean)];
        let found = &fit.model.found;
        let follows = |k: &usize| found[*k].effect.depends().follows_time();
        let others = (0..found.len()).filter(|k| !asked.contains(k) && follows(k));
        let each = others.map(|k| vec![k]);
        for forms in std::iter::once(asked.to_vec()).chain(each) {
            let mut without = fit.model.clone();
            forms.iter().for_each(|k| without.found[*k].values.fill(0.0));
            let without = without.predict(problem, Some(&fit.predicted.sims))?;
            let both = without.gaps.iter().zip(&fit.predicted.gaps);
            let moved = both.map(|(without, with)| without - with);
            told.push(by_steps(problem, moved.enumerate().map(white)));
        }
        let squares = left().map(|gap| gap.norm_squared()).sum();
        let variance = self.scale(now).variance(squares, fit.model.parameters(problem));
        let errors = Autoregression::of(&problem.measured, &told, variance);
        let Some(errors) = errors else { return Ok(1.0) };
        let rank = asked.iter().map(|k| found[*k].values.len()).sum();
        let tried = self.candidates.iter().filter(|c| c.follows_time()).count();
        Ok(errors.p_value(rank, tried))
    }

    /// A fit with the best of what follows time added, be it significant or not.
    pub(super) fn with_more_in_time(
        &self,
        now: &Explained,
        fit: &Fit,
    ) -> Result<Option<Fit>, DiagnoseError> {
        let ordered: Vec<Candidate> =
            self.candidates.iter().filter(|c| c.follows_time()).cloned().collect();
        let in_time = Search { candidates: &ordered, ..*self };
        let begun = Explained { fit: fit.clone(), gathered: OnceLock::new(), ..*now };
        let screen = in_time.screen(&begun, Kept { whole: true, ..Kept::default() });
        let ranked = in_time.ranked(&screen, &begun);
        let best = ranked.first().and_then(|one| in_time.refined(&begun, &[], one, &screen));
        match best {
            Some(best) => in_time.with(&begun, &[], vec![best], f64::INFINITY),
            None => Ok(None),
        }
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
        kept.screen(self.problem, self.folds, gathered, &now.fit.model, candidates)
    }
}

/// Sums of each step of time over the root of its rows: in units of one row's noise.
fn by_steps(
    problem: &Problem<'_>,
    of_rows: impl Iterator<Item = Vector6<f64>>,
) -> Vec<Vector6<f64>> {
    let visits = problem.visits.count();
    let count = visits.min(MOST_STEPS);
    let mut sums = vec![(Vector6::zeros(), 0.0); count];
    for (row, it) in of_rows.enumerate().filter(|(row, _)| problem.fits[*row]) {
        let (sum, rows) = &mut sums[problem.visits.of_row[row] * count / visits];
        *sum += it;
        *rows += 1.0;
    }
    let there = sums.into_iter().filter(|(_, rows)| *rows > 0.0);
    there.map(|(sum, rows): (Vector6<f64>, f64)| sum / rows.sqrt()).collect()
}
