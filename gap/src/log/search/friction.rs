//! Coulomb and viscous friction that the robot file has otherwise, both at once.
//!
//! Where the file has friction that the arm has not, each of its two numbers by itself would take away more than there
//! is, or one number that is in proportion to both (a torque's scale) or bends between them (a curve) does as well. Both are
//! therefore tried together before anything else is named at such a joint. A file's friction is known to a factor of
//! two or three, a torque's constant to a tenth: a scale that is unusual has to do better than friction, not as well.

use super::blocks::Blocks;
use super::candidates::{Asked, Candidate};
use super::dictionary::Dictionary;
use super::fit::{Fitted, Links, Term};
use super::normal_equations::Sums;
use super::{Round, exchange, is_worse};
use crate::infer::constants::{LOOSE, SIGNIFICANT};
use crate::log::effects::{COULOMB, LogEffect, SCALE, Spot, VISCOUS};

/// Friction's two numbers.
const BOTH: [&dyn LogEffect; 2] = [COULOMB, VISCOUS];

/// Some terms and the two of a joint.
struct Tried {
    fit: Fitted,
    /// What they leave of each block, held out.
    squares: Vec<f64>,
}

/// Whether a value is none that one expects: beyond it other explanations are more likely.
pub fn is_unusual(term: &Term) -> bool {
    let parameters = term.effect.parameters().iter().zip(&term.values);
    parameters.into_iter().any(|(p, value)| value.abs() > LOOSE * p.usual)
}

/// A round's terms and what it lacks most; `None` if chance explains all that is left.
pub fn next(
    dict: &Dictionary<'_>,
    round: &Round,
    offers: &[usize],
    seed: u64,
) -> Option<Vec<Term>> {
    let best = round.best(dict.case);
    let whole: f64 = round.asked.squares.iter().sum();
    let left = |squares: &[f64]| squares.iter().sum::<f64>();
    let is_open = |joint: &usize| offer_both(dict, &round.fit.terms, *joint).is_some();
    let at_best = best.filter(|best| !is_either(best.term.effect));
    let at_best = at_best.and_then(|best| Some((best, best.term.spot.joint().filter(is_open)?)));
    let mut more: Vec<usize> = too_much(dict, round).filter(is_open).collect();
    more.dedup();
    if at_best.is_some() || !more.is_empty() {
        let sums = dict.sums(&round.blocks);
        let divided = (&round.blocks, &sums);
        let (links, sizes) = (&round.fit.links, &round.sizes);
        let tried = |joint| Tried::of(dict, &round.fit.terms, joint, links, sizes, divided, seed);
        if let Some((best, joint)) = at_best {
            let as_well = |both: &Tried| match is_unusual(&best.term) {
                true => !is_worse(&both.squares, &best.squares),
                // Its two numbers against one.
                false => is_worse(&best.squares, &both.squares),
            };
            if let Some(both) = tried(joint).filter(as_well) {
                return Some(both.fit.terms);
            }
        }
        let gain = |both: &Tried| (whole - left(&both.squares)) / 2.0;
        let least = best.map_or(0.0, |best| (whole - left(&best.squares)) / best.things());
        let all = more.into_iter().filter_map(tried).filter(|both| gain(both) > least);
        if let Some(both) = all.max_by(|a, b| gain(a).total_cmp(&gain(b))) {
            return Some(both.fit.terms);
        }
    }
    best.map(|best| exchange::added(dict, round, &best.term, offers, seed))
}

fn is_either(effect: &dyn LogEffect) -> bool {
    BOTH.iter().any(|one| one.identifier() == effect.identifier())
}

/// Joints at which one of both would take away more friction than there is.
fn too_much<'r>(dict: &'r Dictionary<'_>, round: &'r Round) -> impl Iterator<Item = usize> + 'r {
    let asked = round.asked.candidates.iter().zip(&round.asked.p_values);
    let is_more = |(c, p): &(&Candidate, &f64)| {
        **p <= SIGNIFICANT && is_either(c.term.effect) && !dict.case.is_feasible(&c.term)
    };
    asked.filter(is_more).filter_map(|(c, _)| c.term.spot.joint())
}

