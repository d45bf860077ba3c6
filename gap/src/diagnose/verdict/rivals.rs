//! What else could explain what a finding explains: every candidate in its place, beside all the
//! others.

use super::outcome::{Group, Held};
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::search::{Explained, Search};
use crate::infer::constants::DISTINGUISHABLE;
use crate::infer::{Doubt, Observations, Ranked, Score, costs};
use crate::parallel;
use crate::report::{Alternative, Left};

/// The explained gap with other explanations in a finding's place.
pub(crate) struct Rivals {
    /// What speaks against the finding.
    pub(crate) doubt: Doubt,
    pub(crate) alternatives: Vec<Alternative>,
    /// How often it is found again on half of the poses.
    pub(crate) stability: f64,
    /// The rival that is hardest to tell from the finding, if one is not told from it.
    pub(crate) nearest: Option<(Candidate, Vec<f64>)>,
}

impl Search<'_, '_> {
    /// What stands in for the effects of each group.
    pub(crate) fn all_rivals(
        &self,
        now: &Explained,
        groups: &[Group],
    ) -> Result<Vec<Rivals>, DiagnoseError> {
        let held = Held::new(self, now);
        let all: Vec<&Group> = groups.iter().collect();
        let with = held.left(&all);
        let each = groups.iter().enumerate().map(|(k, group)| {
            let mut others = all.clone();
            others.remove(k);
            self.rivals(now, group, held.left(&others) <= with)
        });
        each.collect()
    }

    fn rivals(
        &self,
        now: &Explained,
        group: &Group,
        is_idle: bool,
    ) -> Result<Rivals, DiagnoseError> {
        let asked = self.asked(now, group);
        let (screen, ranked) = (&asked.screen, &asked.ranked);
        let left = self.left(now);
        let variance = self.scale(now).variance(left, now.fit.model.parameters(self.problem));
        let found: Vec<_> = group.iter().map(|index| &now.fit.model.found[*index]).collect();
        let costs = costs(self, now, variance);
        let own = left / variance + group.iter().map(|k| costs[*k]).sum::<f64>();
        let is_found = |c: &Candidate| {
            c.effect().is_some_and(|(effect, spot)| {
                effect.identifier() == found[0].effect.identifier()
                    && spot.place == found[0].spot.place
            })
        };
        let rows =
            self.problem.kept_rows().filter(|row| self.problem.is_judged(row)).count() as f64;
        // Of the forms of one effect the best speaks for it.
        let mut rivals: Vec<&Ranked> = Vec::new();
        for one in ranked {
            let candidate = &screen.candidates[one.candidate];
            let is_same = |other: &&Ranked| screen.candidates[other.candidate].is_same(candidate);
            if !is_found(candidate) && !rivals.iter().any(is_same) {
                rivals.push(one);
            }
        }
        let judged = parallel::each(&rivals, &|one| {
            let candidate = &screen.candidates[one.candidate];
            let (effect, spot) = candidate.effect()?;
            let evidence = (screen.left() - one.score.drop) / variance + one.cost - own;
            let alternative = Alternative {
                effect: effect.identifier().into(),
                place: spot.place.to_string(),
                left: Left::AtRest {
                    held_out_after: (asked.held_out(one.candidate).plain / rows).sqrt(),
                    separable: evidence > DISTINGUISHABLE,
                },
            };
            let values = one.score.values.iter().copied().collect();
            Some((alternative, (candidate.clone(), values)))
        });
        let judged: Vec<(Alternative, (Candidate, Vec<f64>))> =
            judged.into_iter().flatten().collect();
        let nearest = judged.iter().find(|(rival, _)| !rival.separable()).map(|(_, it)| it.clone());
        let mut alternatives: Vec<Alternative> =
            judged.into_iter().map(|(rival, _)| rival).collect();
        alternatives.sort_by(|a, b| {
            (a.separable().cmp(&b.separable())).then(a.left.size().total_cmp(&b.left.size()))
        });
        // What the finding explains, be it by several forms.
        let finding = Score {
            drop: (screen.left() - left).max(0.0),
            values: found.iter().flat_map(|f| f.values.iter().copied()).collect::<Vec<_>>().into(),
            rank: found.iter().map(|f| f.values.len()).sum(),
            own: 1.0,
        };
        let mut p_value = asked.p_value(&finding);
        if found[0].effect.depends().follows_time() {
            p_value = p_value.max(self.chance_in_time(now, &now.fit, group)?);
        }
        let contenders: Vec<usize> = ranked.iter().map(|r| r.candidate).collect();
        let again = |candidate: usize| is_found(&screen.candidates[candidate]);
        let stability = self.stability(screen, &contenders, now, &again);
        let doubt = Doubt { is_impossible: false, is_idle, p_value };
        Ok(Rivals { doubt, alternatives, stability, nearest })
    }
}
