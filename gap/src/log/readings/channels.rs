//! What the channels of a log show by themselves, without a model of the arm.

use core::f64::consts::{PI, TAU};

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::Misread;
use crate::constants::{
    FAIR_STEPS, LIMIT_TIMES, LIMITED, MISTAKE_LEAVES, RATE_GOES, SAME_FACTOR, UNCHANGED, WHOLE_TURN,
};
use crate::infer::limits::SOME_SAMPLES;
use crate::log::{Log, Run, Signal};

/// Time over which a change of a joint is compared with the integral of its rate, s: many samples, and less than what a
/// motion takes to turn round.
const OVER: f64 = 0.05;

/// Delays of a servo that are tried, s: up to, in steps.
const FOLLOWS: [f64; 2] = [0.5, 0.02];

/// All of them; `drive` is what drives the joints in the rows, if torques are looked at.
pub(super) fn found(arm: &Arm, log: &Log, drive: Option<Signal>) -> Vec<Misread> {
    let mut all: Vec<Misread> = time(log).into_iter().collect();
    for signal in [Signal::Q, Signal::QCmd] {
        let turns = |j: &usize| arm.joints[*j].motion == Motion::Revolute;
        all.extend((0..arm.dof()).filter(turns).filter_map(|j| wrapped(log, signal, j)));
    }
    let read = super::Readings { all: all.clone() };
    let log = &*read.mended(log);
    let ranges: Vec<f64> = (0..arm.dof()).map(|j| range(log, Signal::Q, j)).collect();
    let most = ranges.iter().copied().fold(0.0, f64::max);
    let parked = |j: &usize| ranges[*j] <= (UNCHANGED * most).min(UNCHANGED);
    all.extend(rates(arm, log, &|j| !parked(&j)));
    let moving = (0..arm.dof()).filter(|j| !parked(j));
    all.extend(moving.filter(|j| is_against(log, *j)).map(|joint| Misread::Against { joint }));
    let Some(drive) = drive else { return all };
    for joint in 0..arm.dof() {
        if parked(&joint) {
            all.push(Misread::Parked { joint });
        } else if range(log, drive, joint) == 0.0 {
            let at = each(log, drive, joint).next().unwrap_or(0.0);
            all.push(Misread::Silent { signal: drive, joint, at });
        } else {
            all.extend(clipped(log, drive, joint));
        }
    }
    all
}

fn of(run: &Run, signal: Signal, joint: usize) -> &[f64] {
    run.signals.get(&signal).map_or(&[], |all| &all[joint])
}

fn each(log: &Log, signal: Signal, joint: usize) -> impl Iterator<Item = f64> + '_ {
    log.runs.iter().flat_map(move |run| of(run, signal, joint).iter().copied())
}

fn range(log: &Log, signal: Signal, joint: usize) -> f64 {
    let ends = each(log, signal, joint)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    (ends[1] - ends[0]).max(0.0)
}

fn time(log: &Log) -> Option<Misread> {
    let period = log.period();
    let is_fair = |factor: f64| (FAIR_STEPS[0]..FAIR_STEPS[1]).contains(&(factor * period));
    if is_fair(1.0) {
        return None;
    }
    [1e-3, 1e3].into_iter().find(|f| is_fair(*f)).map(|factor| Misread::Time { factor })
}

/// By how many turns a step between two samples is a jump.
fn turns(step: f64) -> f64 {
    let turns = (step / TAU).round();
    if turns != 0.0 && (step / TAU - turns).abs() < WHOLE_TURN { turns } else { 0.0 }
}

fn wrapped(log: &Log, signal: Signal, joint: usize) -> Option<Misread> {
    let of_run = |run: &Run| {
        let steps = of(run, signal, joint).windows(2);
        steps.filter(|pair| turns(pair[1] - pair[0]) != 0.0).count()
    };
    let jumps: usize = log.runs.iter().map(of_run).sum();
    (jumps > 0).then_some(Misread::Wrapped { signal, joint, jumps })
}

/// Takes whole turns out of the steps between samples.
pub(super) fn unwrap(rows: &mut [f64]) {
    let (mut off, mut before) = (0.0, None);
    for x in rows {
        let told = *x;
        if let Some(before) = before {
            off -= TAU * turns(told - before);
        }
        before = Some(told);
        *x = told + off;
    }
}

/// How many times its joint's rate a column of rates is; `None` where it does not go with it.
fn ratio(log: &Log, joint: usize) -> Option<f64> {
    let lag = ((OVER / log.period()).round() as usize).max(1);
    let [mut own, mut with, mut its] = [0.0; 3];
    for run in &log.runs {
        let (q, qd) = (of(run, Signal::Q, joint), of(run, Signal::Qd, joint));
        let mut integral = vec![0.0; q.len()];
        for k in 1..q.len() {
            let step = run.t[k] - run.t[k - 1];
            integral[k] = integral[k - 1] + 0.5 * step * (qd[k] + qd[k - 1]);
        }
        for k in lag..q.len() {
            let (moved, summed) = (q[k] - q[k - lag], integral[k] - integral[k - lag]);
            own += moved * moved;
            with += moved * summed;
            its += summed * summed;
        }
    }
    (with * with > RATE_GOES * own * its).then(|| with / own)
}

