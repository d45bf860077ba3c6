//! Running all cases: kinds in fixed proportion, effects in turn, places and sizes at random.

use core::sync::atomic::{AtomicUsize, Ordering};

use super::report::{Case, Named, Report};
use super::{Experiment, Kind, Plan, WithholdError, campaign, motion, summary};
use crate::parallel;
use crate::rng::{Rng, Stream, seed_of};

/// A plant with the diagnosis that gets its data.
pub(super) trait Bench: Sync {
    /// What may be put in.
    type Effect: Copy + Sync;
    /// An effect at a place with its size.
    type Truth: Clone + core::fmt::Display + Sync;

    /// Kinds of every twenty cases.
    const TURNS: [Kind; 20];

    /// The plan's effects as far as such an experiment may show them.
    fn effects(&self) -> Vec<Self::Effect>;

    /// The identifier of one.
    fn identifier(effect: Self::Effect) -> &'static str;

    /// An effect at a random place, its error about `multiple` times the noise. `None` if it does
    /// not show anywhere.
    fn plant(
        &self,
        effect: Self::Effect,
        multiple: f64,
        rng: &mut Rng,
    ) -> Option<Planted<Self::Truth>>;

    /// Measures a plant with these truths, diagnoses it, and fills in what the case says of that.
    ///
    /// # Errors
    /// [`WithholdError`]: several effects together are too much for the arm.
    fn judge(
        &self,
        truths: &[Self::Truth],
        seed: u64,
        case: &mut Case,
    ) -> Result<(), WithholdError>;
}

/// An effect put in.
pub(super) struct Planted<T> {
    pub(super) truth: T,
    pub(super) label: Named,
    pub(super) multiple: f64,
}

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
    match &plan.experiment {
        Experiment::Campaign(own) => run(plan, &campaign::Bench::new(plan, own)?, progress),
        Experiment::Log(own) => run(plan, &motion::Bench::new(plan, own)?, progress),
    }
}

fn run<B: Bench>(
    plan: &Plan<'_>,
    bench: &B,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Report, WithholdError> {
    let threads = plan.threads.max(1);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool =
        pool.map_err(|error| WithholdError::Threads { threads, reason: error.to_string() })?;
    let (effects, hidden) = shown(plan, bench);
    let done = AtomicUsize::new(0);
    let one = |k: usize| {
        let case = case(plan, bench, &effects, k);
        progress(1 + done.fetch_add(1, Ordering::Relaxed), plan.cases);
        case
    };
    let cases = pool.install(|| parallel::tried(plan.cases, &one))?;
    let first = cases.iter().find_map(|case| case.error.clone());
    match first.filter(|_| cases.iter().all(|case| case.verdict.is_none())) {
        Some(reason) => Err(WithholdError::Diagnose(reason)),
        None => {
            let hidden =
                hidden.into_iter().map(|effect| B::identifier(effect).to_owned()).collect();
            Ok(summary::report(plan, cases, hidden))
        }
    }
}

/// Which of the plan's effects show in this experiment at some place, in random order, and which do
/// not.
pub(super) fn shown<B: Bench>(plan: &Plan<'_>, bench: &B) -> (Vec<B::Effect>, Vec<B::Effect>) {
    let start = || Rng::new(plan.seed, Stream::Truths);
    let shows = |effect: &B::Effect| bench.plant(*effect, plan.multiple[1], &mut start()).is_some();
    let (mut shown, hidden): (Vec<_>, Vec<_>) = bench.effects().into_iter().partition(shows);
    start().shuffle(&mut shown);
    (shown, hidden)
}

/// The kind of the `k`-th case, and which of its kind it is, both from 0.
fn turn(k: usize, turns: &[Kind; 20]) -> (Kind, usize) {
    let kind = turns[k % turns.len()];
    let of_kind = |turns: &[Kind]| turns.iter().filter(|t| **t == kind).count();
    let (rounds, rest) = (k / turns.len(), k % turns.len());
    (kind, rounds * of_kind(turns) + of_kind(&turns[..rest]))
}

/// The `k`-th case. `effects` are those that show.
fn case<B: Bench>(
    plan: &Plan<'_>,
    bench: &B,
    effects: &[B::Effect],
    k: usize,
) -> Result<Case, WithholdError> {
    let (kind, nth) = turn(k, &B::TURNS);
    let seed = seed_of(plan.seed, k);
    let mut rng = Rng::new(seed, Stream::Truths);
    let [low, high] = plan.multiple;
    let mut put = |effect: B::Effect| {
        let multiple = rng.between(low, high);
        bench.plant(effect, multiple, &mut rng)
    };
    let in_turn = |n: usize| effects[n % effects.len()];
    let planted: Vec<Planted<B::Truth>> = match kind {
        _ if effects.is_empty() => Vec::new(),
        Kind::None => Vec::new(),
        Kind::Single => put(in_turn(nth)).into_iter().collect(),
        // From the other end, so that a few cases already show most effects.
        Kind::Removed => {
            put(in_turn(effects.len() - 1 - nth % effects.len())).into_iter().collect()
        }
        Kind::Pair => {
            // Every effect meets all others in the course of many cases.
            let step = 1 + (nth / effects.len()) % (effects.len() - 1).max(1);
            [in_turn(nth), in_turn(nth + step)].into_iter().filter_map(&mut put).collect()
        }
    };
    let kind = match planted.len() {
        0 => Kind::None,
        1 if kind == Kind::Pair => Kind::Single,
        _ => kind,
    };
    let truths: Vec<B::Truth> = planted.iter().map(|p| p.truth.clone()).collect();
    let mut case = Case {
        kind,
        truths: truths.iter().map(B::Truth::to_string).collect(),
        multiples: planted.iter().map(|p| p.multiple).collect(),
        labels: planted.into_iter().map(|p| p.label).collect(),
        verdict: None,
        without: None,
        error: None,
        after: None,
        realised: None,
    };
    bench.judge(&truths, seed, &mut case)?;
    Ok(case)
}

/// The identifiers that the diagnosis of a case knows: of a case with a removed effect, all of the
/// catalogue that are `allowed` but that; else what is allowed.
pub(super) fn known_to(
    case: &Case,
    catalogue: impl Iterator<Item = &'static str>,
    allowed: Option<&Vec<String>>,
) -> Option<Vec<String>> {
    if case.kind != Kind::Removed {
        return allowed.cloned();
    }
    let is_allowed = |name: &&str| allowed.is_none_or(|all| all.iter().any(|own| own == name));
    let removed = |name: &str| case.labels.iter().any(|label| label.effect == name);
    let known = catalogue.filter(is_allowed).filter(|name| !removed(name));
    Some(known.map(str::to_owned).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_come_in_proportion_and_effects_in_turn() {
        let turns = <campaign::Bench<'_> as Bench>::TURNS;
        let count = |kind: Kind| (0..200).filter(|k| turn(*k, &turns).0 == kind).count();
        assert_eq!(
            [Kind::None, Kind::Single, Kind::Pair, Kind::Removed].map(count),
            [50, 90, 30, 30]
        );
        let all = (0..60).map(|k| turn(k, &turns));
        let singles: Vec<usize> =
            all.filter(|(k, _)| *k == Kind::Single).map(|(_, nth)| nth).collect();
        assert_eq!(singles, (0..27).collect::<Vec<_>>());
    }
}
