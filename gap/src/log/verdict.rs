//! From a log to what is said of it.

use stiffarm_kernels::generic::Arm;

use super::identifiability::hidden;
use super::instrument;
use super::known;
use super::model::{Acting, Model, late};
use super::options::{LogOptions, Refused};
use super::read::{Log, Signal, TorqueSide};
use super::readings::{Readings, placeholder};
use super::rigid::{Base, body, moved, report};
use super::scene::Domain;
use super::search::case::{Case, Simple, Wanted};
use super::search::dictionary::{Dictionary, Mixed};
use super::search::fit::{Fitted, Links, Term};
use super::search::nested::nested;
use super::search::residual::dependences;
use super::search::springs::Springs;
use super::search::unseen::Unseen;
use super::search::{self, Round, Search, effective};
use super::told::{Before, Told};
use crate::constants::{FEWEST_TO_JUDGE, UNCHANGED};
use crate::infer::limits::CONVERGED;
use crate::measurement::Body;
use crate::report::log::{Evidence, Filter, LogDiagnosis, Unexplained};
use crate::signal::Signals;

/// Times that a log is gone through again where effects bend: each makes the error of their values about
/// its square.
const AGAIN: usize = 3;

/// Times that a simple model is asked for mistakes of the readings: each takes out what it finds.
const ASKED: usize = 3;

/// Why a log brings the gap that it has: which effects at which places, one after the other, and how far
/// it shrinks with them on time that no fit has seen.
///
/// # Errors
/// [`Refused`]: what in the log or the options stands in the way.
pub fn diagnose(arm: &Arm, log: &Log, options: &LogOptions) -> Result<LogDiagnosis, Refused> {
    diagnosed(arm, log, options).map(|(diagnosis, _)| diagnosis)
}

/// The same, and what was found as a model that predicts.
///
/// # Errors
/// As [`diagnose`].
pub fn diagnosed(
    arm: &Arm,
    log: &Log,
    options: &LogOptions,
) -> Result<(LogDiagnosis, Model), Refused> {
    diagnosed_with(arm, log, options, &|_| {})
}

