//! One motion in several runs: as repeats of one run, they are not independent of each other, and are averaged.
//!
//! Runs are of one motion if their joint values are the same at some shift of time, and if their torques are, too: what a run
//! carries beside the others shows in these.

use super::LONG;
use super::even::Even;
use super::filter::{LowPass, at};
use super::repeats::{Off, coarse};

/// The part of the longer run that the other may lack, by which it may begin earlier or later.
const LACKS: f64 = 0.25;

/// Torques in the band are the same that differ by less than this part of their spread: friction changes by a few hundredths
/// from run to run, and a load of a tenth of the arm's own changes some joint's torques by more.
const ALIKE: f64 = 0.1;

/// Runs of one motion as one each.
pub(super) struct Merged {
    pub evens: Vec<Even>,
    /// The runs of each motion that there is in several of them.
    pub alike: Vec<Vec<usize>>,
}

/// A stretch, and by how many steps others come after it.
struct Group {
    first: Even,
    others: Vec<(Even, f64)>,
}

/// Merges stretches of one motion each, where `carries` says of two runs that they carry the same; `drive` is the signal of
/// what drives the joints.
pub(super) fn merged(
    evens: Vec<Even>,
    (period, band): (f64, f64),
    drive: usize,
    carries: &dyn Fn(usize, usize) -> bool,
) -> Merged {
    let filter = LowPass::new(band, period);
    let smooth = |x: &[f64]| filter.map_or_else(|| x.to_vec(), |filter| filter.apply(x));
    let mut groups: Vec<Group> = Vec::new();
    for even in evens {
        let mut joins = groups.iter_mut().find_map(|group| {
            let first = &group.first;
            let is_long = first.t.len() as f64 * period >= LONG * LowPass::reach(band);
            let may = is_long && first.run != even.run && carries(first.run, even.run);
            let by = may.then(|| shift(&first.signals[0], &even.signals[0], period)).flatten()?;
            are_alike(&first.signals[drive], &even.signals[drive], by, &smooth)
                .then_some((group, by))
        });
        match joins.take() {
            Some((group, by)) => group.others.push((even, by)),
            None => groups.push(Group { first: even, others: Vec::new() }),
        }
    }
    let runs = |group: &Group| -> Vec<usize> {
        let others = group.others.iter().map(|(even, _)| even.run);
        core::iter::once(group.first.run).chain(others).collect()
    };
    let alike = groups.iter().map(runs).filter(|runs| runs.len() > 1).collect();
    Merged { evens: groups.into_iter().map(Group::averaged).collect(), alike }
}

/// By how many steps the second of two motions comes after the first; `None` if it is another.
fn shift(first: &[Vec<f64>], second: &[Vec<f64>], period: f64) -> Option<f64> {
    let (every, [first, second]) =
        (coarse(first, period).0, [first, second].map(|q| coarse(q, period).1));
    let [count, other] = [&first, &second].map(|q| q.first().map_or(0, Vec::len) as isize);
    let longer = count.max(other);
    let most = (LACKS * longer as f64) as isize;
    let lags = (0..=most).flat_map(|lag| [lag, -lag]);
    lags.into_iter().find_map(|lag| {
        let inner = (1 - lag).max(0)..(other - 2 - lag).min(count);
        if (inner.end - inner.start) < longer - most {
            return None;
        }
        let inner = inner.start as usize..inner.end as usize;
        Off::least(&first, &second, lag as f64, inner).map(|(steps, _)| steps * every as f64)
    })
}

/// Whether the torques of all joints are the same within the band, the second's so many steps later.
fn are_alike(
    first: &[Vec<f64>],
    second: &[Vec<f64>],
    by: f64,
    smooth: &dyn Fn(&[f64]) -> Vec<f64>,
) -> bool {
    first.iter().zip(second).all(|(first, second)| {
        let (first, second) = (smooth(first), smooth(second));
        let last = second.len() as f64 - 1.0;
        let inner = (0..first.len()).filter(|k| (0.0..=last).contains(&(*k as f64 + by)));
        let mean = first.iter().sum::<f64>() / first.len() as f64;
        let [off, spread] = inner.fold([0.0, 0.0], |[off, spread], k| {
            let less = at(&second, k as f64 + by) - first[k];
            [off + less * less, spread + (first[k] - mean).powi(2)]
        });
        off <= ALIKE * ALIKE * spread
    })
}

