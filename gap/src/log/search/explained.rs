//! A log as observations: a model with the noise that it leaves, and what may stand in place of its terms.
//!
//! Rows are autocorrelated: a log of 30,000 holds a few hundred numbers. Each joint's rows weigh by what is left of it,
//! and all of them so much less that their squares are as many as those numbers.

use core::convert::Infallible;

use nalgebra::DMatrix;

use super::candidates::Linear;
use super::fit::{Fitted, Term, weights};
use super::normal_equations::sum;
use super::{Search, effective};
use crate::infer::{Columns, Observations, Ranked, Scale, Screen, Terms, Weighed, pruned};
use crate::log::effects::{CATALOGUE, Spot};
use crate::log::scene::Loads;

use super::case::Simple;

/// A model as it is fitted, and the noise that it leaves.
#[derive(Clone)]
pub struct Explained {
    /// The model.
    pub fit: Fitted,
    /// Size of what it leaves of each joint, in which its rows are told.
    pub sizes: Vec<f64>,
    /// Correlation time of that, of each joint, s.
    pub correlation: Vec<f64>,
}

impl<'s> Search<'s, '_> {
    /// Terms fitted, each joint told in what is left of it; at first in `sizes`.
    pub fn explained(&self, terms: &[Term], sizes: &[f64]) -> Explained {
        let fit = Fitted::of(self.dict, terms, self.links, sizes);
        self.told(&fit.terms, &fit.sizes(self.dict))
    }

    /// Terms fitted in these sizes, with the noise that they leave.
    pub fn told(&self, terms: &[Term], sizes: &[f64]) -> Explained {
        let fit = Fitted::of(self.dict, terms, self.links, sizes);
        let (sizes, correlation) = (fit.sizes(self.dict), fit.correlation(self.dict));
        Explained { fit, sizes, correlation }
    }

    /// Terms fitted in the sizes of another model, which are its noise, too.
    pub fn fitted(&self, terms: &[Term], like: &Explained) -> Explained {
        let fit = Fitted::of(self.dict, terms, self.links, &like.sizes);
        Explained { fit, sizes: like.sizes.clone(), correlation: like.correlation.clone() }
    }

    /// A model without what is superfluous, and with what explains it better in the place of others.
    pub fn pruned(&self, now: Explained) -> Explained {
        pruned(self, now, true).unwrap_or_else(|never| match never {})
    }

    /// What the rows of each joint weigh.
    pub(super) fn weights(&self, now: &Explained) -> Vec<f64> {
        let part = self.scale(now).independent;
        weights(&now.sizes).into_iter().map(|weight| part * weight).collect()
    }

    fn entry(&self, term: &Term) -> &Linear<'s> {
        let is_it = |one: &&Linear<'_>| one.offer == term.offer && one.entry == term.entry;
        self.candidates.iter().find(is_it).expect("terms are of the dictionary")
    }

    /// Whether these terms lack an offer, and have what it adds to.
    pub(super) fn lacks(&self, terms: &[&Term], offer: usize) -> bool {
        let (loads, simple, of) = (Loads::default(), Simple::default(), &self.dict.offers[offer]);
        let has = |name: &str, spot: Spot| {
            terms.iter().any(|t| t.effect.identifier() == name && t.spot == spot)
        };
        let stands = |name: &str| {
            let named = CATALOGUE.iter().find(|e| e.identifier() == name);
            let scene = self.dict.case.scene(&simple, self.dict.case.signals, &loads);
            has(name, of.spot) || named.is_some_and(|e| e.in_file(&scene, of.spot))
        };
        !has(of.effect.identifier(), of.spot) && of.effect.beside().is_none_or(stands)
    }
}

/// The terms but some, by their index.
fn but<'t>(terms: &'t [Term], without: &[usize]) -> Vec<&'t Term> {
    let kept = terms.iter().enumerate().filter(|(k, _)| !without.contains(k));
    kept.map(|(_, term)| term).collect()
}

