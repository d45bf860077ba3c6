//! The robot file with what a diagnosis has found put into it.
//!
//! Zeros, lengths, twists, springs, masses, beams, base, tool and markers go into the table's own
//! entries, what these cannot hold into `[[effect]]` tables: the file is the model that was fitted.
//! Entries that nothing was found about stay as they are, exact multiples of π too.

use stiffarm_table::robot::Robot;

use crate::diagnose::{Diagnosed, Nuisance, NuisanceReport};
use crate::effects::{Catalogue, Known, KnownError, RobotFile};
use crate::report::{Parameter, Word};
use crate::robot::{RobotError, arm};

/// A robot with what was found in it, and where each number is.
#[derive(Clone, Debug, PartialEq)]
pub struct Corrected {
    /// The robot.
    pub robot: Robot,
    /// Where the numbers of each finding are, in their order.
    pub outcomes: Vec<Outcome>,
}

/// Where one number that was found is now.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Identifier of the effect.
    pub effect: Word,
    /// Where it acts.
    pub place: String,
    /// The number and its interval.
    pub parameter: Parameter,
    /// The entries that hold it.
    pub entry: String,
}

/// The robot that `diagnosed` was made of, with what was found put into it: findings, frames and
/// markers that were fitted along. Springs that a log tells too are those of both.
pub fn corrected(robot: &Robot, diagnosed: &Diagnosed) -> Corrected {
    let Diagnosed { diagnosis, explanation, beside_log, .. } = diagnosed;
    let explanation = beside_log.as_ref().map_or(explanation, |both| &both.explanation);
    let mut file = RobotFile::new(robot, explanation.arm());
    for (name, place) in explanation.markers() {
        file.place_marker(name, place);
    }
    let is_fitted = |frame: Nuisance| {
        // A file has one base: of several the robot's stays.
        let is_one = |n: &NuisanceReport| n.name == frame.identifier() && n.session.is_none();
        diagnosis.nuisances.iter().any(is_one)
    };
    file.place_frames(Nuisance::ALL.map(is_fitted));
    if diagnosis.hangs_as_measured {
        file.place_gravity();
    }
    let mut known = explanation.known().to_vec();
    let found = explanation.found();
    let entries: Vec<String> = found.iter().map(|found| file.put(found, &mut known)).collect();
    let mut outcomes = Vec::new();
    for finding in &diagnosis.findings {
        let is_of = |found: &Known| {
            found.effect.identifier() == finding.effect
                && found.spot.place.to_string() == finding.place
        };
        let entry = found.iter().position(is_of).map(|k| entries[k].clone());
        let each = finding.parameters.iter().map(|parameter| Outcome {
            effect: finding.effect.clone(),
            place: finding.place.clone(),
            parameter: parameter.clone(),
            entry: entry.clone().unwrap_or_default(),
        });
        outcomes.extend(each);
    }
    Corrected { robot: file.finish(&known), outcomes }
}

/// Why a robot file's effects cannot be taken into its table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FoldError {
    /// The table has no numbers.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// Tables that say nothing.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Effects(Vec<KnownError>),
}

/// The same robot with every effect in the table's own entries that these can hold, and the effects
/// that are left.
///
/// # Errors
/// [`FoldError`]: the robot has symbols, or an effect that says nothing.
pub fn folded(robot: &Robot, catalogue: &Catalogue) -> Result<(Robot, Vec<Known>), FoldError> {
    let (mut robot, mut left) = (robot.clone(), Vec::new());
    let nominal = arm(&robot)?;
    let known = Known::all(&robot, &nominal, catalogue).map_err(FoldError::Effects)?;
    for one in known {
        let mut file = RobotFile::new(&robot, &nominal);
        let is_in = one.effect.write(&mut file, one.spot, &one.values).is_some();
        robot = file.exact();
        left.extend((!is_in).then_some(one));
    }
    robot.effects = left.iter().map(|known| known.table(&nominal)).collect();
    Ok((robot, left))
}

#[cfg(test)]
mod tests;
