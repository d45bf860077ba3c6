//! Amounts of mistakes that are fitted too: an entry of the table, or how a joint goes with a reading.

use nalgebra::{Isometry3, Point3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::step::{rotated, stacked};
use super::{Fit, Row};
use crate::mistakes::kind::{Entry, Mistake};

/// Half of a central difference, rad or m: its error is of the square, its rounding of 1e-10.
const STEP: f64 = 1e-6;

/// Whose amount is fitted.
pub(super) enum Open {
    /// An entry, and what it is where the amount is zero.
    Entry(usize, Entry, f64),
    /// A joint, and the one whose reading it goes with.
    Reading(usize, usize),
}

impl Open {
    /// Those of some mistakes, in their order.
    pub(super) fn all(mistakes: &[Mistake], arm: &mut Arm) -> Vec<Open> {
        let open = mistakes.iter().filter_map(|mistake| match *mistake {
            Mistake::Off { row, entry, .. } => {
                Some(Open::Entry(row, entry, *entry.of(&mut arm.joints[row])))
            }
            Mistake::Geared { joint, of, .. } => Some(Open::Reading(joint, of)),
            _ => None,
        });
        open.collect()
    }
}

impl Fit {
    /// Puts the amounts of entries into the arm.
    pub(super) fn put_amounts(&mut self) {
        for (open, amount) in self.open.iter().zip(&self.at.amounts) {
            if let Open::Entry(row, entry, from) = open {
                *entry.of(&mut self.arm.joints[*row]) = from + amount;
            }
        }
    }

    /// Adds to the joints' values in a row what the amounts of readings do.
    pub(super) fn add_readings(&self, row: &Row, q: &mut [f64]) {
        for (open, amount) in self.open.iter().zip(&self.at.amounts) {
            if let Open::Reading(joint, of) = open {
                q[*joint] += amount * row.q[*of];
            }
        }
    }

    /// The arm with each open entry a little less and a little more.
    pub(super) fn steps_of_entries(&self) -> Vec<Option<[Arm; 2]>> {
        let moved = |open: &Open| {
            let Open::Entry(row, entry, _) = open else { return None };
            Some([-STEP, STEP].map(|by| {
                let mut arm = self.arm.clone();
                *entry.of(&mut arm.joints[*row]) += by;
                arm
            }))
        };
        self.open.iter().map(moved).collect()
    }

    /// What a unit of each amount does to a row's point and rotation, measuring frame; `turns` are the joints' own
    /// columns.
    pub(super) fn by_amounts<'f>(
        &'f self,
        row: &'f Row,
        q: &'f [f64],
        steps: &'f [Option<[Arm; 2]>],
        turns: &'f [Vector6<f64>],
    ) -> impl Iterator<Item = Vector6<f64>> + 'f {
        let base: &Isometry3<f64> = &self.at.bases[row.session];
        let point = Point3::from(self.at.points[row.point]);
        self.open.iter().zip(steps).map(move |(open, steps)| match (open, steps) {
            (Open::Reading(joint, of), _) => turns[*joint] * row.q[*of],
            (_, Some(steps)) => {
                let [less, more] = steps.each_ref().map(|arm| arm.pose(q));
                let shift = (more * point - less * point) / (2.0 * STEP);
                let turn = (more.rotation * less.rotation.inverse()).scaled_axis() / (2.0 * STEP);
                rotated(&base.rotation, &stacked(shift, turn))
            }
            _ => Vector6::zeros(),
        })
    }
}
