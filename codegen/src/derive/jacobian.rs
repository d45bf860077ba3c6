//! The Jacobian: one twist per joint.

use super::chain::Chain;
use super::lever::{From, Levers};
use crate::expr::{Expr, Vec3};

/// A twist at the tool origin: translation, rotation.
pub(super) type Twist = (Vec3, Vec3);

/// The joints' twists in the working frame: `(z × (p − p_j), z)` where the joint turns, `(z, 0)` where
/// it slides.
pub(super) fn twists(chain: &mut Chain) -> Vec<Twist> {
    if let Some(known) = &chain.twists {
        return known.clone();
    }
    if let Some(known) = chain.by_run() {
        let twists = known.twists.clone();
        for (j, (v, _)) in twists.iter().enumerate() {
            chain.name3(*v, &format!("v{}", j + 1));
        }
        chain.twists = Some(twists.clone());
        return twists;
    }
    let levers = Levers::to_tool(chain);
    let twists: Vec<Twist> = (0..chain.dof())
        .map(|j| {
            let z = chain.joint_axis(j);
            if !chain.revolute(j) {
                return (z, [Expr::ZERO; 3]);
            }
            let from = From::Step(chain.joint_step(j));
            let lever = levers.from(&mut chain.g, from, Some(z));
            chain.name3(lever, &format!("r{}", j + 1));
            let v = chain.g.cross3(z, lever);
            chain.name3(v, &format!("v{}", j + 1));
            (v, z)
        })
        .collect();
    chain.twists = Some(twists.clone());
    twists
}

/// The joints' twists in base axes.
pub(super) fn base_twists(chain: &mut Chain) -> Vec<Twist> {
    let twists = twists(chain);
    twists.into_iter().map(|(v, w)| (chain.in_base(v), chain.in_base(w))).collect()
}

/// 6×n, base axes, at the tool origin.
pub(super) fn jacobian(chain: &mut Chain) -> Vec<Expr> {
    let twists = base_twists(chain);
    flatten(twists)
}

/// 6×n, tool axes, at the tool origin: Paul's differential Jacobian.
pub(super) fn jacobian_tool(chain: &mut Chain) -> Vec<Expr> {
    let tool = chain.tool_axes();
    let twists = twists(chain);
    let turned = twists.into_iter().map(|(v, w)| {
        (tool.map(|axis| chain.g.dot3(axis, v)), tool.map(|axis| chain.g.dot3(axis, w)))
    });
    flatten(turned)
}

/// Twists as columns of six.
pub(super) fn flatten(twists: impl IntoIterator<Item = Twist>) -> Vec<Expr> {
    twists.into_iter().flat_map(|(v, w)| v.into_iter().chain(w)).collect()
}
