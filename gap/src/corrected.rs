//! The robot file with what a diagnosis has found put into it.
//!
//! A robot file holds zeros, lengths, twists, springs, masses, beams and the tool; what else was
//! found is told and left out. Entries that nothing was found about stay as they are, exact
//! multiples of π too.

use stiffarm_codegen::robot::Robot;

use crate::diagnose::{Diagnosed, Nuisance};
pub use crate::effects::Fate;
use crate::effects::{ParameterReport, RobotFile};

/// A robot with what was found in it, and what became of each number.
#[derive(Clone, Debug, PartialEq)]
pub struct Corrected {
    /// The robot; the one that was diagnosed where nothing could be put in.
    pub robot: Robot,
    /// What became of the numbers of each finding, in their order.
    pub outcomes: Vec<Outcome>,
    /// Whether the tool was fitted along, and stands in the robot where it was fitted.
    pub tool_was_fitted: bool,
}

/// What became of one number that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Identifier of the effect.
    pub effect: &'static str,
    /// Where it acts.
    pub place: String,
    /// The number and its interval.
    pub parameter: ParameterReport,
    /// Where it is now.
    pub fate: Fate,
}

/// The robot that `diagnosed` was made of, with what was found put into it.
///
/// A tool that was fitted along (as a nuisance) is put in too.
pub fn corrected(robot: &Robot, diagnosed: &Diagnosed) -> Corrected {
    let (diagnosis, explanation) = (&diagnosed.diagnosis, &diagnosed.explanation);
    let mut file = RobotFile::new(robot, explanation.arm());
    let tool = Nuisance::ToolFrame.identifier();
    let tool_was_fitted = diagnosis.nuisances.iter().any(|n| n.name == tool);
    if tool_was_fitted {
        file.fit_tool();
    }
    let mut outcomes = Vec::new();
    for finding in &diagnosis.findings {
        let effect = explanation.catalogue().named(finding.effect);
        let fates = match (effect, finding.place.parse()) {
            (Some(effect), Ok(place)) => effect.write(&mut file, place, &finding.parameters),
            _ => file.no_entry(&finding.parameters),
        };
        let each = finding.parameters.iter().zip(fates).map(|(parameter, fate)| Outcome {
            effect: finding.effect,
            place: finding.place.clone(),
            parameter: parameter.clone(),
            fate,
        });
        outcomes.extend(each);
    }
    Corrected { robot: file.finish(), outcomes, tool_was_fitted }
}

#[cfg(test)]
mod tests;
