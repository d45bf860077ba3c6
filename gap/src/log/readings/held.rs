//! Something that some runs carry and others do not, where no column says so.

use super::Misread;
use super::plain::Plain;
use crate::constants::{SHRINKS, THINGS_APART};
use crate::effects::{Place, Spot};
use crate::log::TorqueSide;
use crate::log::effects::PAYLOAD;
use crate::log::search::case::{Case, Wanted};
use crate::log::search::fit::Links;

/// Of each thing the runs that carry it, those that carry least apart.
pub(super) fn found(case: &Case<'_>) -> Vec<Misread> {
    let runs = case.payloads.len();
    let signals = case.signals;
    let has_rows = |run: &usize| signals.spans.iter().any(|span| span.run == *run);
    let current = case.kind.1 == Some(TorqueSide::Current);
    if (0..runs).filter(has_rows).count() < 2
        || current
        || case.payloads.iter().any(Option::is_some)
    {
        return Vec::new();
    }
    let spots = (1..runs).map(|run| Spot::at(Place::Held(run + 1)));
    let wanted: Vec<Wanted> = spots.map(|spot| (PAYLOAD, spot, vec![vec![0.0; 10]])).collect();
    let plain = Plain::of(case, wanted, usize::MAX);
    let left = plain.dict.left(&Links::Free, &[]);
    let bodies = &plain.dict.offers[plain.dict.offers.len() + 1 - runs..];
    let more: Vec<_> = bodies.iter().flat_map(|body| body.entries[0].columns.clone()).collect();
    let (alike, _) = plain.left(&[], &left);
    let (each, values) = plain.left(&more, &left);
    let gain: f64 = alike.iter().zip(&each).map(|(a, b)| (a / b).ln()).sum();
    if 1.0 - (-gain / alike.len() as f64).exp() < SHRINKS {
        return Vec::new();
    }
    let bodies = &values[plain.columns.len()..];
    let mass = |run: usize| if run == 0 { 0.0 } else { bodies[10 * (run - 1)] };
    let mut order: Vec<usize> = (0..runs).filter(has_rows).collect();
    order.sort_by(|a, b| mass(*a).total_cmp(&mass(*b)));
    let range = mass(order[order.len() - 1]) - mass(order[0]);
    let mean = |of: &[usize]| of.iter().map(|run| mass(*run)).sum::<f64>() / of.len() as f64;
    let mut things = order.chunk_by(|a, b| mass(*b) - mass(*a) <= THINGS_APART * range);
    let least = things.next().map_or(0.0, mean);
    let held = |thing: &[usize]| {
        // Runs that were averaged carry the same.
        let with = |run: &usize| -> Vec<usize> {
            let alike = signals.alike.iter().find(|alike| alike.contains(run));
            alike.map_or_else(|| vec![*run], Vec::clone)
        };
        let mut runs: Vec<usize> = thing.iter().flat_map(with).collect();
        runs.sort_unstable();
        Misread::Held { runs, mass: mean(thing) - least }
    };
    things.map(held).collect()
}
