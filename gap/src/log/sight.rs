//! What a log cannot show, and why.

use core::f64::consts::TAU;

use super::effects::{CATALOGUE, LogEffect, Spot};
use super::report::Hidden;
use super::scene::{Domain, Loads};
use super::search::case::{Case, Simple, Wanted};
use super::search::fit::Term;
use super::search::judge::Verdict;
use super::search::ripples::{ORDERS, PASSES};
use super::signal::Signals;

/// Of the speeds of a joint, the part that is slower: a ripple is seen there last.
const SLOW: f64 = 0.1;

/// A joint that turns round slides again after about so much, rad or m: teeth and rollers give by
/// hundredths.
const GIVES: f64 = 0.01;

/// A recorder holds a value for up to a step: below this step, s, no arm's delay is shorter.
const SHORT: f64 = 0.01;

/// What this log cannot show, and why: what no motion does, what the model as it was first showed nothing
/// of, and what the log is too slow for.
pub fn hidden(
    case: &Case<'_>,
    simple: &Simple,
    unseen: Vec<(&'static dyn LogEffect, Spot)>,
    wanted: &[Wanted],
    verdict: &Verdict,
    period: f64,
) -> Vec<Hidden> {
    let mut hidden = Vec::new();
    let mut tell = |effect: &'static str, place: String, reason: &str| {
        hidden.push(Hidden { effect, place, reason: reason.to_owned() });
    };
    if case.kind.0 == Domain::Torque && case.loaded.iter().all(Option::is_none) {
        tell(
            "torque_scale",
            Spot::Arm.to_string(),
            "with free masses all inertias and frictions grow with it, exactly: only a payload of \
             known mass tells",
        );
    }
    let loads = Loads::default();
    let scene = case.scene(simple, case.signals, &loads);
    let own = CATALOGUE.iter().filter(|e| e.domain() == case.kind.0);
    for (effect, reason) in own.filter_map(|e: &&dyn LogEffect| Some((e, e.excluded(&scene)?))) {
        tell(effect.identifier(), "every joint".to_owned(), &reason);
    }
    let scale = |effect: &&dyn LogEffect, spot: &Spot| {
        effect.identifier() == "torque_scale" && *spot == Spot::Arm
    };
    for (effect, spot) in unseen.iter().filter(|(e, s)| !scale(e, s)) {
        let reason = "what is fitted along does the same in this motion";
        tell(effect.identifier(), spot.to_string(), reason);
    }
    // What was found was seen, but for a delay that the recorder may make.
    let found = |h: &Hidden| {
        let is = |t: &Term| t.effect.identifier() == h.effect && t.spot.to_string() == h.place;
        let told = |t: &Term| h.effect != "latency" || t.values[0].abs() > 0.5 * period;
        verdict.findings.iter().any(|finding| is(&finding.term) && told(&finding.term))
    };
    let asked = wanted.iter().map(|(effect, ..)| effect.identifier()).collect::<Vec<_>>();
    hidden.extend(too_slow(case, &asked, period).into_iter().filter(|h| !found(h)));
    hidden
}

/// Effects among `asked` that this log is too slow for.
fn too_slow(case: &Case<'_>, asked: &[&str], period: f64) -> Vec<Hidden> {
    let (signals, band) = (case.signals, case.signals.band);
    let mut hidden = Vec::new();
    let mut tell = |effect: &'static str, spot: Spot, reason: String| {
        if asked.contains(&effect) {
            hidden.push(Hidden { effect, place: spot.to_string(), reason });
        }
    };
    if period >= SHORT {
        tell(
            "latency",
            Spot::Interface,
            format!(
                "a sample every {} ms is held for as long: a delay of less than half of that may be the \
                 recorder's",
                round(1e3 * period)
            ),
        );
    }
    if case.kind.0 == Domain::Position {
        return hidden;
    }
    for joint in 0..signals.joints() {
        let highest = TAU * PASSES * band / slow(signals, joint, case.still[joint]);
        if highest < *ORDERS.end() as f64 {
            tell(
                "torque_ripple",
                Spot::Joint(joint),
                format!(
                    "the band of {} Hz lets orders of up to {highest:.0} through at its slow speeds: log faster, \
                     or move more slowly",
                    round(band)
                ),
            );
        }
        let slides = 2.0 * (2.0 * GIVES / acceleration(signals, joint)).sqrt();
        if slides < signals.reach() {
            tell(
                "presliding",
                Spot::Joint(joint),
                format!(
                    "its reversals are over in {} s, and the band of {} Hz spreads them over {} s: log faster, or \
                     turn round more gently",
                    round(slides),
                    round(band),
                    round(signals.reach())
                ),
            );
        }
    }
    hidden
}

/// Two digits of a number.
fn round(x: f64) -> f64 {
    let size = 10f64.powf(1.0 - x.abs().log10().floor());
    (x * size).round() / size
}

/// The speed that a tenth of the samples that move are slower than, rad/s or m/s.
fn slow(signals: &Signals, joint: usize, still: f64) -> f64 {
    let moves = signals.qd[joint].iter().map(|v| v.abs()).filter(|v| *v > still);
    let mut speeds: Vec<f64> = moves.collect();
    speeds.sort_by(f64::total_cmp);
    speeds.get((SLOW * speeds.len() as f64) as usize).copied().unwrap_or(still)
}

/// Root mean square, rad/s² or m/s².
fn acceleration(signals: &Signals, joint: usize) -> f64 {
    let all = &signals.qdd[joint];
    (all.iter().map(|a| a * a).sum::<f64>() / all.len() as f64).sqrt()
}
