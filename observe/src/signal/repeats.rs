//! A motion that is repeated.
//!
//! What an arm does in every repeat, and its model does not, is the same in each: steps of the encoders, errors of the
//! differentiation, whatever is read wrongly at a joint value. Repeats are then not independent of each other, and whoever
//! takes them for that finds ripples of any order with certainty. As is usual in identification they are averaged (Swevers
//! et al. 1997): one period is left, with less noise. The clock need not be locked to the motion: a period is any number
//! of steps, whole or not, and what lies before the first repeat and behind the last is left out.

use core::ops::Range;

use super::even::Even;
use super::filter::at;

/// Repeats are those that differ by less than this part of what the joints move in a step, beside the noise of the encoders.
const LOCKED: f64 = 0.2;

/// So much more they may differ by as they are sampled: half a step.
const BETWEEN: f64 = 0.5;

/// A sample ends the repeats at so many times the root mean square of what they may differ by: of normal noise one in three
/// million does, and an arm that stands or goes elsewhere differs by hundreds of steps.
const ENDS: f64 = 5.0;

/// The shortest period, s: no faster excitation is one that tells the links' numbers.
const SHORTEST: f64 = 1.0;

/// The part of the log at either end that may be no repeat: an approach, a rest.
const LEAD: f64 = 0.125;

/// Steps, s, at which periods are looked for: of finer ones the encoders' noise is most of what a joint moves.
const STEP: f64 = 0.01;

/// Samples that the last repeat may lack: ends are found to one, and a step is the clock's median.
const ROUNDED: usize = 2;

/// Samples at which a period is tried before all are asked.
const ANCHORS: usize = 64;

/// Times that a period is refined: each leaves about the square of its error, in steps.
const REFINED: usize = 3;

/// Repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Repeats {
    /// The first sample of the first.
    pub start: usize,
    /// The first sample behind the last.
    pub end: usize,
    /// The period, steps.
    pub steps: f64,
}

impl Repeats {
    /// How many there are; the last may lack some samples.
    pub fn count(&self) -> usize {
        ((self.end - self.start + ROUNDED) as f64 / self.steps).floor() as usize
    }
}

/// The repeats of a motion at even steps of `period`, s; `None` if it never begins again.
pub(super) fn found(q: &[Vec<f64>], period: f64) -> Option<Repeats> {
    let (every, samples) = coarse(q, period);
    let Repeats { start, end, steps } = found_at(&samples, period * every as f64)?;
    let end = (end * every).min(q.first().map_or(0, Vec::len));
    Some(Repeats { start: start * every, end, steps: steps * every as f64 })
}

/// Every so-manyth sample, and how many.
pub(super) fn coarse(q: &[Vec<f64>], period: f64) -> (usize, Vec<Vec<f64>>) {
    let every = ((STEP / period) as usize).max(1);
    (every, q.iter().map(|q| q.iter().step_by(every).copied().collect()).collect())
}

/// The same of samples that are coarse enough.
fn found_at(q: &[Vec<f64>], period: f64) -> Option<Repeats> {
    let n = q.first().map_or(0, Vec::len);
    let least = ((SHORTEST / period).ceil() as usize).max(1);
    let lead = (LEAD * n as f64) as usize;
    let found = (least..=n / 2).find_map(|lag| {
        let inner = lead..(n - lead).saturating_sub(lag + 2);
        if inner.is_empty() {
            return None;
        }
        let (steps, off) = Off::least(q, q, lag as f64, inner.clone())?;
        Some((inner, steps, off))
    });
    let (inner, steps, off) = found?;
    let limits = off.limits(inner.len());
    let is_repeat = |k: &usize| {
        let pairs = q.iter().zip(&limits);
        pairs.into_iter().all(|(q, limit)| (at(q, *k as f64 + steps) - q[*k]).abs() <= *limit)
    };
    let last = n - 1 - steps.ceil() as usize;
    let middle = inner.start + inner.len() / 2;
    let start = (0..middle).rev().take_while(is_repeat).last().unwrap_or(middle);
    let end = (middle..=last).take_while(is_repeat).last().unwrap_or(middle);
    let repeats = Repeats { start, end: (end + steps.ceil() as usize + 1).min(n), steps };
    (repeats.count() > 1).then_some(repeats)
}

/// By how much a motion differs from another one so many steps later.
pub(super) struct Off {
    /// Of each joint the sums of squares: of the difference, of a step, and of what the step changes by.
    joints: Vec<[f64; 3]>,
    /// The product of differences and steps.
    along: f64,
}

impl Off {
    /// Near a lag, at the steps at which they differ least; `None` where they are not the same.
    pub(super) fn least(
        first: &[Vec<f64>],
        second: &[Vec<f64>],
        lag: f64,
        inner: Range<usize>,
    ) -> Option<(f64, Off)> {
        let anchors = (0..ANCHORS).map(|k| inner.start + inner.len() * k / ANCHORS);
        if !Off::of(first, second, lag, anchors).is_within(BETWEEN + LOCKED) {
            return None;
        }
        let refine = |steps: f64, _| steps - Off::of(first, second, steps, inner.clone()).late();
        let steps = (0..REFINED).fold(lag, refine);
        let off = Off::of(first, second, steps, inner.clone());
        ((steps - lag).abs() < 1.0 && off.is_within(LOCKED)).then_some((steps, off))
    }

