//! All columns that a log may be explained by, and their products, summed in one pass.
//!
//! A million samples of seven joints are some hundred columns of which none is kept: the log goes by in
//! stretches, each brings its columns to the [`Segment`]s that it covers, and what is asked later is asked
//! of these sums. Every so-manyth row is kept beside them, for what sums cannot tell: how long what is
//! left remembers, and what it depends on.

use core::ops::Range;
use std::sync::Arc;

use nalgebra::DMatrix;

use super::blocks::{Block, Blocks};
use super::case::{Case, Simple, Wanted};
use super::fit::Term;
use super::normal_equations::Sums;
use super::segments::{Segment, segments};
use crate::infer::correlation_time;
use crate::infer::limits::SOME_SAMPLES;
use crate::log::effects::{LATE, LogEffect, Spot};
use crate::log::scene::Domain;
use crate::parallel;
use crate::signal::Signals;

/// Fine samples of a stretch, about: what its columns take is a few tens of megabytes.
const STRETCH: usize = 16_384;

/// A sum of stored columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mixed {
    /// A stored column, and how often.
    pub of: Vec<(usize, f64)>,
    /// The one run that it is of, and those that carry the same; zero in all others.
    pub run: Option<usize>,
}

impl Mixed {
    /// A stored column.
    pub fn one(column: usize) -> Mixed {
        Mixed { of: vec![(column, 1.0)], run: None }
    }
}

/// An effect at a place, linearised about some values.
#[derive(Clone, Debug)]
pub struct Entry {
    /// What a unit of each number changes of the rows.
    pub columns: Vec<Mixed>,
    /// What it does at these values, where that is not in proportion to them.
    pub done: Option<Mixed>,
    /// The values.
    pub at: Vec<f64>,
}

/// An effect at a place that may be asked for.
#[derive(Clone)]
pub struct Offer {
    /// The effect.
    pub effect: &'static dyn LogEffect,
    /// Where.
    pub spot: Spot,
    /// About the values from which its own are sought.
    pub entries: Vec<Entry>,
}

/// What is stored of one joint.
struct Own {
    /// The stored columns that this joint has.
    columns: Vec<usize>,
    /// Where a stored column stands among them.
    at: Vec<Option<usize>>,
    /// Products of its columns, of each segment's head and of what is behind it.
    parts: Vec<[DMatrix<f64>; 2]>,
    /// Its columns at the rows that are kept, zero where a row does not count.
    sample: Vec<Vec<f32>>,
}

/// Columns and their products.
pub struct Dictionary<'a> {
    /// The log.
    pub case: &'a Case<'a>,
    /// Which rows count, of each joint.
    pub counts: Vec<Vec<bool>>,
    /// How many of those that were gone through.
    pub used: Vec<f64>,
    /// The finest parts of the time.
    pub segments: Vec<Segment>,
    /// Effects that may be asked for.
    pub offers: Vec<Offer>,
    /// The first so many stored columns are the rigid links'.
    pub base: usize,
    /// The stored column of what is to be explained.
    pub target: usize,
    /// Rows of the sample.
    pub rows: Vec<usize>,
    joints: Arc<Vec<Own>>,
    /// Of each segment, whether its head and what is behind it count.
    kept: Vec<[bool; 2]>,
    whole: Sums,
}

/// Rows of segments that are gone through at once.
struct Stretch {
    segments: Range<usize>,
    rows: Range<usize>,
}

/// What one stretch brings, of each joint.
struct Brought {
    columns: Vec<usize>,
    parts: Vec<[DMatrix<f64>; 2]>,
    sample: Vec<Vec<f32>>,
}

