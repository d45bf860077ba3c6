//! A plant that moves: the real arm with chosen effects, to be logged for a diagnosis that is not told.
//!
//! It shares with the diagnosis of logs the robot file's table, and names, places and numbers of the
//! effects; nothing else. Its links are a recursion of their own (`body`), friction is dry and
//! sticks (`drive`, `stick`), and a torque log comes of an arm that its controller drives with coarse encoders
//! (`control`): nobody differentiates, and nothing is linear in what is looked for. A position log is
//! that of servos (`servo`).

mod body;
mod control;
mod drive;
mod known;
mod laws;
pub mod links;
mod machine;
mod record;
mod servo;
mod stick;
mod text;
mod truth;

#[cfg(test)]
mod steps;

use nalgebra::Vector3;
use stiffarm_kernels::generic::Arm;

pub use known::known;
pub use laws::{LAWS, Law};
pub use record::spread;
pub use record::{Recorded, Recording, Side};
pub use text::csv;
pub use truth::MotionTruth;

use crate::course::Course;
use crate::effects::Place;
use crate::log::Domain;
use crate::rng::{Rng, Stream, seed_of};
use control::Track;
use machine::Machine;

/// Steps are no longer than this, s: what changes within one is told to the second order.
const STEP: f64 = 5e-4;

/// What a log tells beside the joints' values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Logged {
    /// Torques.
    Torque(Side),
    /// Commands alone: the arm is driven by position.
    Position,
}

impl Logged {
    /// The rows that such a log has.
    pub fn rows(self) -> Domain {
        match self {
            Logged::Torque(_) => Domain::Torque,
            Logged::Position => Domain::Position,
        }
    }
}

/// One motion, and what the arm holds in it.
pub struct Stage<'a> {
    /// Where it is sent.
    pub course: &'a dyn Course,
    /// A body that the log names: kg, and m in the tool frame.
    pub payload: Option<(String, f64, Vector3<f64>)>,
}

/// The arm cannot be moved like this.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{arm}: {fault}")]
pub struct MotionError {
    /// The arm's name.
    pub arm: String,
    /// What is wrong, and how to mend it.
    pub fault: String,
}

/// The real arm, to be moved and logged.
#[derive(Clone, Debug)]
pub struct MovingPlant<'a> {
    arm: &'a Arm,
    truths: Vec<MotionTruth>,
    logged: Logged,
    recording: Recording,
}

impl<'a> MovingPlant<'a> {
    /// The robot of the file with these truths, logged like this.
    pub fn new(
        arm: &'a Arm,
        truths: &[MotionTruth],
        logged: Logged,
        recording: Recording,
    ) -> MovingPlant<'a> {
        MovingPlant { arm, truths: truths.to_vec(), logged, recording }
    }

    /// Moves the arm through the stages, and logs each as a run.
    ///
    /// # Errors
    /// [`MotionError`]: joints that move no mass, or that the controller cannot hold.
    pub fn record(&self, stages: &[Stage<'_>], seed: u64) -> Result<Vec<Recorded>, MotionError> {
        let run = |(k, stage): (usize, &Stage<'_>)| {
            let mut rng = Rng::new(seed_of(seed, k), Stream::Noise);
            let mut log = self.run(k, stage, &mut rng)?;
            log.run = k + 1;
            log.payload = stage.payload.as_ref().map(|(name, ..)| name.clone());
            let current = self.logged == Logged::Torque(Side::Current);
            Ok(if current { log.in_amperes(seed) } else { log })
        };
        stages.iter().enumerate().map(run).collect()
    }

    /// The same as the text of a log.
    ///
    /// # Errors
    /// As [`MovingPlant::record`].
    pub fn text(&self, stages: &[Stage<'_>], seed: u64) -> Result<String, MotionError> {
        Ok(csv(self.arm, self.logged, &self.record(stages, seed)?, &[]))
    }

    fn run(&self, k: usize, stage: &Stage<'_>, rng: &mut Rng) -> Result<Recorded, MotionError> {
        let step = self.step();
        let (real, nominal) = (self.machine(&self.of_run(k), stage)?, self.machine(&[], stage)?);
        let Logged::Torque(side) = self.logged else {
            let track = servo::served(&real, &self.truths, stage.course, step);
            return Ok(self.recording.joints(&track, rng));
        };
        let noise = match side {
            Side::Commanded => {
                let exact = control::followed(&real, stage.course, step).drive;
                self.recording.unruly(&exact, stage.course.duration(), rng)
            }
            _ => Vec::new(),
        };
        // What is measured is what was asked for; what is only asked for, each drive makes of it what it does.
        let gives = |k: usize, asked: &[f64]| -> Vec<f64> {
            if noise.is_empty() {
                return asked.to_vec();
            }
            let at = (k as f64 * step * self.recording.rate) as usize;
            let drives = asked.iter().zip(&real.drives).zip(&noise);
            drives
                .map(|((asked, drive), noise)| drive.given(*asked) + noise[at.min(noise.len() - 1)])
                .collect()
        };
        let encoder = self.recording.encoder;
        let track = control::controlled(&real, &nominal, stage.course, encoder, step, &gives);
        let track = track.map_err(|fault| self.error(fault))?;
        Ok(self.recording.torques(&track, &real.drives, side, real.delay, rng))
    }

    /// What the drives of a run give, or where the joints are, if all is followed exactly and told
    /// without noise: rows at the log's rate, of each joint.
    ///
    /// # Errors
    /// [`MotionError`]: joints that move no mass.
    pub fn exact(&self, k: usize, stage: &Stage<'_>) -> Result<Vec<Vec<f64>>, MotionError> {
        let real = self.machine(&self.of_run(k), stage)?;
        // Commands say it often enough.
        let step = 1.0 / self.recording.rate;
        let track = match self.logged {
            Logged::Position => {
                return Ok(servo::served(&real, &self.truths, stage.course, step).q);
            }
            Logged::Torque(_) => control::followed(&real, stage.course, step),
        };
        let Track { drive, links, .. } = &track;
        let given = if self.logged == Logged::Torque(Side::Link) { links } else { drive };
        let late = real.delay / step;
        let told = |(drive, given): (&drive::Drive, &Vec<f64>)| -> Vec<f64> {
            let then = |k: usize| drive.told(record::between(given, k as f64 - late));
            (0..given.len()).map(then).collect()
        };
        Ok(real.drives.iter().zip(given).map(told).collect())
    }

    /// The truths, without what is held in other runs.
    fn of_run(&self, run: usize) -> Vec<MotionTruth> {
        let is_here = |truth: &&MotionTruth| match truth.spot.place {
            Place::Held(other) => other == run + 1,
            _ => true,
        };
        self.truths.iter().filter(is_here).cloned().collect()
    }

    fn machine(&self, truths: &[MotionTruth], stage: &Stage<'_>) -> Result<Machine, MotionError> {
        let machine = Machine::new(self.arm, truths, self.step()).map_err(|f| self.error(f))?;
        Ok(match &stage.payload {
            Some((_, mass, com)) => machine.holding(*mass, *com),
            None => machine,
        })
    }

    fn error(&self, fault: String) -> MotionError {
        MotionError { arm: self.arm.name.clone(), fault }
    }

    /// A whole part of the log's.
    fn step(&self) -> f64 {
        let period = 1.0 / self.recording.rate;
        period / (period / STEP).ceil()
    }
}
