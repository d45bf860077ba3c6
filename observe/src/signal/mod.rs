//! From samples to even, band-limited signals and their rates: one documented step.
//!
//! 1. Samples are brought to even steps, by straight lines between neighbours. Nothing is carried
//!    across a gap of more than `GAP` steps: what lies before and behind it are two spans.
//! 2. Where the rate is far above the band, everything goes through one low-pass, and every so-manyth
//!    sample is kept: at least `FINE` per period of the band's edge.
//! 3. Joint values are low-passed at twice the band and differentiated; a logged velocity stands in place
//!    of the first derivative.
//! 4. Torques, and whatever is computed of the motion, signs too, go through the *same* low-pass at the
//!    band, after they are computed: [`Signals::filtered`].
//!
//! Of the result as many samples are kept as the band holds.

mod alike;
mod band;
mod even;
pub mod filter;
mod repeats;
#[cfg(test)]
mod tests;

use core::ops::Range;

use alike::Merged;
use even::{Even, stretches, thinning};
use filter::{LowPass, rate};
use repeats::Repeats;

use crate::log::{Log, Signal};

/// Samples per period of the band's edge that are kept for the fits.
const KEPT: f64 = 4.0;

/// Joint values are differentiated with so many times the band.
const WIDER: f64 = 2.0;

/// Half the main lobe of the filter's response, in periods of its edge: an ideal low-pass is zero first there.
const LOBE: f64 = 0.5;

/// Reaches of the filter after which nothing of an end is left: a thousandth of each is, of four 1e-12.
const ROOM: f64 = 4.0;

/// Reaches of the filter that a period lasts of which one is enough: eight blocks of twice the reach.
const LONG: f64 = 16.0;

/// Samples without a gap.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Index of the run.
    pub run: usize,
    /// Among the fine samples.
    pub fine: Range<usize>,
    /// Among those that are kept.
    pub kept: Range<usize>,
}

/// The motion and what drove it, of all runs one behind the other; of each joint its samples.
#[derive(Clone, Debug)]
pub struct Signals {
    /// Without a gap each.
    pub spans: Vec<Span>,
    /// s, since the run's first sample.
    pub t: Vec<f64>,
    /// rad or m, low-passed.
    pub q: Vec<Vec<f64>>,
    /// Its rate.
    pub qd: Vec<Vec<f64>>,
    /// Its acceleration.
    pub qdd: Vec<Vec<f64>>,
    /// Torque or current, as it is; empty where there is none.
    pub drive: Vec<Vec<f64>>,
    /// Commanded joint values, as they are; empty where there are none.
    pub command: Vec<Vec<f64>>,
    /// Joint values as they were measured; empty where torques are looked at.
    pub measured: Vec<Vec<f64>>,
    /// Temperature, °C; empty where it is not logged.
    pub temperature: Vec<Vec<f64>>,
    /// Which way each joint moved last, −1, 0 before its first move, or 1; see [`Signals::mark_ways`].
    pub ways: Vec<Vec<i8>>,
    /// Where the arm touches something.
    pub contact: Vec<bool>,
    /// Of each joint where what drives it is missing or at its limit.
    pub holes: Vec<Vec<bool>>,
    /// The band's edge, Hz.
    pub band: f64,
    /// Step between fine samples, s.
    pub period: f64,
    /// How often a motion is repeated, and after how long, s: its periods are averaged.
    pub repeated: Option<(usize, f64)>,
    /// The runs of each motion that there is in several of them: they are averaged to the first.
    pub alike: Vec<Vec<usize>>,
    /// Samples of the log per fine one.
    thin: usize,
    /// Fine samples per one that is kept.
    every: usize,
    filter: Option<LowPass>,
}

