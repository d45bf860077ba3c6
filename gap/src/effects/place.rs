//! Where an effect acts, and in which form.

pub use stiffarm_codegen::robot::beyond::Place;

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

    /// Row of the table, from 0.
    pub fn row(self) -> usize {
        self.place.row()
    }
}
