//! On what the residual depends.
//!
//! What is left is sorted by joint value, speed, load and time into parts of equally many rows. A mean of
//! a part, or of all rows, that chance does not make says that something is still to be found there: under the signs
//! of whole blocks the largest of all joints and quantities is seldom as large. So do neighbours in a quantity's order
//! that are alike, though they are of different times: of what comes and goes within a part.

mod predicted;
mod quantity;

use nalgebra::DMatrix;

use super::blocks::Blocks;
use super::dictionary::Dictionary;
use super::judge::Verdict;
use crate::effects::Spot;
use crate::infer::constants::SIGNIFICANT;
use crate::infer::{Signs, deviate};
use crate::parallel;
use crate::report::log::Dependence;
use predicted::predicted;
use quantity::{Of, Parts};

/// Neighbours in a quantity's order that are held against each other.
const NEAR: usize = 8;

/// Below it a sum is as good as normal.
const LEAST_SKEW: f64 = 0.01;

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
    /// How large it is under these signs, each column of all blocks, as a normal number.
    fn sizes(&self, signs: &DMatrix<f64>) -> Vec<f64> {
        match self {
            By::Means(sums) => {
                let (pulls, parts) = (sums.tr_mul(signs), sums.ncols() as f64);
                pulls.column_iter().map(|sums| deviate(sums.norm_squared(), parts)).collect()
            }
            By::Neighbours(products, count) => {
                let pulls = products * signs;
                let sums = pulls.column_iter().zip(signs.column_iter()).map(|(a, b)| a.dot(&b));
                sums.map(|sum| deviate(count + sum * (2.0 * count).sqrt(), *count)).collect()
            }
        }
    }
}

/// On what the residual of a verdict depends beyond chance, of all joints and quantities; the largest share
/// first.
pub fn dependences(dict: &Dictionary<'_>, verdict: &Verdict, seed: u64) -> Vec<Dependence> {
    let left = verdict.now.fit.sampled(dict);
    let all = quantity::all(dict, &verdict.now.fit, &left);
    let found = beyond_chance(dict, &left, &all, &verdict.blocks, seed, |_, _| true);
    if !found.is_empty() {
        return found;
    }
    // What depends on something slow is autocorrelated, and few blocks tell nothing. What other times predict of it
    // is no chance: the blocks are as long as the correlation of the residual beside that asks for.
    let of_joint = |joint: usize| {
        let own: Vec<&Parts> =
            all.iter().filter(|parts| parts.joint == joint && !parts.of.is_fine()).collect();
        predicted(dict, &left[joint], &own, &verdict.blocks)
    };
    let (beside, by): (Left, Vec<Vec<Of>>) =
        parallel::map(left.len(), &of_joint).into_iter().unzip();
    let correlation = parallel::each(&beside, &|rows| dict.correlation(rows));
    let longest = correlation.into_iter().fold(0.0, f64::max);
    let blocks = dict.blocks(longest);
    if blocks.all.len() <= verdict.blocks.all.len() {
        return Vec::new();
    }
    beyond_chance(dict, &left, &all, &blocks, seed, |joint, of| by[joint].contains(&of))
}

/// What is left of some blocks' rows beyond chance, of the joints and quantities that count.
fn beyond_chance(
    dict: &Dictionary<'_>,
    left: &Left,
    all: &[Parts],
    blocks: &Blocks,
    seed: u64,
    counts: impl Fn(usize, Of) -> bool,
) -> Vec<Dependence> {
    let sorted = |parts: &Parts| sorted(dict, &left[parts.joint], parts, blocks);
    let all: Vec<Sorted> = parallel::each(all, &sorted).into_iter().flatten().collect();
    let count = blocks.all.len();
    let signs = Signs::new(count, seed);
    let mut highest = vec![f64::NEG_INFINITY; signs.patterns.ncols()];
    for sorted in &all {
        let sizes = sorted.by.sizes(&signs.patterns);
        highest.iter_mut().zip(sizes).for_each(|(most, x)| *most = most.max(x));
    }
    let told = |sorted: &Sorted| {
        let found = sorted.by.sizes(&DMatrix::repeat(count, 1, 1.0))[0];
        let p_value = signs.p_value(&highest, found);
        let (place, of) = (Spot::of_joint(sorted.joint).to_string(), sorted.of.named(sorted.joint));
        (p_value <= SIGNIFICANT).then_some(Dependence { place, of, share: sorted.share, p_value })
    };
    let counted = all.iter().filter(|sorted| counts(sorted.joint, sorted.of));
    let mut found: Vec<Dependence> = counted.filter_map(told).collect();
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}

fn sorted(
    dict: &Dictionary<'_>,
    left: &[Option<f64>],
    parts: &Parts,
    blocks: &Blocks,
) -> Option<Sorted> {
    let in_block =
        |(k, sign): &(usize, f64)| Some((dict.block_of(blocks, dict.rows[*k])?, *sign, left[*k]?));
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
