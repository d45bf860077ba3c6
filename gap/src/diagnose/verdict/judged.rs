//! The last word on what was found: held out, compared with its rivals, and what is left tested for
//! structure. What is not significant beside all the others is taken out again.

use nalgebra::Vector6;

use super::outcome::Held;
use super::refitted::Refitted;
use crate::diagnose::options::DiagnoseError;
use crate::diagnose::progress::Stage;
use crate::diagnose::report::{
    BenchReport, Finding, Observability, PairReport, Residual, Unexplained,
};
use crate::diagnose::search::{Explained, Search};
use crate::gap::Statistics;
use crate::infer::Observations;
use crate::infer::constants::SIGNIFICANT;
use crate::shrink::Shrink;

/// Findings that are taken out, one after the other.
const MOST_OUT: usize = 8;

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
        let mut out = 0;
        now = self.whole(now)?;
        loop {
            let (fitted, shrinking) = self.shrinking(now)?;
            now = fitted;
            let groups = &shrinking.groups;
            (self.progress)(Stage::Judge(groups.len()));
            let after = if groups.is_empty() { before } else { &shrinking.after };
            let size = Statistics::of(self.problem.kept(after));
            let positions = self.problem.measures_position();
            let main = if positions { size.position_rms } else { size.rotation_rms };
            let unexplained =
                if is_there { self.remainder(start, &now, main)? } else { Unexplained::default() };
            let refitted = Refitted::new(&Held::new(self, &now), groups, self.options.seed);
            let at_noise = !unexplained.present;
            let sizes: Vec<f64> = before.iter().map(|gap| self.problem.size(gap)).collect();
            let mut findings = self.findings(&now, &shrinking, &sizes, &refitted, at_noise)?;
            let worst = (0..findings.len())
                .max_by(|a, b| findings[*a].p_value.total_cmp(&findings[*b].p_value))
                .filter(|k| {
                    findings[*k].p_value > SIGNIFICANT && out < MOST_OUT && !self.stopped()
                });
            let Some(worst) = worst else {
                let certainty = self.certainty(&now);
                let values = self.intervals(&now, &certainty);
                for (finding, group) in findings.iter_mut().zip(groups) {
                    finding.parameters = group.iter().flat_map(|k| values[*k].clone()).collect();
                }
                let last: Vec<f64> = after.iter().map(|gap| self.problem.size(gap)).collect();
                let shrink = self.shrink(&sizes, &last, refitted.spread(0, groups.len()));
                let is_left = is_there && self.problem.is_there(after);
                let residual = is_left.then(|| self.residual(&now, before, after));
                let observability = self.observability(&now.fit, &certainty);
                let after = if groups.is_empty() { before.to_vec() } else { shrinking.after };
                let (bench, pairs) = (self.bench(&now, &certainty), self.pairs_apart(&now));
                let judged = Judged {
                    findings,
                    after,
                    shrink,
                    unexplained,
                    residual,
                    observability,
                    bench,
                    pairs,
                };
                return Ok((now, judged));
            };
            let mut group = groups[worst].clone();
            group.sort_unstable();
            now = self.fitted_without(now, &group)?;
            out += 1;
        }
    }
}
