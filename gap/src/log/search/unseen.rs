//! What a fit leaves of rows that its values have not seen, 95 % intervals of its values, and how far what
//! it leaves scatters from one log to another.

use nalgebra::{DMatrix, DVector};

use super::blocks::Blocks;
use super::dictionary::Dictionary;
use super::fit::{Fitted, minimum, weights};
use super::normal_equations::{quadratic, sum};
use crate::infer::{Basis, drawn, students_t};
use crate::parallel;

/// What a fit leaves of rows that its values have not seen, and 95 % intervals of its values.
pub struct Unseen {
    /// Root mean square of each joint's rows that were held out; 0 of a joint that has none.
    pub sizes: Vec<f64>,
    /// Half the width of each column's interval.
    pub half_widths: Vec<f64>,
    /// Products of the columns and of what they are fitted to, of each block, as they are fitted.
    products: Vec<DMatrix<f64>>,
    joints: Vec<Joint>,
}

/// What is left of a joint.
struct Joint {
    /// Squares of each block, held out.
    squares: Vec<f64>,
    /// Rows of each block.
    rows: Vec<f64>,
    /// Products of the columns over all blocks.
    whole: DMatrix<f64>,
}

impl Joint {
    /// Mean square of the blocks, each so many times; `None` of no rows.
    fn mean(&self, times: &[f64]) -> Option<f64> {
        let sum = |of: &[f64]| of.iter().zip(times).map(|(x, times)| x * times).sum::<f64>();
        let rows = sum(&self.rows);
        (rows > 0.0).then(|| sum(&self.squares) / rows)
    }
}

impl Unseen {
    /// Of a fit told in these sizes.
    pub fn of(dict: &Dictionary<'_>, fit: &Fitted, sizes: &[f64], blocks: &Blocks) -> Unseen {
        let sums = dict.sums(blocks);
        let (columns, _) = fit.bordered();
        let products = sums.squares(&columns, &weights(sizes));
        let values: Vec<DVector<f64>> =
            (0..blocks.folds).map(|fold| without(&products, blocks, fold)).collect();
        let count = sizes.len();
        let of_joint = |joint: usize| {
            let own = sums.squares_of(joint, &columns);
            let left = own.iter().zip(&blocks.fold);
            Joint {
                squares: left.map(|(own, fold)| quadratic(own, &values[*fold])).collect(),
                rows: dict.rows_of(blocks, joint),
                whole: sum(own.iter()).unwrap_or_default(),
            }
        };
        let joints: Vec<Joint> = parallel::map(count, &of_joint);
        let once = vec![1.0; blocks.all.len()];
        Unseen {
            sizes: joints.iter().map(|joint| joint.mean(&once).unwrap_or(0.0).sqrt()).collect(),
            half_widths: half_widths(&products, &fit.values),
            products,
            joints,
        }
    }

    /// Covariance of the values of a fit, by the same blocks.
    pub fn covariance(&self, values: &[f64]) -> DMatrix<f64> {
        covariance(&self.products, values)
    }

    /// Standard deviation of the logarithm of what is left over what `before` leaves of the same blocks, the
    /// joints' mean in these sizes, of one log against another: this one too is but one of those that might
    /// have been. Blocks are drawn again, once for those that are fitted and once for those on which the gap is
    /// measured.
    pub fn spread(&self, before: &Unseen, sizes: &[f64], seed: u64) -> f64 {
        let log = |[fitted, measured]: &[Vec<f64>; 2]| {
            let left = |of: &Unseen| of.left(fitted, measured, sizes).max(f64::MIN_POSITIVE).ln();
            left(self) - left(before)
        };
        let logs: Vec<f64> = parallel::each(&drawn(self.products.len(), seed), &log);
        (2.0 * DVector::from_vec(logs).variance()).sqrt()
    }

    /// What is left, the joints' sum in these sizes, where the blocks are fitted and measured so many times.
    /// How values of other blocks change it is told by all blocks, how it scatters among blocks by those that
    /// were held out: together these are sums of numbers, where products of every block in every draw would take
    /// longer than the search.
    fn left(&self, fitted: &[f64], measured: &[f64], sizes: &[f64]) -> f64 {
        let n = self.products.first().map_or(0, DMatrix::nrows);
        let mut products = DMatrix::zeros(n, n);
        for (product, times) in self.products.iter().zip(fitted).filter(|(_, times)| **times > 0.0)
        {
            products.zip_apply(product, |sum, x| *sum += times * x);
        }
        let values = DVector::from_vec(minimum(&products)).push(-1.0);
        let of_joint = |(joint, size): (&Joint, &f64)| {
            let squares: f64 = joint.squares.iter().sum();
            let Some(mean) = joint.mean(measured).filter(|_| squares > 0.0) else { return 0.0 };
            (quadratic(&joint.whole, &values) / squares * mean).sqrt() / size
        };
        self.joints.iter().zip(sizes).map(of_joint).sum()
    }
}

/// Values of least squares without a fold, and −1 of the left side.
fn without(products: &[DMatrix<f64>], blocks: &Blocks, fold: usize) -> DVector<f64> {
    let n = products.first().map_or(1, DMatrix::nrows);
    let others = products.iter().zip(&blocks.fold).filter(|(_, of)| **of != fold).map(|(p, _)| p);
    let others = sum(others).unwrap_or_else(|| DMatrix::zeros(n, n));
    DVector::from_vec(minimum(&others)).push(-1.0)
}

/// Covariance of the values of a fit by the products of blocks: each block is left out, `(A − A_b)⁻¹ s_b`, since with as
/// many values as blocks each draws the values to itself (jackknife: Bell & McCaffrey 2002); zero of what they do not
/// determine.
fn covariance(products: &[DMatrix<f64>], values: &[f64]) -> DMatrix<f64> {
    let (n, count) = (values.len(), products.len() as f64);
    let Some(whole) = sum(products.iter()) else { return DMatrix::zeros(n, n) };
    let left = DVector::from_fn(n + 1, |k, _| values.get(k).map_or(1.0, |x| -x));
    let change = |product: &DMatrix<f64>| {
        let others = (&whole - product).view((0, 0), (n, n)).into_owned();
        let t = Basis::ordered(&others).t;
        &t * t.tr_mul(&(product.rows(0, n) * &left))
    };
    let changes = parallel::each(products, &change);
    let changes = DMatrix::from_columns(&changes);
    &changes * changes.transpose() * ((count - 1.0) / count)
}

/// Half the widths of 95 % intervals of the values of a fit: Student's t of as many numbers as there are blocks.
pub(super) fn half_widths(products: &[DMatrix<f64>], values: &[f64]) -> Vec<f64> {
    let off = students_t(products.len() as f64 - 1.0, 0.975);
    covariance(products, values).diagonal().iter().map(|own| off * own.max(0.0).sqrt()).collect()
}
