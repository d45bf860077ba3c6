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

    /// The joint values that the readings `q` mean, n, rad (m if prismatic): for what is worked out
    /// from the table alone, at the joint values that are real.
    ///
    /// # Errors
    /// An effect that does more than move joints, or that is undecided.
    pub fn joints(&self, q: &[f64]) -> Result<Vec<f64>, &'a Known> {
        if let Some(known) = self.undecided() {
            return Err(known);
        }
        // A load shows what scales it.
        let load = Vector6::repeat(1.0);
        let (row, now) = self.situation(q, &load);
        let plain = Actual::new(self.arm, q, &load);
        let mut joints = q.to_vec();
        for known in self.known {
            let mut actual = Actual::new(self.arm, q, &load);
            known.alter(&mut actual, &row, &now);
            if !actual.is_but_for_joints(&plain) {
                return Err(known);
            }
            let moved = actual.joints.iter().zip(q).map(|(is, reads)| is - reads);
            joints.iter_mut().zip(moved).for_each(|(sum, by)| *sum += by);
        }
        Ok(joints)
    }

    /// The arm at rest at the readings `q` (n, rad; m if prismatic) under `wrench` (base axes, tool
    /// origin, N and N·m) and its weights.
    ///
    /// # Errors
    /// [`Unstable`] if no stable equilibrium is found near `q`.
    pub fn at(&self, q: &[f64], wrench: &Vector6<f64>) -> Result<State, Unstable> {
        let mut actual = Actual::new(self.arm, q, wrench);
        if !self.known.is_empty() {
            let (row, now) = self.situation(q, wrench);
            self.known.iter().for_each(|known| known.alter(&mut actual, &row, &now));
        }
        rest(&actual, None)
    }

    fn situation(&self, q: &[f64], wrench: &Vector6<f64>) -> (Row, Moment) {
        let row = self.row.cloned().unwrap_or_else(|| Row::blank(0, q.len()));
        let (last_move, warming) = (vec![0.0; q.len()], self.warming);
        let now = Moment { index: 0, last_move, warming, clock: 0.0 };
        (Row { q: q.to_vec(), wrench: *wrench, ..row }, now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Catalogue, Spot};
    use crate::fixture::springy;

    fn known(id: &str, place: &str, form: usize, values: &[f64]) -> Known {
        let effect = Catalogue::default().named(id).unwrap();
        let spot = Spot { place: place.parse().unwrap(), form };
        Known { effect, spot, values: values.to_vec(), session: None, at: Default::default() }
    }

    #[test]
    fn what_moves_joints_alone_is_other_joint_values() {
        let arm = springy();
        let laws = [
            known("joint_ratio", "joint 1", 0, &[1e-2]),
            known("joint_coupling", "joint 2", 0, &[1e-3]),
            known("transmission_error", "joint 2", 2, &[2e-4, -1e-4]),
        ];
        let whole = Whole { known: &laws, ..Whole::from(&arm) };
        let q: [f64; 3] = [0.5, -0.7, 0.2];
        let joints = whole.joints(&q).unwrap();
        let wave = 2e-4 * (2.0 * q[1]).cos() - 1e-4 * (2.0 * q[1]).sin();
        let expected = [q[0] * 1.01, q[1] + 1e-3 * q[0] + wave, q[2]];
        for (is, expected) in joints.iter().zip(expected) {
            assert!((is - expected).abs() < 1e-15, "{is} {expected}");
        }
        // The arm at rest agrees: the table there, and the effects here.
        let w = Vector6::new(30.0, -20.0, -100.0, 1.0, 2.0, 3.0);
        let (is, moved) = (whole.at(&q, &w).unwrap(), Whole::from(&arm).at(&joints, &w).unwrap());
        assert!((is.tool.to_homogeneous() - moved.tool.to_homogeneous()).amax() < 1e-14);
    }

    #[test]
    fn what_does_more_or_is_undecided_is_named() {
        let arm = springy();
        for (id, place, values) in [
            ("joint_hardening", "joint 1", &[1e-12][..]),
            ("base_compliance", "base", &[1e-6, 1e-6, 1e-7]),
            ("instrument_scale", "instrument", &[1e-4]),
            ("wrench_scale", "tool", &[0.1]),
            ("backlash", "joint 2", &[1e-3]),
            ("settling_lag", "joint 2", &[1e-3]),
        ] {
            let ratio = known("joint_ratio", "joint 1", 0, &[1e-2]);
            let both = [ratio, known(id, place, 0, values)];
            let whole = Whole { known: &both, ..Whole::from(&arm) };
            assert_eq!(whole.joints(&[0.1, 0.2, 0.3]).unwrap_err().effect.identifier(), id);
        }
    }
}
