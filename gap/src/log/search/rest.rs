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
    Angle(usize),
    Speed(usize),
    Acceleration(usize),
    Load,
    Time,
    /// What brakes goes with the way of the motion: the load's size or the time, with its sign.
    BrakingLoad,
    BrakingTime,
}

impl Of {
    /// Of a joint.
    fn named(self, joint: usize) -> String {
        let of = |name: &str, k: usize| match k == joint {
            true => name.to_owned(),
            false => format!("{name} of joint {}", k + 1),
        };
        match self {
            Of::Angle(k) => of("angle", k),
            Of::Speed(k) => of("speed", k),
            Of::Acceleration(k) => of("acceleration", k),
            Of::Load => "load".to_owned(),
            Of::Time => "time".to_owned(),
            Of::BrakingLoad => "load, against the motion".to_owned(),
            Of::BrakingTime => "time, against the motion".to_owned(),
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

/// A joint's rows, and what they may depend on.
#[derive(Clone, Copy)]
struct Asked {
    joint: usize,
    of: Of,
}

/// What is left, and what it may depend on.
struct Left<'a> {
    stock: &'a Stock<'a>,
    /// At the rows of the sample, of each joint.
    left: Vec<Vec<Option<f64>>>,
    loads: Vec<Vec<Option<f64>>>,
}

/// Rows sorted into parts.
struct Sorted {
    asked: Asked,
    share: f64,
    /// Sums of what is left, of each block and part, told so that the squares of a part add up to one.
    sums: DMatrix<f64>,
}

/// On what a verdict's rest depends; the largest share first.
pub fn rests(stock: &Stock<'_>, verdict: &Verdict, seed: u64) -> Vec<Rest> {
    let (left, loads) = (verdict.fit.sampled(stock), asked(stock, &verdict.fit));
    let left = Left { stock, left, loads };
    let joints = || 0..left.left.len();
    let all: Vec<Asked> = joints()
        .flat_map(|joint| {
            let others = joints().flat_map(|k| [Of::Angle(k), Of::Speed(k), Of::Acceleration(k)]);
            let own = [Of::Load, Of::Time, Of::BrakingLoad, Of::BrakingTime];
            let of = own.into_iter().chain(others);
            of.map(move |of| Asked { joint, of })
        })
        .collect();
    let (rests, largest) = left.rests(&all, &verdict.blocks, seed);
    let Some(largest) = largest.filter(|_| rests.is_empty()) else { return rests };
    // What depends on something slow remembers long, and few blocks tell nothing. Were it accident, what is
    // left would be left without it too: so long are the blocks.
    let correlation: Vec<f64> =
        left.without(largest).iter().map(|rows| stock.correlation(rows)).collect();
    let longest = correlation.into_iter().fold(0.0, f64::max);
    let blocks = Blocks::of(&stock.grains, stock.case.signals, longest);
    if blocks.all.len() <= verdict.blocks.all.len() {
        return rests;
    }
    let is_it =
        |rest: &Rest| rest.joint == largest.joint && rest.of == largest.of.named(rest.joint);
    left.rests(&all, &blocks, seed).0.into_iter().filter(is_it).collect()
}

impl Left<'_> {
    /// What is left of some blocks' rows beyond chance; and on what most of it depends.
    fn rests(&self, all: &[Asked], blocks: &Blocks, seed: u64) -> (Vec<Rest>, Option<Asked>) {
        let all: Vec<Sorted> =
            all.par_iter().filter_map(|asked| self.sorted(*asked, blocks)).collect();
        let count = blocks.all.len();
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
            let Asked { joint, of } = sorted.asked;
            Rest { joint, of: of.named(joint), share: sorted.share, chance }
        };
        let mut rests: Vec<Rest> =
            all.iter().map(told).filter(|rest| rest.chance <= CHANCE).collect();
        rests.sort_by(|a, b| b.share.total_cmp(&a.share));
        let most = all.iter().max_by(|a, b| a.share.total_cmp(&b.share));
        (rests, most.map(|sorted| sorted.asked))
    }