/// The same; `each` is told how many effects are found, before the first and with each.
///
/// # Errors
/// As [`diagnose`].
pub fn diagnosed_with(
    arm: &Arm,
    log: &Log,
    options: &LogOptions,
    each: &dyn Fn(usize),
) -> Result<(LogDiagnosis, Model), Refused> {
    each(0);
    let (domain, drive, side) = options.rows_of(log)?;
    let base = (domain == Domain::Torque).then(|| Base::of(arm));
    let current = side == Some(TorqueSide::Current);
    let all_known = known::terms(&options.known, arm.dof(), domain)
        .map_err(|wrong| Refused::Known { message: wrong.in_full() })?;
    let (known_delay, known) = late(&all_known, domain);
    let told_log = log;
    let mut readings = Readings::of_channels(arm, log, drive);
    let left_out = readings.left_out(arm.dof());
    if !left_out.contains(&false) {
        return Err(Refused::Silent { file: log.files.join(", ") });
    }
    let mut asked = 0;
    let (log, signals, still, payloads, loaded) = loop {
        let log = readings.mended(told_log);
        let (mut signals, still) = prepared(&log, drive, options)?;
        signals.align(known_delay);
        let payloads: Vec<Option<String>> =
            log.runs.iter().map(|run| run.payload.clone()).collect();
        let loaded = loaded(arm, &payloads, &options.payloads, current);
        let (kind, base, late) = ((domain, side), base.as_ref(), known_delay.abs());
        let case = Case {
            arm,
            signals: &signals,
            kind,
            still: &still,
            base,
            payloads: &payloads,
            known: &known,
            loaded: &loaded,
            late,
            left_out: &left_out,
        };
        let counts = case.counts().into_iter().zip(&left_out);
        let stands = |(counts, out): (Vec<bool>, &bool)| !out && !counts.contains(&true);
        if let Some(joint) = counts.map(stands).position(|stands| stands) {
            return Err(Refused::Still { file: log.files.join(", "), joint: joint + 1 });
        }
        let more = drive.filter(|_| asked < ASKED).map(|drive| Readings::of_model(&case, drive));
        asked += 1;
        match more.unwrap_or_default() {
            none if none.is_empty() => break (log, signals, still, payloads, loaded),
            more => readings.all.extend(more),
        }
    };
    let log = &*log;
    let case = Case {
        arm,
        signals: &signals,
        kind: (domain, side),
        still: &still,
        base: base.as_ref(),
        payloads: &payloads,
        known: &known,
        loaded: &loaded,
        late: known_delay.abs(),
        left_out: &left_out,
    };
    let links = links(&case, options);
    let mut simple = Simple::of(&case, &links, options.seed);
    let case = match domain {
        Domain::Torque => Case { late: case.late + simple.delay.abs(), ..case },
        Domain::Position => case,
    };
    let mut wanted = search::wanted(&case, &simple, &options.catalogue, options.effects.as_deref());
    if links == Links::Free {
        wanted.retain(|(effect, spot, _)| {
            effect.carried(arm, *spot).is_none_or(|carried| carried.run.is_some())
        });
    }
    let mut dict = Dictionary::of(&case, &simple, &wanted, 1);
    let told = Told { case: &case, arm, kind: case.kind, current, sizes: sizes(&dict) };
    let mut before: Option<Before> = None;
    let mut terms: Vec<Term> = Vec::new();
    if let Some(late) = dict.late().filter(|_| simple.delay != 0.0) {
        let sizes = dict.sizes(&[dict.left(&links, &[])], &[1.0]);
        let offers: Vec<usize> = (0..dict.offers.len()).collect();
        let none = Search::new(&dict, &links, &offers, options.seed).round(&[], &sizes);
        before = Some(Before::of(&dict, &none));
        terms.push(late);
    }
    let mut again = 0;
    let (verdict, left) = loop {
        let offers: Vec<usize> = (0..dict.offers.len()).collect();
        let mut each = |round: &Round| {
            each(round.now.fit.terms.len());
            before.get_or_insert_with(|| Before::of(&dict, round));
        };
        let search = Search::new(&dict, &links, &offers, options.seed);
        let last = search.run(&terms, &mut each);
        let verdict = search.converged(&last, &mut each);
        // What is made of loads is made of those of the links as they are fitted beside it.
        let of_loads = verdict.now.fit.terms.iter().any(|term| term.effect.is_of_loads());
        let better = of_loads && simple.moved_to(&dict, verdict.now.fit.rigid(&dict));
        if again == AGAIN || !(better || moved_on(&dict, &verdict.now.fit.terms)) {
            break search.ordered(verdict, |left| told.mean(left));
        }
        again += 1;
        let more = about(&wanted, &verdict.now.fit.terms);
        dict = Dictionary::of(&case, &simple, &more, 1);
        terms = verdict.now.fit.terms.iter().map(|term| again_of(&dict, term)).collect();
    };
    let Before { left: before, hidden: unseen, alone } = before.unwrap_or_default();
    let left: Vec<f64> =
        core::iter::once(&before).chain(&left).map(|left| told.mean(left)).collect();
    let after = Unseen::of(&dict, &verdict.now.fit, &verdict.now.sizes, &verdict.blocks);
    let blocks = &verdict.blocks;
    let (first, spread) = if verdict.findings.is_empty() {
        (&after.sizes, 0.0)
    } else {
        let none = Fitted::of(&dict, &[], &links, &verdict.now.sizes);
        let sizes = none.sizes(&dict);
        let none = Unseen::of(&dict, &Fitted::of(&dict, &[], &links, &sizes), &sizes, blocks);
        (&before, after.spread(&none, &told.sizes, options.seed))
    };
    let nested = options.nested.then(|| nested(&dict, blocks, &links, options.seed));
    let depends_on = dependences(&dict, &verdict, options.seed);
    let rigid = |fitted: &[f64]| links.values(fitted, dict.base);
    let acting = |term: &Term| Acting {
        effect: term.effect,
        spot: term.spot,
        values: case.at_least_none(term),
    };
    let model = Model {
        rows: domain,
        drive,
        side,
        band: signals.band,
        still: still.clone(),
        payloads: options.payloads.clone(),
        known: all_known,
        terms: verdict.findings.iter().map(|judged| acting(&judged.term)).collect(),
        rigid: rigid(&verdict.now.fit.values),
        alone: rigid(&alone),
        simple: simple.clone(),
        readings,
        springs: Springs::of(&dict, &verdict),
    };
    let asked = instrument::Asked {
        case: &case,
        simple: &simple,
        terms: &model.terms,
        links: &links,
        sizes: &verdict.now.sizes,
    };
    let by_command = asked.numbers();
    let diagnosis = LogDiagnosis {
        stiffarm: options.version.clone(),
        robot: arm.name.clone(),
        files: log.files.clone(),
        rows: domain,
        torque_side: side,
        runs: log.runs.len(),
        samples: log.samples,
        damaged: log.damaged.len(),
        filter: Filter {
            period: log.period(),
            band: signals.band,
            band_given: options.band.is_some(),
            standstill: still.clone(),
        },
        evidence: Evidence {
            effective: effective(&dict.used, &verdict.now.correlation, &signals),
            correlation_time: verdict.now.correlation.clone(),
            rows: dict.used.iter().sum::<f64>() as usize,
            blocks: blocks.all.len(),
            block_length: blocks.length,
            long_enough: blocks.long_enough,
            held_out_by: if blocks.by_run { "run" } else { "block" }.into(),
            folds: blocks.folds,
        },
        rigid_parameters: if links == Links::Free { dict.base } else { 0 },
        rigid: case.base.filter(|_| links == Links::Free && !current).map(|base| {
            let values = &verdict.now.fit.values;
            report::fitted(arm, base, values, &after.covariance(values), blocks.all.len())
        }),
        gap: told.gap(&before, &after.sizes, nested.as_deref()),
        shrink: told.shrink([first, &after.sizes], spread, blocks.all.len()),
        findings: told.findings(&left, &verdict, &after, by_command.as_deref()),
        cannot_see: hidden(
            &case,
            &simple,
            &options.catalogue,
            unseen,
            &wanted,
            &verdict,
            log.period(),
        ),
        unexplained: Unexplained { present: !depends_on.is_empty(), depends_on },
        remarks: [
            model.readings.sentences(told_log),
            log.remarks(),
            signals.remarks(),
            log.doubts(arm),
            placeholder(arm, side).into_iter().collect(),
        ]
        .concat(),
    };
    Ok((diagnosis, model))
}

