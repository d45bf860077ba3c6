//! Columns with a wrong sign or in another's place: what a simple model of the arm shows.
//!
//! Rigid links with free masses and friction that brakes are fitted to what the log says, and to what it would say with
//! one column turned round, or two exchanged. Gravity and inertia ask for torques of several joints by the same masses, and
//! friction never drives: a wrong column leaves most of its torque.

use super::{ENOUGH, Misread, Plain};
use crate::effects::{Facts, InMotion, Law, Place, Spot};
use crate::log::read::Signal;
use crate::log::scene::{Column, Scene};
use crate::log::search::case::{Case, Wanted};
use crate::log::search::fit::Links;
use crate::log::signal::Signals;

/// What a simple model leaves of a joint's torque, as a part of its spread, where nothing is asked: real arms leave
/// half of it at most (a Panda up to 60 Hz, without anything but Coulomb friction).
const BAD: f64 = 0.5;

/// A mistake leaves of its joints less than this part of what they leave with it.
const LEAVES: f64 = 0.5;

/// Mistakes of one log that are looked for.
const MOST: usize = 3;

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
    let mut signals = std::borrow::Cow::Borrowed(case.signals);
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
    let joints: Vec<usize> = case
        .counts()
        .iter()
        .enumerate()
        .filter(|(_, c)| c.contains(&true))
        .map(|(j, _)| j)
        .collect();
    let pairs = joints.iter().flat_map(|a| joints.iter().map(move |b| [*a, *b]));
    let pairs: Vec<[usize; 2]> = pairs.filter(|[a, b]| a <= b).collect();
    let probes = pairs.iter().map(|pair| pair.map(|j| j as f64).to_vec()).collect();
    let wanted: Vec<Wanted> = vec![(&Retold, Spot::at(Place::Interface), probes)];
    let plain = Plain::of(case, wanted, ENOUGH);
    let dict = &plain.dict;
    let (is, _) = plain.left(&[], &dict.left(&Links::Free, &[]));
    let spread = spreads(case, &joints);
    if joints.iter().all(|j| is[*j] < BAD * spread[*j]) {
        return None;
    }
    let last = dict.offers.len() - 1;
    let mut tried: Vec<(Misread, Vec<usize>, Vec<f64>)> = Vec::new();
    for (entry, [a, b]) in pairs.iter().enumerate() {
        let (left, _) = plain.left(&[], &dict.left(&Links::Free, &[dict.term(last, entry)]));
        tried.push(match a == b {
            true => (Misread::Sign { signal: drive, joint: *a }, vec![*a], left),
            false => (Misread::Swapped { signal: drive, joints: [*a, *b] }, vec![*a, *b], left),
        });
    }
    for joint in &joints {
        let misread = Misread::Sign { signal: Signal::Q, joint: *joint };
        let mut signals = case.signals.clone();
        turn(&mut signals, &misread);
        let turned = Case { signals: &signals, ..*case };
        let plain = Plain::of(&turned, Vec::new(), ENOUGH);
        let (left, _) = plain.left(&[], &plain.dict.left(&Links::Free, &[]));
        tried.push((misread, vec![*joint], left));
    }
    let gain = |left: &[f64]| -> f64 { joints.iter().map(|j| (is[*j] / left[*j]).ln()).sum() };
    let best = tried.into_iter().max_by(|a, b| gain(&a.2).total_cmp(&gain(&b.2)))?;
    let (misread, own, left) = best;
    let part: f64 = own.iter().map(|j| (left[*j] / is[*j]).ln()).sum::<f64>() / own.len() as f64;
    (part < LEAVES.ln() && gain(&left) > 0.0).then_some(misread)
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
fn turn(signals: &mut Signals, misread: &Misread) {
    match misread {
        Misread::Sign { signal: Signal::Q, joint } => {
            let Signals { q, qd, qdd, .. } = signals;
            for rows in [q, qd, qdd] {
                rows[*joint].iter_mut().for_each(|x| *x = -*x);
            }
            if let Some(ways) = signals.ways.get_mut(*joint) {
                ways.iter_mut().for_each(|way| *way = -*way);
            }
        }
        Misread::Sign { joint, .. } => signals.drive[*joint].iter_mut().for_each(|x| *x = -*x),
        Misread::Swapped { joints: [a, b], .. } => signals.drive.swap(*a, *b),
        _ => {}
    }
}
