//! The candidates judged: the best of them on what no fit has seen, whether it is significant, and
//! what cannot be told from it.

use nalgebra::Vector6;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::bootstrap::{excludes_zero, mean_interval, shrink, shrink_interval};
use super::fit::{Candidate, Fit};
use super::folds::Folds;
use super::noise::Noise;
use super::options::Options;
use super::problem::Problem;
use super::report::{Alternative, Finding, ParameterReport, Share, Shrink};
use super::significance;
use crate::gap::{Statistics, rms};

/// A finding's largest p value.
const SIGNIFICANT: f64 = 0.05;

/// A gap below this, relative to the arm's reach, is rounding error.
const ROUNDING: f64 = 1e-12;

/// Every candidate fitted and put in order.
pub(crate) struct Judged {
    pub(crate) fits: Vec<Fit>,
    /// Candidates, least held-out gap first.
    pub(crate) order: Vec<usize>,
    /// Weights of the components, by the noise.
    weights: Vector6<f64>,
}

impl Judged {
    pub(crate) fn of(
        problem: &Problem<'_>,
        folds: &Folds,
        candidates: &[Candidate],
        options: &Options,
    ) -> Judged {
        let noise = Noise::of(problem, options, &problem.gaps, 0);
        let mut judged = Judged::with(problem, folds, candidates, noise.weights(&problem.mask));
        // A noise that is taken from the residual is known only after a fit. It matters where
        // positions are weighed against rotations.
        if let Some(&best) = judged.order.first() {
            let fit = &judged.fits[best];
            let noise = Noise::of(problem, options, &fit.point.gaps, fit.values.len());
            let weights = noise.weights(&problem.mask);
            let both = measures_position(problem) && problem.mask.fixed_rows::<3>(3).amax() > 0.0;
            if both && weights != judged.weights {
                judged = Judged::with(problem, folds, candidates, weights);
            }
        }
        judged
    }

    fn with(
        problem: &Problem<'_>,
        folds: &Folds,
        candidates: &[Candidate],
        weights: Vector6<f64>,
    ) -> Judged {
        let fits: Vec<Fit> = candidates.iter().map(|c| c.fit(problem, folds, &weights)).collect();
        let mut order: Vec<usize> = (0..fits.len()).collect();
        let score = |k: &usize| squares(&fits[*k].held_out, &weights);
        order.sort_by(|a, b| score(a).total_cmp(&score(b)));
        Judged { fits, order, weights }
    }

    /// The best candidate, if it is significant and shrinks the held-out gap.
    pub(crate) fn accepted(
        &self,
        problem: &Problem<'_>,
        candidates: &[Candidate],
        options: &Options,
    ) -> Option<Finding> {
        let best = *self.order.first()?;
        let (candidate, fit) = (&candidates[best], &self.fits[best]);
        let shrinks = squares(&fit.held_out, &self.weights) < squares(&problem.gaps, &self.weights);
        if !shrinks || fit.values.iter().all(|v| *v == 0.0) {
            return None;
        }
        let seed = options.seed;
        let p_value = significance::p_value(problem, candidates, best, &self.weights, seed);
        if p_value > SIGNIFICANT {
            return None;
        }
        let (before, after) =
            (main_size(problem, &problem.gaps), main_size(problem, &fit.held_out));
        let alternatives = self.alternatives(problem, candidates, seed);
        let inseparable =
            self.order[1..].iter().zip(&alternatives).find(|(_, a)| !a.separable).map(|(k, _)| *k);
        Some(Finding {
            effect: candidate.effect.identifier(),
            place: candidate.place.to_string(),
            parameters: parameters(problem, candidate, fit),
            held_out: Shrink {
                before: rms(&before),
                after: rms(&after),
                shrink: shrink(
                    before.iter().map(|g| g * g).sum(),
                    after.iter().map(|g| g * g).sum(),
                ),
                shrink_ci95: shrink_interval(
                    &per_pose(problem, &before),
                    &per_pose(problem, &after),
                    seed,
                ),
            },
            p_value,
            alternatives,
            to_separate: inseparable.map(|k| self.to_separate(problem, candidates, best, k)),
        })
    }

