//! A torque-driven arm under its controller: computed torque with the robot file's numbers.
//!
//! Every step the controller reads the encoders, which are coarse, differentiates them through a filter
//! of its own, and asks the drives for the torque of `q̈_ref + 2ω ė + ω² e`. The arm answers with its own
//! inertias and friction, so that noise, error and torque hang together as in a real log.

use core::f64::consts::TAU;

use super::machine::{Machine, Moving};
use crate::course::{Course, State};

/// Of the closed loop, rad/s; critically damped.
const LOOP: f64 = TAU * 5.0;

/// Time over which the controller smoothes its rates, s.
const SMOOTHED: f64 = 0.003;

/// A joint that is off by more has been lost, rad or m.
const LOST: f64 = 1.0;

/// What happened, step by step, of each joint.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    pub(super) step: f64,
    /// What the encoders stand at, before they are read.
    pub(super) q: Vec<Vec<f64>>,
    /// What the motors were asked for.
    pub(super) drive: Vec<Vec<f64>>,
    /// What the links asked.
    pub(super) links: Vec<Vec<f64>>,
    /// Where the joints were to be.
    pub(super) sent: Vec<Vec<f64>>,
}

impl Track {
    pub(super) fn new(joints: usize, step: f64) -> Track {
        let none = || vec![Vec::new(); joints];
        Track { step, q: none(), drive: none(), links: none(), sent: none() }
    }

    pub(super) fn push(to: &mut [Vec<f64>], values: impl IntoIterator<Item = f64>) {
        to.iter_mut().zip(values).for_each(|(to, x)| to.push(x));
    }
}

/// What drives give that are asked for torques; at which step.
pub(super) type Gives<'a> = dyn Fn(usize, &[f64]) -> Vec<f64> + 'a;

/// Follows a course with the controller that knows `nominal`; encoders step by `encoder`.
pub(super) fn controlled(
    real: &Machine,
    nominal: &Machine,
    course: &dyn Course,
    encoder: f64,
    step: f64,
    gives: &Gives<'_>,
) -> Result<Track, String> {
    let start = course.at(0.0);
    let n = start.q.len();
    let mut track = Track::new(n, step);
    let mut now = real.at(&turned(real, &start.q), &start.qd);
    let read = |now: &Moving| -> Vec<f64> {
        encoders(real, now)
            .map(|q| if encoder > 0.0 { (q / encoder).round() * encoder } else { q })
            .collect()
    };
    let (mut before, mut rates) = (read(&now), start.qd.clone());
    let steps = (course.duration() / step).ceil() as usize;
    for k in 0..=steps {
        let wanted = course.at(k as f64 * step);
        let seen = read(&now);
        for ((rate, seen), before) in rates.iter_mut().zip(&seen).zip(&before) {
            *rate += step / (SMOOTHED + step) * ((seen - before) / step - *rate);
        }
        let torques = asked(nominal, &wanted, &seen, &rates);
        let held = |j: usize| (wanted.q[j] - seen[j]).abs() < LOST;
        let lost = !(0..n).all(held);
        let qdd = real.driven(&mut now, &gives(k, &torques)).filter(|_| !lost);
        let Some(qdd) = qdd else {
            return Err(format!(
                "the controller loses the arm at {:.2} s: make the effects smaller, or move more slowly",
                k as f64 * step
            ));
        };
        Track::push(&mut track.q, encoders(real, &now));
        Track::push(&mut track.links, now.loads.iter().copied());
        Track::push(&mut track.sent, wanted.q);
        Track::push(&mut track.drive, torques);
        before = seen;
        real.step(&mut now, &qdd);
    }
    Ok(track)
}

/// The same where the encoders read exactly what they are to: what the drives give then.
pub(super) fn followed(real: &Machine, course: &dyn Course, step: f64) -> Track {
    let steps = (course.duration() / step).ceil() as usize;
    let wanted: Vec<State> = (0..=steps).map(|k| course.at(k as f64 * step)).collect();
    let links = links_behind(real, &wanted, step);
    let mut track = Track::new(wanted[0].q.len(), step);
    let mut now = real.at(&links[0].q, &links[0].qd);
    for (State { q, qd, qdd }, wanted) in links.into_iter().zip(wanted) {
        (now.q, now.qd) = (q, qd);
        let torques = real.needed(&mut now, &qdd);
        Track::push(&mut track.q, wanted.q.iter().copied());
        Track::push(&mut track.links, now.loads.iter().copied());
        Track::push(&mut track.sent, wanted.q);
        Track::push(&mut track.drive, torques);
        real.bend(&mut now, step);
    }
    track
}

/// Where the links are: behind the motors by what the drives give way, to first order.
fn links_behind(real: &Machine, wanted: &[State], step: f64) -> Vec<State> {
    let mut links = wanted.to_vec();
    links.iter_mut().for_each(|link| link.q = turned(real, &link.q));
    if real.drives.iter().all(|drive| drive.compliance == 0.0) {
        return links;
    }
    let bends = |s: &State| -> Vec<f64> {
        let loads = real.links(&turned(real, &s.q), &s.qd, &s.qdd);
        real.drives.iter().zip(loads).map(|(drive, load)| drive.compliance * load).collect()
    };
    let bent: Vec<Vec<f64>> = wanted.iter().map(bends).collect();
    for (k, link) in links.iter_mut().enumerate() {
        let around = [k.saturating_sub(1), k, (k + 1).min(bent.len() - 1)];
        let bends = |joint: usize| around.map(|k| bent[k][joint]);
        for joint in 0..link.q.len() {
            let [before, at, after] = bends(joint);
            link.q[joint] -= at;
            link.qd[joint] -= (after - before) / (2.0 * step);
            link.qdd[joint] -= (after - 2.0 * at + before) / (step * step);
        }
    }
    links
}

/// Where the joints are whose encoders are to read so.
fn turned(real: &Machine, read: &[f64]) -> Vec<f64> {
    real.drives.iter().zip(read).map(|(drive, q)| q + drive.zero).collect()
}

/// Encoders sit at the motors: behind the link by what the drive gives way.
fn encoders<'m>(real: &'m Machine, now: &'m Moving) -> impl Iterator<Item = f64> + 'm {
    let drives = real.drives.iter().zip(&now.loads).zip(&now.q);
    drives.map(|((drive, load), q)| q + drive.compliance * load - drive.zero)
}

/// What the controller asks of the drives.
fn asked(nominal: &Machine, wanted: &State, seen: &[f64], rates: &[f64]) -> Vec<f64> {
    let corrected = (0..seen.len()).map(|j| {
        let (error, slip) = (wanted.q[j] - seen[j], wanted.qd[j] - rates[j]);
        wanted.qdd[j] + 2.0 * LOOP * slip + LOOP * LOOP * error
    });
    let corrected: Vec<f64> = corrected.collect();
    let mut there = nominal.at(&wanted.q, &wanted.qd);
    nominal.needed(&mut there, &corrected)
}