impl<'a> Dictionary<'a> {
    /// Of a log and the effects that may be asked for, with loads as the simple model has them. Every
    /// `thinned`-th stretch alone is gone through where so much is enough.
    pub fn of(
        case: &'a Case<'a>,
        simple: &Simple,
        wanted: &[Wanted],
        thinned: usize,
    ) -> Dictionary<'a> {
        let signals = case.signals;
        let (segments, counts) = (segments(signals), case.counts());
        let all = stretches(&segments, signals);
        let every = signals.rows().div_ceil(SOME_SAMPLES);
        let went: Vec<&Stretch> = all.iter().step_by(thinned).collect();
        let brought: Vec<Vec<Brought>> = parallel::each(&went, &|stretch| {
            bring(case, simple, wanted, stretch, &segments, &counts, every)
        });
        let base = case.base.map_or(0, |base| base.columns.len());
        let (offers, target) = offers(case, wanted, base);
        let of = |stretch: &&Stretch| stretch.rows.clone();
        let rows = went.iter().flat_map(of).filter(|row| row % every == 0).collect();
        let used = |counts: &Vec<bool>| went.iter().flat_map(of).filter(|k| counts[*k]).count();
        let used = counts.iter().map(|counts| used(counts) as f64).collect();
        let mut joints: Vec<Own> =
            (0..signals.joints()).map(|_| Own::new(target, segments.len())).collect();
        for (stretch, brought) in went.iter().zip(brought) {
            joints.iter_mut().zip(brought).for_each(|(own, more)| own.take(stretch, more));
        }
        let (kept, whole) = (vec![[true; 2]; segments.len()], Sums::default());
        let joints = Arc::new(joints);
        let mut dict = Dictionary {
            case,
            counts,
            used,
            segments,
            offers,
            base,
            target,
            rows,
            joints,
            kept,
            whole,
        };
        dict.whole = dict.sums(&Blocks::whole(&dict.segments));
        dict
    }

    /// Torques that are told late, about the longest delay that is asked for.
    pub fn late(&self) -> Option<Term> {
        let is_late = |offer: &Offer| {
            offer.effect.domain() == Domain::Torque
                && offer.effect.identifier() == LATE.identifier()
        };
        let offer = self.offers.iter().position(is_late)?;
        Some(self.term(offer, self.offers[offer].entries.len() - 1))
    }

    /// The same without the rows of a fold, nor those behind them that the filter still reaches from there.
    #[must_use]
    pub fn without(&self, blocks: &Blocks, fold: usize) -> Dictionary<'a> {
        let (mut kept, mut counts) = (self.kept.clone(), self.counts.clone());
        let mut leave = |rows: Range<usize>| {
            counts.iter_mut().for_each(|counts| counts[rows.clone()].fill(false));
        };
        for (block, _) in blocks.all.iter().zip(&blocks.fold).filter(|(_, of)| **of == fold) {
            kept[block.segments.clone()].fill([false; 2]);
            let (first, last) = (block.segments.start, block.segments.end - 1);
            leave(self.segments[first].rows.start..self.segments[last].rows.end);
            let next = self.segments.get(last + 1);
            if let Some(next) = next.filter(|next| next.run == block.run) {
                kept[last + 1][0] = false;
                leave(next.head.clone());
            }
        }
        let used = counts.iter().map(|c| c.iter().filter(|c| **c).count() as f64).collect();
        let (segments, offers, rows) =
            (self.segments.clone(), self.offers.clone(), self.rows.clone());
        let joints = Arc::clone(&self.joints);
        let whole = Sums::default();
        let mut dict =
            Dictionary { counts, used, segments, offers, rows, joints, kept, whole, ..*self };
        dict.whole = dict.sums(&Blocks::whole(&dict.segments));
        dict
    }

    /// The time divided for a residual of this correlation time, s.
    pub fn blocks(&self, correlation: f64) -> Blocks {
        let by_run = !self.case.is_held_once();
        Blocks::of(&self.segments, self.case.signals, correlation, by_run)
    }

    /// Products of all columns of each joint over whole runs.
    pub fn whole(&self) -> &Sums {
        &self.whole
    }

    /// Products of all columns of each joint over each block.
    pub fn sums(&self, blocks: &Blocks) -> Sums {
        let joint = |own: &Own| {
            let block = |block: &Block| {
                let n = own.columns.len();
                let mut sum = DMatrix::zeros(n, n);
                for segment in block.segments.clone() {
                    let ([head, body], kept) = (&own.parts[segment], self.kept[segment]);
                    if kept[0] && !(block.purged && segment == block.segments.start) {
                        add(&mut sum, head);
                    }
                    if kept[1] {
                        add(&mut sum, body);
                    }
                }
                sum
            };
            blocks.all.iter().map(block).collect()
        };
        Sums {
            runs: blocks.all.iter().map(|block| self.case.held_as(block.run)).collect(),
            at: self.joints.iter().map(|own| own.at.clone()).collect(),
            joints: self.joints.iter().map(joint).collect(),
        }
    }

    /// Rows of a joint that count, of each block.
    pub fn rows_of(&self, blocks: &Blocks, joint: usize) -> Vec<f64> {
        let of = |block: &Block| {
            let (first, last) = (block.segments.start, block.segments.end - 1);
            let head = &self.segments[first].head;
            let start = if block.purged { head.end } else { head.start };
            let counts = &self.counts[joint][start..self.segments[last].rows.end];
            counts.iter().filter(|counts| **counts).count() as f64
        };
        blocks.all.iter().map(of).collect()
    }

    /// Root mean square of what columns with these values, −1 of the left side, leave of each joint.
    pub fn sizes(&self, columns: &[Mixed], values: &[f64]) -> Vec<f64> {
        let size = |joint: usize| {
            let sum = self.whole.square(joint, columns, values);
            // A joint without rows has no size: it is told in one.
            if sum > 0.0 { (sum / self.used[joint]).sqrt() } else { 1.0 }
        };
        parallel::map(self.joints.len(), &size)
    }

    /// What columns with these values are at the rows of the sample, of each joint; a hole where a row
    /// does not count.
    pub fn sampled(&self, columns: &[Mixed], values: &[f64]) -> Vec<Vec<Option<f64>>> {
        let runs: Vec<usize> = self.rows.iter().map(|row| self.run_of(*row)).collect();
        let joint = |(joint, own): (usize, &Own)| {
            let mut sum = vec![0.0; self.rows.len()];
            for (column, value) in columns.iter().zip(values) {
                for (stored, times) in &column.of {
                    let Some(at) = own.at[*stored] else { continue };
                    let times = times * value;
                    let rows = &own.sample[at];
                    for ((sum, x), run) in sum.iter_mut().zip(rows).zip(&runs) {
                        if column.run.is_none_or(|own| own == *run) {
                            *sum += times * f64::from(*x);
                        }
                    }
                }
            }
            let counts = self.rows.iter().map(|row| self.counts[joint][*row]);
            sum.into_iter().zip(counts).map(|(x, counts)| counts.then_some(x)).collect()
        };
        parallel::map(self.joints.len(), &|k| joint((k, &self.joints[k])))
    }

    fn segment_of(&self, row: usize) -> usize {
        self.segments.partition_point(|segment| segment.rows.end <= row)
    }

    fn run_of(&self, row: usize) -> usize {
        self.case.held_as(self.segments[self.segment_of(row)].run)
    }

    /// The block that a row is in; `None` of one between two blocks.
    pub fn block_of(&self, blocks: &Blocks, row: usize) -> Option<usize> {
        let segment = self.segment_of(row);
        let at = blocks.all.partition_point(|block| block.segments.end <= segment);
        let block = &blocks.all[at];
        let head = block.purged
            && block.segments.start == segment
            && row < self.segments[segment].head.end;
        (!head).then_some(at)
    }

    /// The correlation time of what is told at the rows of the sample, s.
    pub fn correlation(&self, sampled: &[Option<f64>]) -> f64 {
        let signals = self.case.signals;
        let every = signals.rows().div_ceil(SOME_SAMPLES);
        let mut parts: Vec<Vec<Option<f64>>> = vec![Vec::new(); signals.spans.len()];
        for (row, x) in self.rows.iter().zip(sampled) {
            let at = signals.spans.partition_point(|span| span.kept.end <= *row);
            parts[at].push(*x);
        }
        correlation_time(&parts, every as f64 * signals.step())
    }
}