    fn alternatives(
        &self,
        problem: &Problem<'_>,
        candidates: &[Candidate],
        seed: u64,
    ) -> Vec<Alternative> {
        let whitened = |k: usize| -> Vec<f64> {
            self.fits[k].held_out.iter().map(|g| g.component_mul(&self.weights).norm()).collect()
        };
        let rows = per_pose(problem, &vec![1.0; problem.data.rows.len()]);
        let best = per_pose(problem, &whitened(self.order[0]));
        let others = self.order[1..].iter().map(|&k| {
            let other = per_pose(problem, &whitened(k));
            let difference: Vec<f64> = other.iter().zip(&best).map(|(o, b)| o - b).collect();
            Alternative {
                effect: candidates[k].effect.identifier(),
                place: candidates[k].place.to_string(),
                held_out_after: rms(&main_size(problem, &self.fits[k].held_out)),
                separable: excludes_zero(mean_interval(&difference, &rows, seed)),
            }
        });
        others.collect()
    }

    /// The row of this data at which the two fitted explanations differ most.
    fn to_separate(
        &self,
        problem: &Problem<'_>,
        candidates: &[Candidate],
        best: usize,
        other: usize,
    ) -> String {
        let pairs = self.fits[best].point.gaps.iter().zip(&self.fits[other].point.gaps);
        let apart: Vec<_> = pairs.map(|(a, b)| a - b).collect();
        let whitened = |k: &usize| apart[*k].component_mul(&self.weights).norm();
        let row = (0..apart.len()).max_by(|a, b| whitened(a).total_cmp(&whitened(b))).unwrap_or(0);
        let size = main_size(problem, &apart)[row];
        let unit = if measures_position(problem) { "m" } else { "rad" };
        let (found, alternative) = (candidates[best].place, candidates[other].place);
        format!(
            "measure again, with more load, at the pose of line {}: there {found} and \
             {alternative} \
             predict readings {size:.1e} {unit} apart, more than elsewhere in this data",
            problem.data.rows[row].line
        )
    }

    /// Held-out share of each place alone, by its best effect.
    pub(crate) fn shares(&self, problem: &Problem<'_>, candidates: &[Candidate]) -> Vec<Share> {
        let whole = squares(&problem.gaps, &self.weights);
        let mut shares: Vec<Share> = Vec::new();
        for &k in &self.order {
            let place = candidates[k].place.to_string();
            let share = 1.0 - squares(&self.fits[k].held_out, &self.weights) / whole;
            if share > 0.0 && !shares.iter().any(|s| s.place == place) {
                shares.push(Share { place, share });
            }
        }
        shares
    }
}

/// Weighted sum of squares.
fn squares(gaps: &[Vector6<f64>], weights: &Vector6<f64>) -> f64 {
    gaps.iter().map(|g| g.component_mul(weights).norm_squared()).sum()
}

fn measures_position(problem: &Problem<'_>) -> bool {
    problem.data.kind.components()[..3].contains(&true)
}

/// Whether the gap is larger than rounding error: else there is nothing to explain.
pub(crate) fn is_there(problem: &Problem<'_>) -> bool {
    let size = Statistics::of(&problem.gaps);
    size.position_max > ROUNDING * (1.0 + problem.reach) || size.rotation_rms > ROUNDING
}

/// Size of each gap in what the file measures first: translations, or rotations if there are none.
fn main_size(problem: &Problem<'_>, gaps: &[Vector6<f64>]) -> Vec<f64> {
    let first = if measures_position(problem) { 0 } else { 3 };
    gaps.iter().map(|g| g.fixed_rows::<3>(first).norm()).collect()
}

/// Sums of squares of each pose.
fn per_pose(problem: &Problem<'_>, sizes: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; problem.data.poses];
    for (row, size) in problem.data.rows.iter().zip(sizes) {
        sums[row.group] += size * size;
    }
    sums
}

/// Values of the exact fit with their intervals.
fn parameters(problem: &Problem<'_>, candidate: &Candidate, fit: &Fit) -> Vec<ParameterReport> {
    let numbers = problem.data.rows.len() * problem.data.components();
    let freedom = numbers.saturating_sub(fit.values.len()).max(1) as f64;
    let t = StudentsT::new(0.0, 1.0, freedom).map_or(f64::MAX, |t| t.inverse_cdf(0.975));
    let variances = fit.normal.variances() * (fit.normal.rr / freedom);
    let each = candidate.parameters.iter().zip(fit.values.iter()).zip(variances.iter());
    each.map(|((parameter, value), variance)| {
        let half = t * variance.max(0.0).sqrt();
        ParameterReport {
            name: parameter.name,
            value: *value,
            unit: parameter.unit,
            ci95: [value - half, value + half],
        }
    })
    .collect()
}
