//! How well the data tell the fitted numbers from each other.

use super::certainty::Certainty;
use crate::diagnose::fit::{Fit, Model};
use crate::diagnose::report::{Correlation, CorrelationMatrix, Observability};
use crate::diagnose::search::Search;
use crate::infer::limits::MOST_NAMED;
use crate::infer::{RANK, principal};

/// Numbers whose correlations are told one by one.
const MOST_NUMBERS: usize = 12;

/// A smaller correlation is none to be told.
const LEAST: f64 = 0.5;

const FRAME: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

impl Search<'_, '_> {
    /// Of the numbers of a fit; `None` where there are none.
    pub(super) fn observability(&self, fit: &Fit, certainty: &Certainty) -> Option<Observability> {
        let seen = &certainty.seen;
        let parameters = Some(seen.nrows()).filter(|count| *count > 0)?;
        let scale = seen.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
        let scaled = seen.map_with_location(|r, c, x| x * scale[r] * scale[c]);
        let mut values: Vec<f64> = principal(scaled).0.iter().copied().collect();
        values.retain(|value| *value > RANK);
        values.sort_by(|a, b| b.total_cmp(a));
        let singular_values: Vec<f64> = values.iter().map(|value| value.sqrt()).collect();
        let (most, least) = (singular_values.first()?, singular_values.last()?);
        Some(Observability {
            parameters,
            decided: values.len(),
            condition: most / least,
            correlations: self.correlations(fit, certainty),
            matrix: self.matrix(fit, certainty),
            singular_values,
        })
    }

    /// Of the numbers of findings: what is fitted along stands before them.
    fn matrix(&self, fit: &Fit, certainty: &Certainty) -> CorrelationMatrix {
        let along = fit.model.found.iter().take(Model::along(self.problem));
        let first = Model::nuisances(self.problem) + along.map(|f| f.values.len()).sum::<usize>();
        let of: Vec<String> =
            self.parameters(&fit.model).into_iter().skip(first).take(MOST_NUMBERS).collect();
        let own = first..first + of.len();
        let row = |a: usize| own.clone().map(|b| certainty.correlation(a, b)).collect();
        CorrelationMatrix { rows: own.clone().map(row).collect(), of }
    }

    /// The most correlated pairs of numbers, one of them at least of an effect beyond ordinary
    /// calibration: that frames and the table are hardly told apart is no news.
    fn correlations(&self, fit: &Fit, certainty: &Certainty) -> Vec<Correlation> {
        let names = self.parameters(&fit.model);
        let found = fit.model.found.iter();
        let mut beyond = vec![false; Model::nuisances(self.problem)];
        beyond.extend(found.flat_map(|f| f.values.iter().map(|_| !f.effect.is_tolerated())));
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for b in 0..names.len() {
            for a in (0..b).filter(|a| beyond[*a] || beyond[b]) {
                let correlation = certainty.correlation(a, b);
                if correlation.abs() >= LEAST {
                    pairs.push((correlation, a, b));
                }
            }
        }
        pairs.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
        let named = pairs.into_iter().take(MOST_NAMED).map(|(correlation, a, b)| Correlation {
            of: names[b].clone(),
            with: names[a].clone(),
            correlation,
        });
        named.collect()
    }

    /// The names of all parameters, in the order of the model's block.
    fn parameters(&self, model: &Model) -> Vec<String> {
        let problem = self.problem;
        let frames = problem.frames().flat_map(|frame| {
            let of = problem.frame_of(frame).map_or_else(String::new, |of| format!(" of {of}"));
            FRAME.map(|axis| format!("{axis} of {}{of}", frame.0.identifier()))
        });
        let markers = problem.markers.iter();
        let markers = markers.flat_map(|m| ["x", "y", "z"].map(|axis| format!("{axis} of {m}")));
        let bench = problem.bench.iter().flat_map(|thing| thing.aim.unknowns());
        let effects = model.found.iter().flat_map(|found| {
            let (effect, place) = (found.effect.identifier(), found.spot.place);
            let all = found.effect.parameters(problem.arm, found.spot).into_iter();
            all.map(move |p| format!("{} of {effect} at {place}", p.name))
        });
        frames.chain(markers).chain(bench).chain(effects).collect()
    }
}
