//! Which terms a model keeps. What came later may make a term superfluous, or another better: every term is held
//! against all that could stand in its place, and what has more evidence stays, whatever was observed.

use nalgebra::{DMatrix, DVector};

use super::basis::Basis;
use super::constants::{EXCHANGE, SURE};
use super::evidence::Scale;
use super::rank::Ranked;
use super::score::price;
use super::screen::{Columns, Screen, Usual};

/// Rounds of taking back and exchanging after each addition.
const MOST_ROUNDS: usize = 12;

/// What a model is fitted to: a campaign's rows, a log's. Terms are an effect at a place each, told by their index.
pub trait Observations {
    /// A model as it is fitted, and the noise that it leaves.
    type Fit;
    /// What may be added to it.
    type Candidate: Columns;
    /// Why none can be fitted.
    type Error;

    /// Whether nothing more is to be fitted.
    fn stopped(&self) -> bool {
        false
    }

    /// All candidates beside what is left of a model without some of its terms (ascending), over all rows.
    fn beside(&self, now: &Self::Fit, without: &[usize]) -> Screen<'_, Self::Candidate>;

    /// How many independent numbers are measured, and whether their noise is known.
    fn scale(&self, now: &Self::Fit) -> Scale;

    /// Squares that a model leaves, by the weights of another, and what it costs to hold its values.
    fn left_by(&self, now: &Self::Fit, weights: &Self::Fit) -> f64;

    /// The same by its own weights.
    fn left(&self, now: &Self::Fit) -> f64 {
        self.left_by(now, now)
    }

    /// Normal matrix of all parameters, each held to what is usual of it.
    fn normal(&self, now: &Self::Fit) -> DMatrix<f64>;

    /// The terms of a model.
    fn terms<'f>(&'f self, now: &'f Self::Fit) -> Terms<'f>;

    /// Which candidates may stand in place of some terms.
    fn replacing<'n>(
        &'n self,
        now: &'n Self::Fit,
        without: &'n [usize],
    ) -> Box<dyn Fn(&Ranked) -> bool + 'n>;

    /// Whether one candidate may stand in place of these two together.
    fn is_pair(&self, now: &Self::Fit, pair: [usize; 2]) -> bool;

    /// The model without some terms and with a candidate, fitted again; `None` if its squares, with what holds it,
    /// do not come `below` something.
    fn replaced(
        &self,
        now: &Self::Fit,
        without: &[usize],
        by: Option<(&Ranked, &Screen<'_, Self::Candidate>)>,
        below: f64,
    ) -> Result<Option<Self::Fit>, Self::Error>;

    /// Notes by how much more evidence a term has than any other in its place.
    fn note_margin(&self, now: &mut Self::Fit, term: usize, margin: f64);
}

/// The terms of a model.
pub struct Terms<'f> {
    /// Parameters before the first.
    pub nuisances: usize,
    /// How many, from the first, are fitted along and never taken back.
    pub along: usize,
    /// In the order of their parameters.
    pub each: Vec<Weighed<'f>>,
}

/// A term as evidence sees it.
pub struct Weighed<'f> {
    /// Its parameters.
    pub values: &'f [f64],
    /// What is usual of them.
    pub usual: &'f Usual,
    /// Whether it is a maker's tolerance, which costs only what its values are uncertain by.
    pub is_tolerated: bool,
    /// Whether what it does is its values' multiple.
    pub is_proportional: bool,
    /// By how much more evidence it had than any other when last compared; 0 before.
    pub margin: f64,
}

/// Variance of what a model leaves.
fn variance<O: Observations>(data: &O, now: &O::Fit) -> f64 {
    let terms = data.terms(now);
    let own: usize = terms.each.iter().map(|term| term.values.len()).sum();
    data.scale(now).variance(data.left(now), terms.nuisances + own)
}

/// Cost of the terms of a model, of some in the place of others by the `variance` that is left.
pub fn costs<O: Observations>(data: &O, now: &O::Fit, variance: f64) -> Vec<f64> {
    costs_by(data, now, &Basis::new(&data.normal(now)), variance)
}

/// The same in a basis of the model's normal matrix.
fn costs_by<O: Observations>(data: &O, now: &O::Fit, basis: &Basis, variance: f64) -> Vec<f64> {
    let numbers = data.scale(now).count();
    let terms = data.terms(now);
    let mut at = terms.nuisances;
    let cost = |term: &Weighed<'_>| {
        let own = basis.t.rows(at, term.values.len());
        at += term.values.len();
        // What is left of its products beside all others is the inverse of its covariance.
        let beside = Basis::new(&(own * own.transpose())).t;
        let products = &beside * beside.transpose();
        let values = (!term.is_tolerated).then_some(term.values);
        let price = price(products, &term.usual.held, values, numbers, variance);
        Scale::cost(price, term.usual.multiplicity)
    };
    terms.each.iter().map(cost).collect()
}

