//! A motion that is repeated, sample by sample.
//!
//! What an arm does in every repeat, and its model does not, is the same in each: steps of the encoders, errors of the
//! differentiation, whatever is read wrongly at a joint value. Repeats are then not independent of each other, and whoever
//! takes them for that finds ripples of any order with certainty. As is usual in identification they are averaged (Swevers
//! et al. 1997): one period is left, with less noise.

use super::Even;

/// Repeats are locked to the samples that differ by less than this part of what the joints move in a step.
const LOCKED: f64 = 0.2;

/// The shortest period, s: no faster excitation is one that tells the links' numbers.
const SHORTEST: f64 = 1.0;

/// Samples at which a period is tried before all are asked.
const ANCHORS: usize = 64;

/// After how many steps a motion of at least two repeats begins again; `None` if it never does.
pub(super) fn found(q: &[Vec<f64>], period: f64) -> Option<usize> {
    let n = q.first().map_or(0, Vec::len);
    let least = (SHORTEST / period).ceil() as usize;
    (least.max(1)..=n / 2).find(|lag| {
        let last = n - lag - 1;
        let some = (0..ANCHORS).map(|k| last * k / ANCHORS);
        is_locked(q, *lag, some) && is_locked(q, *lag, 0..last)
    })
}

fn is_locked(q: &[Vec<f64>], lag: usize, at: impl Iterator<Item = usize> + Clone) -> bool {
    let joint = |q: &Vec<f64>| {
        let add = |[off, step]: [f64; 2], k: usize| {
            [off + (q[k + lag] - q[k]).powi(2), step + (q[k + 1] - q[k]).powi(2)]
        };
        at.clone().fold([0.0; 2], add)
    };
    let all: Vec<[f64; 2]> = q.iter().map(joint).collect();
    all.iter().any(|[_, step]| *step > 0.0)
        && all.iter().all(|[off, step]| *off <= LOCKED * LOCKED * step)
}

impl Even {
    /// The mean of all whole periods of so many steps.
    pub(super) fn averaged(self, steps: usize) -> Even {
        let count = self.t.len() / steps;
        let mean = |x: &Vec<f64>| {
            let of = |k: usize| (0..count).map(|r| x[k + r * steps]).sum::<f64>() / count as f64;
            (0..steps).map(of).collect()
        };
        let touches = |k: usize| (0..count).any(|r| self.contact[k + r * steps]);
        Even {
            run: self.run,
            signals: self.signals.iter().map(|s| s.iter().map(mean).collect()).collect(),
            contact: (0..steps).map(touches).collect(),
            t: self.t.into_iter().take(steps).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_is_found_and_a_motion_that_only_comes_near_is_none() {
        let wave = |k: usize, turn: f64| (turn * k as f64).sin();
        let turn = core::f64::consts::TAU / 250.0;
        let q = |other: f64| -> Vec<Vec<f64>> {
            let joint = |by: f64| (0..1200).map(|k| wave(k, by)).collect();
            vec![joint(turn), joint(other)]
        };
        assert_eq!(found(&q(3.0 * turn), 0.01), Some(250));
        assert_eq!(found(&q(2f64.sqrt() * turn), 0.01), None);
        assert_eq!(found(&[vec![1.0; 800]], 0.01), None);
    }
}
