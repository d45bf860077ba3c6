//! What is wrong with a log's readings: a unit, a sign, a column in another's place, a channel that tells nothing.
//!
//! They come before the effects, as [`mistakes`](crate::mistakes) come before mechanics: each is taken out of the log
//! exactly, is said in a sentence, and the diagnosis goes on without it. What the channels show by themselves is asked
//! first (`channels`), then what only a model shows (`retold`, `held`).

mod channels;
mod held;
mod retold;

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};
use stiffarm_kernels::generic::Arm;

use super::effects::{COULOMB, OFFSET, Spot, VISCOUS};
use super::read::{Clock, Log, Signal, TorqueSide};
use super::search::case::{Case, Wanted};
use super::search::dictionary::{Dictionary, Mixed};
use super::search::fit::weights;
use super::search::normal_equations::sum;
use crate::infer::{RANK, Squares};

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
    /// A column has the wrong sign.
    Sign { signal: Signal, joint: usize },
    /// Two joints' columns stand in each other's place.
    Swapped { signal: Signal, joints: [usize; 2] },
    /// Runs carry something that the others do not, kg more, and no column says so.
    Held { runs: Vec<usize>, mass: f64 },
}

/// Samples beside one at a limit that are left out with it: a filter of the recorder rounds the edge.
const BESIDE: usize = 3;

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
                    let there: Vec<usize> =
                        (0..run.t.len()).filter(|k| at(&all[*joint][*k])).collect();
                    for k in there {
                        let end = (k + BESIDE + 1).min(run.t.len());
                        run.contact[k.saturating_sub(BESIDE)..end].fill(true);
                    }
                }
                Misread::Sign { signal, joint } => {
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

    /// What is wrong, what is done, and how to mend it.
    fn sentence(&self, log: &Log) -> String {
        let file = log.files.join(", ");
        let named = |signal: &Signal, joint: usize| format!("{}{}", signal.name(), joint + 1);
        let what = match self {
            Misread::Time { factor } if *factor < 1.0 => format!(
                "t steps by {} s: it is read as milliseconds; write t[ms]",
                shown(log.period())
            ),
            Misread::Time { .. } => format!(
                "t steps by {} s: it is read as a thousand times that; write its unit as t[s] or t[ms]",
                shown(log.period())
            ),
            Misread::Wrapped { signal, joint, jumps } => format!(
                "{} jumps by whole turns {jumps} times: it is read without the jumps",
                named(signal, *joint)
            ),
            Misread::Rates { factor } if *factor < 0.0 => {
                "qd1 … have the sign against which q1 … change: they are read \
                 with the other"
                    .to_owned()
            }
            Misread::Rates { factor } => {
                let (is, says) = if *factor < 1.0 { ("deg", "rad") } else { ("rad", "deg") };
                format!(
                    "qd1 … are {} times the rates of q1 …: they are read as {is}/s, not {says}/s; write \
                     qd1[{is}/s]",
                    shown(1.0 / factor)
                )
            }
            Misread::NoRate { joint, ratio: Some(ratio) } => format!(
                "qd{n} is {} times the rate of q{n}: no column of rates is used; is its unit right?",
                shown(*ratio),
                n = joint + 1
            ),
            Misread::NoRate { joint, ratio: None } => format!(
                "qd{n} does not go with the rate of q{n}: no column of rates is used; is it another joint's?",
                n = joint + 1
            ),
            Misread::Silent { signal, joint, at } => format!(
                "{} is {} throughout: joint {} is left out; is the channel connected?",
                named(signal, *joint),
                shown(*at),
                joint + 1
            ),
            Misread::Parked { joint } => {
                format!("joint {} does not move: it is left out", joint + 1)
            }
            Misread::Clipped { signal, joint, samples, limits } => {
                let limits = limits.iter().filter(|limit| limit.is_finite());
                let limits: Vec<String> = limits.map(|limit| shown(*limit)).collect();
                let limits = limits.join(" and ");
                format!(
                    "{} stands at its limit of {limits} in {samples} samples: these are left out",
                    named(signal, *joint)
                )
            }
            Misread::Sign { signal, joint } => format!(
                "{name} has the wrong sign for joint {}: it is read as −{name}; give it factor = -1 in a map",
                joint + 1,
                name = named(signal, *joint),
            ),
            Misread::Swapped { signal, joints: [a, b] } => format!(
                "{} and {} stand in each other's columns: they are read as swapped; write their names the other way",
                named(signal, *a),
                named(signal, *b)
            ),
            Misread::Held { runs, mass } => {
                let names: Vec<String> = runs.iter().map(|run| (run + 1).to_string()).collect();
                let (which, verb) = match names.as_slice() {
                    [one] => (format!("run {one}"), "carries"),
                    [before @ .., last] => {
                        (format!("runs {} and {last}", before.join(", ")), "carry")
                    }
                    [] => (String::new(), ""),
                };
                format!(
                    "{which} {verb} about {} kg more than the others, and no column says so: it is taken for one \
                     body; write its name in a column `payload`",
                    shown(*mass)
                )
            }
        };
        format!("{file}: {what}")
    }
}

