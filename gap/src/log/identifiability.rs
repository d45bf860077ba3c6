//! What a log cannot show, and why.

use super::effects::{Catalogue, LogEffect, Spot};
use super::pace::Pace;
use super::scene::{Domain, Loads};
use super::search::case::{Case, Simple, Wanted};
use super::search::fit::Links;
use super::search::judge::Verdict;
use crate::effects::Place;
use crate::report::{CannotSee, Hidden};

/// What this log cannot show, and why: what no motion does, what the model as it was first showed nothing
/// of, and what the log is too slow for.
pub fn hidden(
    case: &Case<'_>,
    simple: &Simple,
    catalogue: &Catalogue,
    unseen: Vec<(&'static dyn LogEffect, Spot)>,
    wanted: &[Wanted],
    verdict: &Verdict,
    period: f64,
) -> Vec<CannotSee> {
    let mut hidden = Vec::new();
    let mut tell = |effect: &'static str, place: String, reason: &str| {
        let why = Hidden::InMotion { reason: reason.to_owned() };
        hidden.push(CannotSee { effect: effect.into(), place, why });
    };
    let is_free = verdict.now.fit.links == Links::Free;
    if case.kind.0 == Domain::Torque && is_free && case.loaded.iter().all(Option::is_none) {
        tell(
            "torque_scale",
            Spot::at(Place::Arm).to_string(),
            "with free masses one scale of all torques is not distinguishable from a scale of all inertias and \
             frictions; only a payload of known mass determines it",
        );
    }
    let loads = Loads::default();
    let scene = case.scene(simple, case.signals, &loads);
    let own = || catalogue.iter().filter(|e| e.domain() == case.kind.0);
    for (effect, reason) in own().filter_map(|e| Some((e, e.excluded(&scene)?))) {
        tell(effect.identifier(), "every joint".to_owned(), &reason);
    }
    let scale = |effect: &&dyn LogEffect, spot: &Spot| {
        effect.identifier() == "torque_scale" && spot.place == Place::Arm
    };
    for (effect, spot) in unseen.iter().filter(|(e, s)| !scale(e, s)) {
        let reason = "not distinguishable from the co-estimated parameters in this motion";
        tell(effect.identifier(), spot.to_string(), reason);
    }
    let pace = Pace { signals: case.signals, still: case.still, period };
    let found = |effect: &str, spot: Spot| {
        let mut terms = verdict.findings.iter().map(|finding| &finding.term);
        let term = terms.find(|t| t.effect.identifier() == effect && t.spot == spot)?;
        Some(term.values.as_slice())
    };
    for effect in own() {
        let id = effect.identifier();
        if wanted.iter().all(|(effect, ..)| effect.identifier() != id) {
            continue;
        }
        for spot in effect.spots(&scene) {
            if let Some(reason) = effect.too_slow(&pace, spot, found(id, spot)) {
                tell(id, spot.to_string(), &reason);
            }
        }
    }
    hidden
}
