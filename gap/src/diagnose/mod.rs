//! The diagnosis: where the gap between model and measurement lies, which unmodelled effects cause
//! it, and how far it shrinks when they are put into the model, judged on poses that no fit has
//! seen.
//!
//! A residual goes through the rooms in this order, each of which says on its page what comes in and
//! what goes out:
//!
//! 1. `data`: the rows as they are to be explained, the folds, the noise.
//! 2. `fit`: frames that are known to be unknown are fitted first, and along with everything after.
//! 3. `normal_equations`: one pass over the data sums up what every candidate (an effect at a place, in one
//!    form) does to the measured quantities; all that is asked of it then is algebra, `infer`'s.
//! 4. `identifiability`: what this data cannot show is told before anything is fitted.
//! 5. `search`: effects are added one by one, then fitted exactly, and the others taken back or
//!    exchanged where that makes them superfluous, by the evidence that logs are judged by, too.
//! 6. `verdict`: the findings are held out together, every candidate is tried in the place of each,
//!    and what is left is tested for structure.
//! 7. `prediction`: what was found as a model that predicts.
//!
//! [`Options`] say what may be chosen, a [`Diagnosis`] is what is reported.

pub(crate) mod data;
pub(crate) mod fit;
mod identifiability;
mod look;
mod normal_equations;
mod options;
mod prediction;
mod prior;
mod progress;
pub(crate) mod search;
mod verdict;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

pub use data::LARGEST;
pub(crate) use data::Problem;
pub(crate) use fit::{aligned, prior_penalty, refit_roughly, rigid};
use options::LEAST_POSES;
pub use options::{DiagnoseError, Nuisance, Options, TOLERANCE};
pub use prediction::{Expected, Explanation, Prediction, Trust};
pub use prior::Prior;
pub use progress::{Stage, Stop};

use crate::gap::Statistics;
use crate::infer::Observations;

use crate::measurement::Measurements;
use crate::mistakes::{self, Mended};
pub use crate::report::campaign as report;
pub use crate::report::campaign::*;
pub use crate::report::{Alternative, Parameter as ParameterReport};
pub use crate::shrink::Shrink;
use crate::spring::{Joined, Spring};
use data::{Folds, Precision};
use fit::{Axes, Model};
use normal_equations::Candidate;
use search::{Explained, Search};

/// Rounds of explaining and of leaving out what does not fit: after two of them hardly a row changes.
const MOST_ROUNDS: usize = 4;

/// Precisions of rows that change by less than this part have converged.
const SAME_PRECISION: f64 = 0.05;

/// A diagnosis, and the models before and after it.
pub struct Diagnosed {
    /// What was found.
    pub diagnosis: Diagnosis,
    /// The same as models that predict.
    pub explanation: Explanation,
    /// The same beside the springs that a log tells too; where [`Options::springs`] has any.
    pub beside_log: Option<BesideLog>,
    /// The arm and the rows that all of it is of, where the given ones have mistakes.
    pub mended: Option<Mended>,
}

/// What a campaign says together with a log.
pub struct BesideLog {
    /// The springs of which both tell, and one has found something.
    pub springs: Vec<Joined>,
    /// The model with the springs that both tell, and everything else fitted beside them.
    pub explanation: Explanation,
    /// Joints whose springs the rows contradict.
    contradicted: Vec<usize>,
}

/// Tells where the gap between `arm` and `data` comes from.
///
/// # Errors
/// [`DiagnoseError`]: what in the options or the data stands in the way.
pub fn diagnose(
    arm: &Arm,
    data: &Measurements,
    options: &Options,
) -> Result<Diagnosis, DiagnoseError> {
    diagnose_with(arm, data, options, &|_| {}).map(|d| d.diagnosis)
}

