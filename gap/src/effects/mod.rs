//! The catalogue: what reality does that the sim does not. A new effect is one file that implements
//! [`Effect`], and one line in [`CATALOGUE`].

mod joint_compliance;

use std::fmt;

use nalgebra::Matrix6xX;
use stiffarm_kernels::generic::Arm;

use crate::measurement::Row;
use crate::simulate::State;

pub use joint_compliance::JointCompliance;

/// Where an effect acts; numbers count from 1 at the base, as they are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// A joint.
    Joint(usize),
    /// A link, that is a row of the table.
    Link(usize),
    /// The base.
    Base,
    /// The tool.
    Tool,
    /// The arm as a whole.
    Arm,
    /// The measuring instrument.
    Instrument,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Joint(i) => write!(f, "joint {i}"),
            Place::Link(i) => write!(f, "link {i}"),
            Place::Base => f.write_str("base"),
            Place::Tool => f.write_str("tool"),
            Place::Arm => f.write_str("arm"),
            Place::Instrument => f.write_str("instrument"),
        }
    }
}

/// One number of an effect at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// What it is.
    pub name: &'static str,
    /// In SI.
    pub unit: &'static str,
    /// The least value that is physical; −∞ if every one is.
    pub least: f64,
    /// Magnitude that makes the parameters of one effect comparable between places of other units:
    /// 1, or powers of the arm's reach.
    pub scale: f64,
}

/// An effect of reality at places of the arm.
///
/// [`Effect::apply`] is the exact model: the arm and the row as they are *with* the effect, to be
/// simulated like any other. [`Effect::block`] is its linearisation; the fit iterates between the
/// two.
pub trait Effect: Sync {
    /// The identifier that files and options use.
    fn identifier(&self) -> &'static str;

    /// Where on this arm it may act.
    fn places(&self, arm: &Arm) -> Vec<Place>;

    /// Its parameters at a place; all zero is no effect. `reach` is the arm's reach on the data, m.
    fn parameters(&self, arm: &Arm, place: Place, reach: f64) -> Vec<Parameter>;

    /// Puts the effect with these values into the arm, or into the row where it depends on
    /// the row's direction, temperature, load or time.
    fn apply(&self, arm: &mut Arm, row: &mut Row, place: Place, values: &[f64]);

    /// Twist of the tool, base axes, at the tool origin, per unit of each parameter, 6×p, at a
    /// state of the arm.
    fn block(&self, arm: &Arm, row: &Row, state: &State, place: Place) -> Matrix6xX<f64>;

    /// Why data shows nothing of it where its block is zero everywhere.
    fn idle(&self) -> &'static str;
}

/// Every effect of this version.
pub const CATALOGUE: [&dyn Effect; 1] = [&JointCompliance];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_unique() {
        let mut names: Vec<_> = CATALOGUE.iter().map(|e| e.identifier()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), CATALOGUE.len());
    }

    #[test]
    fn places_print_as_the_format_has_them() {
        assert_eq!(Place::Joint(2).to_string(), "joint 2");
        assert_eq!(Place::Link(3).to_string(), "link 3");
        assert_eq!(Place::Instrument.to_string(), "instrument");
    }
}
