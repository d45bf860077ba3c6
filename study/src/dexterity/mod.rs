//! How well a posture suits the identification of joint stiffnesses (Dumas, Caro, Cherif, Garnier,
//! Furet: *Joint stiffness identification of industrial serial robots*, Robotica 2011, sections
//! 2.2 to 3.2).
//!
//! * [`inverse_condition`]: the dexterity `1/κ_F` of eqs. 11-12; it needs a length that makes
//!   translations and rotations comparable, which [`characteristic_length`] finds (Khan & Angeles,
//!   J. Mech. Design 128, 2006, the direct problem).
//! * [`influence`]: ν_p and ν_r of eqs. 14-15, what leaving K_C out costs.
//! * [`Map`]: any of these over two joints, as data.
//! * [`mod@design`]: postures and loads for tests by D-optimality.
//!
//! Joint values are in rad (m of prismatic joints), J in m and rad, base axes at the tool origin.
//! Nothing here reads a robot's weight: the displacements are those of an added load. Of an arm whose
//! file says more than its table ([`Whole`]) they are readings, and all is told of the joint values that
//! these mean: each joint in the middle of its play, at the temperature of the table, at the beginning.

mod condition;
pub mod design;
mod influence;
mod length;
mod map;
mod search;

pub use condition::{Best, best_length, condition_number, inverse_condition, normalised_jacobian};
pub use influence::{Influence, influence};
pub use length::{Characteristic, Search, characteristic_length};
pub use map::{Map, Peak, Plane};

use nalgebra::{Matrix6xX, Vector6};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Output, Unstable};

use crate::whole::{Situation, Whole};

/// Why a property of a posture could not be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DexterityError {
    /// The number of joint values.
    #[error("found {found} joint values, expected {expected}, one for each joint")]
    Posture {
        /// As given.
        found: usize,
        /// Of the arm.
        expected: usize,
    },
    /// A joint value that is infinite or not a number.
    #[error("joint value {joint} is not a finite number")]
    NotFinite {
        /// From 1.
        joint: usize,
    },
    /// A closed-form length needs six independent motions.
    #[error("found {found} joints, expected at least 6: fewer cannot move the tool in all ways")]
    TooFewJoints {
        /// Of the arm.
        found: usize,
    },
    /// J has no inverse here.
    #[error(
        "the posture is singular (smallest singular value of J {ratio:e} of the largest), so that \
         no finite stiffness describes it: use the deflection, which needs no inverse of J"
    )]
    Singular {
        /// Smallest singular value of J over the largest.
        ratio: f64,
    },
    /// A thing of a bench to which no posture goes.
    #[error(
        "no posture within the joints' ranges brings the tool to {thing} with the arm above every plane: move it, or \
         mend `at`, `rotation` and `on` in the bench"
    )]
    OutOfReach {
        /// As reports call it.
        thing: String,
    },
    /// A prismatic joint without limits cannot be searched.
    #[error("joint {joint} is prismatic and has no limits: give it limits to search between")]
    Unlimited {
        /// From 1.
        joint: usize,
    },
    /// A length that cannot make rotations and translations comparable.
    #[error("found {found} as the length, expected a positive number of metres")]
    Length {
        /// As given.
        found: f64,
    },
    /// A map needs cells.
    #[error("found {found} as {what}, expected {expected}")]
    Setting {
        /// Which setting.
        what: &'static str,
        /// As given.
        found: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// An effect that no test shows.
    #[error("no test of this plan shows {effect}: {why}")]
    Idle {
        /// In words.
        effect: String,
        /// Why.
        why: &'static str,
    },
    /// An effect has no such form.
    #[error("found no such form of {effect}: leave out what stands behind the colon")]
    NoForm {
        /// In words.
        effect: String,
    },
    /// Two effects that do the same in all tests.
    #[error(
        "no test of this plan tells {first} from {second}: allow loads in more directions, moments \
         too, or measure rotations"
    )]
    Alike {
        /// In words.
        first: String,
        /// In words.
        second: String,
    },
    /// No posture of the search was regular.
    #[error("every posture that was tried is singular: the arm cannot move the tool in all ways")]
    AllSingular,
    /// The load is too large for the springs.
    #[error(transparent)]
    Unstable(#[from] Unstable),
}

/// An output of six rows at a posture under a load.
fn block(
    whole: Whole<'_>,
    output: Output,
    q: &[f64],
    load: &Vector6<f64>,
) -> Result<Matrix6xX<f64>, Unstable> {
    let block = whole.evaluate(output, q, &Situation::under(*load))?;
    Ok(Matrix6xX::from_vec(block.unwrap_or_default()))
}

/// One finite joint value for each joint.
///
/// # Errors
/// [`DexterityError::Posture`], [`DexterityError::NotFinite`].
pub fn check_posture(arm: &Arm, q: &[f64]) -> Result<(), DexterityError> {
    if q.len() != arm.dof() {
        return Err(DexterityError::Posture { found: q.len(), expected: arm.dof() });
    }
    match q.iter().position(|value| !value.is_finite()) {
        Some(k) => Err(DexterityError::NotFinite { joint: k + 1 }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use stiffarm_kernels::Motion;

    use super::*;

    #[test]
    fn what_cannot_be_searched_or_mapped_is_refused() {
        let (mut arm, q) = (crate::fixture::kr240([0.0; 3]), [0.3, 1.1, -1.7, 0.6, -0.9, 2.1]);
        for length in [0.0, -1.0, f64::NAN] {
            let error = inverse_condition(&arm, &q, length).unwrap_err();
            assert!(matches!(error, DexterityError::Length { .. }), "{error}");
        }
        let none = Search { starts: 0, ..Search::default() };
        let mut settings = vec![characteristic_length(&arm, none).map(|_| ())];
        let steps = [0.0, -1.0, f64::NAN, 1e-12].map(|step| ([1, 2], step));
        for (joints, step) in steps.into_iter().chain([([1, 1], 0.1), ([1, 6], 0.1)]) {
            settings.push(Plane::over_limits(&arm, &q, joints, step).map(|_| ()));
        }
        for setting in settings {
            assert!(matches!(setting, Err(DexterityError::Setting { .. })), "{setting:?}");
        }
        (arm.joints[2].motion, arm.joints[2].limits) = (Motion::Prismatic, None);
        let unlimited = DexterityError::Unlimited { joint: 3 };
        assert_eq!(Plane::over_limits(&arm, &q, [1, 2], 0.1).unwrap_err(), unlimited);
        assert_eq!(characteristic_length(&arm, Search::default()).unwrap_err(), unlimited);
        arm.joints.pop();
        let error = characteristic_length(&arm, Search::default()).unwrap_err();
        assert_eq!(error, DexterityError::TooFewJoints { found: 5 });
    }
}