/// What speaks against a model: twice its negative logarithmic evidence at the noise of a fit.
pub fn against<O: Observations>(data: &O, fit: &O::Fit, by: &O::Fit) -> f64 {
    let variance = variance(data, by);
    data.left_by(fit, by) / variance + costs(data, fit, variance).into_iter().sum::<f64>()
}

/// Takes back what is superfluous and exchanges what another explains better; at the `end` also two
/// for one.
pub fn pruned<O: Observations>(data: &O, mut now: O::Fit, end: bool) -> Result<O::Fit, O::Error> {
    for _ in 0..MOST_ROUNDS {
        if data.terms(&now).each.is_empty() || data.stopped() {
            break;
        }
        let Some(next) = changed(data, &mut now, end)? else { break };
        now = next;
    }
    Ok(now)
}

fn changed<O: Observations>(
    data: &O,
    now: &mut O::Fit,
    end: bool,
) -> Result<Option<O::Fit>, O::Error> {
    let variance = variance(data, now);
    let basis = Basis::new(&data.normal(now));
    let costs = costs_by(data, now, &basis, variance);
    let terms = data.terms(now);
    let (along, count) = (terms.along, terms.each.len());
    // One alone was just added.
    if count > 1
        && let Some(term) = superfluous(&terms, &basis, &costs, variance)
        && let Some(fit) = data.replaced(now, &[term], None, f64::INFINITY)?
    {
        return Ok(Some(fit));
    }
    for term in along..count {
        if data.terms(now).each[term].margin > SURE {
            continue;
        }
        match exchanged(data, now, &[term], &costs, variance)? {
            Compared::Exchanged(fit) => return Ok(Some(fit)),
            Compared::Leads(margin) => data.note_margin(now, term, margin),
            Compared::Alone => {}
        }
    }
    for first in (along..count).filter(|_| end) {
        for second in first + 1..count {
            if data.is_pair(now, [first, second]) {
                let both = exchanged(data, now, &[first, second], &costs, variance)?;
                if let Compared::Exchanged(fit) = both {
                    return Ok(Some(fit));
                }
            }
        }
    }
    Ok(None)
}

/// Some terms against the best of all others in their place.
enum Compared<F> {
    /// They have so much more evidence.
    Leads(f64),
    /// The model with the other.
    Exchanged(F),
    /// No other can be fitted.
    Alone,
}

/// Some terms (ascending) against the best of all others in their place, at these `costs` of all terms.
fn exchanged<O: Observations>(
    data: &O,
    now: &O::Fit,
    without: &[usize],
    costs: &[f64],
    variance: f64,
) -> Result<Compared<O::Fit>, O::Error> {
    if data.stopped() {
        return Ok(Compared::Alone);
    }
    let screen = data.beside(now, without);
    let own = data.left(now) / variance + without.iter().map(|k| costs[*k]).sum::<f64>();
    let can = data.replacing(now, without);
    let ranked = screen.ranked(data.scale(now));
    let Some(best) = ranked.iter().find(|one| can(one)) else { return Ok(Compared::Alone) };
    let margin = (screen.left() - best.score.drop) / variance + best.cost - own;
    if margin + EXCHANGE >= 0.0 {
        return Ok(Compared::Leads(margin));
    }
    let below = (own - best.cost) * variance;
    let fit = data.replaced(now, without, Some((best, &screen)), below)?;
    Ok(fit.map_or(Compared::Alone, Compared::Exchanged))
}

/// The term that costs most beyond what it explains beside all the others, if one does.
fn superfluous(terms: &Terms<'_>, basis: &Basis, costs: &[f64], variance: f64) -> Option<usize> {
    let mut at = terms.nuisances;
    let mut worst: Option<(f64, usize)> = None;
    for (index, term) in terms.each.iter().enumerate() {
        let size = term.values.len();
        let own = basis.t.rows(at, size);
        at += size;
        if index < terms.along || !term.is_proportional {
            continue;
        }
        // Without it the squares rise by its values in the metric of their covariance.
        let values = DVector::from_column_slice(term.values);
        let rise = Basis::new(&(own * own.transpose())).t.tr_mul(&values).norm_squared();
        let excess = costs[index] - rise / variance;
        if excess >= 0.0 && worst.is_none_or(|(most, _)| excess > most) {
            worst = Some((excess, index));
        }
    }
    worst.map(|(_, index)| index)
}
