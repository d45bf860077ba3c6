//! Columns with a wrong sign or in another's place: what a simple model of the arm shows.
//!
//! Rigid links with free masses and friction that brakes are fitted to what the log says, and to what it would say with
//! one column turned round, or two exchanged. Gravity and inertia ask for torques of several joints by the same masses, and
//! friction never drives: a wrong column leaves most of its torque.

use std::borrow::Cow;

use super::Misread;
use super::plain::Plain;
use crate::constants::{BAD_TORQUE, MISTAKE_LEAVES, SAME_SIGNS};
use crate::effects::{Facts, InMotion, Law, Place, Spot};
use crate::infer::limits::SOME_SAMPLES;
use crate::log::Signal;
use crate::log::scene::{Column, Scene};
use crate::log::search::case::{Case, Wanted};
use crate::log::search::fit::Links;
use crate::signal::Signals;

/// Mistakes of one log that are looked for.
const MOST: usize = 3;

/// Delays, s, about which mistakes are asked for where without one nothing helps: those that the
/// [scan](crate::log::search::delay) has, so coarsely that a motion of 1 Hz is off by less than a sixth of its size.
const DELAYS: [f64; 12] = [-0.1, -0.05, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5];

/// Two joints' torques in each other's place; of one joint, its sign.
#[derive(Debug)]
struct Retold;

const FACTS: &Facts = &Facts { identifier: "retold", bends: true, ..Facts::TORQUE };

impl Law for Retold {
    fn facts(&self) -> &'static Facts {
        FACTS
    }
}

impl InMotion for Retold {
    fn columns(&self, _: &Scene<'_>, _: Spot, values: &[f64]) -> Vec<Column> {
        vec![Column::default(); values.len()]
    }

    /// What is told less what would be.
    fn value(&self, scene: &Scene<'_>, _: Spot, values: &[f64]) -> Column {
        let [a, b] = [values[0] as usize, values[1] as usize];
        let drive = &scene.signals.drive;
        let less = |one: usize, other: usize| -> Vec<f64> {
            let pairs = drive[one].iter().zip(&drive[other]);
            scene.signals.filtered(&pairs.map(|(x, y)| x - y).collect::<Vec<f64>>())
        };
        if a == b {
            let twice: Vec<f64> = drive[a].iter().map(|x| 2.0 * x).collect();
            return Column::of(a, scene.signals.filtered(&twice));
        }
        Column { parts: vec![(a, less(a, b)), (b, less(b, a))] }
    }
}

/// Mistakes of the columns; none if a simple model leaves little.
pub(super) fn found(case: &Case<'_>, drive: Signal) -> Vec<Misread> {
    let mut signals = Cow::Borrowed(case.signals);
    let mut all = Vec::new();
    while all.len() < MOST {
        let case = Case { signals: &signals, ..*case };
        let Some(misread) = one(&case, drive) else { break };
        turn(signals.to_mut(), &misread);
        all.push(misread);
    }
    all
}

fn one(case: &Case<'_>, drive: Signal) -> Option<Misread> {
    let counts = case.counts();
    let joints = (0..counts.len()).filter(|joint| counts[*joint].contains(&true)).collect();
    let asked = Asked { drive, joints };
    let spread = spreads(case, &asked.joints);
    let is_well = |left: &[f64]| asked.joints.iter().all(|j| left[*j] < BAD_TORQUE * spread[*j]);
    let is = asked.without(case, SOME_SAMPLES);
    if !is_well(&is)
        && let Some(found) = asked.best(&is, asked.tried(case))
    {
        return Some(found);
    }
    if let Some(found) = asked.zero(case, &is, &spread) {
        return Some(found);
    }
    if is_well(&is) {
        return None;
    }
    // Torques that are late besides hide what is wrong with their columns.
    let late = case.late + DELAYS.iter().fold(0.0_f64, |most, delay| most.max(delay.abs()));
    let moved = DELAYS.map(|delay| {
        let mut signals = case.signals.clone();
        signals.align(delay);
        signals
    });
    let cases: Vec<Case<'_>> =
        moved.iter().map(|signals| Case { signals, late, ..*case }).collect();
    let alone = cases.iter().map(|case| asked.without(case, SOME_SAMPLES));
    let is = alone.min_by(|a, b| asked.sum(a).total_cmp(&asked.sum(b)))?;
    if is_well(&is) {
        return None;
    }
    asked.best(&is, cases.iter().flat_map(|case| asked.tried(case)).collect())
}

/// A mistake, the joints whose rows it is in, and what is left of every joint without it.
type Tried = (Misread, Vec<usize>, Vec<f64>);

/// What is asked of a log.
pub(super) struct Asked {
    drive: Signal,
    /// Those that have rows.
    pub(super) joints: Vec<usize>,
}

impl Asked {
    /// What is left of every joint with the columns as they are told, of about so many fine samples.
    pub(super) fn without(&self, case: &Case<'_>, enough: usize) -> Vec<f64> {
        let plain = Plain::of(case, Vec::new(), enough);
        plain.left(&[], &plain.dict.left(&Links::Free, &[])).0
    }

