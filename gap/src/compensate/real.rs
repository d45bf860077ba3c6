//! The arm that is compensated: the robot file's, with what else reality does to it.

use nalgebra::{Isometry3, Vector6};
use stiffarm_kernels::Unstable;
use stiffarm_kernels::generic::Arm;

use super::CompensateError;
use crate::effects::{Depends, Effect, Spot};
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, State, rest};

/// An arm as it is.
#[derive(Clone, Debug)]
pub struct Real<'a> {
    /// Of the robot file.
    pub arm: &'a Arm,
    /// What reality does beside it.
    pub effects: Vec<Present>,
}

/// An effect at a place, with its values in the order of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Present {
    /// Which.
    pub effect: &'static dyn Effect,
    /// Where, and in which form.
    pub spot: Spot,
    /// SI.
    pub values: Vec<f64>,
}

/// What is known of a set-point beside the joint values.
#[derive(Clone, Debug, PartialEq)]
pub struct Situation {
    /// Wrench on the tool, base axes, at the tool origin, N and N·m.
    pub load: Vector6<f64>,
    /// From which side each joint comes to rest, n, each −1, 0 or 1.
    pub direction: Option<Vec<i8>>,
    /// How much warmer the arm is than when it was measured first, K.
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

impl<'a> Real<'a> {
    /// The robot file's arm and nothing else.
    pub fn nominal(arm: &'a Arm) -> Real<'a> {
        Real { arm, effects: Vec::new() }
    }

    /// The arm at rest at some set-points, and where its base stands.
    ///
    /// # Errors
    /// [`Unstable`] if no stable equilibrium is found.
    pub(super) fn rest(
        &self,
        q: &[f64],
        at: &Situation,
    ) -> Result<(State, Isometry3<f64>), Unstable> {
        let direction = at.direction.clone();
        let row = Row { wrench: at.load, direction, ..Row::new(0, q.to_vec()) };
        let before = at.before.as_deref().unwrap_or(q);
        let last_move = q.iter().zip(before).map(|(now, then)| now - then).collect();
        let warming = at.warming.unwrap_or(0.0);
        let when = Moment::at_rest(last_move, warming);
        let mut actual = Actual::new(self.arm, q, &at.load);
        for present in &self.effects {
            present.effect.alter(&mut actual, &row, &when, present.spot, &present.values);
        }
        Ok((rest(&actual, None)?, actual.base))
    }

    /// Whether all is known that the effects depend on.
    pub(super) fn check(&self, at: &Situation) -> Result<(), CompensateError> {
        let unknown = |present: &&Present| -> Option<&'static str> {
            match present.effect.depends() {
                Depends::Posture => None,
                Depends::Direction => {
                    at.direction.is_none().then_some("from which side each joint comes to rest")
                }
                Depends::Temperature => at.warming.is_none().then_some("how warm the arm is"),
                Depends::LastMove => at.before.is_none().then_some("the posture before"),
                Depends::Session => Some("when in its session it happens, which no arm repeats"),
            }
        };
        let missing = self.effects.iter().find_map(|p| Some((p, unknown(&p)?)));
        match missing {
            None => Ok(()),
            Some((Present { effect, spot, .. }, unknown)) => {
                let effect = format!("{} at {}", effect.identifier(), spot.place);
                Err(CompensateError::Unknown { effect, unknown })
            }
        }
    }
}