impl Signals {
    /// Of a log; `drive` is what is looked at, if not the command. The band is found where none is
    /// given.
    pub fn of(log: &Log, drive: Option<Signal>, band: Option<f64>) -> Signals {
        let mut wanted = vec![Signal::Q];
        let has = |signal: &Signal| log.has(*signal);
        let more = [Signal::Qd, Signal::QCmd, Signal::Temperature];
        wanted.extend(more.iter().filter(|s| has(s)).copied());
        wanted.extend(drive);
        let period = log.period();
        let evens: Vec<Even> = (0..log.runs.len())
            .flat_map(|run| stretches(run, &log.runs[run], period, &wanted, drive))
            .collect();
        let at = |signal| wanted.iter().position(|s| *s == signal);
        let band = band.unwrap_or_else(|| {
            let joints = |e: &Even| e.signals[0].clone();
            let narrowest = if drive.is_some() { band::TORQUES } else { band::POSITIONS };
            band::found(&evens.iter().map(joints).collect::<Vec<_>>(), period, narrowest)
        });
        let mut repeated = None;
        let evens: Vec<Even> = evens
            .into_iter()
            .map(|even| {
                let found = drive.and_then(|_| repeats::found(&even.signals[0], period));
                let long = |r: &Repeats| r.steps * period >= LONG * LowPass::reach(band);
                let Some(found) = found.filter(long) else { return even };
                repeated = Some(repeated.unwrap_or((found.count(), found.steps * period)));
                even.averaged(&found)
            })
            .collect();
        let carries = |a: usize, b: usize| log.runs[a].payload == log.runs[b].payload;
        let Merged { evens, alike } = match drive.and_then(at) {
            Some(drive) => alike::merged(evens, (period, band), drive, &carries),
            None => Merged { evens, alike: Vec::new() },
        };
        let evens: Vec<Even> = evens.into_iter().map(|e| e.thinned(band, period)).collect();
        let thin = thinning(band, period);
        let period = period * thin as f64;
        let every = ((1.0 / (KEPT * band * period)).floor() as usize).max(1);
        let joints = evens.first().map_or(0, |e| e.signals[0].len());
        let empty = || vec![Vec::new(); joints];
        let mut all = Signals {
            spans: Vec::new(),
            t: Vec::new(),
            q: empty(),
            qd: empty(),
            qdd: empty(),
            drive: empty(),
            command: empty(),
            measured: empty(),
            temperature: empty(),
            ways: vec![Vec::new(); joints],
            contact: Vec::new(),
            holes: vec![Vec::new(); joints],
            band,
            period,
            repeated,
            alike,
            thin,
            every,
            filter: LowPass::new(band, period),
        };
        let wide = LowPass::new(WIDER * band, period);
        let smooth = |x: &[f64]| wide.map_or_else(|| x.to_vec(), |filter| filter.apply(x));
        let mut kept = 0;
        for even in evens {
            let from = all.t.len();
            let count = even.t.len().div_ceil(every);
            all.spans.push(Span {
                run: even.run,
                fine: from..from + even.t.len(),
                kept: kept..kept + count,
            });
            kept += count;
            for joint in 0..joints {
                let of = |signal| at(signal).map(|k| &even.signals[k][joint]);
                let measured = &even.signals[0][joint];
                let q = smooth(measured);
                let qd = of(Signal::Qd).map_or_else(|| rate(&q, period), |qd| smooth(qd));
                all.qdd[joint].extend(rate(&qd, period));
                all.qd[joint].extend(qd);
                all.q[joint].extend(q);
                if drive.is_none() {
                    all.measured[joint].extend(measured);
                }
                let temperature = of(Signal::Temperature).into_iter().flatten();
                all.temperature[joint].extend(temperature);
                all.command[joint].extend(of(Signal::QCmd).into_iter().flatten());
                all.drive[joint].extend(drive.and_then(of).into_iter().flatten());
                all.holes[joint].extend(&even.holes[joint]);
            }
            all.t.extend(even.t);
            all.contact.extend(even.contact);
        }
        all
    }

    /// Notes which way each joint moved last, as soon as it moves faster than `still`. A joint that
    /// stands keeps its direction.
    pub fn mark_ways(&mut self, still: &[f64]) {
        let of = |(speeds, still): (&Vec<f64>, &f64)| {
            let mut ways = Vec::with_capacity(speeds.len());
            for span in &self.spans {
                let mut way = 0;
                for speed in &speeds[span.fine.clone()] {
                    if speed.abs() > *still {
                        way = if *speed > 0.0 { 1 } else { -1 };
                    }
                    ways.push(way);
                }
            }
            ways
        };
        self.ways = self.qd.iter().zip(still).map(of).collect();
    }