impl<'s> Observations for Search<'s, '_> {
    type Fit = Explained;
    type Candidate = Linear<'s>;
    type Error = Infallible;

    fn beside(&self, now: &Explained, without: &[usize]) -> Screen<'_, Linear<'s>> {
        let others: Vec<Term> = but(&now.fit.terms, without).into_iter().cloned().collect();
        self.screen_of(&self.fitted(&others, now), None, &self.candidates)
    }

    fn scale(&self, now: &Explained) -> Scale {
        let rows: f64 = self.dict.used.iter().sum();
        let own = effective(&self.dict.used, &now.correlation, self.dict.case.signals);
        Scale { known: false, numbers: rows as usize, independent: own / rows.max(1.0) }
    }

    fn left_by(&self, now: &Explained, by: &Explained) -> f64 {
        let (columns, values) = now.fit.bordered();
        let square = |joint: usize| self.dict.whole().square(joint, &columns, &values);
        let joints = self.weights(by).into_iter().enumerate();
        let squares: f64 = joints.map(|(joint, weight)| weight * square(joint)).sum();
        let terms = self.terms(now).each;
        let each = terms.iter().flat_map(|term| term.values.iter().zip(&term.usual.held));
        squares + each.map(|(value, held)| (value * held).powi(2)).sum::<f64>()
    }

    fn normal(&self, now: &Explained) -> DMatrix<f64> {
        let count = now.fit.columns.len();
        let products = self.dict.whole().squares(&now.fit.columns, &self.weights(now));
        let mut normal = sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(count, count));
        let terms = self.terms(now);
        let held = terms.each.iter().flat_map(|term| &term.usual.held);
        for (at, held) in held.enumerate() {
            normal[(terms.nuisances + at, terms.nuisances + at)] += held * held;
        }
        normal
    }

    fn terms<'f>(&'f self, now: &'f Explained) -> Terms<'f> {
        let weighed = |term: &'f Term| {
            let entry = self.entry(term);
            Weighed {
                values: &term.values,
                usual: entry.usual(),
                is_tolerated: false,
                is_proportional: !entry.is_linearized(),
                margin: term.margin,
            }
        };
        let each: Vec<Weighed<'f>> = now.fit.terms.iter().map(weighed).collect();
        let own: usize = each.iter().map(|term| term.values.len()).sum();
        Terms { nuisances: now.fit.columns.len() - own, along: 0, each }
    }

    fn replacing<'n>(
        &'n self,
        now: &'n Explained,
        without: &'n [usize],
    ) -> Box<dyn Fn(&Ranked) -> bool + 'n> {
        let others = but(&now.fit.terms, without);
        let gone: Vec<&Term> = without.iter().map(|k| &now.fit.terms[*k]).collect();
        Box::new(move |one| {
            let candidate = &self.candidates[one.candidate];
            let spot = self.dict.offers[candidate.offer].spot;
            // What drives other joints alone explains no row of these.
            gone.iter().any(|term| spot.meets(term.spot))
                && (gone.len() > 1 || gone[0].offer != candidate.offer)
                && self.lacks(&others, candidate.offer)
                && self.dict.case.is_feasible(&self.term(candidate, &one.score.values))
        })
    }

    fn is_pair(&self, now: &Explained, [one, other]: [usize; 2]) -> bool {
        now.fit.terms[one].spot == now.fit.terms[other].spot
    }

    fn replaced(
        &self,
        now: &Explained,
        without: &[usize],
        by: Option<(&Ranked, &Screen<'_, Linear<'s>>)>,
        below: f64,
    ) -> Result<Option<Explained>, Infallible> {
        let others: Vec<Term> = but(&now.fit.terms, without).into_iter().cloned().collect();
        let mut terms = others;
        if let Some((one, screen)) = by {
            // It stands where the first of them stood.
            let term = self.term(&screen.candidates[one.candidate], &one.score.values);
            terms.insert(without[0].min(terms.len()), term);
        }
        let fitted = self.explained(&terms, &now.sizes);
        let is_feasible = fitted.fit.terms.iter().all(|term| self.dict.case.is_feasible(term));
        let is_better = is_feasible && self.left_by(&fitted, now) <= below;
        Ok(is_better.then_some(fitted))
    }

    fn note_margin(&self, now: &mut Explained, term: usize, margin: f64) {
        now.fit.terms[term].margin = margin;
    }
}
