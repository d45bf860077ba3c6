//! A candidate as a part of the model, a jump at the best of all moments near its own.

use super::forward::{Explained, Search};
use crate::diagnose::fit::Fitted;
use crate::diagnose::normal_equations::{Candidate, Kept, Screen};
use crate::effects::{Forms, Spot};
use crate::infer::{Ranked, Score};

/// Moments of a jump that are tried at once; of more, an even choice, and then those about the best.
const MOST_NEAR: usize = 256;

impl Search<'_, '_> {
    /// The candidate as a part of the model; a jump at the best of all rows near its own.
    pub(crate) fn refined(
        &self,
        now: &Explained,
        without: &[usize],
        one: &Ranked,
        screen: &Screen<'_>,
    ) -> Option<Fitted> {
        let candidate = &screen.candidates[one.candidate];
        let (effect, spot) = candidate.effect()?;
        let fitted = |spot: Spot, score: &Score| {
            candidate.fitted(spot, score.values.iter().copied().collect())
        };
        if !matches!(effect.forms_are(), Forms::Searched { .. }) {
            return fitted(spot, &one.score);
        }
        let forms = effect.forms(self.problem.arm, spot.place, self.problem.data);
        let at = forms.iter().position(|f| *f == spot.form).unwrap_or(0);
        let from = at.checked_sub(1).map_or(1, |k| forms[k] + 1);
        // Beyond the last as far as to the one before it.
        let to = forms.get(at + 1).copied().unwrap_or(2 * spot.form + 1 - from);
        let (mut from, mut to) = (from, to);
        loop {
            let every = (to - from).div_ceil(MOST_NEAR).max(1);
            let near: Vec<Candidate> = (from..to)
                .step_by(every)
                .map(|form| Candidate::of(self.problem, effect, Spot { form, ..spot }, forms.len()))
                .collect();
            let kept = Kept { without, whole: true, ..Kept::default() };
            let finer = self.screen_of(now, &self.gather(now, &[], &near), kept, &near);
            let scores = (0..near.len()).map(|c| (c, finer.score(c)));
            let best = scores.max_by(|a, b| a.1.drop.total_cmp(&b.1.drop));
            let (at, score) =
                best.and_then(|(c, score)| near[c].effect().map(|(_, at)| (at, score)))?;
            if every == 1 {
                return fitted(at, &score);
            }
            (from, to) = (from.max(at.form.saturating_sub(every - 1)), to.min(at.form + every));
        }
    }
}
