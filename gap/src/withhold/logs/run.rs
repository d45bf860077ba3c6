//! Running all cases of logs.

use core::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::bench::{Bench, Planted, may_show};
use super::report::{Asked, LogCase, LogReport, LogVerdict};
use super::{LogPlan, LogWithholdError};
use crate::log::{Log, LogOptions, Names, diagnose};
use crate::plant::motion::{Law, Logged, MotionError, MotionTruth, MovingPlant, csv, known};
use crate::rng::{Rng, Stream, seed_of};
use crate::withhold::Kind;
use crate::withhold::report::Named;

/// Of every twenty cases five are without an effect, twelve with one, and three with one that the
/// diagnosis does not know.
const TURNS: [Kind; 20] = {
    use Kind::{None as N, Removed as R, Single as S};
    [S, N, S, R, S, S, N, S, S, N, S, R, S, N, S, S, R, S, N, S]
};

/// The kind of the `k`-th case, and which of its kind it is, both from 0.
fn turn(k: usize) -> (Kind, usize) {
    let kind = TURNS[k % TURNS.len()];
    let of_kind = |turns: &[Kind]| turns.iter().filter(|t| **t == kind).count();
    let (rounds, rest) = (k / TURNS.len(), k % TURNS.len());
    (kind, rounds * of_kind(&TURNS) + of_kind(&TURNS[..rest]))
}

/// Runs the check. `progress` is told of every case that is done; the result does not depend on how
/// many are worked on at once.
///
/// # Errors
/// [`LogWithholdError`]: a plan that cannot be carried out, or not a single case that could be
/// diagnosed.
pub fn withhold(
    plan: &LogPlan<'_>,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<LogReport, LogWithholdError> {
    let [from, to] = plan.multiple;
    if plan.cases == 0 || !(from > 0.0 && from <= to && to.is_finite()) {
        return Err(LogWithholdError::Plan { cases: plan.cases, from, to });
    }
    let threads = plan.threads.max(1);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool =
        pool.map_err(|error| LogWithholdError::Threads { threads, reason: error.to_string() })?;
    let bench = Bench::new(plan)?;
    let asked = plan.effects.iter().filter(|law| may_show(law, plan.logged));
    let (mut shown, hidden): (Vec<&'static Law>, Vec<_>) = asked
        .copied()
        .partition(|law| bench.plant(law, to, &mut Rng::new(plan.seed, Stream::Truths)).is_some());
    Rng::new(plan.seed, Stream::Truths).shuffle(&mut shown);
    let done = AtomicUsize::new(0);
    let cases: Result<Vec<LogCase>, MotionError> = pool.install(|| {
        (0..plan.cases)
            .into_par_iter()
            .map(|k| {
                let case = one(&bench, &shown, k);
                progress(1 + done.fetch_add(1, Ordering::Relaxed), plan.cases);
                case
            })
            .collect()
    });
    let cases = cases?;
    let first = cases.iter().find_map(|case| case.error.clone());
    match first.filter(|_| cases.iter().all(|case| case.verdict.is_none())) {
        Some(reason) => Err(LogWithholdError::Diagnose(reason)),
        None => Ok(LogReport::of(plan, cases, &hidden)),
    }
}

fn one(bench: &Bench<'_>, effects: &[&'static Law], k: usize) -> Result<LogCase, MotionError> {
    let (plan, (kind, nth)) = (bench.plan, turn(k));
    let seed = seed_of(plan.seed, k);
    let mut rng = Rng::new(seed, Stream::Truths);
    let planted = match kind {
        Kind::None => None,
        // From the other end, so that a few cases already show most effects.
        _ if effects.is_empty() => None,
        kind => {
            let nth = nth % effects.len();
            let which = if kind == Kind::Removed { effects.len() - 1 - nth } else { nth };
            bench.plant(effects[which], rng.between(plan.multiple[0], plan.multiple[1]), &mut rng)
        }
    };
    let kind = if planted.is_none() { Kind::None } else { kind };
    let asked = Asked {
        kind,
        truth: planted.as_ref().map(|p| p.truth.to_string()),
        label: planted.as_ref().map(|p| Named::new(p.truth.law.name, &p.truth.spot)),
        multiple: planted.as_ref().map(|p| p.multiple),
    };
    let options = options(plan, &asked, seed);
    let found = |planted| Ok(diagnosed(plan, &text(plan, planted, seed)?, &options));
    let without = if kind == Kind::Removed { found(None)?.ok() } else { None };
    Ok(match found(planted.as_ref())? {
        Ok(verdict) => LogCase { asked, verdict: Some(verdict), without, error: None },
        Err(error) => LogCase { asked, verdict: None, without, error: Some(error) },
    })
}

/// The arm with some truths and those that the robot file knows.
pub(super) fn plant<'p>(
    plan: &LogPlan<'p>,
    truths: &[MotionTruth],
) -> Result<MovingPlant<'p>, MotionError> {
    let known = known(&plan.options.known, plan.arm, plan.stages.len(), plan.logged);
    let known = known
        .map_err(|error| MotionError { arm: plan.arm.name.clone(), fault: error.to_string() })?;
    let all = [&known, truths].concat();
    Ok(MovingPlant::new(plan.arm, &all, plan.logged, plan.recording))
}

/// The log as a file.
fn text(plan: &LogPlan<'_>, planted: Option<&Planted>, seed: u64) -> Result<String, MotionError> {
    let truths: Vec<_> = planted.iter().map(|p| p.truth.clone()).collect();
    let plant = plant(plan, &truths)?;
    Ok(csv(plan.arm, plan.logged, &plant.record(plan.stages, seed)?, &[]))
}

/// What the diagnosis says of a file.
fn diagnosed(plan: &LogPlan<'_>, told: &str, options: &LogOptions) -> Result<LogVerdict, String> {
    let motions: Vec<_> = plan.arm.joints.iter().map(|joint| joint.motion).collect();
    let log = Log::from_bytes("withheld", told.as_bytes(), &motions, &Names::default());
    let log = log.map_err(|error| error.to_string())?;
    let found = diagnose(plan.arm, &log, options).map_err(|error| error.to_string())?;
    Ok(LogVerdict::of(&found))
}

/// The plan's options; of a case with a removed effect, all of the catalogue but that.
fn options(plan: &LogPlan<'_>, asked: &Asked, seed: u64) -> LogOptions {
    let mut options = LogOptions { seed, ..plan.options.clone() };
    if let (Kind::Removed, Some(label)) = (asked.kind, &asked.label) {
        let known = plan.options.catalogue.iter().map(|effect| effect.identifier().to_owned());
        let allowed =
            |name: &String| options.effects.as_ref().is_none_or(|only| only.contains(name));
        let known = known.filter(|name| allowed(name) && *name != label.effect);
        options.effects = Some(known.collect());
    }
    if plan.logged == Logged::Position {
        options.rows = Some(crate::log::Domain::Position);
    }
    options
}
