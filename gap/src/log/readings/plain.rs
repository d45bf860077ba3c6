//! A simple model beside which readings are asked for: rigid links, friction that brakes and zeros.

use nalgebra::{DMatrix, DVector};

use crate::infer::{RANK, Squares};
use crate::log::effects::{COULOMB, OFFSET, Spot, VISCOUS};
use crate::log::search::case::{Case, Simple, Wanted};
use crate::log::search::dictionary::{Dictionary, Mixed};
use crate::log::search::fit::weights;
use crate::log::search::normal_equations::sum;

/// Rigid links, friction that brakes and zeros, beside which readings are asked for.
pub(super) struct Plain<'a> {
    pub(super) dict: Dictionary<'a>,
    pub(super) columns: Vec<Mixed>,
    least: Vec<f64>,
}

impl<'a> Plain<'a> {
    /// Of a log, with what else is wanted behind three offers for each joint; of about so many fine samples of it.
    pub(super) fn of(case: &'a Case<'a>, more: Vec<Wanted>, enough: usize) -> Plain<'a> {
        let effects = [COULOMB, VISCOUS, OFFSET];
        let spots = (0..case.signals.joints()).map(Spot::of_joint);
        let own = spots.flat_map(|spot| effects.map(|e| (e, spot, vec![vec![0.0]])));
        let wanted: Vec<Wanted> = own.chain(more).collect();
        let nothing = Simple::nothing(case);
        let thinned = case.signals.t.len().div_ceil(enough);
        let dict = Dictionary::of(case, &nothing, &wanted, thinned);
        let count = 3 * case.signals.joints();
        let mut columns: Vec<Mixed> = (0..dict.base).map(Mixed::one).collect();
        let mut least = vec![f64::NEG_INFINITY; dict.base];
        for offer in &dict.offers[..count] {
            columns.extend(offer.entries[0].columns.iter().cloned());
            let of_file = offer.effect.file_value(case.arm, case.kind.1, offer.spot);
            least.push(offer.effect.parameters()[0].least - of_file);
        }
        Plain { dict, columns, least }
    }

    /// What is left of each joint, each told in its own size, where friction brakes: root mean square.
    pub(super) fn left(&self, more: &[Mixed], left: &Mixed) -> (Vec<f64>, Vec<f64>) {
        let columns: Vec<Mixed> = self.columns.iter().chain(more).cloned().collect();
        let mut least = self.least.clone();
        least.resize(columns.len(), f64::NEG_INFINITY);
        let mut bordered = columns.clone();
        bordered.push(left.clone());
        let n = columns.len();
        let mut sizes = vec![1.0; self.dict.case.signals.joints()];
        let mut values = Vec::new();
        for _ in 0..2 {
            let products = self.dict.whole().squares(&bordered, &weights(&sizes));
            let products = sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(n + 1, n + 1));
            let matrix = products.view((0, 0), (n, n)).into_owned();
            let right: DVector<f64> = products.view((0, n), (n, 1)).column(0).into_owned();
            let squares =
                Squares { sizes: matrix.diagonal(), matrix: &matrix, right: &right, decided: RANK };
            values = squares.solve(&least).0.iter().copied().chain([-1.0]).collect();
            sizes = self.dict.sizes(&bordered, &values);
        }
        (sizes, values)
    }
}