impl Group {
    /// The mean of all, at the samples of the first.
    fn averaged(self) -> Even {
        let Group { first, others } = self;
        if others.is_empty() {
            return first;
        }
        let within = |even: &Even, k: usize, by: f64| {
            let place = k as f64 + by;
            (0.0..=even.t.len() as f64 - 1.0).contains(&place).then_some(place)
        };
        let mean = |signal: usize, joint: usize| -> Vec<f64> {
            let own = first.signals[signal][joint].iter().enumerate();
            let of = |(k, x): (usize, &f64)| {
                let others = others.iter().filter_map(|(even, by)| {
                    Some(at(&even.signals[signal][joint], within(even, k, *by)?))
                });
                let (sum, count) = others.fold((*x, 1.0), |(sum, n), x| (sum + x, n + 1.0));
                sum / count
            };
            own.map(of).collect()
        };
        let any = |own: &[bool], of: &dyn Fn(&Even) -> Vec<bool>| -> Vec<bool> {
            let marks: Vec<(&Even, f64, Vec<bool>)> =
                others.iter().map(|(even, by)| (even, *by, of(even))).collect();
            let is = |k: usize| {
                own[k]
                    || marks.iter().any(|(even, by, marks)| {
                        within(even, k, *by).is_some_and(|place| {
                            marks[place.floor() as usize] || marks[place.ceil() as usize]
                        })
                    })
            };
            (0..own.len()).map(is).collect()
        };
        let joints = first.holes.len();
        Even {
            run: first.run,
            signals: (0..first.signals.len())
                .map(|s| (0..first.signals[s].len()).map(|j| mean(s, j)).collect())
                .collect(),
            contact: any(&first.contact, &|even| even.contact.clone()),
            holes: (0..joints).map(|j| any(&first.holes[j], &|e| e.holes[j].clone())).collect(),
            t: first.t.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::infer::rng::{Rng, Stream};

    /// A motion of two joints from `begin` on, at steps of 0.01 s, with torques that are so many times theirs.
    fn run(run: usize, begin: f64, torque: f64, seed: u64) -> Even {
        let mut rng = Rng::new(seed, Stream::Noise);
        let t: Vec<f64> = (0..2000).map(|k| 0.01 * f64::from(k)).collect();
        let at = |t: f64| [(0.7 * t).sin() + 0.3 * (2.9 * t).cos(), (1.3 * t).sin()];
        let q = |j: usize| t.iter().map(|t| at(t + begin)[j]).collect::<Vec<f64>>();
        let mut tau = |j: usize| -> Vec<f64> {
            q(j).iter().map(|q| torque * q + 0.1 * rng.normal()).collect()
        };
        let signals = vec![vec![q(0), q(1)], vec![tau(0), tau(1)]];
        Even { run, signals, contact: vec![false; 2000], holes: vec![vec![false; 2000]; 2], t }
    }

    #[test]
    fn runs_of_one_motion_are_one_and_others_are_not() {
        let runs = vec![
            run(0, 0.0, 5.0, 1),
            run(1, 0.1234, 5.0, 2),
            run(2, 0.0, 6.5, 3),
            run(3, 50.0, 5.0, 4),
            run(4, -0.7, 5.0, 5),
        ];
        let alone = runs[0].signals[1][0].clone();
        let Merged { evens, alike } = merged(runs, (0.01, 5.0), 1, &|_, _| true);
        assert_eq!(alike, [[0, 1, 4]]);
        assert_eq!(evens.iter().map(|even| even.run).collect::<Vec<_>>(), [0, 2, 3]);
        let truth = |k: usize| 5.0 * ((0.007 * k as f64).sin() + 0.3 * (0.029 * k as f64).cos());
        let off = |x: &[f64]| (100..1800).map(|k| (x[k] - truth(k)).powi(2)).sum::<f64>() / 1700.0;
        // Three runs have a third of the variance of one; a cubic between samples takes some more.
        let part = off(&evens[0].signals[1][0]) / off(&alone);
        assert!((0.2..0.4).contains(&part), "{part}");
        let apart =
            merged(vec![run(0, 0.0, 5.0, 1), run(1, 0.0, 5.0, 2)], (0.01, 5.0), 1, &|_, _| false);
        assert_eq!((apart.evens.len(), apart.alike.len()), (2, 0));
    }
}
