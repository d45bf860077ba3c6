//! How late all torques are told, or all servos follow.
//!
//! A delay acts on all joints and on all that drives them: while it is in the log every joint shows something that no
//! effect is. It is therefore looked for before the effects are. The logged torques are shifted by each of many delays,
//! rigid links, Coulomb and viscous friction and zeros are fitted to every one of them anew, and the delay that leaves
//! least is refined. A motion that nearly repeats has other minima, which are higher.

use super::case::{Case, Simple, Wanted};
use super::dictionary::Dictionary;
use super::fit::{Fitted, Links, Term};
use crate::constants::SHRINKS;
use crate::effects::Place;
use crate::log::effects::{COULOMB, LATENCY, OFFSET, SHIFT, Spot, VISCOUS};
use crate::log::scene::Loads;

/// Delays of torques that are tried, s: from the first to the last, in steps. One that is told early is one of positions,
/// which are filtered longer than torques.
const FIRST: f64 = -0.1;
const LAST: f64 = 0.5;
const STEP: f64 = 0.01;

/// Steps on either side of the best, each again in so many parts.
const PARTS: usize = 10;

/// How late all torques are told, s; 0 if it makes little difference.
pub fn of_torques(case: &Case<'_>, nothing: &Simple, thinned: usize) -> f64 {
    let step = |k: usize| FIRST + STEP * k as f64;
    let count = ((LAST - FIRST) / STEP).round() as usize;
    let coarse: Vec<f64> = (0..=count).map(step).collect();
    let Some(best) = scan(case, nothing, thinned, &coarse) else { return 0.0 };
    let fine = |k: usize| best.at + STEP * (k as f64 / PARTS as f64 - 1.0);
    let fine: Vec<f64> = (0..=2 * PARTS).map(fine).chain([0.0]).collect();
    let Some(best) = scan(case, nothing, thinned, &fine) else { return 0.0 };
    if best.shrinks > SHRINKS { best.at } else { 0.0 }
}

/// The best of some delays.
struct Best {
    at: f64,
    /// By which part it makes smaller what no delay leaves, mean over the joints.
    shrinks: f64,
}

/// Of delays, one of which is none, the one that leaves least; `None` where the log is too short for them.
fn scan(case: &Case<'_>, nothing: &Simple, thinned: usize, delays: &[f64]) -> Option<Best> {
    let late = delays.iter().fold(0.0_f64, |most, delay| most.max(delay.abs()));
    let case = Case { late: case.late + late, ..*case };
    let moves: Vec<bool> = case.counts().iter().map(|counts| counts.contains(&true)).collect();
    if moves.iter().zip(case.left_out).any(|(moves, out)| !moves && !out) {
        return None;
    }
    let probes: Vec<Vec<f64>> = delays.iter().map(|delay| vec![*delay]).collect();
    let dict = Dictionary::of(&case, nothing, &wanted(case.signals.joints(), probes), thinned);
    let left = |entry: usize| -> Vec<f64> {
        let fit = fitted(&dict, entry);
        fit.sizes(&dict).iter().map(|size| size.ln()).collect()
    };
    let sum = |left: &Vec<f64>| left.iter().sum::<f64>();
    let all: Vec<Vec<f64>> = (0..delays.len()).map(left).collect();
    let best = (0..all.len()).min_by(|a, b| sum(&all[*a]).total_cmp(&sum(&all[*b])))?;
    let none = delays.iter().position(|delay| delay.abs() < 1e-3 * STEP)?;
    let count = moves.iter().filter(|moves| **moves).count() as f64;
    let shrinks = (sum(&all[none]) - sum(&all[best])) / count.max(1.0);
    // Between three neighbours a parabola has its vertex.
    let around = |k: usize| (k > 0 && k + 1 < all.len()).then(|| [k - 1, k, k + 1]);
    let by = around(best).map_or(0.0, |near| {
        let [before, here, after] = near.map(|k| sum(&all[k]));
        let even = (delays[near[2]] - 2.0 * delays[best] + delays[near[0]]).abs() < 1e-6;
        let bend = before - 2.0 * here + after;
        if even && bend > 0.0 { 0.5 * (before - after) / bend } else { 0.0 }
    });
    let step = if best > 0 { delays[best] - delays[best - 1] } else { 0.0 };
    Some(Best { at: delays[best] + by * step, shrinks: 1.0 - (-shrinks).exp() })
}

/// What a simple model asks for: friction and a zero of each joint, and a shift last.
fn wanted(joints: usize, probes: Vec<Vec<f64>>) -> Vec<Wanted> {
    let own = |spot| [COULOMB, VISCOUS, OFFSET].map(|effect| (effect, spot, vec![vec![0.0]]));
    let mut wanted: Vec<Wanted> = (0..joints).map(Spot::of_joint).flat_map(own).collect();
    wanted.push((SHIFT, Spot::at(Place::Interface), probes));
    wanted
}

/// All of it, shifted as one entry says, each joint told in what is left of it.
fn fitted(dict: &Dictionary<'_>, entry: usize) -> Fitted {
    let last = dict.offers.len() - 1;
    let term = |offer: usize| dict.term(offer, if offer == last { entry } else { 0 });
    let terms: Vec<Term> = (0..=last).map(term).collect();
    let sizes = vec![1.0; dict.case.signals.joints()];
    let rough = Fitted::of(dict, &terms, &Links::Free, &sizes);
    Fitted::of(dict, &terms, &Links::Free, &rough.sizes(dict))
}

/// A simple model of torques that are late by so much: three terms for each joint, and a shift last.
pub fn fitted_at<'a>(
    case: &'a Case<'a>,
    nothing: &Simple,
    thinned: usize,
    late: f64,
) -> (Dictionary<'a>, Fitted) {
    let wanted = wanted(case.signals.joints(), vec![vec![late]]);
    let dict = Dictionary::of(case, nothing, &wanted, thinned);
    let fit = fitted(&dict, 0);
    (dict, fit)
}

/// How late all servos follow, the whole of it, known or not.
pub fn of_servos(case: &Case<'_>, nothing: &Simple, thinned: usize) -> f64 {
    let case = Case { known: &[], ..*case };
    let loads = Loads::default();
    let probes =
        LATENCY.probes(&case.scene(nothing, case.signals, &loads), Spot::at(Place::Interface));
    let dict =
        Dictionary::of(&case, nothing, &[(LATENCY, Spot::at(Place::Interface), probes)], thinned);
    let sizes = dict.sizes(&[dict.left(&Links::Free, &[])], &[1.0]);
    let fits = (0..dict.offers[0].entries.len()).map(|entry| {
        let fit = Fitted::of(&dict, &[dict.term(0, entry)], &Links::Free, &sizes);
        (fit.sizes(&dict).iter().map(|size| size.ln()).sum::<f64>(), fit.terms[0].values[0])
    });
    fits.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, delay)| delay.max(0.0))
}
