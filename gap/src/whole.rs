//! An arm as its robot file describes it, at rest at a posture: the table, and the effects beyond it.

mod textbook;

use nalgebra::{Isometry3, Vector6};
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
}

/// What is known of a posture beside the joint values.
#[derive(Clone, Debug, PartialEq)]
pub struct Situation {
    /// Wrench on the tool, base axes, at the tool origin, N and N·m.
    pub load: Vector6<f64>,
    /// From which side each joint comes to rest, n, each −1, 0 or 1.
    pub direction: Option<Vec<i8>>,
    /// How much warmer the arm is than when it is as its table says, K.
    pub warming: Option<f64>,
    /// The joint values that it comes from, n, rad (m if prismatic).
    pub before: Option<Vec<f64>>,
}

impl Situation {
    /// Under a load, all else unknown.
    pub fn under(load: Vector6<f64>) -> Situation {
        Situation { load, direction: None, warming: None, before: None }
    }
}

impl<'a> From<&'a Arm> for Whole<'a> {
    fn from(arm: &'a Arm) -> Self {
        Whole { arm, known: &[] }
    }
}

impl<'a> Whole<'a> {
    /// The first effect that depends on what a situation leaves open, and what that is.
    pub fn undecided(&self, at: &Situation) -> Option<(&'a Known, &'static str)> {
        let open = |known: &Known| match known.effect.depends() {
            Depends::Posture => None,
            Depends::Direction => {
                at.direction.is_none().then_some("from which side each joint comes to rest")
            }
            Depends::Temperature => at.warming.is_none().then_some("how warm the arm is"),
            Depends::LastMove => at.before.is_none().then_some("the posture before"),
            Depends::Session => Some("when in its session it happens, which no arm repeats"),
        };
        self.known.iter().find_map(|known| Some((known, open(known)?)))
    }

    /// The joint values that the readings `q` mean, n, rad (m if prismatic): for what is worked out
    /// from the table alone, at the joint values that are real.
    ///
    /// # Errors
    /// An effect that does more than move joints, or depends on more than the posture.
    pub fn joints(&self, q: &[f64]) -> Result<Vec<f64>, &'a Known> {
        // A load shows what scales it.
        let at = Situation::under(Vector6::repeat(1.0));
        if let Some((known, _)) = self.undecided(&at) {
            return Err(known);
        }
        let (row, now) = at.row(q);
        let plain = Actual::new(self.arm, q, &at.load);
        let mut joints = q.to_vec();
        for known in self.known {
            let mut actual = Actual::new(self.arm, q, &at.load);
            known.alter(&mut actual, &row, &now);
            if !actual.is_but_for_joints(&plain) {
                return Err(known);
            }
            let moved = actual.joints.iter().zip(q).map(|(is, reads)| is - reads);
            joints.iter_mut().zip(moved).for_each(|(sum, by)| *sum += by);
        }
        Ok(joints)
    }

    /// The arm at rest at the readings `q` (n, rad; m if prismatic) under the load and its weights,
    /// and where its base stands in the world.
    ///
    /// # Errors
    /// [`Unstable`] if no stable equilibrium is found near `q`.
    pub fn at(&self, q: &[f64], at: &Situation) -> Result<(State, Isometry3<f64>), Unstable> {
        let actual = self.actual(q, at);
        Ok((rest(&actual, None)?, actual.base))
    }

    /// The arm as the effects make it of the table.
    fn actual(&self, q: &[f64], at: &Situation) -> Actual<'a> {
        let mut actual = Actual::new(self.arm, q, &at.load);
        let (row, now) = at.row(q);
        self.known.iter().for_each(|known| known.alter(&mut actual, &row, &now));
        actual
    }
}

impl Situation {
    /// As a row of measurements at the readings `q`, and its moment.
    fn row(&self, q: &[f64]) -> (Row, Moment) {
        let direction = self.direction.clone();
        let row = Row { wrench: self.load, direction, ..Row::new(0, q.to_vec()) };
        let before = self.before.as_deref().unwrap_or(q);
        let last_move = q.iter().zip(before).map(|(now, then)| now - then).collect();
        (row, Moment::at_rest(last_move, self.warming.unwrap_or(0.0)))
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
        let under = Situation::under(w);
        let (is, _) = whole.at(&q, &under).unwrap();
        let (moved, _) = Whole::from(&arm).at(&joints, &under).unwrap();
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
