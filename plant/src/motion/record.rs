//! How a motion becomes a log: encoders and sensors that are coarse and noisy, a clock that jitters,
//! samples that are lost.

use super::control::Track;
use super::drive::Drive;
use crate::rng::{Rng, Stream};

/// N·m (N) at the joint per ampere, from, to: a gear of 50 to 160 on a motor of 0.1 to 0.12 N·m/A.
const PER_AMPERE: [f64; 2] = [5.0, 20.0];

/// How well a log is recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recording {
    /// Samples a second.
    pub rate: f64,
    /// Step of the encoders at the joints, rad or m.
    pub encoder: f64,
    /// Standard deviation of a reading beyond its step, rad or m.
    pub reading: f64,
    /// Standard deviation of the torque's noise, as a part of the torque's own.
    pub torque: f64,
    /// Its correlation time, s; 0 is white.
    pub colour: f64,
    /// Step of a torque, as a part of its largest.
    pub torque_step: f64,
    /// Standard deviation of a sample's instant, s. Stamps say when it was.
    pub jitter: f64,
    /// Part of the samples that are lost.
    pub lost: f64,
}

impl Default for Recording {
    /// A usual industrial arm.
    fn default() -> Recording {
        Recording {
            rate: 250.0,
            encoder: 1e-5,
            reading: 0.0,
            torque: 0.02,
            colour: 0.0,
            torque_step: 1.0 / 4096.0,
            jitter: 50e-6,
            lost: 1e-3,
        }
    }
}

/// Where a torque is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At the motor, told at the joint's side of the gear.
    Motor,
    /// Behind the gear.
    Link,
    /// The motors' currents; nobody says how many newton-metres an ampere is.
    Current,
    /// What the controller asked of the drives, which give it with an error of their own.
    Commanded,
}

/// One run as it is logged; of each joint its samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    /// Which run, from 1.
    pub run: usize,
    /// What the arm holds, if that is told.
    pub payload: Option<String>,
    /// s.
    pub t: Vec<f64>,
    /// rad or m.
    pub q: Vec<Vec<f64>>,
    /// Where they were to be.
    pub q_cmd: Vec<Vec<f64>>,
    /// N·m or N, or amperes; none of position logs.
    pub tau: Vec<Vec<f64>>,
    /// Of a log of currents the N·m or N of an ampere, of each joint.
    pub per_ampere: Vec<f64>,
}

impl Recording {
    /// Instants at which samples are taken, s.
    fn instants(&self, duration: f64, rng: &mut Rng) -> Vec<f64> {
        let mut instants = Vec::new();
        // A sample never overtakes the next.
        let most = 0.4 / self.rate;
        for k in 0..=(duration * self.rate) as usize {
            let late = (self.jitter * rng.normal()).clamp(-most, most);
            let at = (k as f64 / self.rate + late).clamp(0.0, duration);
            if rng.unit() >= self.lost {
                // Stamps are told in microseconds.
                instants.push((at * 1e6).round() / 1e6);
            }
        }
        instants.dedup();
        instants
    }

    /// The log of a track: torques of the motors or behind the gears, told `delay` late.
    pub(super) fn torques(
        &self,
        track: &Track,
        drives: &[Drive],
        side: Side,
        delay: f64,
        rng: &mut Rng,
    ) -> Recorded {
        let mut log = self.joints(track, rng);
        let given = if side == Side::Link { &track.links } else { &track.drive };
        for (drive, given) in drives.iter().zip(given) {
            let spread = spread(given);
            let largest = given.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let noise = self.noise(&log.t, self.torque * spread, rng);
            let told = log.t.iter().zip(noise).map(|(t, noise)| {
                let then = between(given, (t - delay) / track.step);
                // A controller knows what it asks; the noise is in what the drive makes of it.
                let told = if side == Side::Commanded { then } else { drive.told(then) + noise };
                quantised(told, self.torque_step * largest)
            });
            log.tau.push(told.collect());
        }
        log
    }

    /// What drives make of commands that are told: of each joint its noise, at the log's rate.
    pub(super) fn unruly(&self, given: &[Vec<f64>], duration: f64, rng: &mut Rng) -> Vec<Vec<f64>> {
        let times: Vec<f64> =
            (0..=(duration * self.rate) as usize).map(|k| k as f64 / self.rate).collect();
        given.iter().map(|given| self.noise(&times, self.torque * spread(given), rng)).collect()
    }

    /// The log of a track without what drives it.
    pub(super) fn joints(&self, track: &Track, rng: &mut Rng) -> Recorded {
        let steps = track.q.first().map_or(0, Vec::len);
        let t = self.instants(steps.saturating_sub(1) as f64 * track.step, rng);
        let at =
            |of: &Vec<f64>| -> Vec<f64> { t.iter().map(|t| between(of, t / track.step)).collect() };
        let q = track.q.iter().map(|q| {
            let read = at(q).into_iter();
            read.map(|q| quantised(q + self.reading * rng.normal(), self.encoder)).collect()
        });
        let q = q.collect();
        let q_cmd = track.sent.iter().map(at).collect();
        Recorded { t, q, q_cmd, ..Recorded::default() }
    }

    /// White, or of one correlation time.
    fn noise(&self, t: &[f64], size: f64, rng: &mut Rng) -> Vec<f64> {
        let mut value = rng.normal();
        let mut before = t.first().copied().unwrap_or(0.0);
        let next = |t: &f64| {
            let kept = if self.colour > 0.0 { (-(t - before) / self.colour).exp() } else { 0.0 };
            before = *t;
            value = kept * value + (1.0 - kept * kept).sqrt() * rng.normal();
            size * value
        };
        t.iter().map(next).collect()
    }
}

impl Recorded {
    /// The same in amperes: motors of chance, the same in every run of a seed.
    pub(super) fn in_amperes(mut self, seed: u64) -> Recorded {
        let mut rng = Rng::new(seed, Stream::Arm);
        let [from, to] = PER_AMPERE;
        self.per_ampere = self.tau.iter().map(|_| rng.between(from, to)).collect();
        for (rows, per_ampere) in self.tau.iter_mut().zip(&self.per_ampere) {
            rows.iter_mut().for_each(|torque| *torque /= per_ampere);
        }
        self
    }
}

/// Standard deviation.
pub fn spread(values: &[f64]) -> f64 {
    let n = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / n;
    (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt()
}

fn quantised(value: f64, step: f64) -> f64 {
    if step > 0.0 { (value / step).round() * step } else { value }
}

/// Between steps, on a straight line; beyond the ends the last.
pub(super) fn between(values: &[f64], at: f64) -> f64 {
    let at = at.clamp(0.0, (values.len() - 1) as f64);
    let before = (at as usize).min(values.len().saturating_sub(2));
    let part = at - before as f64;
    values[before] + part * (values[(before + 1).min(values.len() - 1)] - values[before])
}
