//! What the wrench does to the joints.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, power, twists, wrench};
use crate::expr::Expr;

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] = &[(Output::JointTorque, joint_torque)];

/// Jᵀw.
fn joint_torque(chain: &mut Chain) -> Derived {
    let wrench = wrench(chain);
    let twists = twists(chain);
    let torques: Vec<Expr> = twists.into_iter().map(|t| power(chain, t, wrench)).collect();
    for (j, torque) in torques.iter().enumerate() {
        chain.g.name(*torque, || format!("tau{}", j + 1));
    }
    torques.into()
}
