//! K_C: how the torque of a constant load changes with the posture.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, load, twists};
use crate::expr::{Expr, Twist, Vec3, parallel3};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] =
    &[(Output::ComplementaryStiffness, complementary_stiffness)];

/// A load that stays constant in base axes, as the joints feel it.
pub(super) struct Load {
    /// Force on joint `j` and beyond, by joint: the same everywhere for a tool wrench, growing inwards
    /// for weights.
    pub force: Vec<Vec3>,
    /// Moment on the tool.
    pub moment: Vec3,
    /// `z_j × lever` of each revolute joint; the axis of a prismatic one.
    pub arms: Vec<Vec3>,
}

/// K_C for the wrench on the tool, n×n column-major; row j, column i is ∂(column j of J)ᵀ/∂q_i · w.
fn complementary_stiffness(chain: &mut Chain) -> Derived {
    let twists = twists(chain);
    let load = tool_load(chain, &twists);
    matrix(chain, &load, "kc").into()
}

/// The wrench on the tool as a load.
pub(super) fn tool_load(chain: &mut Chain, twists: &[Twist]) -> Load {
    let load = load(chain);
    let arm = |(j, (v, w)): (usize, &Twist)| match chain.revolute(j) {
        true => {
            let beside = chain.g.cross3(*w, load.at);
            chain.g.add3(*v, beside)
        }
        false => *v,
    };
    let arms = twists.iter().enumerate().map(arm).collect();
    Load { force: vec![load.force; chain.dof()], moment: load.moment, arms }
}

/// With i the inner and j the outer of two joints: force part `f · (z_i × v_j)` in both triangles,
/// moment part `m · (z_i × z_j)` in row j, column i only. A prismatic inner joint changes nothing; a
/// prismatic outer one has no moment part.
pub(super) fn matrix(chain: &mut Chain, load: &Load, prefix: &str) -> Vec<Expr> {
    let n = chain.dof();
    let mut out = vec![Expr::ZERO; n * n];
    for i in 0..n {
        if !chain.revolute(i) {
            continue;
        }
        let z_i = chain.joint_axis(i);
        let turned = chain.g.cross3(load.moment, z_i);
        for j in i..n {
            if j == i && !chain.revolute(j) {
                continue;
            }
            // f · (z_i × v) = (f × z_i) · v: the first factor is shared along the row.
            let crossed = chain.g.cross3(load.force[j], z_i);
            let force = chain.g.dot3(crossed, load.arms[j]);
            let z_j = chain.joint_axis(j);
            let moment = match j > i && chain.revolute(j) && !parallel3(z_i, z_j) {
                true => chain.g.dot3(turned, z_j),
                false => Expr::ZERO,
            };
            let below = chain.g.add(force, moment);
            out[j * n + i] = force;
            out[i * n + j] = below;
            if j > i {
                chain.g.name(force, || format!("{prefix}_{}{}", i + 1, j + 1));
            }
            chain.g.name(below, || format!("{prefix}_{}{}", j + 1, i + 1));
        }
    }
    out
}
