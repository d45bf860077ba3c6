//! The diagnosis: which joint's compliance, if any, closes the gap, judged on poses that no fit
//! has seen.
//!
//! 1. The gap of the model as it is, whitened by the noise.
//! 2. Each effect at each place that the data can show is fitted exactly; the one with the least
//!    held-out gap is chosen.
//! 3. It is a finding if it is significant (signs of whole poses flipped, corrected for the number
//!    of candidates) and if the held-out gap shrinks.
//! 4. Alternatives that resampling the poses does not tell from it are named as such.
//!
//! This version adds one finding at most.

mod bootstrap;
mod fit;
mod folds;
mod judge;
mod noise;
mod normal;
mod options;
mod problem;
mod report;
mod rival;
mod rng;
mod significance;
mod visibility;

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

pub use options::{DiagnoseError, Options};
pub use report::{
    Alternative, CannotSee, Diagnosis, Finding, GapReport, HeldOut, NoiseReport, ParameterReport,
    Rival, Share, Shrink, Unexplained,
};

use crate::gap::Statistics;
use crate::measurement::Measurements;
use fit::Candidate;
use folds::Folds;
use judge::{Judged, is_there};
use noise::Noise;
use problem::Problem;

/// Tells where the gap between `arm` and `data` comes from.
///
/// # Errors
/// [`DiagnoseError`]: what in the options or the data stands in the way.
pub fn diagnose(
    arm: &Arm,
    data: &Measurements,
    options: &Options,
) -> Result<Diagnosis, DiagnoseError> {
    options.check()?;
    let effects = options.effects()?;
    let problem = Problem::new(arm, data)?;
    let folds = Folds::deal(data, options)?;
    let rivals: Vec<_> = options
        .rivals
        .iter()
        .map(|name| rival::Rival::read(data, name))
        .collect::<Result<_, _>>()?;
    let (mut candidates, cannot_see) = visibility::candidates(&problem, &effects);
    enough_rows(&problem, &folds, &candidates)?;
    if !is_there(&problem) {
        candidates.clear();
    }

    let judged = Judged::of(&problem, &folds, &candidates, options);
    let before = Statistics::of(&problem.gaps);
    let finding = judged.accepted(&problem, &candidates, options);
    let (residual, held_out, parameters) = match &finding {
        Some(_) => {
            let best = &judged.fits[judged.order[0]];
            (&best.point.gaps, &best.held_out, best.values.len())
        }
        None => (&problem.gaps, &problem.gaps, 0),
    };
    let after = Statistics::of(held_out);
    let noise = Noise::of(&problem, options, residual, parameters);
    let compared = rivals.iter().map(|r| r.compare(data, held_out, options.seed)).collect();
    Ok(Diagnosis {
        stiffarm: options.version.clone(),
        robot: arm.name.clone(),
        measurements: data.rows.len(),
        held_out: HeldOut { folds: folds.count, grouped_by: "pose" },
        gap: GapReport { before, after, noise: noise.report() },
        places: judged.shares(&problem, &candidates),
        findings: finding.into_iter().collect(),
        cannot_see,
        unexplained: unexplained(&noise, residual, parameters, &after),
        rivals: (!rivals.is_empty()).then_some(compared),
    })
}

/// Every fold must leave at least as many measured numbers as an effect has parameters.
fn enough_rows(
    problem: &Problem<'_>,
    folds: &Folds,
    candidates: &[Candidate],
) -> Result<(), DiagnoseError> {
    let parameters = candidates.iter().map(|c| c.parameters.len()).max().unwrap_or(0);
    let rows = &problem.data.rows;
    let kept = |fold| rows.iter().filter(|r| folds.of_pose[r.group] != fold).count();
    let least = (0..folds.count).map(kept).min().unwrap_or(0) * problem.data.components();
    if least >= parameters {
        return Ok(());
    }
    Err(DiagnoseError::TooFewRows { file: problem.data.file.clone(), rows: rows.len(), parameters })
}

fn unexplained(
    noise: &Noise,
    residual: &[Vector6<f64>],
    parameters: usize,
    after: &Statistics,
) -> Unexplained {
    if !noise.exceeded(residual, parameters) {
        return Unexplained::default();
    }
    let beyond = after.position_rms.powi(2) - noise.report().position_rms.powi(2);
    Unexplained { present: true, position_rms: beyond.max(0.0).sqrt(), ..Unexplained::default() }
}

#[cfg(test)]
mod tests;
