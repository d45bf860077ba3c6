//! Candidates beside a fitted model, in coordinates of the model in which its normal matrix is the
//! identity.

use super::basis::Basis;
use super::products::{Products, starts};
use crate::parallel;

/// What is usual of a candidate, before the data.
#[derive(Clone, Debug)]
pub struct Usual {
    /// Least values of its numbers.
    pub least: Vec<f64>,
    /// Inverse of the standard deviation to which each of its numbers is held; 0 where any value is as good.
    pub held: Vec<f64>,
    /// Forms and places that it has: each more is one more chance to fit noise.
    pub multiplicity: usize,
}

/// What may be added to a model, as far as its columns go.
pub trait Columns: Sync {
    /// What is usual of it.
    fn usual(&self) -> &Usual;

    /// Whether its numbers are held to what makers tolerate.
    fn is_tolerated(&self) -> bool {
        false
    }

    /// Whether it is linearized about values that are not 0: a last column is then what it does there.
    fn is_linearized(&self) -> bool {
        false
    }

    /// Its columns.
    fn columns(&self) -> usize {
        self.usual().least.len() + usize::from(self.is_linearized())
    }
}

/// Candidates beside a fitted model.
pub struct Screen<'c, C> {
    /// All of them, in the order of their products.
    pub candidates: &'c [C],
    /// First column of each candidate.
    pub(super) at: Vec<usize>,
    /// Of the model's normal matrix.
    pub basis: Basis,
    /// Of all rows, and of what the model's parameters and each candidate's numbers are held to; `z`
    /// in the coordinates of `basis`.
    pub total: Products,
    /// The part of `total` that is what the parameters are held to, a measurement of each.
    pub prior: Products,
    /// The same of each block; none where they were not wanted.
    pub blocks: Vec<Products>,
    pub(super) fold_of_block: Vec<usize>,
    /// The same of each fold.
    pub(super) folds: Vec<Products>,
    /// Of each fold, what is measured first alone, in m or rad.
    pub(super) plain: Vec<Products>,
}

impl<'c, C: Columns> Screen<'c, C> {
    /// Of all rows alone, where nothing is held out and no signs are flipped. `prior` is a part of
    /// `total`.
    pub fn new(
        candidates: &'c [C],
        basis: Basis,
        mut total: Products,
        mut prior: Products,
    ) -> Self {
        total.turn(&basis.t);
        prior.turn(&basis.t);
        let sizes: Vec<usize> = candidates.iter().map(Columns::columns).collect();
        Self {
            candidates,
            at: starts(&sizes),
            basis,
            total,
            prior,
            blocks: Vec::new(),
            fold_of_block: Vec::new(),
            folds: Vec::new(),
            plain: Vec::new(),
        }
    }

    /// The same with what each block and each fold of them says.
    pub fn by_block(
        mut self,
        mut blocks: Vec<Products>,
        mut plain: Vec<Products>,
        fold_of_block: &[usize],
        folds: usize,
    ) -> Self {
        let turn = |products: &mut Products| products.turn(&self.basis.t);
        parallel::change(&mut blocks, &turn);
        parallel::change(&mut plain, &turn);
        let sizes: Vec<usize> = self.candidates.iter().map(Columns::columns).collect();
        self.folds = vec![Products::zeros(self.basis.rank(), &sizes); folds];
        for (products, fold) in blocks.iter().zip(fold_of_block) {
            self.folds[*fold].add(products);
        }
        (self.blocks, self.plain, self.fold_of_block) = (blocks, plain, fold_of_block.to_vec());
        self
    }

    /// Columns of a candidate in the products.
    pub fn range(&self, candidate: usize) -> std::ops::Range<usize> {
        let from = self.at[candidate];
        from..from + self.candidates[candidate].columns()
    }

    /// Sum of squares left without any candidate, and what it costs to hold the parameters.
    pub fn left(&self) -> f64 {
        self.total.rr - self.total.zr.norm_squared()
    }
}