    fn of(
        first: &[Vec<f64>],
        second: &[Vec<f64>],
        steps: f64,
        samples: impl Iterator<Item = usize> + Clone,
    ) -> Off {
        let mut along = 0.0;
        let mut joint = |(first, second): (&Vec<f64>, &Vec<f64>)| {
            let mut sums = [0.0; 3];
            for k in samples.clone() {
                let [before, here, after] =
                    [-1.0, 0.0, 1.0].map(|by| at(second, k as f64 + steps + by));
                let (off, step) = (here - first[k], 0.5 * (after - before));
                let bend = after - 2.0 * here + before;
                sums.iter_mut().zip([off, step, bend]).for_each(|(sum, x)| *sum += x * x);
                along += off * step;
            }
            sums
        };
        let joints = first.iter().zip(second).map(&mut joint).collect();
        Off { joints, along }
    }

    /// By how many steps it comes late.
    fn late(&self) -> f64 {
        let steps: f64 = self.joints.iter().map(|[_, step, _]| step).sum();
        if steps > 0.0 { self.along / steps } else { 0.0 }
    }

    /// The squares by which a joint may differ: a part of its step, and what two readings' noise of variance σ² makes of 2 σ²,
    /// and half as much again by chance, where three readings make a bend of 6 σ².
    fn allowed([_, step, bend]: &[f64; 3], part: f64) -> f64 {
        part * part * step + bend / 2.0
    }

    /// Whether no joint differs by more, and some joint moves.
    fn is_within(&self, part: f64) -> bool {
        self.joints.iter().any(|[_, step, bend]| *step > *bend)
            && self.joints.iter().all(|joint| joint[0] <= Off::allowed(joint, part))
    }

    /// Differences of each joint at which repeats end, of sums over so many samples.
    fn limits(&self, count: usize) -> Vec<f64> {
        let limit =
            |joint: &[f64; 3]| ENDS * (Off::allowed(joint, LOCKED) / count.max(1) as f64).sqrt();
        self.joints.iter().map(limit).collect()
    }
}

impl Even {
    /// The mean of all repeats: one period.
    pub(super) fn averaged(self, repeats: &Repeats) -> Even {
        let Repeats { start, end, steps } = *repeats;
        let places = |k: usize| {
            let all = (0..).map(move |r| (start + k) as f64 + steps * f64::from(r));
            all.take_while(move |place| *place <= (end - 1) as f64)
        };
        let count = steps.floor() as usize;
        let mean = |x: &Vec<f64>| {
            let of = |k: usize| {
                let (sum, count) =
                    places(k).fold((0.0, 0.0), |(sum, count), p| (sum + at(x, p), count + 1.0));
                sum / count
            };
            (0..count).map(of).collect()
        };
        let any = |marks: &Vec<bool>| {
            let of =
                |k: usize| places(k).any(|p| marks[p.floor() as usize] || marks[p.ceil() as usize]);
            (0..count).map(of).collect()
        };
        Even {
            run: self.run,
            signals: self.signals.iter().map(|s| s.iter().map(mean).collect()).collect(),
            contact: any(&self.contact),
            holes: self.holes.iter().map(any).collect(),
            t: self.t[start..start + count].to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    /// Two joints of so many samples: a wave of 250 steps, and another one.
    fn waves(count: usize, first: f64, other: f64) -> Vec<Vec<f64>> {
        let wave = |steps: f64| (0..count).map(|k| (TAU * k as f64 / steps).sin()).collect();
        vec![wave(first), wave(other)]
    }

    #[test]
    fn a_period_is_found_and_a_motion_that_only_comes_near_is_none() {
        let found = |q: &[Vec<f64>]| found(q, 0.01);
        let whole = found(&waves(1200, 250.0, 250.0 / 3.0)).unwrap();
        assert!((whole.steps - 250.0).abs() < 1e-6, "{whole:?}");
        assert_eq!((whole.start, whole.end, whole.count()), (0, 1200, 4));
        assert_eq!(found(&waves(1200, 250.0, 250.0 / 2f64.sqrt())), None);
        assert_eq!(found(&[vec![1.0; 800]]), None);
    }

    /// Of no whole number of steps, with noise of encoders, and rest before and behind.
    #[test]
    fn a_clock_need_not_be_locked_and_rest_is_left_out() {
        let mut rng = crate::infer::rng::Rng::new(5, crate::infer::rng::Stream::Noise);
        for (steps, count) in [(240.45, 4), (230.8, 4), (260.3, 3)] {
            let rest = 120;
            let mut q = waves(1000, steps, steps / 3.0);
            for joint in &mut q {
                let last = joint[999];
                joint.splice(0..0, core::iter::repeat_n(joint[0], rest));
                joint.extend(core::iter::repeat_n(last, rest));
                joint.iter_mut().for_each(|q| *q += 2e-3 * rng.normal());
            }
            let found = found(&q, 0.01).unwrap_or_else(|| panic!("{steps}"));
            assert!((found.steps - steps).abs() < 0.05, "{found:?}, {steps}");
            // A wave moves by 0.025 and 0.075 in a step.
            assert!(
                found.start.abs_diff(rest) < 5 && found.end.abs_diff(1000 + rest) < 5,
                "{found:?}"
            );
            assert_eq!(found.count(), count, "{found:?}");
        }
    }
}
