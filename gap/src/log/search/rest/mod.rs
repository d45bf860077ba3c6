//! On what it depends that is left.
//!
//! What is left is sorted by joint value, speed, load and time into parts of equally many rows. A mean of
//! a part, or of all rows, that chance does not make says that something is still to be found there: under the signs
//! of whole blocks the largest of all joints and quantities is seldom as large. So do neighbours in a quantity's order
//! that are alike, though they are of different times: of what comes and goes within a part.

mod foretold;
mod quantity;

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::blocks::Blocks;
use super::stock::Stock;
use super::{CHANCE, judge::Verdict};
use crate::dice::{Dice, Stream};
use foretold::foretold;
use quantity::{Of, Parts};

/// Neighbours in a quantity's order that are held against each other.
const NEAR: usize = 8;

/// Below it a sum is as good as normal.
const LEAST_SKEW: f64 = 0.01;

/// Random signs.
const FLIPS: usize = 999;

/// What is left of a joint, as far as it depends on something.
pub struct Rest {
    /// The joint, from 0.
    pub joint: usize,
    /// On what.
    pub of: String,
    /// The part of the squares that goes with it.
    pub share: f64,
    /// The chance that it is accident, among all joints and quantities.
    pub chance: f64,
}

/// What is left at the rows of the sample, of each joint.
type Left = Vec<Vec<Option<f64>>>;

/// Rows sorted into parts.
struct Sorted {
    joint: usize,
    of: Of,
    share: f64,
    by: By,
}

/// What the signs of blocks are set to.
enum By {
    /// Sums of what is left, of each block and part, told so that the squares of a part add up to one.
    Means(DMatrix<f64>),
    /// Products of neighbours in two blocks, told so that their squares add up to one; under signs of chance their sum
    /// has the skewness of a sum of so many squares.
    Neighbours(DMatrix<f64>, f64),
}

impl By {
    /// How large it is under these signs, each row of all blocks, as a normal number.
    fn sizes(&self, signs: &DMatrix<f64>) -> Vec<f64> {
        match self {
            By::Means(sums) => {
                let (pulls, parts) = (signs * sums, sums.ncols() as f64);
                pulls.row_iter().map(|row| normal(row.norm_squared(), parts)).collect()
            }
            By::Neighbours(products, count) => {
                let pulls = signs * products;
                let sums = pulls.row_iter().zip(signs.row_iter()).map(|(a, b)| a.dot(&b));
                sums.map(|sum| normal(count + sum * (2.0 * count).sqrt(), *count)).collect()
            }
        }
    }
}

/// On what a verdict's rest depends; the largest share first.
pub fn rests(stock: &Stock<'_>, verdict: &Verdict, seed: u64) -> Vec<Rest> {
    let left = verdict.fit.sampled(stock);
    let all = quantity::all(stock, &verdict.fit, &left);
    let told = |rests: Vec<(Of, Rest)>| rests.into_iter().map(|(_, rest)| rest).collect();
    let rests = beyond_chance(stock, &left, &all, &verdict.blocks, seed);
    if !rests.is_empty() {
        return told(rests);
    }
    // What depends on something slow remembers long, and few blocks tell nothing. What other times foretell of it
    // is no accident: what is left beside that remembers for as long as accident does, and so long are the blocks.
    let (beside, by): (Left, Vec<Vec<Of>>) = (0..left.len())
        .into_par_iter()
        .map(|joint| {
            let own: Vec<&Parts> =
                all.iter().filter(|parts| parts.joint == joint && !parts.of.is_fine()).collect();
            foretold(stock, &left[joint], &own, &verdict.blocks)
        })
        .unzip();
    let correlation = beside.par_iter().map(|rows| stock.correlation(rows));
    let longest = correlation.reduce(|| 0.0, f64::max);
    let blocks = Blocks::of(&stock.grains, stock.case.signals, longest);
    if blocks.all.len() <= verdict.blocks.all.len() {
        return Vec::new();
    }
    let mut again = beyond_chance(stock, &left, &all, &blocks, seed);
    again.retain(|(of, rest)| by[rest.joint].contains(of));
    told(again)
}

