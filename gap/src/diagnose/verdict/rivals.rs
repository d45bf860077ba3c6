//! What else could explain what a finding explains: every candidate in its place, beside all the
//! others.

use super::outcome::Group;
use crate::diagnose::normal_equations::{Candidate, Kept, Screen};
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::search::{Explained, Search};
use crate::infer::constants::{DISTINGUISHABLE, WEAK};
use crate::infer::{Observations, Ranked, Score, SignFlips, costs};
use crate::parallel;
use crate::report::{Alternative, Left};

/// The explained gap with other explanations in a finding's place.
pub(crate) struct Rivals {
    pub(crate) alternatives: Vec<Alternative>,
    /// The chance that noise explains as much.
    pub(crate) p_value: f64,
    /// How often it is found again on half of the poses.
    pub(crate) stability: f64,
    /// The rival that is hardest to tell from the finding, if one is not told from it.
    pub(crate) nearest: Option<(Candidate, Vec<f64>)>,
}

impl Search<'_, '_> {
    /// Judges what stands in for the effects of `group`.
    pub(crate) fn rivals(
        &self,
        now: &Explained,
        group: &Group,
        at_noise: bool,
    ) -> Result<Rivals, DiagnoseError> {
        let screen = self.screen(now, Kept { without: group, ..Kept::default() });
        let scale = self.scale(now);
        let left = self.left(now);
        let variance = scale.variance(left, now.fit.model.parameters(self.problem));
        let found: Vec<_> = group.iter().map(|index| &now.fit.model.found[*index]).collect();
        let costs = costs(self, now, variance);
        let own = left / variance + group.iter().map(|k| costs[*k]).sum::<f64>();
        let own_blocks = self.per_block(now);
        let ranked = self.ranked(&screen, now);
        let trained = screen.trained();
        let is_found = |c: &Candidate| {
            c.effect().is_some_and(|(effect, spot)| {
                effect.identifier() == found[0].effect.identifier()
                    && spot.place == found[0].spot.place
            })
        };
        let rows = self.problem.kept_rows().count() as f64;
        // Of the forms of one effect the best speaks for it.
        let mut rivals: Vec<&Ranked> = Vec::new();
        for one in &ranked {
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
            let weak = evidence <= WEAK || !at_noise;
            let apart = evidence > DISTINGUISHABLE
                && !(weak && self.is_chance(&screen, one, &own_blocks, [variance, evidence]));
            let held_out = screen.held_out(&trained, Some(one.candidate));
            let alternative = Alternative {
                effect: effect.identifier().into(),
                place: spot.place.to_string(),
                left: Left::AtRest {
                    held_out_after: (held_out.plain / rows).sqrt(),
                    separable: apart,
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
        let contenders: Vec<usize> = ranked.iter().map(|r| r.candidate).collect();
        let mut p_value = self.p_value(&screen, &contenders, &finding, now);
        if found[0].effect.depends().follows_time() {
            p_value = p_value.max(self.chance_in_time(now, &now.fit, group)?);
        }
        let again = |candidate: usize| is_found(&screen.candidates[candidate]);
        let stability = self.stability(&screen, &contenders, now, &again);
        Ok(Rivals { alternatives, p_value, stability, nearest })
    }

    /// Weighted squares that are left in each block of poses.
    fn per_block(&self, now: &Explained) -> Vec<f64> {
        let gaps = self.problem.standard(&now.fit.predicted.gaps);
        let sizes: Vec<f64> = gaps.map(|g| g.component_mul(&now.weights).norm()).collect();
        self.folds.per_block(&sizes)
    }

    /// Whether the rival's excess, block by block, scatters so much that it may be chance. What a log tells is a part of
    /// the evidence that is in no block.
    fn is_chance(
        &self,
        screen: &Screen<'_>,
        one: &Ranked,
        own: &[f64],
        [variance, evidence]: [f64; 2],
    ) -> bool {
        let range = screen.range(one.candidate);
        let x = &one.score.values;
        let z = &screen.total.zr - screen.total.zx.columns_range(range.clone()) * x;
        let excess: Vec<f64> = screen
            .blocks
            .iter()
            .zip(own)
            .map(|(b, own)| {
                let model = z.dot(&(&b.zz * &z)) - 2.0 * z.dot(&b.zr);
                let rival = x.dot(&(&b.xx[one.candidate] * x))
                    - 2.0 * x.dot(&b.xr.rows_range(range.clone()))
                    + 2.0 * z.dot(&(b.zx.columns_range(range.clone()) * x));
                (b.rr + model + rival - own) / variance
            })
            .collect();
        let count = excess.len() as f64;
        let sum: f64 = excess.iter().sum();
        let spread: f64 = excess.iter().map(|e| (e - sum / count).powi(2)).sum();
        let told = if self.problem.springs.is_empty() { sum } else { sum.max(evidence) };
        told <= 2.0 * spread.sqrt()
    }

    /// The chance that the best of all that were tried explains as much of noise as `finding` does.
    fn p_value(
        &self,
        screen: &Screen<'_>,
        tried: &[usize],
        finding: &Score,
        now: &Explained,
    ) -> f64 {
        let scale = self.scale(now);
        let p_value = scale.p_value(finding, screen.left(), screen.basis.rank(), tried.len());
        let variance = scale.variance(screen.left(), screen.basis.rank());
        let flips = SignFlips::new(screen, tried, variance, self.options.seed);
        p_value.max(flips.p_value(finding))
    }
}