    /// The motion that was commanded in place of the one that was measured; `None` where none was logged.
    pub fn commanded(&self) -> Option<Signals> {
        if self.command.iter().any(|joint| joint.len() != self.t.len()) {
            return None;
        }
        let wide = LowPass::new(WIDER * self.band, self.period);
        let smooth = |x: &[f64]| wide.map_or_else(|| x.to_vec(), |filter| filter.apply(x));
        let by_span = |all: &Vec<f64>, of: &dyn Fn(&[f64]) -> Vec<f64>| -> Vec<f64> {
            self.spans.iter().flat_map(|span| of(&all[span.fine.clone()])).collect()
        };
        let each = |all: &[Vec<f64>], of: &dyn Fn(&[f64]) -> Vec<f64>| -> Vec<Vec<f64>> {
            all.iter().map(|joint| by_span(joint, of)).collect()
        };
        let q = each(&self.command, &smooth);
        let qd = each(&q, &|x| rate(x, self.period));
        let qdd = each(&qd, &|x| rate(x, self.period));
        Some(Signals { q, qd, qdd, ..self.clone() })
    }

    /// Torques of a joint at the fine samples, through the filter: of now, and of `delay` s later. By cubics through four
    /// samples: ten of them are there for each period of the band's edge. Beyond an end it is the last.
    pub fn drive_and_later(&self, joint: usize, delay: f64) -> (Vec<f64>, Vec<f64>) {
        let (mut now, mut later) = (Vec::new(), Vec::new());
        for span in &self.spans {
            let smooth = self.smoothed(&self.drive[joint][span.fine.clone()]);
            later.extend(filter::later(&smooth, delay / self.period));
            now.extend(smooth);
        }
        (now, later)
    }

    /// Which way something moves at a fine sample, of its speeds at all of them.
    pub fn sign(&self, speeds: &[f64], k: usize) -> f64 {
        filter::sign(speeds, k, self.thin)
    }

    /// Brings torques that are told `delay` s late beside the motion that they belong to.
    pub fn align(&mut self, delay: f64) {
        if delay == 0.0 {
            return;
        }
        let by = delay / self.period;
        for joint in &mut self.drive {
            for span in &self.spans {
                let moved = filter::later(&joint[span.fine.clone()], by);
                joint[span.fine.clone()].copy_from_slice(&moved);
            }
        }
    }

    /// A part of a span by itself, with so much room at both its ends, and `late` s more, that no end is felt in its
    /// `rows`; and how many of its rows are that room, before them.
    pub fn stretch(&self, span: &Span, rows: &Range<usize>, late: f64) -> (Signals, usize) {
        let room = ((ROOM * self.reach() + late) / self.step()).ceil() as usize;
        let from = rows.start.saturating_sub(room).max(span.kept.start);
        let to = (rows.end + room).min(span.kept.end);
        let at = |row: usize| span.fine.start + (row - span.kept.start) * self.every;
        let fine = at(from)..at(to).min(span.fine.end);
        fn part<T: Clone>(all: &[Vec<T>], fine: &Range<usize>) -> Vec<Vec<T>> {
            let of = |x: &Vec<T>| x.get(fine.clone()).map_or_else(Vec::new, <[T]>::to_vec);
            all.iter().map(of).collect()
        }
        let signals = Signals {
            spans: vec![Span { run: span.run, fine: 0..fine.len(), kept: 0..to - from }],
            t: self.t[fine.clone()].to_vec(),
            q: part(&self.q, &fine),
            qd: part(&self.qd, &fine),
            qdd: part(&self.qdd, &fine),
            drive: part(&self.drive, &fine),
            command: part(&self.command, &fine),
            measured: part(&self.measured, &fine),
            temperature: part(&self.temperature, &fine),
            ways: part(&self.ways, &fine),
            contact: self.contact[fine.clone()].to_vec(),
            holes: part(&self.holes, &fine),
            alike: Vec::new(),
            ..*self
        };
        (signals, rows.start - from)
    }

