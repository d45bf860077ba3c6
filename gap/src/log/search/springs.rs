//! The springs of the joints: what a log tells of each, found or not, and everything else beside those
//! that are known from elsewhere.

use nalgebra::DMatrix;

use super::dictionary::Dictionary;
use super::fit::{minimum, weights};
use super::judge::Verdict;
use super::normal_equations::sum;
use super::unseen::half_widths;
use crate::log::effects::{DROOP, ELASTICITY, LogEffect, Spot};
use crate::log::model::{Acting, Model};
use crate::log::scene::Domain;
use crate::spring::Spring;

/// What a log tells of the joints' springs.
#[derive(Clone)]
pub struct Springs {
    /// Of each joint of which it tells something.
    pub told: Vec<Spring>,
    /// As what it tells it.
    pub effect: &'static dyn LogEffect,
    /// Of each joint that was asked: it, its column, and what the robot file knows already.
    asked: Vec<(usize, usize, f64)>,
    /// Columns of the model.
    fitted: usize,
    /// Products of those, of the springs' that the model lacks, and of the left side.
    products: DMatrix<f64>,
    /// From where the number of each of the model's columns counts.
    from: Vec<f64>,
}

impl Springs {
    /// Of a log's model and the joints that may have a spring.
    pub fn of(dict: &Dictionary<'_>, verdict: &Verdict) -> Springs {
        let fit = &verdict.now.fit;
        let effect = if dict.case.kind.0 == Domain::Position { DROOP } else { ELASTICITY };
        let is_spring = |of: &dyn LogEffect| of.identifier() == effect.identifier();
        let (mut columns, fitted) = (fit.columns.clone(), fit.columns.len());
        let mut asked = Vec::new();
        for offer in dict.offers.iter().filter(|offer| is_spring(offer.effect)) {
            let Some(joint) = offer.spot.joint() else { continue };
            let terms = fit.terms.iter();
            let is_own = |t: &&super::fit::Term| is_spring(t.effect) && t.spot == offer.spot;
            let column = match terms.clone().find(is_own) {
                Some(_) => {
                    let before = terms.take_while(|t| !is_own(t)).map(|t| t.values.len());
                    fitted - fit.terms.iter().map(|t| t.values.len()).sum::<usize>()
                        + before.sum::<usize>()
                }
                None => {
                    columns.extend(offer.entries[0].columns.iter().cloned());
                    columns.len() - 1
                }
            };
            let known = dict.case.known.iter();
            let known = known.filter(|k| is_spring(k.effect) && k.spot == offer.spot);
            asked.push((joint, column, known.map(|k| k.values[0]).sum()));
        }
        columns.push(fit.left.clone());
        let weights = weights(&verdict.now.sizes);
        let whole = dict.whole().squares(&columns, &weights);
        let n = columns.len();
        let products = sum(whole.iter()).unwrap_or_else(|| DMatrix::zeros(n, n));
        let blocks = dict.sums(&verdict.blocks).squares(&columns, &weights);
        // What was found is told as it was fitted; what was not, beside that.
        let own: Vec<usize> = (0..fitted).chain([n - 1]).collect();
        let of = |k: &[usize]| {
            let part = |m: &DMatrix<f64>| m.select_rows(k).select_columns(k);
            let values = minimum(&part(&products));
            let half = half_widths(&blocks.iter().map(part).collect::<Vec<_>>(), &values);
            (values, half)
        };
        let (found, beside) = (of(&own), of(&(0..n).collect::<Vec<_>>()));
        let told = asked.iter().map(|(joint, column, known)| {
            let is_found = *column < fitted;
            let (values, half) = if is_found { &found } else { &beside };
            Spring::new(*joint, known + values[*column], half[*column], is_found)
        });
        let told = told.filter(|spring| spring.half_width() > 0.0).collect();
        let mut from = vec![0.0; fitted];
        let mut at = fitted - fit.terms.iter().map(|t| t.values.len()).sum::<usize>();
        for term in &fit.terms {
            let entry = dict.entry(term);
            for value in &entry.at {
                from[at] = if entry.done.is_some() { *value } else { 0.0 };
                at += 1;
            }
        }
        Springs { told, effect, asked, fitted, products, from }
    }
}

impl Model {
    /// The same with springs that are known, and everything else fitted beside them.
    #[must_use]
    pub fn beside(&self, springs: &[Spring]) -> Model {
        let Springs { effect, asked, fitted, products, from, .. } = &self.springs;
        let value = |(joint, column, known): &(usize, usize, f64)| {
            let spring = springs.iter().find(|s| s.joint == *joint)?;
            Some((*joint, *column, spring.value - known))
        };
        let held: Vec<(usize, usize, f64)> = asked.iter().filter_map(value).collect();
        let is_held = |k: usize| held.iter().any(|(_, column, _)| *column == k);
        let left = products.ncols() - 1;
        let mut products = products.clone();
        for (_, column, value) in &held {
            let away = products.column(*column) * *value;
            products.column_mut(left).axpy(-1.0, &away, 1.0);
            let away = products.row(*column) * *value;
            let mut row = products.row_mut(left);
            row -= away;
        }
        let free: Vec<usize> = (0..*fitted).filter(|k| !is_held(*k)).collect();
        let own: Vec<usize> = free.iter().copied().chain([left]).collect();
        let values = minimum(&products.select_rows(&own).select_columns(&own));
        let mut all = vec![0.0; *fitted];
        free.iter().zip(values).for_each(|(k, value)| all[*k] = from[*k] + value);
        for (_, column, value) in held.iter().filter(|(_, column, _)| column < fitted) {
            all[*column] = *value;
        }
        let numbers = self.terms.iter().map(|t| t.values.len()).sum::<usize>();
        let (rigid, terms) = all.split_at(fitted - numbers);
        let mut model = self.clone();
        // Links that are known have no columns.
        if !rigid.is_empty() {
            model.rigid = rigid.to_vec();
        }
        let mut terms = terms.iter().copied();
        for term in &mut model.terms {
            term.values = terms.by_ref().take(term.values.len()).collect();
        }
        let lacking = held.iter().filter(|(_, column, _)| column >= fitted);
        model.terms.extend(lacking.map(|(joint, _, value)| Acting {
            effect: *effect,
            spot: Spot::of_joint(*joint),
            values: vec![*value],
        }));
        model
    }
}
