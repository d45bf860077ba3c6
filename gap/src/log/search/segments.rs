//! The finest parts of a log's time, over which products are summed once and for all.

use core::ops::Range;

use crate::infer::limits::BLOCKS;
use crate::signal::Signals;

/// Rows that stand beside each other in one run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Index of the run.
    pub run: usize,
    /// Its rows.
    pub rows: Range<usize>,
    /// The first rows behind its edge, which the filter still reaches from before it.
    pub head: Range<usize>,
}

/// A division of the rows, none shorter than the filter's reach.
pub fn segments(signals: &Signals) -> Vec<Segment> {
    let reach = (signals.reach() / signals.step()).ceil() as usize;
    let length = reach.max(signals.rows() / BLOCKS).max(1);
    let mut runs: Vec<(usize, Range<usize>)> = Vec::new();
    for span in &signals.spans {
        match runs.last_mut() {
            Some((run, rows)) if *run == span.run => rows.end = span.kept.end,
            _ => runs.push((span.run, span.kept.clone())),
        }
    }
    let of = |(run, rows): (usize, Range<usize>)| {
        let count = (rows.len() / length).max(1);
        let edge = move |k: usize| rows.start + rows.len() * k / count;
        (0..count).map(move |k| {
            let rows = edge(k)..edge(k + 1);
            Segment { run, head: rows.start..(rows.start + reach).min(rows.end), rows }
        })
    };
    runs.into_iter().flat_map(of).collect()
}