    /// Every mistake by itself.
    fn tried(&self, case: &Case<'_>) -> Vec<Tried> {
        let Asked { drive, joints } = self;
        let pairs = joints.iter().flat_map(|a| joints.iter().map(move |b| [*a, *b]));
        let pairs: Vec<[usize; 2]> = pairs.filter(|[a, b]| a <= b).collect();
        let probes = pairs.iter().map(|pair| pair.map(|j| j as f64).to_vec()).collect();
        let wanted: Vec<Wanted> = vec![(&Retold, Spot::at(Place::Interface), probes)];
        let plain = Plain::of(case, wanted, SOME_SAMPLES);
        let dict = &plain.dict;
        let last = dict.offers.len() - 1;
        let column = |(entry, [a, b]): (usize, &[usize; 2])| {
            let (left, _) = plain.left(&[], &dict.left(&Links::Free, &[dict.term(last, entry)]));
            match a == b {
                true => (Misread::Sign { signal: *drive, joint: *a, or: None }, vec![*a], left),
                false => {
                    (Misread::Swapped { signal: *drive, joints: [*a, *b] }, vec![*a, *b], left)
                }
            }
        };
        let angle = |joint: &usize| {
            let misread = Misread::Sign { signal: Signal::Q, joint: *joint, or: None };
            let mut signals = case.signals.clone();
            turn(&mut signals, &misread);
            let left = self.without(&Case { signals: &signals, ..*case }, SOME_SAMPLES);
            (misread, vec![*joint], left)
        };
        pairs.iter().enumerate().map(column).chain(joints.iter().map(angle)).collect()
    }

    /// The mistake without which least is left, if that is so much less than `is` at its own joints. Of a joint's two signs
    /// that leave the same it is the torque's: its column is given a convention, where an encoder has an arrow.
    fn best(&self, is: &[f64], tried: Vec<Tried>) -> Option<Misread> {
        let sums: Vec<f64> = tried.iter().map(|(.., left)| self.sum(left)).collect();
        let best = (0..tried.len()).min_by(|a, b| sums[*a].total_cmp(&sums[*b]))?;
        let (misread, own, left) = &tried[best];
        let part = own.iter().map(|j| (left[*j] / is[*j]).ln()).sum::<f64>() / own.len() as f64;
        if part >= MISTAKE_LEAVES.ln() || sums[best] >= self.sum(is) {
            return None;
        }
        let Misread::Sign { signal, joint, .. } = *misread else { return Some(misread.clone()) };
        let is_other = |of: &Misread| match of {
            Misread::Sign { signal: s, joint: j, .. } => *j == joint && *s != signal,
            _ => false,
        };
        let other = (0..tried.len()).filter(|k| is_other(&tried[*k].0));
        let is_told = other.min_by(|a, b| sums[*a].total_cmp(&sums[*b]));
        match is_told.is_some_and(|k| sums[k] - sums[best] < SAME_SIGNS) {
            true => Some(Misread::Sign { signal: self.drive, joint, or: Some(Signal::Q) }),
            false => Some(misread.clone()),
        }
    }

    pub(super) fn sum(&self, left: &[f64]) -> f64 {
        self.joints.iter().map(|j| left[*j].ln()).sum()
    }
}

/// Standard deviation of what drives each joint, where its rows count.
fn spreads(case: &Case<'_>, joints: &[usize]) -> Vec<f64> {
    let counts = case.counts();
    let mut all = vec![1.0; counts.len()];
    for joint in joints {
        let rows = case.signals.filtered(&case.signals.drive[*joint]);
        let used = rows.iter().zip(&counts[*joint]).filter(|(_, counts)| **counts);
        let used: Vec<f64> = used.map(|(x, _)| *x).collect();
        let mean = used.iter().sum::<f64>() / used.len().max(1) as f64;
        let square =
            used.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / used.len().max(1) as f64;
        all[*joint] = square.sqrt().max(f64::MIN_POSITIVE);
    }
    all
}

/// The signals without the mistake.
pub(super) fn turn(signals: &mut Signals, misread: &Misread) {
    match misread {
        Misread::Sign { signal: Signal::Q, joint, .. } => {
            let Signals { q, qd, qdd, .. } = signals;
            for rows in [q, qd, qdd] {
                rows[*joint].iter_mut().for_each(|x| *x = -*x);
            }
            if let Some(ways) = signals.ways.get_mut(*joint) {
                ways.iter_mut().for_each(|way| *way = -*way);
            }
        }
        Misread::Zero { joint, by } => signals.q[*joint].iter_mut().for_each(|x| *x += by),
        Misread::Sign { joint, .. } => signals.drive[*joint].iter_mut().for_each(|x| *x = -*x),
        Misread::Swapped { joints: [a, b], .. } => signals.drive.swap(*a, *b),
        _ => {}
    }
}
