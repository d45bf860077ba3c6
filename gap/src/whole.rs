//! An arm as its robot file describes it, at rest at a posture: the table, and the effects beyond it.

use std::ops::Deref;

use nalgebra::Vector6;
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use crate::effects::{Depends, Known};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, State, rest};

/// A table and the effects beyond it; a table alone is one without effects.
#[derive(Clone, Copy, Debug)]
pub struct Whole<'a> {
    /// The table.
    pub arm: &'a Arm,
    /// What the robot file says beyond it.
    pub known: &'a [Known],
    /// What is known of the situation beside posture and load: from where the joints come to rest, and
    /// how warm the arm is.
    pub row: Option<&'a Row>,
    /// Temperature minus that at which the arm is as its table says, K.
    pub warming: f64,
}

impl<'a> From<&'a Arm> for Whole<'a> {
    fn from(arm: &'a Arm) -> Self {
        Whole { arm, known: &[], row: None, warming: 0.0 }
    }
}

impl Deref for Whole<'_> {
    type Target = Arm;

    fn deref(&self) -> &Arm {
        self.arm
    }
}

impl<'a> Whole<'a> {
    /// The first effect that posture, load and row do not decide: one of a direction or a temperature that
    /// is not given, of the last move, or of a moment of one session.
    pub fn undecided(&self) -> Option<&'a Known> {
        let decided = |known: &&Known| match known.effect.depends() {
            Depends::Posture => true,
            Depends::Direction => self.row.is_some_and(|row| row.direction.is_some()),
            Depends::Temperature => self.row.is_some_and(|row| row.temperature.is_some()),
            Depends::LastMove | Depends::Session => false,
        };
        self.known.iter().find(|known| !decided(known))
    }

    /// The arm at rest at the readings `q` (n, rad; m if prismatic) under `wrench` (base axes, tool
    /// origin, N and N·m) and its weights.
    ///
    /// # Errors
    /// [`Unstable`] if no stable equilibrium is found near `q`.
    pub fn at(&self, q: &[f64], wrench: &Vector6<f64>) -> Result<State, Unstable> {
        let mut actual = Actual::new(self.arm, q, wrench);
        if !self.known.is_empty() {
            let row = self.row.cloned().unwrap_or_else(|| Row::blank(0, q.len()));
            let row = Row { q: q.to_vec(), wrench: *wrench, ..row };
            let (last_move, warming) = (vec![0.0; q.len()], self.warming);
            let now = Moment { index: 0, last_move, warming, clock: 0.0 };
            self.known.iter().for_each(|known| known.alter(&mut actual, &row, &now));
        }
        rest(&actual, None)
    }
}
