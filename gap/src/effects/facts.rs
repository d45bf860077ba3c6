//! What is known of an effect before there is any data: one declaration for each of its laws.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{Depends, Group, Parameter, Place};
use crate::log::scene::Domain;

/// What a law of an effect says of itself. Texts are sentences; names of other effects stand in backticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// The identifier that files, options and findings use.
    pub identifier: &'static str,
    /// The effect whose law it is, where findings call the law otherwise; else empty.
    pub law_of: &'static str,
    /// What reality does that the sim does not.
    pub reality: &'static str,
    /// How its error shows.
    pub signature: &'static str,
    /// What makes almost the same error, and when.
    pub confused_with: &'static str,
    /// Which measurement separates the two.
    pub separated_by: &'static str,
    /// The law, in the symbols of its parameters.
    pub formula: &'static str,
    /// Its parameters: their units, bounds and usual sizes, of a joint that turns. Empty where they depend on the
    /// arm or the form.
    pub parameters: &'static [Parameter],
    /// The rows of a log in which it is seen; `None` is an arm at rest.
    pub rows: Option<Domain>,
    /// Where it may act.
    pub at: At,
    /// What it moves, if to move one thing is all that it does.
    pub moves: Moves,
    /// Why data shows nothing of it where its linearisation is zero everywhere.
    pub idle: &'static str,
    /// With what it goes, for the parts of a gap; `None` if with none of them alone.
    pub group: Option<Group>,
    /// What must be known of a row, beyond readings and load, to predict and to compensate it.
    pub depends: Depends,
    /// Whether it is a matter of lengths and angles alone, the same at every load, moment and
    /// direction: what calibration would take up.
    pub is_geometry: bool,
    /// How many times less likely than others it is beforehand, where nothing is known of the arm.
    pub odds: usize,
    /// The effect that must stand at the same place before: what this one adds to.
    pub beside: Option<&'static str>,
    /// Whether its change of a log's rows is not in proportion to its parameters.
    pub bends: bool,
}

impl Facts {
    /// Nothing; what a law does not declare.
    pub const NONE: Facts = Facts {
        identifier: "",
        law_of: "",
        reality: "",
        signature: "",
        confused_with: "",
        separated_by: "",
        formula: "",
        parameters: &[],
        rows: None,
        at: At::Joints,
        moves: Moves::Several,
        idle: "",
        group: None,
        depends: Depends::Posture,
        is_geometry: false,
        odds: 1,
        beside: None,
        bends: false,
    };

    /// The same of a law of torque rows.
    pub const TORQUE: Facts = Facts { rows: Some(Domain::Torque), ..Facts::NONE };

    /// The same of a law of position rows.
    pub const POSITION: Facts = Facts { rows: Some(Domain::Position), ..Facts::NONE };

    /// The effect whose law it is.
    pub fn effect(&self) -> &'static str {
        if self.law_of.is_empty() { self.identifier } else { self.law_of }
    }
}

/// Where an effect may act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    /// Every joint.
    Joints,
    /// Joints that turn.
    Revolute,
    /// Neighbouring joints, whose motions add up or are subtracted.
    Pairs,
    /// Every joint, and all of them together.
    JointsAndArm,
    /// Every link.
    Links,
    /// What the arm stands on.
    Base,
    /// The tool.
    Tool,
    /// What the tool holds in one run of a log.
    Held,
    /// The arm as a whole.
    Arm,
    /// The measuring instrument.
    Instrument,
    /// Between the controller and the arm.
    Interface,
}

impl At {
    /// These places of an arm.
    pub fn places(self, arm: &Arm) -> Vec<Place> {
        let mut places = self.among(arm.dof());
        if self == At::Revolute {
            places.retain(|place| arm.joints[place.row()].motion == Motion::Revolute);
        }
        places
    }

    /// Those of an arm of so many joints, whatever they are.
    pub(super) fn among(self, joints: usize) -> Vec<Place> {
        let numbers = 1..=joints;
        match self {
            At::Joints | At::Revolute => numbers.map(Place::Joint).collect(),
            At::Pairs => {
                let both = |b: usize| [1, -1].map(|sum| Place::Pair(b - 1, b, sum));
                numbers.skip(1).flat_map(both).collect()
            }
            At::JointsAndArm => [Place::Arm].into_iter().chain(numbers.map(Place::Joint)).collect(),
            At::Links => numbers.map(Place::Link).collect(),
            At::Base => vec![Place::Base],
            At::Tool => vec![Place::Tool],
            At::Held => vec![Place::Held(1)],
            At::Arm => vec![Place::Arm],
            At::Instrument => vec![Place::Instrument],
            At::Interface => vec![Place::Interface],
        }
    }
}

/// What an effect moves, if that is one thing and all that it does is to move it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moves {
    /// Several, or what its own linearisation says.
    Several,
    /// The joint at its place, along its own axis.
    Joint,
    /// The base in the measuring frame.
    Base,
    /// The tool frame.
    Tool,
}

/// A law of an effect: how it acts on an arm at rest, or in motion.
pub trait Law: Sync {
    /// What is known of it.
    fn facts(&self) -> &Facts;

    /// The identifier that files and options use.
    fn identifier(&self) -> &'static str {
        self.facts().identifier
    }
}
