//! Two ordinary causes at once: one exotic effect can do most of what two springs under gravity do, and a search
//! that adds one effect after the other would keep it.

use nalgebra::{DMatrix, DVector};

use super::forward::{Explained, Search};
use crate::diagnose::fit::Fitted;
use crate::diagnose::normal_equations::Candidate;
use crate::diagnose::options::DiagnoseError;
use crate::effects::{Forms, Group};
use crate::infer::constants::{EXCHANGE, OWN};
use crate::infer::{Basis, Observations, Scale, Squares, against, price, starts};

/// Two causes, and the evidence of both beside the frames.
struct Pair {
    causes: [usize; 2],
    values: Vec<f64>,
    gain: f64,
}

impl Search<'_, '_> {
    /// What was found (`now`), or the best pair of ordinary causes beside the frames (`begun`) if that has more
    /// evidence.
    pub(super) fn or_paired(
        &self,
        begun: &Explained,
        now: Explained,
    ) -> Result<Explained, DiagnoseError> {
        let is_ordinary = |c: &&Candidate| is_ordinary(c);
        let ordinary: Vec<Candidate> =
            self.candidates.iter().filter(is_ordinary).cloned().collect();
        let is_found = |cause: usize| {
            let found = &now.fit.model.found;
            ordinary[cause].effect().is_some_and(|(effect, spot)| {
                found.iter().any(|f| f.effect == effect && f.spot.place == spot.place)
            })
        };
        let best = self.best_pair(begun, &ordinary);
        let Some(best) = best.filter(|p| !p.causes.into_iter().all(is_found)) else {
            return Ok(now);
        };
        let sizes = best.causes.map(|cause| ordinary[cause].size);
        let (first, second) = best.values.split_at(sizes[0]);
        let causes = best.causes.iter().zip([first, second]);
        let added: Vec<Fitted> = causes
            .filter_map(|(cause, values)| {
                let (_, spot) = ordinary[*cause].effect()?;
                ordinary[*cause].fitted(spot, values.to_vec())
            })
            .collect();
        let Some(fit) = self.with(begun, &[], added, f64::INFINITY)? else { return Ok(now) };
        let pair = self.converged(fit, begun.weights)?;
        // By the noise of either.
        let is_better = [&now, &pair]
            .into_iter()
            .all(|by| against(self, &pair, by) + EXCHANGE < against(self, &now, by));
        Ok(if is_better { pair } else { now })
    }

    fn best_pair(&self, begun: &Explained, ordinary: &[Candidate]) -> Option<Pair> {
        let model = &begun.fit.model;
        let fitted = model.parameters(self.problem);
        let gathered = self.gather(begun, ordinary, &[]);
        let mut normal = gathered.total.zz;
        let mut right = gathered.total.zr;
        model.hold(self.problem, &mut normal, &mut right);
        let left = self.left(begun);
        let all = normal.nrows() - fitted;
        let basis = Basis::new(&normal.view((0, 0), (fitted, fitted)).into_owned());
        let across = basis.t.tr_mul(&normal.view((0, fitted), (fitted, all)));
        let mine = basis.t.tr_mul(&right.rows(0, fitted));
        let sizes = normal.diagonal().rows(fitted, all).into_owned();
        let mut own = normal.view((fitted, fitted), (all, all)) - across.tr_mul(&across);
        let shown = DVector::from_fn(all, |k, _| own[(k, k)] > OWN * OWN * sizes[k]);
        let right = right.rows(fitted, all) - across.tr_mul(&mine);
        let held: Vec<f64> = ordinary.iter().flat_map(|c| c.usual.held.clone()).collect();
        held.iter().enumerate().for_each(|(k, held)| own[(k, k)] += held * held);
        let own_sizes: Vec<usize> = ordinary.iter().map(|c| c.size).collect();
        let begins = starts(&own_sizes);
        let ranges: Vec<_> =
            begins.iter().zip(own_sizes).map(|(at, size)| *at..at + size).collect();
        let seen = |cause: &usize| ranges[*cause].clone().any(|k| shown[k]);
        let causes: Vec<usize> = (0..ordinary.len()).filter(seen).collect();
        let scale = self.scale(begun);
        let fall = |causes: [usize; 2]| {
            let columns: Vec<usize> = causes.into_iter().flat_map(|c| ranges[c].clone()).collect();
            let matrix: DMatrix<f64> = own.select_rows(&columns).select_columns(&columns);
            let right = right.select_rows(&columns);
            let least: Vec<f64> =
                causes.into_iter().flat_map(|c| ordinary[c].usual.least.clone()).collect();
            let sizes = sizes.select_rows(&columns);
            let squares = Squares { matrix: &matrix, right: &right, sizes, decided: OWN * OWN };
            let (values, _) = squares.solve(&least);
            let held: Vec<f64> = columns.iter().map(|k| held[*k]).collect();
            (squares.fall(&values), values, matrix, held)
        };
        let pairs = causes
            .iter()
            .enumerate()
            .flat_map(|(k, first)| causes[k + 1..].iter().map(move |second| [*first, *second]));
        let falls: Vec<_> = pairs.map(|causes| (causes, fall(causes))).collect();
        let most = falls.iter().map(|(_, (fall, ..))| *fall).fold(0.0, f64::max);
        let variance = scale.variance((left - most).max(0.0), fitted);
        let weighed = falls.into_iter().map(|(causes, (fall, values, matrix, held))| {
            let price = price(matrix, &held, Some(values.as_slice()), scale.numbers, variance);
            let multiplicity = causes.into_iter().map(|c| ordinary[c].usual.multiplicity).product();
            let gain = fall / variance - Scale::cost(price, multiplicity);
            Pair { causes, values: values.iter().copied().collect(), gain }
        });
        weighed.max_by(|a, b| a.gain.total_cmp(&b.gain))
    }
}

/// Whether it is a spring, a zero or a length: what every arm has amiss.
fn is_ordinary(candidate: &Candidate) -> bool {
    candidate.effect().is_some_and(|(effect, _)| {
        let spring = effect.group() == Some(Group::Elastic);
        let whole = effect.forms_are() == Forms::One && !effect.is_tolerated();
        whole && (spring || effect.is_geometry())
    })
}