/// A log at even steps, and the speeds below which its joints count as standing.
///
/// # Errors
/// [`Refused`]: a band or a speed that is none, or less motion than can be divided.
fn prepared(
    log: &Log,
    drive: Option<Signal>,
    options: &LogOptions,
) -> Result<(Signals, Vec<f64>), Refused> {
    options.checked(log.period())?;
    let mut signals = Signals::of(log, drive, options.band);
    let (found, expected) =
        (signals.rows() as f64 * signals.step(), 2.0 * FEWEST_TO_JUDGE as f64 * signals.reach());
    if found < expected {
        return Err(Refused::TooShort { file: log.files.join(", "), found, expected });
    }
    let fastest = |v: &Vec<f64>| v.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let still = |v: &Vec<f64>| options.standstill.unwrap_or(UNCHANGED * fastest(v));
    let still: Vec<f64> = signals.qd.iter().map(still).collect();
    signals.mark_ways(&still);
    Ok((signals, still))
}

/// Of each run the numbers of the load that is known to be on the last link, in its frame.
pub(super) fn loaded(
    arm: &Arm,
    runs: &[Option<String>],
    payloads: &[Body],
    current: bool,
) -> Vec<Option<[f64; 10]>> {
    let load = |name: &Option<String>| {
        let known = payloads.iter().find(|body| Some(&body.name) == name.as_ref())?;
        Some(moved(&arm.tool, &body(known.mass, &known.com, &Default::default())))
    };
    // Of a current no one knows the newton-metres: a known load tells nothing of it.
    runs.iter().map(|name| load(name).filter(|_| !current)).collect()
}

/// What is known of the rigid links: the robot file's numbers, if it has them and they are trusted.
fn links(case: &Case<'_>, options: &LogOptions) -> Links {
    let weightless = case.arm.joints.iter().all(|joint| joint.mass == 0.0);
    let current = case.kind.1 == Some(TorqueSide::Current);
    let trusted = options.known_links && !weightless && !current;
    let Some(base) = case.base.filter(|_| trusted) else {
        return Links::Free;
    };
    let moments = nalgebra::DVector::from_vec(case.arm.moments());
    Links::Known((&base.mix * moments).iter().copied().collect())
}

/// Sizes of the joints' torques, or of their position errors.
fn sizes(dict: &Dictionary<'_>) -> Vec<f64> {
    let rows = dict.sampled(&[Mixed::one(dict.target)], &[1.0]);
    let size = |rows: &Vec<Option<f64>>| {
        let count = rows.iter().flatten().count().max(1) as f64;
        let mean = match dict.case.kind.0 {
            Domain::Torque => rows.iter().flatten().sum::<f64>() / count,
            Domain::Position => 0.0,
        };
        let sum = rows.iter().flatten().map(|x| (x - mean).powi(2)).sum::<f64>();
        if sum > 0.0 { (sum / count).sqrt() } else { 1.0 }
    };
    rows.iter().map(size).collect()
}

/// Whether terms that bend have left the values about which they are linearised.
fn moved_on(dict: &Dictionary<'_>, terms: &[Term]) -> bool {
    let moved = |term: &Term| {
        let pairs = dict.entry(term).at.iter().zip(&term.values);
        pairs.into_iter().any(|(at, is)| (is - at).abs() > CONVERGED * is.abs())
    };
    terms.iter().any(|term| term.effect.bends() && moved(term))
}

/// The effects that are asked for, those that bend about the values that they have too.
fn about(wanted: &[Wanted], terms: &[Term]) -> Vec<Wanted> {
    let mut wanted = wanted.to_vec();
    for term in terms.iter().filter(|term| term.effect.bends()) {
        wanted[term.offer].2.push(term.values.clone());
    }
    wanted
}

/// The same term in another dictionary, about its own values if it bends.
fn again_of(dict: &Dictionary<'_>, term: &Term) -> Term {
    let entry = if term.effect.bends() { dict.offers[term.offer].entries.len() - 1 } else { 0 };
    Term { entry, ..term.clone() }
}