    /// What is to be said of a motion that is repeated.
    pub fn remarks(&self) -> Vec<String> {
        let why = "since an error that all of them share is no evidence";
        let repeats = self.repeated.map(|(count, period)| {
            format!(
                "the motion repeats {count} times, every {period:.3} s: the repeats are averaged, {why}"
            )
        });
        let runs = self.alike.iter().map(|runs| {
            let runs: Vec<String> = runs.iter().map(|run| (run + 1).to_string()).collect();
            let (last, before) =
                runs.split_last().map_or((String::new(), &[][..]), |(l, b)| (l.clone(), b));
            format!(
                "runs {} and {last} repeat one motion: they are averaged, {why}",
                before.join(", ")
            )
        });
        repeats.into_iter().chain(runs).collect()
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.q.len()
    }

    /// Number of samples that are kept.
    pub fn rows(&self) -> usize {
        self.spans.last().map_or(0, |span| span.kept.end)
    }

    /// Step between samples that are kept, s.
    pub fn step(&self) -> f64 {
        self.period * self.every as f64
    }

    /// How far the filter reaches, s.
    pub fn reach(&self) -> f64 {
        self.filter.map_or(self.period, |_| LowPass::reach(self.band))
    }

    /// Of the samples that are kept, those that no end of a span reaches through the filters: the band's, the
    /// one of the joint values and that of the thinning, whose reaches are 1, 1/2 and at most 1/4; nor by torques
    /// that are told `late` s late.
    pub fn settled(&self, late: f64) -> Vec<bool> {
        let edge = ((2.0 * self.reach() + late) / self.step()).ceil() as usize;
        let of = |span: &Span| {
            let count = span.kept.len();
            (0..count).map(move |k| k >= edge && k + edge < count)
        };
        self.spans.iter().flat_map(of).collect()
    }

    /// Of the samples that are kept, those in which a marked one weighs: within half a period of the band's edge, the main
    /// lobe of the filter, and as far as torques are told `late`, s.
    pub fn near(&self, marks: &[bool], late: f64) -> Vec<bool> {
        if !marks.contains(&true) {
            return vec![false; self.rows()];
        }
        let lobe = self.filter.map_or(0.0, |_| LOBE / self.band);
        let reach = ((lobe + late) / self.period).ceil() as usize;
        let of = |span: &Span| -> Vec<bool> {
            let part = &marks[span.fine.clone()];
            let mut until = vec![0; part.len() + 1];
            for (k, mark) in part.iter().enumerate() {
                until[k + 1] = until[k] + usize::from(*mark);
            }
            let is_near =
                |k: usize| until[(k + reach + 1).min(part.len())] > until[k.saturating_sub(reach)];
            (0..part.len()).step_by(self.every).map(is_near).collect()
        };
        self.spans.iter().flat_map(of).collect()
    }

    /// What is computed at every fine sample, through the filter, at those that are kept.
    pub fn filtered(&self, fine: &[f64]) -> Vec<f64> {
        let mut rows = Vec::with_capacity(self.rows());
        for span in &self.spans {
            let part = &fine[span.fine.clone()];
            match &self.filter {
                Some(filter) => rows.extend(filter.apply(part).iter().step_by(self.every)),
                None => rows.extend(part.iter().step_by(self.every)),
            }
        }
        rows
    }

    /// What is computed at every fine sample of one span, through the filter.
    pub fn smoothed(&self, fine: &[f64]) -> Vec<f64> {
        self.filter.map_or_else(|| fine.to_vec(), |filter| filter.apply(fine))
    }

    /// The samples that are kept, of what is known at every fine one.
    pub fn kept<T: Copy>(&self, fine: &[T]) -> Vec<T> {
        let part = |span: &Span| fine[span.fine.clone()].iter().step_by(self.every).copied();
        self.spans.iter().flat_map(part).collect()
    }
}
