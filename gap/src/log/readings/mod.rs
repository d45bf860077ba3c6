//! What is wrong with a log's readings: a unit, a sign, a column in another's place, a channel that tells nothing.
//!
//! They come before the effects, as [`mistakes`](crate::mistakes) come before mechanics: each is taken out of the log
//! exactly, is said in a sentence, and the diagnosis goes on without it. What the channels show by themselves is asked
//! first (`channels`), then what only a model shows (`retold`, `held`).

mod channels;
mod held;
mod plain;
mod retold;
mod sentences;
mod zeros;

use std::borrow::Cow;

use stiffarm_kernels::generic::Arm;

use super::read::{Clock, Hole, Log, Signal};
use super::search::case::Case;
use crate::constants::BESIDE_LIMIT;
pub use sentences::placeholder;

/// One thing that is wrong. Joints and runs count from 0.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the sentence of each variant says what its fields are")]
pub enum Misread {
    /// Stamps have another unit: what is true is the factor times what is told.
    Time { factor: f64 },
    /// A joint's values jump by whole turns.
    Wrapped { signal: Signal, joint: usize, jumps: usize },
    /// Rates of all joints have another unit, or the other sign.
    Rates { factor: f64 },
    /// A column of rates is none of its joint: rates are those of the joint values.
    NoRate { joint: usize, ratio: Option<f64> },
    /// What drives a joint never changes.
    Silent { signal: Signal, joint: usize, at: f64 },
    /// A joint does not move.
    Parked { joint: usize },
    /// What drives a joint stands at its limit in so many samples.
    Clipped { signal: Signal, joint: usize, samples: usize, limits: [f64; 2] },
    /// A column has the wrong sign, or the joint's other one has, as far as these data distinguish them.
    Sign { signal: Signal, joint: usize, or: Option<Signal> },
    /// A joint's zero is another than the robot file's: what is true is so much more than what is told, rad.
    Zero { joint: usize, by: f64 },
    /// A joint goes against its command.
    Against { joint: usize },
    /// Two joints' columns stand in each other's place.
    Swapped { signal: Signal, joints: [usize; 2] },
    /// Runs carry something that the others do not, kg more, and no column says so.
    Held { runs: Vec<usize>, mass: f64 },
}

/// All that is wrong with a log's readings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readings {
    /// In the order in which they were found.
    pub all: Vec<Misread>,
}

impl Readings {
    /// What the channels show by themselves.
    pub fn of_channels(arm: &Arm, log: &Log, drive: Option<Signal>) -> Readings {
        Readings { all: channels::found(arm, log, drive) }
    }

    /// What a simple model of the mended log shows beside; rows of torques alone.
    pub fn of_model(case: &Case<'_>, drive: Signal) -> Vec<Misread> {
        match retold::found(case, drive) {
            none if none.is_empty() => held::found(case),
            found => found,
        }
    }

    /// The log without it.
    pub fn mended<'l>(&self, log: &'l Log) -> Cow<'l, Log> {
        let mut log = Cow::Borrowed(log);
        for misread in self.all.iter().filter(|misread| !misread.is_left_out()) {
            misread.mend(log.to_mut());
        }
        log
    }

    /// Of so many joints those that are left out.
    pub fn left_out(&self, joints: usize) -> Vec<bool> {
        let is_out = |of: usize| {
            let is = |misread: &Misread| match misread {
                Misread::Silent { joint, .. } | Misread::Parked { joint } => *joint == of,
                _ => false,
            };
            self.all.iter().any(is)
        };
        (0..joints).map(is_out).collect()
    }

    /// A sentence for each.
    pub fn sentences(&self, log: &Log) -> Vec<String> {
        self.all.iter().map(|misread| misread.sentence(log)).collect()
    }
}

impl Misread {
    /// Whether the joint is left out, and the log stays as it is.
    fn is_left_out(&self) -> bool {
        matches!(self, Misread::Silent { .. } | Misread::Parked { .. })
    }

    /// Takes it out of a log of the same recorder.
    fn mend(&self, log: &mut Log) {
        if let Misread::Held { runs, .. } = self {
            let name = format!("unnamed, of run {}", runs[0] + 1);
            let of = |run: &usize| *run < log.runs.len();
            for run in runs.iter().copied().filter(of).collect::<Vec<_>>() {
                log.runs[run].payload = Some(name.clone());
            }
            return;
        }
        for run in &mut log.runs {
            let scale = |rows: &mut Vec<f64>, factor: f64| {
                rows.iter_mut().for_each(|x| *x *= factor);
            };
            match self {
                Misread::Time { factor } => {
                    scale(&mut run.t, *factor);
                    run.clock = Clock::of(&run.t, run.clock.repeated);
                }
                Misread::Rates { factor } => {
                    for rows in run.signals.get_mut(&Signal::Qd).into_iter().flatten() {
                        scale(rows, *factor);
                    }
                }
                Misread::NoRate { .. } => {
                    run.signals.remove(&Signal::Qd);
                }
                Misread::Wrapped { signal, joint, .. } => {
                    if let Some(all) = run.signals.get_mut(signal) {
                        channels::unwrap(&mut all[*joint]);
                    }
                }
                Misread::Clipped { signal, joint, limits, .. } => {
                    let Some(all) = run.signals.get(signal) else { continue };
                    let at = |x: &f64| *x <= limits[0] || *x >= limits[1];
                    let beside = |k: usize| {
                        k.saturating_sub(BESIDE_LIMIT)..(k + BESIDE_LIMIT + 1).min(run.t.len())
                    };
                    let there = (0..run.t.len()).filter(|k| at(&all[*joint][*k])).map(beside);
                    let hole = |samples| Hole { signal: *signal, joint: *joint, samples };
                    run.holes.extend(there.map(hole));
                }
                Misread::Zero { joint, by } => {
                    for signal in [Signal::Q, Signal::QCmd] {
                        let all = run.signals.get_mut(&signal).into_iter();
                        all.for_each(|all| all[*joint].iter_mut().for_each(|x| *x += by));
                    }
                }
                Misread::Against { joint } => {
                    for signal in [Signal::QCmd, Signal::QdCmd] {
                        if let Some(all) = run.signals.get_mut(&signal) {
                            scale(&mut all[*joint], -1.0);
                        }
                    }
                }
                Misread::Sign { signal, joint, .. } => {
                    let with: &[Signal] = match signal {
                        Signal::Q => {
                            &[Signal::Q, Signal::Qd, Signal::Qdd, Signal::QCmd, Signal::QdCmd]
                        }
                        other => &[*other],
                    };
                    for signal in with {
                        if let Some(all) = run.signals.get_mut(signal) {
                            scale(&mut all[*joint], -1.0);
                        }
                    }
                }
                Misread::Swapped { signal, joints: [a, b] } => {
                    if let Some(all) = run.signals.get_mut(signal) {
                        all.swap(*a, *b);
                    }
                }
                Misread::Silent { .. } | Misread::Parked { .. } | Misread::Held { .. } => {}
            }
        }
    }
}
