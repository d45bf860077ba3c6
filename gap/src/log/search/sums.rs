//! Least squares of many rows by their products, block by block.

use nalgebra::{DMatrix, DVector, DVectorViewMut};

use super::stock::Mixed;

/// A column of which less than this part of its square stands apart from those before it says nothing
/// of its own.
const APART: f64 = 1e-9;

/// Products of the stored columns of each joint, block by block.
#[derive(Clone, Debug, Default)]
pub struct Sums {
    /// The run of each block.
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

/// The least of the squares `xᵀ A x − 2 bᵀ x`; unknowns that say nothing beside those before them stay
/// zero.
#[derive(Clone, Debug)]
pub struct Solver {
    /// Rows of Cholesky's factor of the matrix scaled to a diagonal of one; of unknowns that are left
    /// out nothing.
    factor: DMatrix<f64>,
    scale: DVector<f64>,
    /// Which unknowns are solved for.
    pub seen: Vec<bool>,
}

impl Solver {
    /// Of a symmetric matrix.
    pub fn of(matrix: &DMatrix<f64>) -> Solver {
        let n = matrix.nrows();
        let scale = DVector::from_fn(n, |k, _| {
            let size = matrix[(k, k)];
            if size > 0.0 { 1.0 / size.sqrt() } else { 0.0 }
        });
        let mut factor = DMatrix::<f64>::zeros(n, n);
        let mut seen = vec![false; n];
        for row in 0..n {
            for column in 0..=row {
                let known: f64 = (0..column).map(|k| factor[(row, k)] * factor[(column, k)]).sum();
                let rest = matrix[(row, column)] * scale[row] * scale[column] - known;
                if row == column {
                    seen[row] = rest > APART;
                    factor[(row, row)] = if seen[row] { rest.sqrt() } else { 0.0 };
                } else if seen[column] {
                    factor[(row, column)] = rest / factor[(column, column)];
                }
            }
            if !seen[row] {
                (0..row).for_each(|k| factor[(row, k)] = 0.0);
            }
        }
        Solver { factor, scale, seen }
    }

    /// The first half of a solution, in place.
    fn forwards(&self, mut column: DVectorViewMut<'_, f64>) {
        for row in 0..self.seen.len() {
            let known: f64 = (0..row).map(|k| self.factor[(row, k)] * column[k]).sum();
            column[row] = match self.seen[row] {
                true => (column[row] * self.scale[row] - known) / self.factor[(row, row)],
                false => 0.0,
            };
        }
    }

    /// For right-hand sides, one a column.
    pub fn solve(&self, right: &DMatrix<f64>) -> DMatrix<f64> {
        let n = self.seen.len();
        let mut x = right.clone();
        for mut column in x.column_iter_mut() {
            self.forwards(column.as_view_mut());
            for row in (0..n).rev() {
                let known: f64 = (row + 1..n).map(|k| self.factor[(k, row)] * column[k]).sum();
                if self.seen[row] {
                    column[row] = (column[row] - known) / self.factor[(row, row)];
                }
            }
            column.component_mul_assign(&self.scale);
        }
        x
    }
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

impl Solver {
    /// What is left of columns of these squares, without those of which nothing is.
    pub fn apart(left: &DMatrix<f64>, squares: &DVector<f64>) -> DMatrix<f64> {
        let mut told = left.clone();
        for k in (0..left.nrows()).filter(|k| left[(*k, *k)] <= APART * squares[*k]) {
            told.row_mut(k).fill(0.0);
            told.column_mut(k).fill(0.0);
        }
        told
    }

    /// `L⁻¹` of what is left `L Lᵀ` of columns of these squares, so that `|L⁻¹ v|²` tells `v` in what it
    /// weighs; rows of 0 of those that say nothing.
    pub fn inverse_root(left: &DMatrix<f64>, squares: &DVector<f64>) -> DMatrix<f64> {
        let n = left.nrows();
        let solver = Solver::of(&Solver::apart(left, squares));
        let mut root = DMatrix::identity(n, n);
        for mut column in root.column_iter_mut() {
            solver.forwards(column.as_view_mut());
        }
        root
    }
}
