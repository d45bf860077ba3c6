//! What kernels are made of besides the table: the `[[effect]]` tables of a robot file, understood.
//!
//! [`Robot::with_effects`] takes into the table's own entries what these hold (zeros, lengths, springs, frames,
//! masses) and keeps the rest as [`Beyond`]. An effect that no function of posture, load, side of
//! approach and warming can tell is refused where it stands, and so is one of the arm in motion.

mod fold;
mod motion;
mod place;
mod quantity;
mod read;

pub use place::Place;
pub use quantity::Quantity;

use super::model::{Robot, Spot};
use crate::number::Number;
use read::Found;

/// What an arm does beyond its table. Joints and rows count from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Beyond {
    /// What makes a joint's value another than its reading, in the order of the file.
    pub moves: Vec<Move>,
    /// What gives besides the table's springs and beams, in proportion to its load.
    pub springs: Vec<Spring>,
    /// A joint, and what it gives by the cube of its torque: rad/(N·m)³ (prismatic joint: m/N³).
    pub hardening: Vec<(usize, Number)>,
    /// A joint, and what friction winds it up by its torque's size, against its approach: rad/(N·m)
    /// (prismatic joint: m/N).
    pub windup: Vec<(usize, Number)>,
    /// What the wrench is larger by than it is told.
    pub wrench_scale: Number,
    /// Where the wrench's force acts, tool frame, m.
    pub load_point: [Number; 3],
}

/// Something that makes joint values others than the readings.
#[derive(Clone, Debug, PartialEq)]
pub enum Move {
    /// One joint is moved by a law.
    Joint(usize, Law),
    /// All lengths of rows and tool grow, and a prismatic joint's value with them; 1/K.
    Growth(Number),
}

/// By what a joint is off its reading, rad (prismatic joint: m).
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// In proportion to its own reading.
    Ratio(Number),
    /// In proportion to the reading of another joint.
    Coupling(usize, Number),
    /// `cos · cos(k q) + sin · sin(k q)` of its own reading; k, cos and sin.
    Wave(usize, [Number; 2]),
    /// Half of the dead band behind the approach.
    Backlash(Number),
    /// By the kelvin.
    Warming(Number),
}

/// Something that gives in proportion to its load, to first order.
#[derive(Clone, Debug, PartialEq)]
pub enum Spring {
    /// A joint tilts about the axes across its own, which do not turn with it: rad/(N·m) about x, y.
    Bearing(usize, [Number; 2]),
    /// The base turns about its axes, rad/(N·m), and gives along all of them, m/N.
    Base([Number; 4]),
    /// A row's chord bends in both planes and twists: 1/EI and 1/GJ, 1/(N·m²).
    Link(usize, [Number; 2]),
}

impl Beyond {
    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        *self == Beyond::default()
    }

    /// Leaves out what is of joints and rows from `row` on. What moves the others stays: readings are those of
    /// the whole arm.
    pub fn truncate(&mut self, row: usize) {
        self.moves.retain(|each| match each {
            Move::Joint(joint, Law::Coupling(other, _)) => joint.max(other) < &row,
            Move::Joint(joint, _) => *joint < row,
            Move::Growth(_) => true,
        });
        self.springs.retain(|spring| match spring {
            Spring::Bearing(at, _) | Spring::Link(at, _) => *at < row,
            Spring::Base(_) => true,
        });
        self.hardening.retain(|(joint, _)| *joint < row);
        self.windup.retain(|(joint, _)| *joint < row);
    }

    /// Whether it matters from which side a joint came.
    pub fn takes_sides(&self) -> bool {
        let backlash = |each: &Move| matches!(each, Move::Joint(_, Law::Backlash(_)));
        !self.windup.is_empty() || self.moves.iter().any(backlash)
    }

    /// Whether lengths are others than the table's.
    pub fn grows(&self) -> bool {
        self.moves.iter().any(|each| matches!(each, Move::Growth(_)))
    }

    /// Whether it matters how warm the arm is.
    pub fn takes_warming(&self) -> bool {
        let warms = |each: &Move| matches!(each, Move::Joint(_, Law::Warming(_)));
        self.grows() || self.moves.iter().any(warms)
    }
}

/// Effects that depend on the side from which a joint came.
#[cfg(feature = "macro")]
pub(crate) const SIDED: [&str; 2] = ["backlash", "friction_hysteresis"];

/// Effects that depend on how warm the arm is.
#[cfg(feature = "macro")]
pub(crate) const WARMED: [&str; 2] = ["joint_warming", "thermal_growth"];

/// An `[[effect]]` that says nothing, or that kernels cannot be made of.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectError {
    /// Where.
    pub at: Spot,
    /// What was found, and what is expected there.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
}

impl Robot {
    /// The robot with its `[[effect]]` tables understood: what the table's own entries hold is in them, the
    /// rest is [`Robot::beyond`], of which the tables that are left tell.
    ///
    /// # Errors
    /// The first mistake of each table, and each that kernels cannot be made of.
    pub fn with_effects(&self) -> Result<Robot, Vec<EffectError>> {
        let Some(first) = self.effects.first() else { return Ok(self.clone()) };
        if let Some(symbol) = self.symbols().first() {
            let message = format!(
                "an [[effect]] stands in a file whose table has no number for `{}`: it is of an arm as it is",
                symbol.name
            );
            let help = Some("write the numbers into a copy of the robot file".to_owned());
            return Err(vec![EffectError { at: first.at.clone(), message, help }]);
        }
        let read = self.effects.iter().map(|table| Found::read(table, self));
        let (found, wrong): (Vec<_>, Vec<_>) = read.partition(Result::is_ok);
        if !wrong.is_empty() {
            return Err(wrong.into_iter().filter_map(Result::err).collect());
        }
        let mut robot = Robot { effects: Vec::new(), beyond: Beyond::default(), ..self.clone() };
        for (found, table) in found.into_iter().flatten().zip(&self.effects) {
            if !robot.takes(&found) {
                robot.beyond.take(&found);
                robot.effects.push(table.clone());
            }
        }
        Ok(robot)
    }
}
