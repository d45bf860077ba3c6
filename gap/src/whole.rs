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
    use stiffarm_kernels::Output;

    use super::*;
    use crate::fixture::{known, springy};

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
        let wave = 2e-4 * (2.0 * q[1]).cos() - 1e-4 * (2.0 * q[1]).sin();
        let joints = [q[0] * 1.01, q[1] + 1e-3 * q[0] + wave, q[2]];
        let under = Situation::under(Vector6::new(30.0, -20.0, -100.0, 1.0, 2.0, 3.0));
        let (is, _) = whole.at(&q, &under).unwrap();
        let (moved, _) = Whole::from(&arm).at(&joints, &under).unwrap();
        assert!((is.tool.to_homogeneous() - moved.tool.to_homogeneous()).amax() < 1e-14);
        for output in [Output::Jacobian, Output::Deflection, Output::ComplianceRegressor] {
            let is = whole.evaluate(output, &q, &under).unwrap().unwrap();
            let moved = Whole::from(&arm).evaluate(output, &joints, &under).unwrap().unwrap();
            let off = is.iter().zip(&moved).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-14, "{output:?} {off:e}");
        }
    }

    #[test]
    fn what_is_not_told_or_undecided_is_named() {
        let arm = springy();
        let under = Situation::under(Vector6::repeat(1.0));
        for (id, place, values) in [
            ("joint_hardening", "joint 1", &[1e-12][..]),
            ("base_compliance", "base", &[1e-6, 1e-6, 1e-7, 0.0]),
            ("wrench_scale", "tool", &[0.1]),
        ] {
            let one = [known(id, place, 0, values)];
            let whole = Whole { known: &one, ..Whole::from(&arm) };
            assert!(whole.untold(&[0.1, 0.2, 0.3], &under).is_none(), "{id}");
            assert!(whole.undecided(&under).is_none(), "{id}");
        }
        for (id, place, values) in [
            ("instrument_scale", "instrument", &[1e-4][..]),
            ("bearing_wobble", "joint 2", &[1e-4; 2]),
            ("backlash", "joint 2", &[1e-3]),
            ("settling_lag", "joint 2", &[1e-3]),
        ] {
            let both = [known("joint_ratio", "joint 1", 0, &[1e-2]), known(id, place, 0, values)];
            let whole = Whole { known: &both, ..Whole::from(&arm) };
            let undecided = whole.undecided(&under).map(|(known, _)| known);
            let named = undecided.or_else(|| whole.untold(&[0.1, 0.2, 0.3], &under)).unwrap();
            assert_eq!(named.effect.identifier(), id);
        }
    }
}