/// Adds what there is; a segment that nothing was brought to has an empty matrix.
fn add(sum: &mut DMatrix<f64>, more: &DMatrix<f64>) {
    if more.nrows() > 0 {
        *sum += more;
    }
}

/// Neighbouring segments of one run, so many that a stretch is worth its ends.
fn stretches(segments: &[Segment], signals: &Signals) -> Vec<Stretch> {
    let most = STRETCH / (signals.t.len() / signals.rows().max(1)).max(1);
    let mut all: Vec<Stretch> = Vec::new();
    for (k, segment) in segments.iter().enumerate() {
        match all.last_mut() {
            Some(last)
                if segments[last.segments.start].run == segment.run
                    && segment.rows.end - last.rows.start <= most =>
            {
                last.segments.end = k + 1;
                last.rows.end = segment.rows.end;
            }
            _ => all.push(Stretch { segments: k..k + 1, rows: segment.rows.clone() }),
        }
    }
    all
}

/// The stored columns that each effect's numbers are of: the base's first, then the effects' in their
/// order, then what is to be explained.
fn offers(case: &Case<'_>, wanted: &[Wanted], base: usize) -> (Vec<Offer>, usize) {
    let mut next = base;
    let mut take = || {
        next += 1;
        next - 1
    };
    let mut offers = Vec::new();
    for (effect, spot, probes) in wanted {
        let entries = match case.carried(*effect, *spot) {
            Some(columns) => vec![Entry { at: vec![0.0; columns.len()], columns, done: None }],
            None => probes
                .iter()
                .map(|at| Entry {
                    columns: at.iter().map(|_| Mixed::one(take())).collect(),
                    done: effect.bends().then(|| Mixed::one(take())),
                    at: at.clone(),
                })
                .collect(),
        };
        offers.push(Offer { effect: *effect, spot: *spot, entries });
    }
    (offers, next)
}

