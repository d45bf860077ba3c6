//! What was found, put in order and held out: each row predicted by fits that have not seen it.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Vector6};

use crate::diagnose::data::{Folds, Problem};
use crate::diagnose::fit::{Bond, Fit, Model, block};
use crate::diagnose::search::{Explained, Search};
use crate::effects::At;
use crate::infer::limits::CHUNK;
use crate::infer::{Basis, Products, RANK, ordered};
use crate::parallel;

/// The effects of one finding, ascending: all forms of one effect at one place are one.
pub(crate) type Group = Vec<usize>;

/// Findings in the order in which they shrink the held-out gap most, and what is left of it before the
/// first and after each.
pub(crate) struct Shrinking {
    /// Of the groups as they were given.
    pub(crate) order: Vec<usize>,
    /// Steps × rows: how far each row is off.
    sizes: DMatrix<f64>,
    /// Gap of each row with all of them.
    pub(crate) after: Vec<Vector6<f64>>,
}

impl Shrinking {
    /// How far each row is off with the first groups.
    pub(crate) fn sizes_after(&self, count: usize) -> Vec<f64> {
        self.sizes.row(count).iter().copied().collect()
    }
}

/// The fit's products fold by fold, ready to be solved again without some of its parts.
pub(crate) struct Held<'h> {
    problem: &'h Problem<'h>,
    folds: &'h Folds,
    fit: &'h Fit,
    /// Weighted, all effects given back.
    of_fold: Vec<Products>,
    total: Products,
    /// Of each block of poses, weighted and as it is measured first, m or rad.
    pub(super) blocks: Vec<[Products; 2]>,
    /// Which parameters belong to which effect; what is fitted along to none.
    owner: Vec<Option<usize>>,
}

impl<'h> Held<'h> {
    pub(crate) fn new(search: &Search<'h, 'h>, now: &'h Explained) -> Self {
        let (problem, folds, fit) = (search.problem, search.folds, &now.fit);
        let mut owner = vec![None; Model::nuisances(problem)];
        for (index, found) in fit.model.found.iter().enumerate() {
            let own = (index >= Model::along(problem)).then_some(index);
            owner.extend(std::iter::repeat_n(own, found.values.len()));
        }
        let values = DVector::from_vec(fit.model.values(problem));
        let mut of_fold = vec![Products::zeros(owner.len(), &[]); folds.count];
        let mut total = Products::zeros(owner.len(), &[]);
        let gathered = search.gathered(now);
        let both = gathered.blocks.iter().zip(&gathered.plain_blocks);
        let blocks: Vec<[Products; 2]> =
            both.map(|both| <[&Products; 2]>::from(both).map(|p| p.given_back(&values))).collect();
        for (block, [white, _]) in blocks.iter().enumerate() {
            of_fold[folds.of_block[block]].add(white);
            total.add(white);
        }
        Self { problem, folds, fit, of_fold, total, blocks, owner }
    }

    /// The values of all parameters with the effects of `groups` fitted to the other folds, a
    /// column for each fold; those of other effects are 0.
    fn values(&self, groups: &[&Group]) -> DMatrix<f64> {
        let kept = self.kept(groups);
        let each = self.of_fold.iter().map(|own| {
            let mut others = self.total.clone();
            others.add_scaled(own, -1.0);
            self.solved(&others, &kept)
        });
        DMatrix::from_columns(&each.collect::<Vec<_>>())
    }

    /// Number of parameters.
    pub(super) fn parameters(&self) -> usize {
        self.owner.len()
    }

    /// The parameters of some groups, and what is fitted along.
    pub(super) fn kept(&self, groups: &[&Group]) -> Vec<usize> {
        let is_kept =
            |c: &usize| self.owner[*c].is_none_or(|o| groups.iter().any(|g| g.contains(&o)));
        (0..self.owner.len()).filter(is_kept).collect()
    }

    /// The values of all parameters of which some are kept; those of the others are 0.
    pub(super) fn solved(&self, rows: &Products, kept: &[usize]) -> DVector<f64> {
        let held = self.fit.model.held(self.problem);
        let mut matrix = rows.zz.select_rows(kept).select_columns(kept);
        kept.iter().enumerate().for_each(|(k, at)| matrix[(k, k)] += held[*at].powi(2));
        let mut right = rows.zr.select_rows(kept);
        let back = self.fit.model.values(self.problem);
        for bond in Bond::all(self.problem, &self.fit.model) {
            bond.chosen(kept, &back).add(&mut matrix, &mut right);
        }
        let found = match matrix.clone().cholesky().filter(|root| is_decided(root, &matrix)) {
            Some(root) => root.solve(&right),
            None => Basis::new(&matrix).solve(&right),
        };
        let mut values = DVector::zeros(self.owner.len());
        kept.iter().zip(found.iter()).for_each(|(at, value)| values[*at] = *value);
        values
    }

