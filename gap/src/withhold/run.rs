//! Running all cases.

use rayon::prelude::*;

use super::bench::Bench;
use super::case::Setup;
use super::predict::squares;
use super::report::{Case, Named, Report};
use super::verdict::Verdict;
use super::{Kind, Plan, WithholdError, exact, summary};
use crate::diagnose::{DiagnoseError, Diagnosis, Options, diagnose};
use crate::plant::{Truth, blurred};
use crate::rng::seed_of;

/// Runs the check. `progress` is told how many cases of how many are done; the result does not
/// depend on how many are worked on at once.
///
/// # Errors
/// [`WithholdError`]: a plan that cannot be carried out, or not a single case that could be
/// diagnosed.
pub fn withhold(
    plan: &Plan<'_>,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Report, WithholdError> {
    let [from, to] = plan.multiple;
    if plan.cases == 0 {
        return Err(WithholdError::NoCases);
    }
    if !(from > 0.0 && from <= to && to.is_finite()) {
        return Err(WithholdError::Multiple { from, to });
    }
    let threads = plan.threads.max(1);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool =
        pool.map_err(|error| WithholdError::Threads { threads, reason: error.to_string() })?;
    let bench = Bench::new(plan)?;
    let (effects, hidden) = bench.shows();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let cases: Result<Vec<(Case, Option<DiagnoseError>)>, WithholdError> = pool.install(|| {
        (0..plan.cases)
            .into_par_iter()
            .map(|k| {
                let setup = bench.set_up(k, &effects)?;
                let case = run_case(plan, &setup);
                progress(1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed), plan.cases);
                Ok(case)
            })
            .collect()
    });
    let (cases, errors): (Vec<Case>, Vec<Option<DiagnoseError>>) = cases?.into_iter().unzip();
    match errors.iter().flatten().next() {
        Some(first) if cases.iter().all(|case| case.verdict.is_none()) => Err(first.clone().into()),
        _ => Ok(summary::report(plan, cases, hidden)),
    }
}

fn run_case(plan: &Plan<'_>, setup: &Setup) -> (Case, Option<DiagnoseError>) {
    let labels: Vec<Named> = setup
        .planted
        .iter()
        .map(|p| Named::new(p.truth.effect.identifier(), &p.truth.place))
        .collect();
    let data = blurred(&setup.exact, plan.noise, setup.seed);
    let found = diagnose(plan.arm, &data, &options(plan, setup, &labels));
    let mut case = Case {
        kind: setup.kind,
        truths: setup.planted.iter().map(|p| p.truth.to_string()).collect(),
        labels,
        multiples: setup.planted.iter().map(|p| p.multiple).collect(),
        verdict: None,
        error: None,
        after: None,
        realised: None,
    };
    match found {
        Ok(found) => {
            let verdict = Verdict::of(&found);
            case.after = Some(in_noise(plan, &verdict));
            if setup.kind == Kind::Single && verdict.shrink.is_some() {
                case.realised = realised_of(plan, setup, &found);
            }
            case.verdict = Some(verdict);
            (case, None)
        }
        Err(error) => {
            case.error = Some(error.to_string());
            (case, Some(error))
        }
    }
}

/// The plan's options; of a case with a removed effect, all of the catalogue but that.
fn options(plan: &Plan<'_>, setup: &Setup, labels: &[Named]) -> Options {
    let mut options = plan.options.clone();
    options.seed = setup.seed;
    let components = plan.design.kind.components();
    options.noise_position = Some(plan.noise.position).filter(|_| components[..3].contains(&true));
    options.noise_rotation = Some(plan.noise.rotation).filter(|_| components[3..].contains(&true));
    if setup.kind == Kind::Removed {
        let known = options.catalogue.identifiers().into_iter().map(str::to_owned);
        let allowed = |name: &String| options.effects.as_ref().is_none_or(|e| e.contains(name));
        let removed = |name: &String| labels.iter().any(|label| label.effect == *name);
        options.effects = Some(known.filter(|name| allowed(name) && !removed(name)).collect());
    }
    options
}

/// The gap that is left in multiples of the noise: in position, or in rotation where no position is
/// measured.
fn in_noise(plan: &Plan<'_>, verdict: &Verdict) -> f64 {
    let components = plan.design.kind.components();
    let count =
        |range: core::ops::Range<usize>| (range.filter(|k| components[*k]).count() as f64).sqrt();
    if components[..3].contains(&true) {
        verdict.after_position / (count(0..3) * plan.noise.position)
    } else {
        verdict.after_rotation / (count(3..6) * plan.noise.rotation)
    }
}

/// 1 − rms after / rms before, over all fresh sessions.
fn realised_of(plan: &Plan<'_>, setup: &Setup, found: &Diagnosis) -> Option<f64> {
    let predict = plan.predict?;
    let truths: Vec<Truth> = setup.planted.iter().map(|p| p.truth.clone()).collect();
    let (mut before, mut after) = (0.0, 0.0);
    for (k, fresh) in plan.fresh.iter().enumerate() {
        let seed = seed_of(setup.seed, k);
        let shown = |truths: &[Truth]| exact(plan.whole(), truths, None, fresh).ok();
        let measured = blurred(&shown(&truths)?, plan.noise, seed);
        let sums = squares(&measured, &shown(&[])?, &predict(found, fresh)?);
        before += sums[0];
        after += sums[1];
    }
    (before > 0.0).then(|| 1.0 - (after / before).sqrt())
}
