//! On what it depends that is left.
//!
//! What is left is sorted by joint value, speed, load and time into parts of equally many rows. A mean of
//! a part that chance does not make says that something is still to be found there: under the signs of
//! whole blocks the largest of all joints and quantities is seldom as large.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::blocks::Blocks;
use super::fit::Fitted;
use super::stock::{Mixed, Stock};
use super::{CHANCE, judge::Verdict};
use crate::dice::{Dice, Stream};

/// Parts into which a quantity is divided.
const PARTS: usize = 8;

/// Random signs.
const FLIPS: usize = 999;

/// On what a rest may depend: of the joint itself, or of another.
#[derive(Clone, Copy)]
enum Of {
    Angle,
    Speed(usize),
    Acceleration(usize),
    Load,
    Time,
}

impl Of {
    /// Of a joint.
    fn named(self, joint: usize) -> String {
        let of = |name: &str, k: usize| match k == joint {
            true => name.to_owned(),
            false => format!("{name} of joint {}", k + 1),
        };
        match self {
            Of::Angle => "angle".to_owned(),
            Of::Speed(k) => of("speed", k),
            Of::Acceleration(k) => of("acceleration", k),
            Of::Load => "load".to_owned(),
            Of::Time => "time".to_owned(),
        }
    }
}

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

/// Rows sorted into parts.
struct Sorted {
    joint: usize,
    of: String,
    share: f64,
    /// Sums of what is left, of each block and part, told so that the squares of a part add up to one.
    sums: DMatrix<f64>,
}

/// On what a verdict's rest depends; the largest share first.
pub fn rests(stock: &Stock<'_>, verdict: &Verdict, seed: u64) -> Vec<Rest> {
    let left = verdict.fit.sampled(stock);
    let loads = asked(stock, &verdict.fit);
    let signals = stock.case.signals;
    let all: Vec<Sorted> = (0..left.len())
        .into_par_iter()
        .flat_map(|joint| {
            let joints = 0..left.len();
            let others = joints.flat_map(|k| [Of::Speed(k), Of::Acceleration(k)]);
            let of: Vec<Of> = [Of::Angle, Of::Load, Of::Time].into_iter().chain(others).collect();
            let quantity = |of: Of| {
                let kept = |of: &[f64]| signals.kept(of);
                let rows = match of {
                    Of::Angle => kept(&signals.q[joint]),
                    Of::Speed(k) => kept(&signals.qd[k]),
                    Of::Acceleration(k) => kept(&signals.qdd[k]),
                    Of::Time => kept(&signals.t),
                    Of::Load => Vec::new(),
                };
                let value = |k: usize| match of {
                    Of::Load => loads[joint][k].unwrap_or(0.0),
                    _ => rows[stock.rows[k]],
                };
                sorted(stock, &verdict.blocks, joint, of, &left[joint], value)
            };
            of.into_iter().filter_map(quantity).collect::<Vec<_>>()
        })
        .collect();
    let count = verdict.blocks.all.len();
    let mut dice = Dice::new(seed, Stream::Visits);
    let signs = DMatrix::from_fn(FLIPS, count, |_, _| dice.sign());
    let size = |sorted: &Sorted, signs: &DMatrix<f64>| -> Vec<f64> {
        let pulls = signs * &sorted.sums;
        pulls.row_iter().map(|row| row.norm_squared()).collect()
    };
    let mut largest = vec![0.0_f64; FLIPS];
    for sorted in &all {
        let sizes = size(sorted, &signs);
        largest.iter_mut().zip(sizes).for_each(|(most, x)| *most = most.max(x));
    }
    let told = |sorted: &Sorted| {
        let found = size(sorted, &DMatrix::repeat(1, count, 1.0))[0];
        let as_good = largest.iter().filter(|x| **x >= found * (1.0 - 1e-12)).count();
        let chance = (1 + as_good) as f64 / (FLIPS + 1) as f64;
        Rest { joint: sorted.joint, of: sorted.of.clone(), share: sorted.share, chance }
    };
    let mut rests: Vec<Rest> = all.iter().map(told).filter(|rest| rest.chance <= CHANCE).collect();
    rests.sort_by(|a, b| b.share.total_cmp(&a.share));
    rests
}

/// What a fit asks of each joint at the rows of the sample.
pub fn asked(stock: &Stock<'_>, fit: &Fitted) -> Vec<Vec<Option<f64>>> {
    let (mut columns, mut values) = fit.bordered();
    columns.push(Mixed::one(stock.target));
    values.push(1.0);
    // The target less what is left of it.
    stock.sampled(&columns, &values)
}

fn sorted(
    stock: &Stock<'_>,
    blocks: &Blocks,
    joint: usize,
    of: Of,
    left: &[Option<f64>],
    value: impl Fn(usize) -> f64,
) -> Option<Sorted> {
    let mut rows: Vec<(f64, f64, usize)> = left
        .iter()
        .enumerate()
        .filter_map(|(k, left)| Some((value(k), (*left)?, stock.block_of(blocks, stock.rows[k])?)))
        .collect();
    if rows.len() < PARTS {
        return None;
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = rows.len() as f64;
    let mean = rows.iter().map(|row| row.1).sum::<f64>() / count;
    let whole = rows.iter().map(|row| (row.1 - mean).powi(2)).sum::<f64>();
    let mut sums = DMatrix::zeros(blocks.all.len(), PARTS);
    let mut explained = 0.0;
    for part in 0..PARTS {
        let own = &rows[rows.len() * part / PARTS..rows.len() * (part + 1) / PARTS];
        let mut total = 0.0;
        for (_, left, block) in own {
            sums[(*block, part)] += left - mean;
            total += left - mean;
        }
        explained += total * total / own.len() as f64;
    }
    for mut part in sums.column_iter_mut() {
        let size = part.norm();
        part /= if size > 0.0 { size } else { 1.0 };
    }
    let of = of.named(joint);
    Some(Sorted { joint, of, share: explained / whole.max(f64::MIN_POSITIVE), sums })
}
