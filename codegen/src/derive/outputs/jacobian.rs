//! The Jacobian: one twist per joint.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, Levers, Point, base_twists, flatten, twists};
use crate::expr::Expr;

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] = &[
    (Output::Jacobian, jacobian),
    (Output::JacobianTool, jacobian_tool),
    (Output::JacobianSpatial, jacobian_spatial),
];

/// 6×n, base axes, at the tool origin.
pub(super) fn jacobian(chain: &mut Chain) -> Derived {
    let twists = base_twists(chain);
    flatten(twists).into()
}

/// 6×n, tool axes, at the tool origin: Paul's differential Jacobian.
fn jacobian_tool(chain: &mut Chain) -> Derived {
    let tool = chain.tool_axes();
    let twists = twists(chain);
    let turned = twists.into_iter().map(|(v, w)| {
        (tool.map(|axis| chain.g.dot3(axis, v)), tool.map(|axis| chain.g.dot3(axis, w)))
    });
    flatten(turned).into()
}

/// 6×n, base axes, at the world's origin: the lever leads from there to the joint's axis.
fn jacobian_spatial(chain: &mut Chain) -> Derived {
    let mut twists = Vec::with_capacity(chain.dof());
    for row in 0..chain.dof() {
        let z = chain.joint_axis(row);
        let axis = chain.in_base(z);
        twists.push(match chain.revolute(row) {
            true => {
                let before = Levers::inside(chain, chain.joint_step(row), [Expr::ZERO; 3]);
                let lever = before.lever(&mut chain.g, Point::Boundary(0), Some(z));
                let moment = chain.g.cross3(lever, z);
                let (own, base) = (chain.in_base(moment), chain.in_world([Expr::ZERO; 3]));
                let carried = chain.g.cross3(base, axis);
                (chain.g.add3(own, carried), axis)
            }
            false => (axis, [Expr::ZERO; 3]),
        });
    }
    flatten(twists).into()
}
