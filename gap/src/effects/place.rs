//! Where an effect acts, and in which form.

use core::fmt;

pub use stiffarm_table::robot::beyond::Place;

use super::At;

/// A place and a form of the effect there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Spot {
    /// Where.
    pub place: Place,
    /// Which form; 0 where there is one only.
    pub form: usize,
}

impl Spot {
    /// The first form at a place.
    pub fn at(place: Place) -> Self {
        Self { place, form: 0 }
    }

    /// A joint; rows count from 0.
    pub fn of_joint(row: usize) -> Self {
        Spot::at(Place::Joint(row + 1))
    }

    /// Row of the table, from 0.
    pub fn row(self) -> usize {
        self.place.row()
    }

    /// The joint that it is at, from 0, if it is at one.
    pub fn joint(self) -> Option<usize> {
        matches!(self.place, Place::Joint(_)).then(|| self.row())
    }

    /// The joints of a pair, from 0.
    pub fn pair(self) -> Option<[usize; 2]> {
        let Place::Pair(a, b, _) = self.place else { return None };
        Some([a - 1, b - 1])
    }

    /// Whether both act on one joint, or one of them on none in particular.
    pub fn meets(self, other: Spot) -> bool {
        let joints = |spot: Spot| spot.joint().map(|joint| [joint; 2]).or_else(|| spot.pair());
        match (joints(self), joints(other)) {
            (Some(mine), Some(theirs)) => mine.iter().any(|joint| theirs.contains(joint)),
            _ => true,
        }
    }

    /// Every place that an arm of so many joints has in motion.
    pub fn all(joints: usize) -> Vec<Spot> {
        let kinds = [At::Joints, At::Links, At::Pairs, At::Base, At::Arm, At::Interface];
        kinds.into_iter().flat_map(|at| at.among(joints)).map(Spot::at).collect()
    }
}

/// As logs tell it.
impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place {
            Place::Base => f.write_str("the base"),
            Place::Arm => f.write_str("every joint"),
            place => place.fmt(f),
        }
    }
}