    /// Weighted squares of the held-out rows with such values.
    fn squares(&self, values: &DMatrix<f64>) -> f64 {
        let each = self.of_fold.iter().zip(values.column_iter());
        each.map(|(own, values)| own.left(&values.into_owned())).sum()
    }

    /// Weighted squares that some groups leave of the held-out rows.
    pub(super) fn left(&self, groups: &[&Group]) -> f64 {
        self.squares(&self.values(groups))
    }

    /// What is left of each row: `values` are those before the first group and after each of the `order`.
    fn shrinking(&self, order: Vec<usize>, values: &[DMatrix<f64>]) -> Shrinking {
        let own = DVector::from_vec(self.fit.model.values(self.problem));
        let rows = self.problem.data.rows.len();
        let mut sizes = DMatrix::zeros(values.len(), rows);
        let mut after = vec![Vector6::zeros(); rows];
        let of_row = |row: usize, sizes: &mut [f64]| {
            let block = block(self.problem, self.fit, row, &self.problem.mask);
            let gap = self.fit.predicted.gaps[row] + &block * &own;
            let fold = self.folds.of_row(row);
            let mut last = gap;
            for (size, values) in sizes.iter_mut().zip(values) {
                last = gap - &block * values.column(fold);
                *size = self.problem.size(&last);
            }
            last
        };
        let chunks = sizes.as_mut_slice().chunks_mut(CHUNK * values.len());
        let mut parts: Vec<_> = chunks.zip(after.chunks_mut(CHUNK)).enumerate().collect();
        parallel::change(&mut parts, &|(k, (sizes, after))| {
            let each = after.iter_mut().zip(sizes.chunks_exact_mut(values.len())).enumerate();
            each.for_each(|(row, (after, sizes))| *after = of_row(CHUNK * *k + row, sizes));
        });
        Shrinking { order, sizes, after }
    }

    /// The held-out gaps without any effect that was found.
    pub(crate) fn without_findings(&self) -> Vec<Vector6<f64>> {
        self.shrinking(Vec::new(), &[self.values(&[])]).after
    }

    /// The groups in the order in which they shrink the held-out gap most, and what is left before the
    /// first and after each. Beside nothing that holds it to what makers tolerate, the whole
    /// table would take up a length or zero that is off by far more: it comes after those.
    pub(crate) fn ordered(&self, groups: &[Group]) -> Shrinking {
        let effect = |k: usize| self.fit.model.found[groups[k][0]].effect;
        let is_of_table = |k: usize| {
            effect(k).is_geometry() && matches!(effect(k).facts().at, At::Joints | At::Links)
        };
        let with = |chosen: &[usize]| {
            let is_last = |k: usize| chosen.contains(&k) || !is_of_table(k);
            let is_early = chosen.last().is_some_and(|k| effect(*k).is_tolerated())
                && !(0..groups.len()).all(is_last);
            (is_early, self.values(&chosen.iter().map(|k| &groups[*k]).collect::<Vec<_>>()))
        };
        let size = |(is_early, values): &(bool, DMatrix<f64>)| match is_early {
            true => f64::INFINITY,
            false => self.squares(values),
        };
        let each = ordered(groups.len(), with, size);
        let (order, after): (Vec<usize>, Vec<DMatrix<f64>>) =
            each.into_iter().map(|(k, (_, values))| (k, values)).unzip();
        let values: Vec<_> = std::iter::once(self.values(&[])).chain(after).collect();
        self.shrinking(order, &values)
    }
}

/// Whether no direction of a normal matrix is left undecided: what is left of a column beside those
/// before it is more than rounding.
fn is_decided(root: &Cholesky<f64, Dyn>, matrix: &DMatrix<f64>) -> bool {
    let own = root.l_dirty().diagonal();
    own.iter().zip(matrix.diagonal().iter()).all(|(own, all)| own * own > RANK * all)
}

/// All forms of one effect at one place are one finding; what is fitted along is none.
pub(crate) fn groups(problem: &Problem<'_>, model: &Model) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, found) in model.found.iter().enumerate().skip(Model::along(problem)) {
        let same = |group: &&mut Group| {
            let first = &model.found[group[0]];
            first.effect.identifier() == found.effect.identifier()
                && first.spot.place == found.spot.place
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.push(index),
            None => groups.push(vec![index]),
        }
    }
    groups
}