/// Rates that are none of their joints', or in another unit; of joints that move.
fn rates(arm: &Arm, log: &Log, moves: &dyn Fn(usize) -> bool) -> Vec<Misread> {
    if !log.has(Signal::Qd) {
        return Vec::new();
    }
    let ratios: Vec<(usize, Option<f64>)> =
        (0..arm.dof()).filter(|j| moves(*j)).map(|j| (j, ratio(log, j))).collect();
    let is =
        |ratio: Option<f64>, of: f64| ratio.is_some_and(|r| (r / of - 1.0).abs() < SAME_FACTOR);
    let turns = |j: usize| arm.joints[j].motion == Motion::Revolute;
    let degrees = 180.0 / PI;
    // All stamps a thousand times too large make a rate's integral so.
    for factor in [1e3, 1e-3] {
        if !ratios.is_empty() && ratios.iter().all(|(_, r)| is(*r, factor)) {
            return vec![Misread::Time { factor: 1.0 / factor }];
        }
    }
    for factor in [degrees, 1.0 / degrees, -1.0] {
        let fits = |(j, r): &(usize, Option<f64>)| is(*r, if turns(*j) { factor } else { 1.0 });
        if ratios.iter().any(|(j, _)| turns(*j))
            && ratios.iter().all(fits)
            && (0..arm.dof()).all(turns)
        {
            return vec![Misread::Rates { factor: 1.0 / factor }];
        }
    }
    let wrong = ratios.into_iter().filter(|(_, r)| !is(*r, 1.0));
    wrong.map(|(joint, ratio)| Misread::NoRate { joint, ratio }).collect()
}

/// Whether a joint goes where its command would send it with the other sign, at whatever delay of a servo.
fn is_against(log: &Log, joint: usize) -> bool {
    if !log.has(Signal::QCmd) {
        return false;
    }
    let step = ((FOLLOWS[1] / log.period()).round() as usize).max(1);
    let most = (FOLLOWS[0] / log.period()).round() as usize;
    let every = log.samples.div_ceil(SOME_SAMPLES).max(1);
    // Mean square of the joint less its command, times 1 or −1, from which a mean is taken in each run.
    let left = |sign: f64, lag: usize| -> f64 {
        let of_run = |run: &Run| {
            let (q, command) = (of(run, Signal::Q, joint), of(run, Signal::QCmd, joint));
            let pairs = q.iter().skip(lag).zip(command).step_by(every);
            let off: Vec<f64> = pairs.map(|(q, command)| q - sign * command).collect();
            let mean = off.iter().sum::<f64>() / off.len().max(1) as f64;
            off.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / off.len().max(1) as f64
        };
        log.runs.iter().map(of_run).sum()
    };
    let least = |sign: f64| {
        (0..=most).step_by(step).map(|lag| left(sign, lag)).fold(f64::INFINITY, f64::min)
    };
    least(-1.0) < MISTAKE_LEAVES * MISTAKE_LEAVES * least(1.0)
}

/// A channel that stands at its ends: both of them, or one.
fn clipped(log: &Log, signal: Signal, joint: usize) -> Option<Misread> {
    let all: Vec<f64> = each(log, signal, joint).collect();
    let low = all.iter().copied().fold(f64::INFINITY, f64::min);
    let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (span, round) = (LIMITED * (high - low), 1e-9 * low.abs().max(high.abs()));
    let within = |from: f64, to: f64| all.iter().filter(|x| **x >= from && **x <= to).count();
    let is_limit = |there: usize, near: usize| {
        there as f64 > LIMITED * all.len() as f64 && there > LIMIT_TIMES * (near - there)
    };
    let at = [within(low, low + round), within(high - round, high)];
    let near = [within(low, low + span), within(high - span, high)];
    let limits = [0, 1].map(|end| is_limit(at[end], near[end]));
    let samples = [0, 1].map(|end| if limits[end] { at[end] } else { 0 }).iter().sum();
    (samples > 0).then(|| Misread::Clipped {
        signal,
        joint,
        samples,
        limits: [
            if limits[0] { low + round } else { f64::NEG_INFINITY },
            if limits[1] { high - round } else { f64::INFINITY },
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_taken_out_of_steps() {
        let mut rows: Vec<f64> = (0..40).map(|k| 0.4 * f64::from(k)).collect();
        let straight = rows.clone();
        rows.iter_mut().for_each(|q| *q = (*q + PI).rem_euclid(TAU) - PI);
        assert!(rows.windows(2).any(|pair| pair[1] < pair[0]));
        unwrap(&mut rows);
        let off = rows.iter().zip(&straight).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{off}");
        assert_eq!((turns(3.0), turns(-6.2), turns(12.7)), (0.0, -1.0, 2.0));
    }
}