/// What is left of some blocks' rows beyond chance.
fn beyond_chance(
    stock: &Stock<'_>,
    left: &Left,
    all: &[Parts],
    blocks: &Blocks,
    seed: u64,
) -> Vec<(Of, Rest)> {
    let sorted =
        all.par_iter().filter_map(|parts| sorted(stock, &left[parts.joint], parts, blocks));
    let all: Vec<Sorted> = sorted.collect();
    let count = blocks.all.len();
    let mut dice = Dice::new(seed, Stream::Visits);
    let signs = DMatrix::from_fn(FLIPS, count, |_, _| dice.sign());
    let mut largest = vec![f64::NEG_INFINITY; FLIPS];
    for sorted in &all {
        let sizes = sorted.by.sizes(&signs);
        largest.iter_mut().zip(sizes).for_each(|(most, x)| *most = most.max(x));
    }
    let told = |sorted: &Sorted| {
        let found = sorted.by.sizes(&DMatrix::repeat(1, count, 1.0))[0];
        let as_good = largest.iter().filter(|x| **x >= found - 1e-9).count();
        let chance = (1 + as_good) as f64 / (FLIPS + 1) as f64;
        let (joint, of) = (sorted.joint, sorted.of.named(sorted.joint));
        (sorted.of, Rest { joint, of, share: sorted.share, chance })
    };
    let mut rests: Vec<(Of, Rest)> =
        all.iter().map(told).filter(|(_, rest)| rest.chance <= CHANCE).collect();
    rests.sort_by(|a, b| b.1.share.total_cmp(&a.1.share));
    rests
}

/// A sum of so many squares of normal numbers as one normal number, so that a mean's one is held against sums of more
/// (Wilson & Hilferty 1931).
fn normal(squares: f64, count: f64) -> f64 {
    let spread = 2.0 / (9.0 * count);
    ((squares / count).cbrt() - (1.0 - spread)) / spread.sqrt()
}

fn sorted(
    stock: &Stock<'_>,
    left: &[Option<f64>],
    parts: &Parts,
    blocks: &Blocks,
) -> Option<Sorted> {
    let in_block = |(k, sign): &(usize, f64)| {
        Some((stock.block_of(blocks, stock.rows[*k])?, *sign, left[*k]?))
    };
    let part = |part: &Vec<(usize, f64)>| part.iter().filter_map(in_block).collect();
    let rows: Vec<Vec<(usize, f64, f64)>> = parts.rows.iter().map(part).collect();
    if rows.iter().any(Vec::is_empty) {
        return None;
    }
    let all = || rows.iter().flatten();
    let mean = match parts.of {
        Of::Mean => 0.0,
        _ => all().map(|(.., left)| left).sum::<f64>() / all().count() as f64,
    };
    let whole: f64 = all().map(|(.., left)| (left - mean).powi(2)).sum();
    if parts.of.is_fine() {
        let of = |(by, share)| Sorted { joint: parts.joint, of: parts.of, share, by };
        return neighbours(&rows[0], blocks.all.len(), mean).map(of);
    }
    let mut sums = DMatrix::<f64>::zeros(blocks.all.len(), rows.len());
    let mut explained = 0.0;
    for (p, part) in rows.iter().enumerate() {
        for (block, sign, left) in part {
            sums[(*block, p)] += sign * (left - mean);
        }
        explained += sums.column(p).sum().powi(2) / part.len() as f64;
    }
    for mut part in sums.column_iter_mut() {
        let size = part.norm();
        part /= if size > 0.0 { size } else { 1.0 };
    }
    let share = explained / whole.max(f64::MIN_POSITIVE);
    Some(Sorted { joint: parts.joint, of: parts.of, share, by: By::Means(sums) })
}

/// Rows that stand beside each other in a quantity's order but in different blocks have nothing in common but what
/// depends finely on it (as von Neumann's ratio asks of rows in time); the part of the squares that does.
fn neighbours(rows: &[(usize, f64, f64)], blocks: usize, mean: f64) -> Option<(By, f64)> {
    let mut products = DMatrix::<f64>::zeros(blocks, blocks);
    let mut squares = 0.0;
    for near in 1..=NEAR {
        for ((a, _, x), (b, _, y)) in rows.iter().zip(rows.iter().skip(near)) {
            if a != b {
                let (x, y) = (x - mean, y - mean);
                products[(*a.min(b), *a.max(b))] += x * y;
                squares += 0.5 * (x * x + y * y);
            }
        }
    }
    let size = products.norm();
    if size == 0.0 {
        return None;
    }
    let share = products.sum() / squares;
    products /= size;
    // The third moment of a form in signs, and the skewness √(8/n) of n squares.
    let both = (&products + products.transpose()) * 0.5;
    let skewness = 8.0 * (&both * &both).dot(&both);
    let count = 8.0 / skewness.max(LEAST_SKEW).powi(2);
    Some((By::Neighbours(products, count), share))
}
