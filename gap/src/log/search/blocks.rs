//! Blocks of time: what of a log is independent, and what is held out.
//!
//! Neighbouring samples tell the same thing again: a log of 30,000 rows holds a few hundred numbers.
//! The correlation time is that of what the model leaves, integrated up to where the sum no longer
//! matters (Sokal 1997); signs flip, and rows are held out, by blocks of at least five of it. Between
//! two blocks stand as many rows as the filter reaches, which belong to neither.

use core::ops::Range;

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

/// A division of the rows in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    /// Rows of each block.
    pub rows: Vec<Range<usize>>,
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

impl Blocks {
    /// All rows in one block.
    pub fn whole(count: usize) -> Blocks {
        let rows = Vec::from([Range { start: 0, end: count }]);
        Blocks { rows, fold: vec![0], folds: 1, by_run: false, length: 0.0, long_enough: false }
    }

    /// Of a log in which what is left has this correlation time.
    pub fn of(signals: &Signals, correlation: f64) -> Blocks {
        let step = signals.step();
        let all: f64 = signals.rows() as f64 * step;
        let wanted = LENGTH * correlation.max(signals.reach());
        let length = wanted.min(all / LEAST as f64);
        let purged = (signals.reach() / step).ceil() as usize;
        let runs = 1 + signals.spans.iter().map(|span| span.run).max().unwrap_or(0);
        let by_run = runs >= RUNS;
        let (mut rows, mut of_run) = (Vec::new(), Vec::new());
        for span in &signals.spans {
            let count = ((span.kept.len() as f64 * step / length) as usize).max(1);
            let edge = |k: usize| span.kept.start + span.kept.len() * k / count;
            for k in 0..count {
                // Rows behind an inner edge are no one's.
                let from = if k > 0 { (edge(k) + purged).min(edge(k + 1)) } else { edge(k) };
                rows.push(from..edge(k + 1));
                of_run.push(span.run);
            }
        }
        let folds = if by_run { runs } else { FOLDS.min(rows.len()) };
        let fold = (0..rows.len()).map(|b| if by_run { of_run[b] } else { b % folds }).collect();
        let long_enough = rows.len() >= LEAST && length >= wanted * (1.0 - 1e-9);
        Blocks { rows, fold, folds, by_run, length, long_enough }
    }
}

/// The correlation time of one joint's rows, s: half the integral of the correlation over all lags.
/// Rows that do not count are holes.
pub fn correlation_time(rows: &[f64], counts: &[bool], signals: &Signals) -> f64 {
    let used = counts.iter().filter(|c| **c).count().max(1) as f64;
    let mean = rows.iter().zip(counts).filter(|(_, c)| **c).map(|(x, _)| x).sum::<f64>() / used;
    let centred: Vec<f64> =
        rows.iter().zip(counts).map(|(x, c)| if *c { x - mean } else { 0.0 }).collect();
    let at = |lag: usize| {
        let (mut sum, mut pairs) = (0.0, 0.0);
        for span in &signals.spans {
            for k in span.kept.start..span.kept.end.saturating_sub(lag) {
                if counts[k] && counts[k + lag] {
                    sum += centred[k] * centred[k + lag];
                    pairs += 1.0;
                }
            }
        }
        if pairs > 0.0 { sum / pairs } else { 0.0 }
    };
    let whole = at(0);
    let mut time = 0.5;
    if whole > 0.0 {
        for lag in 1..rows.len() / 2 {
            time += at(lag) / whole;
            if lag as f64 >= WINDOW * time {
                break;
            }
        }
    }
    time.max(0.5) * signals.step()
}
