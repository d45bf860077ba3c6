//! What the time stamps of a run tell of its clock.

use super::Run;
use crate::infer::middle;

/// A step of more than so many periods lost samples.
const LOST: f64 = 1.5;

/// Jitter above this part of a period is said.
const UNEVEN: f64 = 0.05;

/// A clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Clock {
    /// The usual step between samples, s.
    pub period: f64,
    /// Standard deviation of the steps that lost nothing, s.
    pub jitter: f64,
    /// Samples that are missing, by the steps that are too long.
    pub dropped: usize,
    /// Samples that bear the stamp of the one before; they are left out.
    pub repeated: usize,
}

impl Clock {
    /// Of stamps that increase.
    pub fn of(t: &[f64], repeated: usize) -> Clock {
        let steps: Vec<f64> = t.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let Some(period) = middle(steps.iter().copied()) else {
            return Clock { repeated, ..Clock::default() };
        };
        let (whole, lost): (Vec<f64>, Vec<f64>) =
            steps.into_iter().partition(|step| *step < LOST * period);
        let square: f64 = whole.iter().map(|step| (step - period).powi(2)).sum();
        let missing = lost.iter().map(|step| ((step / period).round() as usize).saturating_sub(1));
        Clock {
            period,
            jitter: (square / whole.len().max(1) as f64).sqrt(),
            dropped: missing.sum(),
            repeated,
        }
    }
}

/// What is to be said of the clocks of a log.
pub(super) fn remarks(runs: &[Run]) -> Vec<String> {
    let mut said = Vec::new();
    let sum = |of: fn(&Clock) -> usize| runs.iter().map(|run| of(&run.clock)).sum::<usize>();
    let all: usize = runs.iter().map(|run| run.t.len()).sum();
    let (dropped, repeated) = (sum(|c| c.dropped), sum(|c| c.repeated));
    if dropped > 0 {
        said.push(format!(
            "{dropped} samples are missing among {all}, by the stamps: what lies in between is \
             interpolated where a gap is short, and nothing is filtered across a long one"
        ));
    }
    if repeated > 0 {
        said.push(format!("{repeated} samples bear the stamp of the one before and are left out"));
    }
    let uneven = runs.iter().map(|run| run.clock.jitter / run.clock.period);
    let worst = uneven.filter(|part| part.is_finite()).fold(0.0, f64::max);
    if worst > UNEVEN {
        let run = runs.iter().find(|r| r.clock.jitter >= worst * r.clock.period);
        let jitter = run.map_or(0.0, |r| 1e3 * r.clock.jitter);
        said.push(format!(
            "the clock jitters by {jitter:.2} ms, {:.0} % of its step: samples are interpolated to \
             even steps, and what turns fast (ripple of high order) cannot be seen",
            100.0 * worst
        ));
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lost_samples_are_counted_and_jitter_is_that_of_the_others() {
        let t = [0.0, 0.01, 0.0201, 0.03, 0.07, 0.08];
        let clock = Clock::of(&t, 2);
        assert!((clock.period - 0.01).abs() < 2e-4);
        assert_eq!((clock.dropped, clock.repeated), (3, 2));
        // Steps of 10, 10.1, 9.9 and 10 ms about their median.
        assert!((clock.jitter - 7e-5).abs() < 2e-5, "{}", clock.jitter);
        assert_eq!(Clock::of(&[1.0], 0), Clock::default());
    }
}
