//! Poses: of the tool and of every frame of the chain.

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, Levers, Point, ROW};
use crate::expr::{Expr, Vec3};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] =
    &[(Output::Pose, pose), (Output::Frames, frames)];

/// Tool pose, base axes: columns x, y, z, origin.
fn pose(chain: &mut Chain) -> Derived {
    let axes = chain.tool_axes();
    let levers = match chain.by_run().map(|known| known.tip) {
        Some(tip) => Levers::inside(chain, chain.cut, tip),
        None => Levers::to_tool(chain),
    };
    let origin = levers.lever(&mut chain.g, Point::Boundary(0), None);
    columns(chain, axes, origin, "n", "o", "a", "p").into()
}

/// Poses of frames 1 to n, base axes, 3×4 each, side by side.
fn frames(chain: &mut Chain) -> Derived {
    let mut out = Vec::new();
    for (row, origin) in path(chain).into_iter().enumerate() {
        let axes = chain.axes(ROW * (row + 1));
        let i = row + 1;
        out.extend(columns(
            chain,
            axes,
            origin,
            &format!("x{i}"),
            &format!("y{i}"),
            &format!("z{i}_"),
            &format!("p{i}"),
        ));
    }
    out.into()
}

/// Origins of frames 1 to n from the base, summed outwards so that each is the last one continued.
fn path(chain: &mut Chain) -> Vec<Vec3> {
    let mut origin = [Expr::ZERO; 3];
    let mut origins = Vec::new();
    for row in 0..chain.dof() {
        let (z_step, x_step) = chain.row_translations(row);
        for s in [z_step.min(x_step), z_step.max(x_step)] {
            let (length, axis) = chain.translation(s).unwrap_or_default();
            let part = chain.g.scale3(length, axis);
            origin = chain.g.add3(origin, part);
        }
        origins.push(origin);
    }
    origins
}

fn columns(
    chain: &mut Chain,
    axes: [Vec3; 3],
    origin: Vec3,
    x: &str,
    y: &str,
    z: &str,
    p: &str,
) -> Vec<Expr> {
    let [ax, ay, az] = axes;
    [(ax, x), (ay, y), (az, z), (origin, p)]
        .into_iter()
        .flat_map(|(v, name)| {
            let v = chain.in_base(v);
            let v = if name == p { chain.in_world(v) } else { v };
            chain.g.name3(v, name);
            v
        })
        .collect()
}
