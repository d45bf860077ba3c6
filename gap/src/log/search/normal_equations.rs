//! Least squares of many rows by their products, block by block.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::dictionary::{Entry, Mixed};
use crate::infer::Products;
use crate::parallel;

/// Products of the stored columns of each joint, block by block.
#[derive(Clone, Debug, Default)]
pub struct Sums {
    /// The run of each block: the first that carries the same.
    pub runs: Vec<usize>,
    /// Where each stored column stands among a joint's, of each joint.
    pub at: Vec<Vec<Option<usize>>>,
    /// Of each joint each block's.
    pub joints: Vec<Vec<DMatrix<f64>>>,
}

impl Sums {
    /// Products of some columns with others, of each block; each joint's rows weigh so much.
    pub fn products(
        &self,
        columns: &[Mixed],
        others: &[Mixed],
        weights: &[f64],
    ) -> Vec<DMatrix<f64>> {
        self.summed(columns, others, weights, |_, _| true)
    }

    /// Products of some columns with each other, of each block.
    pub fn squares(&self, columns: &[Mixed], weights: &[f64]) -> Vec<DMatrix<f64>> {
        let mut all = self.summed(columns, columns, weights, |column, other| column >= other);
        all.iter_mut().for_each(DMatrix::fill_upper_triangle_with_lower_triangle);
        all
    }

    /// Products of some columns with each other at the rows of one joint, of each block.
    pub fn squares_of(&self, joint: usize, columns: &[Mixed]) -> Vec<DMatrix<f64>> {
        let alone = |other: usize| f64::from(u8::from(other == joint));
        let weights: Vec<f64> = (0..self.joints.len()).map(alone).collect();
        self.squares(columns, &weights)
    }

    /// Of each block the products of some columns, the last of which is what is to be explained, and of
    /// entries beside them.
    pub(crate) fn linearized(
        &self,
        bordered: &[Mixed],
        entries: &[&Entry],
        weights: &[f64],
    ) -> Vec<Products> {
        let last = bordered.len() - 1;
        let columns = |entry: &&Entry| -> Vec<Mixed> {
            entry.columns.iter().chain(&entry.done).cloned().collect()
        };
        let beside = |entry: &&Entry| {
            let all = columns(entry);
            (self.products(bordered, &all, weights), self.squares(&all, weights))
        };
        let each = parallel::each(entries, &beside);
        let sizes: Vec<usize> = entries.iter().map(|entry| columns(entry).len()).collect();
        let of_block = |(block, own): (usize, &DMatrix<f64>)| {
            let mut products = Products::zeros(last, &sizes);
            products.zz.copy_from(&own.view((0, 0), (last, last)));
            products.zr.copy_from(&own.view((0, last), (last, 1)));
            products.rr = own[(last, last)];
            let mut at = 0;
            for (cross, _) in &each {
                let (cross, size) = (&cross[block], cross[block].ncols());
                products.zx.columns_mut(at, size).copy_from(&cross.rows(0, last));
                products.xr.rows_mut(at, size).tr_copy_from(&cross.row(last));
                at += size;
            }
            products.xx = Arc::new(each.iter().map(|(_, own)| own[block].clone()).collect());
            products
        };
        self.squares(bordered, weights).iter().enumerate().map(of_block).collect()
    }

    /// Products of those pairs that are wanted, by their indices.
    fn summed(
        &self,
        columns: &[Mixed],
        others: &[Mixed],
        weights: &[f64],
        is_wanted: impl Fn(usize, usize) -> bool,
    ) -> Vec<DMatrix<f64>> {
        let mut all = vec![DMatrix::zeros(columns.len(), others.len()); self.runs.len()];
        for ((joint, at), weight) in self.joints.iter().zip(&self.at).zip(weights) {
            if *weight == 0.0 {
                continue;
            }
            let (columns, others) = (here(columns, at), here(others, at));
            for ((product, sum), run) in joint.iter().zip(&mut all).zip(&self.runs) {
                let is_there = |of: &Here| of.run.is_none_or(|own| own == *run);
                if product.nrows() == 0 {
                    continue;
                }
                for other in others.iter().filter(|c| is_there(c)) {
                    let wanted = columns.iter().filter(|c| is_wanted(c.index, other.index));
                    for column in wanted.filter(|c| is_there(c)) {
                        let mut total = 0.0;
                        for (b, more) in &other.of {
                            let stored = product.column(*b);
                            total +=
                                column.of.iter().map(|(a, x)| x * stored[*a]).sum::<f64>() * more;
                        }
                        sum[(column.index, other.index)] += weight * total;
                    }
                }
            }
        }
        all
    }
}

impl Sums {
    /// The square of a joint's sum of some columns with these values, over all blocks.
    pub fn square(&self, joint: usize, columns: &[Mixed], values: &[f64]) -> f64 {
        let at = &self.at[joint];
        let in_block = |(product, run): (&DMatrix<f64>, &usize)| {
            let mut stored = DVector::zeros(product.nrows());
            let is_there = |column: &Mixed| column.run.is_none_or(|own| own == *run);
            for (column, value) in columns.iter().zip(values).filter(|(c, _)| is_there(c)) {
                let own = column.of.iter().filter_map(|(id, x)| Some((at[*id]?, x)));
                own.for_each(|(k, x)| stored[k] += x * value);
            }
            quadratic(product, &stored)
        };
        self.joints[joint].iter().zip(&self.runs).map(in_block).sum()
    }
}

/// What a joint has of a column.
struct Here {
    index: usize,
    of: Vec<(usize, f64)>,
    run: Option<usize>,
}

fn here(columns: &[Mixed], at: &[Option<usize>]) -> Vec<Here> {
    let of = |(index, column): (usize, &Mixed)| Here {
        index,
        of: column.of.iter().filter_map(|(id, x)| Some((at[*id]?, *x))).collect(),
        run: column.run,
    };
    columns.iter().enumerate().map(of).filter(|here| !here.of.is_empty()).collect()
}

/// `xᵀ A x`, not below zero.
pub fn quadratic(matrix: &DMatrix<f64>, x: &DVector<f64>) -> f64 {
    x.dot(&(matrix * x)).max(0.0)
}

/// The sum of a list of matrices; `None` of none.
pub fn sum<'m>(matrices: impl Iterator<Item = &'m DMatrix<f64>>) -> Option<DMatrix<f64>> {
    let mut sum: Option<DMatrix<f64>> = None;
    for matrix in matrices {
        match &mut sum {
            Some(sum) => *sum += matrix,
            None => sum = Some(matrix.clone()),
        }
    }
    sum
}
