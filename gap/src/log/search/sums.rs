//! Least squares of many rows by their products, block by block.

use nalgebra::{DMatrix, DVector, DVectorViewMut};

use super::blocks::Blocks;
use crate::log::scene::Column;

/// A column of which less than this part of its square stands apart from those before it says nothing
/// of its own.
const APART: f64 = 1e-9;

/// The rows of every joint, with what they weigh.
#[derive(Clone, Debug)]
pub struct Rows {
    /// Whether a row counts, of each joint.
    pub counts: Vec<Vec<bool>>,
    /// Size of what is left in each joint: rows are told in it.
    pub sizes: Vec<f64>,
}

/// Some columns, each joint's rows beside each other and weighed; `columns[i]` is what each is of all.
#[derive(Clone, Debug)]
struct Joint {
    matrix: DMatrix<f64>,
    columns: Vec<usize>,
}

/// Columns that are multiplied with each other.
#[derive(Clone, Debug)]
pub struct Stack {
    joints: Vec<Joint>,
    count: usize,
}

impl Stack {
    /// Of columns, over so many joints.
    pub fn of(columns: &[&Column], rows: &Rows) -> Stack {
        let joint = |joint: usize| {
            let parts = columns.iter().enumerate().flat_map(|(c, column)| {
                let parts = column.parts.iter().filter(move |(on, _)| *on == joint);
                parts.map(move |(_, part)| (c, part))
            });
            let parts: Vec<(usize, &Vec<f64>)> = parts.collect();
            let counts = &rows.counts[joint];
            let matrix = DMatrix::from_fn(counts.len(), parts.len(), |k, c| match counts[k] {
                true => parts[c].1[k] / rows.sizes[joint],
                false => 0.0,
            });
            Joint { matrix, columns: parts.into_iter().map(|(c, _)| c).collect() }
        };
        Stack { joints: (0..rows.counts.len()).map(joint).collect(), count: columns.len() }
    }

    /// The products with another's columns, of each block.
    pub fn products(&self, other: &Stack, blocks: &Blocks) -> Vec<DMatrix<f64>> {
        let of = |range: &core::ops::Range<usize>| {
            let mut sum = DMatrix::zeros(self.count, other.count);
            for (mine, theirs) in self.joints.iter().zip(&other.joints) {
                if mine.columns.is_empty() || theirs.columns.is_empty() {
                    continue;
                }
                let part = |joint: &Joint| joint.matrix.rows(range.start, range.len()).into_owned();
                let product = part(mine).tr_mul(&part(theirs));
                for (r, row) in mine.columns.iter().enumerate() {
                    for (c, column) in theirs.columns.iter().enumerate() {
                        sum[(*row, *column)] += product[(r, c)];
                    }
                }
            }
            sum
        };
        blocks.rows.iter().map(of).collect()
    }
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
    /// `L⁻¹` of what is left `L Lᵀ` of columns of these squares, so that `|L⁻¹ v|²` tells `v` in what it
    /// weighs; rows of 0 of those that say nothing.
    pub fn inverse_root(left: &DMatrix<f64>, squares: &DVector<f64>) -> DMatrix<f64> {
        let n = left.nrows();
        let mut told = left.clone();
        for k in (0..n).filter(|k| left[(*k, *k)] <= APART * squares[*k]) {
            told.row_mut(k).fill(0.0);
            told.column_mut(k).fill(0.0);
        }
        let solver = Solver::of(&told);
        let mut root = DMatrix::identity(n, n);
        for mut column in root.column_iter_mut() {
            solver.forwards(column.as_view_mut());
        }
        root
    }
}