    /// Rows that count by what they are asked for, with their indices: equally many in each part.
    fn parts(&self, Asked { joint, of }: Asked) -> Vec<Vec<usize>> {
        let signals = self.stock.case.signals;
        let rows = match of {
            Of::Angle(k) => signals.kept(&signals.q[k]),
            Of::Speed(k) => signals.kept(&signals.qd[k]),
            Of::Acceleration(k) => signals.kept(&signals.qdd[k]),
            Of::Time => signals.kept(&signals.t),
            Of::BrakingTime => {
                let rows =
                    signals.kept(&signals.t).into_iter().zip(signals.kept(&signals.qd[joint]));
                rows.map(|(t, rate)| t * rate.signum()).collect()
            }
            Of::BrakingLoad => signals.kept(&signals.qd[joint]),
            Of::Load => Vec::new(),
        };
        let value = |k: usize| match of {
            Of::Load => self.loads[joint][k].unwrap_or(0.0),
            Of::BrakingLoad => {
                self.loads[joint][k].unwrap_or(0.0).abs() * rows[self.stock.rows[k]].signum()
            }
            _ => rows[self.stock.rows[k]],
        };
        let left = &self.left[joint];
        let mut sorted: Vec<(f64, usize)> =
            (0..left.len()).filter(|k| left[*k].is_some()).map(|k| (value(k), k)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let edge = |part: usize| sorted.len() * part / PARTS;
        let part = |part| sorted[edge(part)..edge(part + 1)].iter().map(|row| row.1).collect();
        (0..PARTS).map(part).collect()
    }

    fn mean(&self, joint: usize, rows: impl Iterator<Item = usize>) -> f64 {
        let (sum, count) = rows
            .filter_map(|k| self.left[joint][k])
            .fold((0.0, 0.0), |(sum, count), left| (sum + left, count + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// What would be left without the means of its parts.
    fn without(&self, asked: Asked) -> Vec<Vec<Option<f64>>> {
        let mut left = self.left.clone();
        for part in self.parts(asked) {
            let mean = self.mean(asked.joint, part.iter().copied());
            for k in part {
                left[asked.joint][k] = left[asked.joint][k].map(|left| left - mean);
            }
        }
        left
    }

    fn sorted(&self, asked: Asked, blocks: &Blocks) -> Option<Sorted> {
        let (stock, left) = (self.stock, &self.left[asked.joint]);
        let block = |k: usize| stock.block_of(blocks, stock.rows[k]);
        let mut parts = self.parts(asked);
        parts.iter_mut().for_each(|part| part.retain(|k| block(*k).is_some()));
        if parts.iter().any(Vec::is_empty) {
            return None;
        }
        let rows = || parts.iter().flatten().copied();
        let mean = self.mean(asked.joint, rows());
        let beyond = |k: usize| left[k].map_or(0.0, |left| left - mean);
        let whole: f64 = rows().map(|k| beyond(k).powi(2)).sum();
        let mut sums = DMatrix::<f64>::zeros(blocks.all.len(), PARTS);
        let mut explained = 0.0;
        for (p, part) in parts.iter().enumerate() {
            for k in part {
                sums[(block(*k)?, p)] += beyond(*k);
            }
            explained += sums.column(p).sum().powi(2) / part.len() as f64;
        }
        for mut part in sums.column_iter_mut() {
            let size = part.norm();
            part /= if size > 0.0 { size } else { 1.0 };
        }
        Some(Sorted { asked, share: explained / whole.max(f64::MIN_POSITIVE), sums })
    }
}

/// What a fit asks of each joint at the rows of the sample.
pub fn asked(stock: &Stock<'_>, fit: &Fitted) -> Vec<Vec<Option<f64>>> {
    let (mut columns, mut values) = fit.bordered();
    columns.push(Mixed::one(stock.target));
    values.push(1.0);
    // The target less what is left of it.
    stock.sampled(&columns, &values)
}
