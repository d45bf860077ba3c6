//! The links' weights: torques on the joints, and their part of K_C.

use stiffarm_kernels::Output;

use super::stiffness::{Load, matrix};
use super::{Derivation, Derived};
use crate::derive::chain::{Chain, Levers, Point, gravity, mass_beyond};
use crate::expr::Expr;

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] =
    &[(Output::WeightTorque, weight_torque), (Output::WeightStiffness, weight_stiffness)];

/// The torque of the weights on each joint, positive like Jᵀw.
fn weight_torque(chain: &mut Chain) -> Derived {
    let load = load(chain);
    let torques: Vec<Expr> =
        (0..chain.dof()).map(|j| chain.g.dot3(load.force[j], load.arms[j])).collect();
    for (j, torque) in torques.iter().enumerate() {
        chain.g.name(*torque, || format!("tg{}", j + 1));
    }
    torques.into()
}

/// ∂(weight torque)/∂q, n×n.
fn weight_stiffness(chain: &mut Chain) -> Derived {
    let load = load(chain);
    matrix(chain, &load, "kg").into()
}

/// The weights as the joints feel them: gravity times the first moment of mass beyond a
/// revolute joint, times the mass beyond a prismatic one.
pub(super) fn load(chain: &mut Chain) -> Load {
    let g = gravity(chain);
    let moments = Levers::of_mass(chain);
    let (mut force, mut arms) = (Vec::new(), Vec::new());
    for j in 0..chain.dof() {
        let (z, step) = (chain.joint_axis(j), chain.joint_step(j));
        if chain.revolute(j) {
            let moment = moments.lever(&mut chain.g, Point::Step(step), Some(z));
            chain.g.name3(moment, &format!("s{}_", j + 1));
            arms.push(chain.g.cross3(z, moment));
            force.push(g);
        } else {
            let mass = mass_beyond(chain, step + 1);
            arms.push(z);
            force.push(chain.g.scale3(mass, g));
        }
    }
    Load { force, moment: [Expr::ZERO; 3], arms }
}
