//! What most effects move: a joint, or a frame.

use nalgebra::{Matrix6xX, Vector6};

use crate::simulate::{Site, State};

/// A part of the arm whose motion is all that an effect does to first order. Many effects share
/// one: what its twist has to do with anything else is worked out once for all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Carrier {
    /// A joint along its own axis; rows count from 0.
    Joint(usize),
    /// The measuring frame against the base.
    Base,
    /// The tool frame.
    Tool,
}

impl Carrier {
    /// Number of its columns: one of a joint, six of a frame.
    pub fn size(self) -> usize {
        match self {
            Carrier::Joint(_) => 1,
            Carrier::Base | Carrier::Tool => 6,
        }
    }

    /// Twists of the tool per unit of its motion, 6×size, base axes, at the tool origin.
    pub fn twists(self, state: &State) -> Matrix6xX<f64> {
        match self {
            Carrier::Joint(row) => Matrix6xX::from_columns(&[state.twist_of_joint(row)]),
            Carrier::Base => state.base_moved(),
            Carrier::Tool => {
                let column = |k: usize| state.carry(Site::Tool, &Vector6::ith(k, 1.0));
                Matrix6xX::from_columns(&[0, 1, 2, 3, 4, 5].map(column))
            }
        }
    }
}