/// Both as they are offered for a joint at which the robot file has one of them, and the terms none.
fn offer_both(dict: &Dictionary<'_>, terms: &[Term], joint: usize) -> Option<[usize; 2]> {
    let spot = Spot::of_joint(joint);
    let case = dict.case;
    let stands = |t: &Term| t.spot == spot && is_either(t.effect);
    let in_file = |e: &&dyn LogEffect| e.file_value(case.arm, case.kind.1, spot) > 0.0;
    if terms.iter().any(stands) || !BOTH.iter().any(in_file) {
        return None;
    }
    let [coulomb, viscous] = BOTH.map(|effect| offered(dict, effect, spot));
    Some([coulomb?, viscous?])
}

fn offered(dict: &Dictionary<'_>, effect: &dyn LogEffect, spot: Spot) -> Option<usize> {
    let is_it = |offer: &super::dictionary::Offer| {
        offer.effect.identifier() == effect.identifier() && offer.spot == spot
    };
    dict.offers.iter().position(is_it)
}

impl Tried {
    /// `None` where both are not offered, or come out as no friction.
    fn of(
        dict: &Dictionary<'_>,
        terms: &[Term],
        joint: usize,
        links: &Links,
        sizes: &[f64],
        divided: (&Blocks, &Sums),
        seed: u64,
    ) -> Option<Tried> {
        let both = offer_both(dict, terms, joint)?.map(|offer| dict.term(offer, 0));
        let terms: Vec<Term> = terms.iter().cloned().chain(both).collect();
        let fit = Fitted::of(dict, &terms, links, sizes);
        let own = &fit.terms[fit.terms.len() - BOTH.len()..];
        if !own.iter().all(|term| dict.case.is_feasible(term)) {
            return None;
        }
        let squares = Asked::of(dict, &fit, sizes, divided, &[], seed).squares;
        Some(Tried { fit, squares })
    }
}

/// What does as well in place of a term that leaves such `squares`: both for a scale of the joint's torque, that scale for
/// both; each with the squares that it leaves.
pub fn instead(
    dict: &Dictionary<'_>,
    fit: &Fitted,
    term: &Term,
    sizes: &[f64],
    divided: (&Blocks, &Sums),
    squares: &[f64],
    seed: u64,
) -> Vec<(Term, Vec<f64>)> {
    let Some(joint) = term.spot.joint() else { return Vec::new() };
    let is_here = |t: &Term| t.spot == term.spot;
    let own = fit.terms.iter().filter(|t| is_here(t) && is_either(t.effect)).count();
    let mut others = fit.terms.clone();
    let found: Vec<(Term, Vec<f64>)> = if term.effect.identifier() == SCALE.identifier() {
        others.retain(|t| !(is_here(t) && t.effect.identifier() == SCALE.identifier()));
        let both = Tried::of(dict, &others, joint, &fit.links, sizes, divided, seed);
        let each = |both: Tried| -> Vec<(Term, Vec<f64>)> {
            let own = both.fit.terms[others.len()..].iter();
            own.map(|t| (t.clone(), both.squares.clone())).collect()
        };
        both.map_or_else(Vec::new, each)
    } else if is_either(term.effect) && own == BOTH.len() {
        others.retain(|t| !(is_here(t) && is_either(t.effect)));
        let lacks = Fitted::of(dict, &others, &fit.links, sizes);
        let scale = offer_both(dict, &others, joint).and_then(|_| offered(dict, SCALE, term.spot));
        let asked = scale.map(|offer| Asked::of(dict, &lacks, sizes, divided, &[offer], seed));
        let asked = asked.into_iter().flat_map(|asked| asked.candidates);
        asked.filter(|c| dict.case.is_feasible(&c.term)).map(|c| (c.term, c.squares)).collect()
    } else {
        Vec::new()
    };
    found.into_iter().filter(|(_, other)| !is_worse(other, squares)).collect()
}
