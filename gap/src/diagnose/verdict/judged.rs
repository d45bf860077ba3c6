//! The last word on what was found: held out, compared with its rivals, and what is left tested for
//! structure. What is not significant beside all the others is taken out again.

use nalgebra::Vector6;

use super::outcome::{Group, Held, groups};
use super::refitted::Refitted;
use super::rivals::Rivals;
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::progress::Stage;
use crate::diagnose::report::{
    BenchReport, Finding, Observability, PairReport, Residual, Unexplained,
};
use crate::diagnose::search::{Explained, Search};
use crate::infer::constants::SIGNIFICANT;
use crate::infer::{Observations, worst};
use crate::shrink::Shrink;

/// What a diagnosis says.
pub(crate) struct Judged {
    pub(crate) findings: Vec<Finding>,
    /// Held-out gap of each row with all findings.
    pub(crate) after: Vec<Vector6<f64>>,
    /// From the gap before to that.
    pub(crate) shrink: Shrink,
    pub(crate) unexplained: Unexplained,
    pub(crate) residual: Option<Residual>,
    pub(crate) observability: Option<Observability>,
    pub(crate) bench: Vec<BenchReport>,
    pub(crate) pairs: Vec<PairReport>,
}

impl Search<'_, '_> {
    /// Judges what was found beyond `start`; `before` are the gaps of the robot file as it is, and `is_there` says
    /// whether they are more than rounding.
    pub(crate) fn judged(
        &self,
        start: &Explained,
        mut now: Explained,
        before: &[Vector6<f64>],
        is_there: bool,
    ) -> Result<(Explained, Judged), DiagnoseError> {
        now = self.whole(now)?;
        let (groups, rivals) = loop {
            let groups = groups(self.problem, &now.fit.model);
            (self.progress)(Stage::Judge(groups.len()));
            let rivals = self.all_rivals(&now, &groups)?;
            let doubts = rivals.iter().map(|rivals| rivals.doubt).enumerate();
            let doubted = doubts.filter(|(_, doubt)| doubt.is_doubted(SIGNIFICANT));
            let Some(worst) = worst(doubted).filter(|_| !self.stopped()) else {
                break (groups, rivals);
            };
            now = self.fitted_without(now, &groups[worst])?;
        };
        let held = Held::new(self, &now);
        let shrinking = held.ordered(&groups);
        let after = if groups.is_empty() { before } else { &shrinking.after };
        let size = self.problem.statistics(after);
        let positions = self.problem.measures_position();
        let main = if positions { size.position_rms } else { size.rotation_rms };
        let unexplained =
            if is_there { self.remainder(start, &now, main)? } else { Unexplained::default() };
        let mut rivals: Vec<Option<Rivals>> = rivals.into_iter().map(Some).collect();
        let (groups, rivals): (Vec<Group>, Vec<Rivals>) = (shrinking.order.iter())
            .filter_map(|k| Some((groups[*k].clone(), rivals[*k].take()?)))
            .unzip();
        let refitted = Refitted::new(&held, &groups, self.options.seed);
        let sizes: Vec<f64> = before.iter().map(|gap| self.problem.size(gap)).collect();
        let certainty = self.certainty(&now);
        let values = self.intervals(&now, &certainty);
        let mut findings = self.findings(&now, &groups, rivals, &sizes, &shrinking, &refitted);
        for (finding, group) in findings.iter_mut().zip(&groups) {
            finding.parameters = group.iter().flat_map(|k| values[*k].clone()).collect();
        }
        let last: Vec<f64> = after.iter().map(|gap| self.problem.size(gap)).collect();
        let shrink = self.shrink(&sizes, &last, refitted.spread(0, groups.len()));
        let is_left = is_there && self.problem.is_there(after);
        let residual = is_left.then(|| self.residual(&now, before, after));
        let observability = self.observability(&now.fit, &certainty);
        let (bench, pairs) = (self.bench(&now, &certainty), self.pairs_apart(&now));
        let judged = Judged {
            findings,
            after: after.to_vec(),
            shrink,
            unexplained,
            residual,
            observability,
            bench,
            pairs,
        };
        Ok((now, judged))
    }
}