/// Goes through one stretch: products and rows of all columns.
fn bring(
    case: &Case<'_>,
    simple: &Simple,
    wanted: &[Wanted],
    stretch: &Stretch,
    segments: &[Segment],
    counts: &[Vec<bool>],
    every: usize,
) -> Vec<Brought> {
    let signals = case.signals;
    let joints = signals.joints();
    let mut brought: Vec<Brought> = Vec::new();
    let own = &segments[stretch.segments.clone()];
    for span in &signals.spans {
        let rows = stretch.rows.start.max(span.kept.start)..stretch.rows.end.min(span.kept.end);
        if rows.is_empty() {
            continue;
        }
        let (part, before) = signals.stretch(span, &rows, case.late);
        let columns = case.columns(simple, wanted, &part, span.run);
        for joint in 0..joints {
            let parts = columns.iter().enumerate().flat_map(|(id, column)| {
                let parts = column.parts.iter().filter(move |(on, _)| *on == joint);
                parts.map(move |(_, rows)| (id, rows))
            });
            let parts: Vec<(usize, &Vec<f64>)> = parts.collect();
            if brought.len() <= joint {
                let empty = || DMatrix::zeros(parts.len(), parts.len());
                brought.push(Brought {
                    columns: parts.iter().map(|(id, _)| *id).collect(),
                    parts: own.iter().map(|_| [empty(), empty()]).collect(),
                    sample: vec![Vec::new(); parts.len()],
                });
            }
            let to = &mut brought[joint];
            for (segment, sums) in own.iter().zip(&mut to.parts) {
                let behind = segment.head.end..segment.rows.end;
                for (range, sum) in [&segment.head, &behind].into_iter().zip(sums) {
                    let used = range.start.max(rows.start)..range.end.min(rows.end);
                    let used: Vec<usize> = used.filter(|row| counts[joint][*row]).collect();
                    if used.is_empty() {
                        continue;
                    }
                    let at = |k: usize, c: usize| parts[c].1[used[k] - rows.start + before];
                    let matrix = DMatrix::from_fn(used.len(), parts.len(), at);
                    // By the blocked product, which a transposed factor as it stands would not get.
                    sum.gemm(1.0, &matrix.transpose(), &matrix, 1.0);
                }
            }
            let kept = rows.clone().filter(|row| row % every == 0);
            for row in kept {
                let counts = counts[joint][row];
                for (sample, (_, x)) in to.sample.iter_mut().zip(&parts) {
                    let x = x[row - rows.start + before] as f32;
                    sample.push(if counts { x } else { 0.0 });
                }
            }
        }
    }
    brought
}

impl Own {
    fn new(target: usize, segments: usize) -> Own {
        let none = || [DMatrix::zeros(0, 0), DMatrix::zeros(0, 0)];
        Own {
            columns: Vec::new(),
            at: vec![None; target + 1],
            parts: (0..segments).map(|_| none()).collect(),
            sample: Vec::new(),
        }
    }

    fn take(&mut self, stretch: &Stretch, more: Brought) {
        if self.columns.is_empty() {
            more.columns.iter().enumerate().for_each(|(k, id)| self.at[*id] = Some(k));
            self.sample = vec![Vec::new(); more.columns.len()];
            self.columns = more.columns;
        }
        for (segment, sums) in stretch.segments.clone().zip(more.parts) {
            self.parts[segment] = sums;
        }
        self.sample.iter_mut().zip(more.sample).for_each(|(to, rows)| to.extend(rows));
    }
}
