//! Blocks of time: what of a log is independent, and what is held out.
//!
//! Neighbouring samples tell the same thing again: a log of 30,000 rows holds a few hundred numbers.
//! The correlation time is that of what the model leaves, integrated up to where the sum no longer
//! matters (Sokal 1997); signs flip, and rows are held out, by blocks of at least five of it. Between
//! two blocks stand as many rows as the filter reaches, which belong to neither.

use super::grains::Grain;
use crate::log::signal::Signals;

/// Correlation times of a block.
const LENGTH: f64 = 5.0;

/// A window of so many correlation times holds the correlation (Sokal: 4 to 10).
const WINDOW: f64 = 5.0;

/// Fewer blocks than this tell nothing: their signs can be set in too few ways.
pub const LEAST: usize = 8;

/// Whole runs are held out where there are so many.
const RUNS: usize = 3;

/// Folds of blocks.
const FOLDS: usize = 10;

/// A block of time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Index of the run.
    pub run: usize,
    /// Its grains.
    pub grains: core::ops::Range<usize>,
    /// Whether the head of the first grain is no one's: another block stands before it.
    pub purged: bool,
}

/// A division of the rows in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    /// The blocks.
    pub all: Vec<Block>,
    /// The fold of each block.
    pub fold: Vec<usize>,
    /// Number of folds.
    pub folds: usize,
    /// Whether a fold is a whole run.
    pub by_run: bool,
    /// Length of a block, s.
    pub length: f64,
    /// Whether that is five correlation times, or only what the log has for so many blocks.
    pub long_enough: bool,
}

/// Grains of each run.
fn runs(grains: &[Grain]) -> Vec<(usize, core::ops::Range<usize>)> {
    let mut runs: Vec<(usize, core::ops::Range<usize>)> = Vec::new();
    for (k, grain) in grains.iter().enumerate() {
        match runs.last_mut() {
            Some((run, own)) if *run == grain.run => own.end = k + 1,
            _ => runs.push((grain.run, k..k + 1)),
        }
    }
    runs
}

impl Blocks {
    /// Every run in one block.
    pub fn whole(grains: &[Grain]) -> Blocks {
        let block = |(run, grains)| Block { run, grains, purged: false };
        let all: Vec<Block> = runs(grains).into_iter().map(block).collect();
        let fold = vec![0; all.len()];
        Blocks { all, fold, folds: 1, by_run: false, length: 0.0, long_enough: false }
    }

    /// Of a log in which what is left has this correlation time.
    pub fn of(grains: &[Grain], signals: &Signals, correlation: f64) -> Blocks {
        let rows: usize = grains.iter().map(|grain| grain.rows.len()).sum();
        let grain = rows as f64 / grains.len() as f64 * signals.step();
        let wanted = LENGTH * correlation.max(signals.reach());
        let most = (grains.len() / LEAST).max(1);
        let each = ((wanted / grain).ceil() as usize).clamp(1, most);
        let runs = runs(grains);
        let by_run = runs.len() >= RUNS;
        let mut all = Vec::new();
        for (run, own) in &runs {
            let count = (own.len() / each).max(1);
            let edge = |k: usize| own.start + own.len() * k / count;
            let block = |k| Block { run: *run, grains: edge(k)..edge(k + 1), purged: k > 0 };
            all.extend((0..count).map(block));
        }
        let folds = if by_run { runs.len() } else { FOLDS.min(all.len()) };
        let of_run = |run: usize| runs.iter().position(|(own, _)| *own == run).unwrap_or(0);
        let fold = |(b, block): (usize, &Block)| if by_run { of_run(block.run) } else { b % folds };
        let fold = all.iter().enumerate().map(fold).collect();
        let length = each as f64 * grain;
        let long_enough = all.len() >= LEAST && length >= wanted * (1.0 - 1e-9);
        Blocks { all, fold, folds, by_run, length, long_enough }
    }
}

/// The correlation time, s, of what is told every `step`: half the integral of the correlation over all
/// lags. Parts are not told of each other; what does not count is a hole.
pub fn correlation_time(parts: &[Vec<Option<f64>>], step: f64) -> f64 {
    let all = || parts.iter().flatten().filter_map(|x| *x);
    let mean = all().sum::<f64>() / all().count().max(1) as f64;
    let at = |lag: usize| {
        let pairs = parts.iter().flat_map(|part| part.iter().zip(part.iter().skip(lag)));
        let both = pairs.filter_map(|(a, b)| Some((*a)? - mean).zip(Some((*b)? - mean)));
        let (sum, count) = both.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + a * b, n + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    };
    let whole = at(0);
    let longest = parts.iter().map(Vec::len).max().unwrap_or(0);
    let mut time = 0.5;
    if whole > 0.0 {
        for lag in 1..longest / 2 {
            time += at(lag) / whole;
            if lag as f64 >= WINDOW * time {
                break;
            }
        }
    }
    time.max(0.5) * step
}
