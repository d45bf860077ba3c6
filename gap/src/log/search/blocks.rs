//! Blocks of time: what of a log is independent, and what is held out.
//!
//! Neighbouring samples tell the same thing again: a log of 30,000 rows holds a few hundred numbers.
//! The correlation time is that of what the model leaves, integrated up to where the sum no longer
//! matters (Sokal 1997); signs flip, and rows are held out, by blocks of at least five of it. Between
//! two blocks stand as many rows as the filter reaches, which belong to neither.

use super::segments::Segment;
use crate::constants::{FEWEST_OF_A_KIND, FEWEST_TO_JUDGE};
use crate::infer::constants::FOLDS;
use crate::infer::limits::CORRELATION_TIMES;
use crate::signal::Signals;

/// A block of time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Index of the run.
    pub run: usize,
    /// Its segments.
    pub segments: core::ops::Range<usize>,
    /// Whether the head of the first segment is no one's: another block stands before it.
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
fn runs(segments: &[Segment]) -> Vec<(usize, core::ops::Range<usize>)> {
    let mut runs: Vec<(usize, core::ops::Range<usize>)> = Vec::new();
    for (k, segment) in segments.iter().enumerate() {
        match runs.last_mut() {
            Some((run, own)) if *run == segment.run => own.end = k + 1,
            _ => runs.push((segment.run, k..k + 1)),
        }
    }
    runs
}

impl Blocks {
    /// Every run in one block.
    pub fn whole(segments: &[Segment]) -> Blocks {
        let block = |(run, segments)| Block { run, segments, purged: false };
        let all: Vec<Block> = runs(segments).into_iter().map(block).collect();
        let fold = vec![0; all.len()];
        Blocks { all, fold, folds: 1, by_run: false, length: 0.0, long_enough: false }
    }

    /// Of a log in which what is left has this correlation time; whole runs are held out if they `may` be, and are
    /// enough.
    pub fn of(segments: &[Segment], signals: &Signals, correlation: f64, may: bool) -> Blocks {
        let rows: usize = segments.iter().map(|segment| segment.rows.len()).sum();
        let segment = rows as f64 / segments.len() as f64 * signals.step();
        let wanted = CORRELATION_TIMES * correlation.max(signals.reach());
        let most = (segments.len() / FEWEST_TO_JUDGE).max(1);
        let each = ((wanted / segment).ceil() as usize).clamp(1, most);
        let runs = runs(segments);
        let by_run = may && runs.len() >= FEWEST_OF_A_KIND;
        let mut all = Vec::new();
        for (run, own) in &runs {
            let count = (own.len() / each).max(1);
            let edge = |k: usize| own.start + own.len() * k / count;
            let block = |k| Block { run: *run, segments: edge(k)..edge(k + 1), purged: k > 0 };
            all.extend((0..count).map(block));
        }
        let folds = if by_run { runs.len() } else { FOLDS.min(all.len()) };
        let of_run = |run: usize| runs.iter().position(|(own, _)| *own == run).unwrap_or(0);
        let fold = |(b, block): (usize, &Block)| if by_run { of_run(block.run) } else { b % folds };
        let fold = all.iter().enumerate().map(fold).collect();
        let length = each as f64 * segment;
        let long_enough = all.len() >= FEWEST_TO_JUDGE && length >= wanted * (1.0 - 1e-9);
        Blocks { all, fold, folds, by_run, length, long_enough }
    }
}
