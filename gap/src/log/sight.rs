//! What the rate of a log, and the band that it leaves, take from sight.

use core::f64::consts::TAU;

use super::effects::{LogEffect, Spot};
use super::report::Hidden;
use super::scene::Domain;
use super::search::case::Case;
use super::search::ripples::{ORDERS, PASSES};
use super::signal::Signals;

/// Of the speeds of a joint, the part that is slower: a ripple is seen there last.
const SLOW: f64 = 0.1;

/// A joint that turns round slides again after about so much, rad or m: teeth and rollers give by
/// hundredths.
const GIVES: f64 = 0.01;

/// A recorder holds a value for up to a step: below this step, s, no arm's delay is shorter.
const SHORT: f64 = 0.01;

/// Effects among `asked` that this log is too slow for.
pub fn too_slow<'e>(
    case: &Case<'_>,
    asked: impl Iterator<Item = &'e dyn LogEffect>,
    period: f64,
) -> Vec<Hidden> {
    let (signals, band) = (case.signals, case.signals.band);
    let asked: Vec<&'static str> = asked.map(|effect| effect.identifier()).collect();
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