/// The same, with the models that were found, telling `progress` how far it is.
///
/// # Errors
/// As [`diagnose`].
pub fn diagnose_with(
    arm: &Arm,
    data: &Measurements,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Diagnosed, DiagnoseError> {
    options.check()?;
    progress(Stage::Align);
    options.effects()?;
    let mut options = options.clone();
    options.nuisances = Nuisance::unknown(data, &options.nuisances);
    let (mut mistaken, mended) = mistakes::find(arm, data, &options).unzip();
    let mended = mended.flatten();
    // In a gap that is no arm's there is nothing to be found.
    let is_no_arms = mistaken.is_some() && mended.is_none();
    if is_no_arms || mended.as_ref().is_some_and(|mended| !mended.is_whole) {
        options.effects = Some(Vec::new());
    }
    let (arm, data) = mended.as_ref().map_or((arm, data), |mended| (&mended.arm, &mended.data));
    if let Some(mended) = &mended {
        options.known.clone_from(&mended.known);
    }
    let displaced = || mistakes::displaced(arm, data, &options, mistaken.clone());
    if let Some((told, frames)) = (!is_no_arms).then(displaced).flatten() {
        mistaken = Some(told);
        options.nuisances.extend(frames);
    }
    let mut diagnosed = diagnose_as_told(arm, data, &options, &[], progress)?;
    // In one fit a spring that is not the rows' would be made up for by other effects: they are asked without it first.
    let (mut springs, mut agree) = (Vec::new(), options.springs.clone());
    while let Some(beside_log) = &diagnosed.beside_log {
        agree.retain(|spring| !beside_log.contradicted.contains(&spring.joint));
        if agree == springs {
            break;
        }
        springs.clone_from(&agree);
        diagnosed = diagnose_as_told(arm, data, &options, &springs, progress)?;
    }
    diagnosed.diagnosis.mistaken = mistaken;
    Ok(Diagnosed { mended, ..diagnosed })
}

/// The same of an arm and rows that are taken to mean what they say, in one fit with `springs` of a log.
fn diagnose_as_told(
    arm: &Arm,
    data: &Measurements,
    options: &Options,
    springs: &[Spring],
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Diagnosed, DiagnoseError> {
    let effects = options.effects()?;
    let mut problem = Problem::new(arm, data, options)?;
    problem.precision = Precision::of(data);
    problem.springs = springs.to_vec();
    let folds = Folds::deal(data, options)?;
    enough_rows(&problem, &folds)?;
    let compared: Vec<_> = options
        .rivals
        .iter()
        .map(|name| verdict::Rival::read(data, name))
        .collect::<Result<_, _>>()?;
    let mut candidates = Candidate::all(&problem, &effects);
    let mut model = fit::aligned(&problem)?;
    normal_equations::scale_elastic(&mut candidates, &problem, &model)?;
    let (mut known, mut left_out, mut round) = (None, Vec::new(), 0);
    let looked = loop {
        let search =
            Search { problem: &problem, folds: &folds, candidates: &candidates, options, progress };
        let looked = search.look(&effects, &model, known)?;
        let (fits, out, precision) = search.fitting(&looked.explained)?;
        let fit = options.keep_all || fits == problem.fits;
        let converged = fit && precision.is_near(&problem.precision, SAME_PRECISION);
        let ends = converged || round == MOST_ROUNDS || search.stopped();
        let hung = if ends { search.with_loads_as_measured(&looked.explained)? } else { None };
        // The last fit is that of the rows that are told.
        if !options.keep_all && (fit || !ends) {
            (problem.fits, left_out) = (fits, out);
        }
        if hung.is_some() {
            model.axes = Axes::Measuring;
            (known, round) = (hung, 0);
            continue;
        }
        if ends {
            break looked;
        }
        round += 1;
        known = Some(looked.explained.fit.model);
        problem.precision = precision;
    };
    if !looked.is_there {
        candidates.clear();
    }
    let search =
        Search { problem: &problem, folds: &folds, candidates: &candidates, options, progress };
    let (before, nominal) = (looked.before, looked.start.fit.model.clone());
    let (explained, judged) =
        search.judged(&looked.start, looked.explained, &before, looked.is_there)?;
    let (findings, after, unexplained) = (judged.findings, judged.after, judged.unexplained);
    let nested = |folds: &Folds| -> Result<Option<Statistics>, DiagnoseError> {
        let gaps = options.nested.then(|| search.nested(&model, folds)).transpose()?;
        Ok(gaps.map(|gaps| problem.statistics(&gaps)))
    };
    let in_time = Folds::fifths(data);
    let (nested, nested_in_time) = (nested(&folds)?, in_time.map_or(Ok(None), |f| nested(&f))?);
    let [size, statistics] = [&before, &after].map(|gaps| problem.statistics(gaps));
    let compare = |r: &verdict::Rival| r.compare(data, &problem.fits, &after, options.seed);
    let compared = compared.iter().map(compare).collect();
    let mut diagnosis = Diagnosis {
        stiffarm: options.version.clone(),
        robot: arm.name.clone(),
        measurements: data.rows.len(),
        held_out: HeldOut { folds: folds.count, grouped_by: "pose".into() },
        gap: GapReport {
            before: size,
            after: statistics,
            shrink: judged.shrink,
            fitted: problem.statistics(&explained.fit.predicted.gaps),
            nested,
            nested_in_time,
            noise: explained.noise.report(),
            at_tool: None,
        },
        mistaken: None,
        places: looked.places,
        findings,
        cannot_see: looked.cannot_see,
        unexplained,
        residual: judged.residual,
        observability: judged.observability,
        gauge: looked.gauge,
        left_out,
        parts: looked.parts,
        by: search.slices(&before, &after),
        nuisances: verdict::nuisances(&problem, &explained.fit.model),
        bench: judged.bench,
        pairs: judged.pairs,
        geometry_along: problem.along.is_some(),
        hangs_as_measured: explained.fit.model.axes == Axes::Measuring,
        covers: verdict::cover(&problem),
        rivals: (!options.rivals.is_empty()).then_some(compared),
        stopped: options.stop.is_asked(),
    };
    let told = |now: Explained| {
        let models = [nominal.clone(), now.fit.model.clone()];
        Explanation::new(&problem, models, search.spread(&now), &diagnosis.covers, options)
    };
    let beside_log = match &options.springs[..] {
        [] => None,
        of_log => {
            let slides = |joint: usize| arm.joints[joint].motion == Motion::Prismatic;
            let own = search.springs(&explained)?;
            let springs = Joined::all(&own, of_log, slides);
            let explanation = told(search.beside_springs(&explained, &springs)?);
            let differs = |own: &&Spring| {
                of_log.iter().any(|other| other.joint == own.joint && other.and(own).is_none())
            };
            let contradicted = own.iter().filter(differs).map(|own| own.joint).collect();
            Some(BesideLog { springs, explanation, contradicted })
        }
    };
    let explanation = told(explained);
    diagnosis.gap.at_tool = explanation.at_tool(data)?;
    Ok(Diagnosed { diagnosis, explanation, beside_log, mended: None })
}

/// Every fold must leave poses by which each base is told.
fn enough_of_each_session(problem: &Problem<'_>, folds: &Folds) -> Result<(), DiagnoseError> {
    let bases = problem.stands.bases.len();
    if bases == 1 || !problem.is_unknown(Nuisance::BaseFrame) {
        return Ok(());
    }
    let mut held = vec![vec![0; folds.count]; bases];
    let mut seen = vec![vec![false; bases]; problem.data.poses];
    let rows = problem.data.rows.iter().zip(&problem.stands.base_of);
    for (number, (row, base)) in rows.enumerate() {
        if !std::mem::replace(&mut seen[row.group][*base], true) {
            held[*base][folds.of_row(number)] += 1;
        }
    }
    for (base, held) in held.into_iter().enumerate() {
        let most: usize = held.iter().copied().max().unwrap_or(0);
        let poses = held.iter().sum::<usize>() - most;
        if poses < LEAST_POSES {
            let (file, session) =
                (problem.data.file.clone(), problem.stands.base(base).unwrap_or_default());
            return Err(DiagnoseError::ShortSession { file, session, poses });
        }
    }
    Ok(())
}

/// Every fold must leave more measured numbers than there are frames to fit.
fn enough_rows(problem: &Problem<'_>, folds: &Folds) -> Result<(), DiagnoseError> {
    let parameters = Model::nuisances(problem) + 1;
    let rows = &problem.data.rows;
    let kept = |fold| (0..rows.len()).filter(|row| folds.of_row(*row) != fold).count();
    let least = (0..folds.count).map(kept).min().unwrap_or(0) * problem.measured.len();
    if least >= parameters {
        return enough_of_each_session(problem, folds);
    }
    Err(DiagnoseError::TooFewRows { file: problem.data.file.clone(), rows: rows.len(), parameters })
}
