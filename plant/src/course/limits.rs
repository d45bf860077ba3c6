//! How far, how fast and how hard joints may move.

use core::f64::consts::PI;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

/// Of every joint, rad or m.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Lowest and highest value.
    pub position: Vec<[f64; 2]>,
    /// Largest rate, either way, per second.
    pub rate: Vec<f64>,
    /// Largest acceleration, either way, per second squared.
    pub acceleration: Vec<f64>,
}

/// Limits between which nothing moves.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LimitsError {
    /// A prismatic joint may be anywhere.
    #[error("joint {joint} slides and has no `limits`: give it limits to move between")]
    Unlimited {
        /// From 1.
        joint: usize,
    },
    /// A rate or an acceleration that is none.
    #[error("found {found} as the largest {what} of joint {joint}, expected a positive number")]
    Largest {
        /// Rate or acceleration.
        what: &'static str,
        /// From 1.
        joint: usize,
        /// As given.
        found: f64,
    },
    /// So many for another number of joints.
    #[error(
        "found {found} values of the largest {what}, expected one, or one for each of {expected} joints"
    )]
    Count {
        /// Rate or acceleration.
        what: &'static str,
        /// As given.
        found: usize,
        /// Of the arm.
        expected: usize,
    },
}

/// Rates and accelerations of a joint that turns, where none are given: about a third of what arms of
/// this size are sold with.
const TURNING: [f64; 2] = [1.0, 3.0];

/// The same of a joint that slides, m/s and m/s².
const SLIDING: [f64; 2] = [0.25, 0.75];

impl Limits {
    /// Positions as the table has them (a joint that turns without limits turns once around); rates and
    /// accelerations one for all joints or one for each, of which none is usual.
    ///
    /// # Errors
    /// [`LimitsError`].
    pub fn of(arm: &Arm, rate: &[f64], acceleration: &[f64]) -> Result<Limits, LimitsError> {
        let range = |(k, joint): (usize, &stiffarm_kernels::generic::Joint)| match joint.motion {
            Motion::Revolute => Ok(joint.limits.unwrap_or([-PI, PI])),
            Motion::Prismatic => joint.limits.ok_or(LimitsError::Unlimited { joint: k + 1 }),
        };
        let position = arm.joints.iter().enumerate().map(range).collect::<Result<_, _>>()?;
        let largest = |what: &'static str, given: &[f64], usual: usize| {
            let expected = arm.dof();
            let of = |(k, joint): (usize, &stiffarm_kernels::generic::Joint)| {
                let usual = match joint.motion {
                    Motion::Revolute => TURNING[usual],
                    Motion::Prismatic => SLIDING[usual],
                };
                let found = given.get(k).or(given.first()).copied().unwrap_or(usual);
                let holds = found > 0.0 && found.is_finite();
                holds.then_some(found).ok_or(LimitsError::Largest { what, joint: k + 1, found })
            };
            if ![0, 1, expected].contains(&given.len()) {
                return Err(LimitsError::Count { what, found: given.len(), expected });
            }
            arm.joints.iter().enumerate().map(of).collect()
        };
        Ok(Limits {
            position,
            rate: largest("rate", rate, 0)?,
            acceleration: largest("acceleration", acceleration, 1)?,
        })
    }
}