/// What a robot file's friction looks like that nobody has measured: one number at every joint.
pub fn placeholder(arm: &Arm, side: Option<TorqueSide>) -> Option<String> {
    if arm.dof() < ALIKE || !side.is_some_and(TorqueSide::is_driven) {
        return None;
    }
    let drives = || arm.joints.iter().map(|joint| &joint.drive);
    let all = |of: &dyn Fn(&stiffarm_kernels::generic::Drive) -> f64| {
        let first = drives().map(of).next().unwrap_or(0.0);
        (first > 0.0 && drives().all(|drive| of(drive) == first)).then_some(first)
    };
    let coulomb = all(&|drive| drive.coulomb).map(|x| format!("coulomb = {}", shown(x)));
    let viscous = all(&|drive| drive.viscous).map(|x| format!("viscous = {}", shown(x)));
    let named: Vec<String> = coulomb.into_iter().chain(viscous).collect();
    (!named.is_empty()).then(|| {
        format!(
            "the robot file has {} at every joint: is it a placeholder of a simulator's file? What is found is beyond it, \
             and takes it back where it is too much",
            named.join(" and ")
        )
    })
}

/// Fewer joints may have motors of one type.
const ALIKE: usize = 3;

/// Three significant digits.
fn shown(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let digits = (2.0 - x.abs().log10().floor()).clamp(0.0, 12.0);
    let text = format!("{x:.*}", digits as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Fine samples that are enough to tell a sign.
const ENOUGH: usize = 20_000;

/// Rigid links, friction that brakes and zeros, beside which readings are asked for.
struct Plain<'a> {
    dict: Dictionary<'a>,
    columns: Vec<Mixed>,
    least: Vec<f64>,
}

impl<'a> Plain<'a> {
    /// Of a log, with what else is wanted behind three offers for each joint; of about so many fine samples of it.
    fn of(case: &'a Case<'a>, more: Vec<Wanted>, enough: usize) -> Plain<'a> {
        let effects = [COULOMB, VISCOUS, OFFSET];
        let spots = (0..case.signals.joints()).map(Spot::of_joint);
        let own = spots.flat_map(|spot| effects.map(|e| (e, spot, vec![vec![0.0]])));
        let wanted: Vec<Wanted> = own.chain(more).collect();
        let nothing = super::search::case::Simple::nothing(case);
        let thinned = case.signals.t.len().div_ceil(enough);
        let dict = Dictionary::of(case, &nothing, &wanted, thinned);
        let count = 3 * case.signals.joints();
        let mut columns: Vec<Mixed> = (0..dict.base).map(Mixed::one).collect();
        let mut least = vec![f64::NEG_INFINITY; dict.base];
        for offer in &dict.offers[..count] {
            columns.extend(offer.entries[0].columns.iter().cloned());
            let of_file = offer.effect.file_value(case.arm, case.kind.1, offer.spot);
            least.push(offer.effect.parameters()[0].least - of_file);
        }
        Plain { dict, columns, least }
    }

    /// What is left of each joint, each told in its own size, where friction brakes: root mean square.
    fn left(&self, more: &[Mixed], left: &Mixed) -> (Vec<f64>, Vec<f64>) {
        let columns: Vec<Mixed> = self.columns.iter().chain(more).cloned().collect();
        let mut least = self.least.clone();
        least.resize(columns.len(), f64::NEG_INFINITY);
        let mut bordered = columns.clone();
        bordered.push(left.clone());
        let n = columns.len();
        let mut sizes = vec![1.0; self.dict.case.signals.joints()];
        let mut values = Vec::new();
        for _ in 0..2 {
            let products = self.dict.whole().squares(&bordered, &weights(&sizes));
            let products = sum(products.iter()).unwrap_or_else(|| DMatrix::zeros(n + 1, n + 1));
            let matrix = products.view((0, 0), (n, n)).into_owned();
            let right: DVector<f64> = products.view((0, n), (n, 1)).column(0).into_owned();
            let squares =
                Squares { sizes: matrix.diagonal(), matrix: &matrix, right: &right, decided: RANK };
            values = squares.solve(&least).0.iter().copied().chain([-1.0]).collect();
            sizes = self.dict.sizes(&bordered, &values);
        }
        (sizes, values)
    }
}
