//! A model of a log, fitted: what the rigid links ask, and effects at their places.

use nalgebra::DMatrix;

use super::dictionary::{Dictionary, Entry, Mixed};
use super::normal_equations::sum;
use crate::infer::Basis;
use crate::log::effects::{LogEffect, Spot};
use crate::parallel;

/// An effect at a place, with its values.
#[derive(Clone)]
pub struct Term {
    /// Which of the dictionary's offers.
    pub offer: usize,
    /// About which values it is linearised.
    pub entry: usize,
    /// The effect.
    pub effect: &'static dyn LogEffect,
    /// Where.
    pub spot: Spot,
    /// Its numbers, SI.
    pub values: Vec<f64>,
    /// By how much more evidence it had than any other in its place when last compared; 0 before.
    pub margin: f64,
}

/// What is known of the rigid links.
#[derive(Clone, Debug, PartialEq)]
pub enum Links {
    /// Nothing: they are fitted along.
    Free,
    /// The values of their columns.
    Known(Vec<f64>),
}

impl Links {
    /// The values of their columns, of a fit whose first `base` values they are where nothing is known.
    pub fn values(&self, fitted: &[f64], base: usize) -> Vec<f64> {
        match self {
            Links::Free => fitted[..base].to_vec(),
            Links::Known(values) => values.clone(),
        }
    }
}

/// A fit.
#[derive(Clone)]
pub struct Fitted {
    /// With their values.
    pub terms: Vec<Term>,
    /// The rigid links' columns, if these are free, then the terms' in their order.
    pub columns: Vec<Mixed>,
    /// What they are fitted to.
    pub left: Mixed,
    /// Values of all columns.
    pub values: Vec<f64>,
    /// What is known of the rigid links.
    pub links: Links,
}

impl Dictionary<'_> {
    /// An effect at a place where it is linearised.
    pub fn term(&self, offer: usize, entry: usize) -> Term {
        let of = &self.offers[offer];
        let values = of.entries[entry].at.clone();
        Term { offer, entry, effect: of.effect, spot: of.spot, values, margin: 0.0 }
    }

    /// Its columns there.
    pub fn entry(&self, term: &Term) -> &Entry {
        &self.offers[term.offer].entries[term.entry]
    }

    /// What is to be explained, less what is known of the links and what terms do where they are
    /// linearised.
    pub fn left(&self, links: &Links, terms: &[Term]) -> Mixed {
        let known: &[f64] = if let Links::Known(values) = links { values } else { &[] };
        let known = known.iter().enumerate().map(|(column, value)| (column, -value));
        let done = terms.iter().filter_map(|term| self.entry(term).done.as_ref());
        let done = done.flat_map(|done| done.of.iter().map(|(column, x)| (*column, -x)));
        let of = [(self.target, 1.0)].into_iter().chain(known).chain(done);
        Mixed { of: of.collect(), run: None }
    }
}

impl Fitted {
    /// Fits the links, if they are free, and these terms by least squares, each joint's rows told in
    /// its size.
    pub fn of(dict: &Dictionary<'_>, terms: &[Term], links: &Links, sizes: &[f64]) -> Fitted {
        let base = if *links == Links::Free { dict.base } else { 0 };
        let own = terms.iter().flat_map(|term| dict.entry(term).columns.clone());
        let columns: Vec<Mixed> = (0..base).map(Mixed::one).chain(own).collect();
        let left = dict.left(links, terms);
        let mut all = columns.clone();
        all.push(left.clone());
        let products = dict.whole().squares(&all, &weights(sizes));
        let products = sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(all.len(), all.len()));
        let values = minimum(&products);
        let mut found = values[base..].iter();
        let mut terms = terms.to_vec();
        for term in &mut terms {
            let entry = dict.entry(term);
            // What is linearised is sought beside the values there; what is in proportion whole.
            let from = entry.at.iter().map(|at| if entry.done.is_some() { *at } else { 0.0 });
            term.values = from.zip(&mut found).map(|(from, by)| from + by).collect();
        }
        Fitted { terms, columns, left, values, links: links.clone() }
    }

    /// The values of the rigid links' columns, with what terms change of them in every run.
    pub fn rigid(&self, dict: &Dictionary<'_>) -> Vec<f64> {
        let mut values = self.links.values(&self.values, dict.base);
        let is_carried = |term: &&Term| dict.case.carried(term.effect, term.spot).is_some();
        for term in self.terms.iter().filter(is_carried) {
            let columns = dict.entry(term).columns.iter().zip(&term.values);
            for (column, value) in columns.filter(|(column, _)| column.run.is_none()) {
                column.of.iter().for_each(|(row, x)| values[*row] += x * value);
            }
        }
        values
    }

    /// The columns and the left side, with their values and −1.
    pub fn bordered(&self) -> (Vec<Mixed>, Vec<f64>) {
        let columns = self.columns.iter().chain([&self.left]).cloned().collect();
        (columns, self.values.iter().copied().chain([-1.0]).collect())
    }

    /// Root mean square of what is left of each joint.
    pub fn sizes(&self, dict: &Dictionary<'_>) -> Vec<f64> {
        let (columns, values) = self.bordered();
        dict.sizes(&columns, &values)
    }

    /// What is left at the rows of the sample, of each joint.
    pub fn sampled(&self, dict: &Dictionary<'_>) -> Vec<Vec<Option<f64>>> {
        let (columns, values) = self.bordered();
        let values: Vec<f64> = values.iter().map(|x| -x).collect();
        dict.sampled(&columns, &values)
    }

    /// The correlation time of what is left, of each joint, s.
    pub fn correlation(&self, dict: &Dictionary<'_>) -> Vec<f64> {
        parallel::each(&self.sampled(dict), &|rows| dict.correlation(rows))
    }
}

/// What rows weigh that are told in these sizes.
pub fn weights(sizes: &[f64]) -> Vec<f64> {
    sizes.iter().map(|size| 1.0 / (size * size)).collect()
}

/// The values of least squares, of products whose last column is the left side's.
pub fn minimum(products: &DMatrix<f64>) -> Vec<f64> {
    let n = products.nrows() - 1;
    let matrix = products.view((0, 0), (n, n)).into_owned();
    let right = products.view((0, n), (n, 1)).column(0).into_owned();
    Basis::ordered(&matrix).solve(&right).iter().copied().collect()
}
