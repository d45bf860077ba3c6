//! The characteristic length: the one with which the arm's best posture is conditioned best (Khan &
//! Angeles 2006, the direct problem; Dumas et al., section 3.1, use 0.682 m of the KR 240-2).

use core::f64::consts::PI;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

use super::search::climb;
use super::{Best, DexterityError, best_length};
use crate::rng::{Rng, Stream};
use crate::robot::ranges;

/// How to search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Random postures to climb from; the condition number has many local optima.
    pub starts: usize,
    /// Of the random postures.
    pub seed: u64,
    /// Keep within the joint limits; otherwise revolute joints turn freely.
    pub limits: bool,
}

impl Default for Search {
    fn default() -> Search {
        Search { starts: 24, seed: 0, limits: true }
    }
}

/// The characteristic length and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Characteristic {
    /// m.
    pub length: f64,
    /// `1/κ_F(J_N)` at the best posture.
    pub inverse_condition: f64,
    /// The best posture, n joint values; those that do not matter (the first joint, say) are
    /// arbitrary.
    pub posture: Vec<f64>,
    /// Of the starts, how many ended within 1e-6 of the best.
    pub agreeing: usize,
}

/// The length and the posture that together make `1/κ_F(J_N)` largest. For each posture the length
/// is exact ([`best_length`]); the postures are searched from many starts.
///
/// # Errors
/// [`DexterityError::TooFewJoints`] below six joints; [`DexterityError::Unlimited`] if a prismatic
/// joint has no limits; [`DexterityError::AllSingular`]; [`DexterityError::Setting`] without
/// starts.
pub fn characteristic_length(arm: &Arm, search: Search) -> Result<Characteristic, DexterityError> {
    if arm.dof() < 6 {
        return Err(DexterityError::TooFewJoints { found: arm.dof() });
    }
    if search.starts == 0 {
        let (what, expected) = ("the number of starts", "at least 1");
        return Err(DexterityError::Setting { what, found: 0.0, expected });
    }
    let mut bounds = ranges(arm).map_err(|joint| DexterityError::Unlimited { joint })?;
    let freed = |joint: &Joint| !search.limits && joint.motion == Motion::Revolute;
    for (range, _) in bounds.iter_mut().zip(&arm.joints).filter(|(_, joint)| freed(joint)) {
        *range = [-PI, PI];
    }
    let value = |q: &[f64]| best_length(arm, q).map_or(f64::NAN, |best| best.inverse_condition);
    let mut rng = Rng::new(search.seed, Stream::Starts);
    let ends: Vec<(Vec<f64>, f64)> = (0..search.starts)
        .map(|_| climb(&rng.point(&bounds), &bounds, value))
        .filter(|(_, height)| height.is_finite())
        .collect();
    let best = ends.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let (posture, height) = best.ok_or(DexterityError::AllSingular)?;
    let Best { length, inverse_condition } = best_length(arm, posture)?;
    let agreeing = ends.iter().filter(|end| end.1 > height - 1e-6).count();
    Ok(Characteristic { length, inverse_condition, posture: posture.clone(), agreeing })
}
