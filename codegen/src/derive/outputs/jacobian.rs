//! The Jacobian: one twist per joint.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, base_twists, flatten, twists};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] =
    &[(Output::Jacobian, jacobian), (Output::JacobianTool, jacobian_tool)];

/// 6×n, base axes, at the tool origin.
fn jacobian(chain: &mut Chain) -> Derived {
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
