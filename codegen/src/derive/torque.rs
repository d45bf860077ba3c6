//! The wrench, and what it does to the joints.

use super::chain::Chain;
use super::jacobian::{Twist, twists};
use crate::expr::{Expr, Symbol, Vec3};

/// The wrench on the tool in the working frame: force, moment.
pub(super) fn wrench(chain: &mut Chain) -> (Vec3, Vec3) {
    let component: [Expr; 6] = core::array::from_fn(|k| chain.g.symbol(Symbol::Wrench(k)));
    let [fx, fy, fz, mx, my, mz] = component;
    let (f, m) = (chain.in_frame([fx, fy, fz]), chain.in_frame([mx, my, mz]));
    chain.name3(f, "fw");
    chain.name3(m, "mw");
    (f, m)
}

/// `v·f + ω·m`: the generalised force of a wrench along a twist.
pub(super) fn power(chain: &mut Chain, (v, w): Twist, (f, m): (Vec3, Vec3)) -> Expr {
    let (linear, angular) = (chain.g.dot3(v, f), chain.g.dot3(w, m));
    chain.g.add(linear, angular)
}

/// Jᵀw.
pub(super) fn joint_torque(chain: &mut Chain) -> Vec<Expr> {
    let wrench = wrench(chain);
    let twists = twists(chain);
    let torques: Vec<Expr> = twists.into_iter().map(|t| power(chain, t, wrench)).collect();
    for (j, torque) in torques.iter().enumerate() {
        chain.g.name(*torque, || format!("tau{}", j + 1));
    }
    torques
}
