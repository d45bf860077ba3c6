//! The joints' twists at the tool origin, and the wrench that does work along them.

use super::layout::Chain;
use super::lever::{Levers, Point};
use super::place::ROW;
use crate::expr::{Expr, Symbol, Twist, Vec3, negate3};
use crate::number::Number;

/// The joints' twists in the working frame: `(z × (p − p_j), z)` of a revolute joint, `(z, 0)`
/// of a prismatic one.
pub fn twists(chain: &mut Chain) -> Vec<Twist> {
    if let Some(known) = &chain.twists {
        return known.clone();
    }
    if let Some(known) = chain.by_run() {
        let twists = known.twists.clone();
        for (j, (v, _)) in twists.iter().enumerate() {
            chain.g.name3(*v, &format!("v{}", j + 1));
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
            let from = Point::Step(chain.joint_step(j));
            let lever = levers.lever(&mut chain.g, from, Some(z));
            chain.g.name3(lever, &format!("r{}", j + 1));
            let v = chain.g.cross3(z, lever);
            chain.g.name3(v, &format!("v{}", j + 1));
            (v, z)
        })
        .collect();
    chain.twists = Some(twists.clone());
    twists
}

/// The joints' twists in the working frame, told at the origin of frame `row` as if the tool reached there.
pub fn seen_from(chain: &mut Chain, row: usize) -> Vec<Twist> {
    let seen = ROW * row;
    let twist = |chain: &mut Chain, joint: usize| {
        let (step, z) = (chain.joint_step(joint), chain.joint_axis(joint));
        let (inside, turns) = (step <= seen, chain.revolute(joint));
        let from = if inside { Point::Step(step) } else { Point::Boundary(seen) };
        let levers = Levers::inside(chain, step.max(seen), [Expr::ZERO; 3]);
        let (v, w) = levers.twist(&mut chain.g, from, z, turns);
        (if inside || !turns { v } else { negate3(v) }, w)
    };
    (0..chain.dof()).map(|joint| twist(chain, joint)).collect()
}

/// The joints' twists in base axes.
pub fn base_twists(chain: &mut Chain) -> Vec<Twist> {
    twists(chain).into_iter().map(|twist| chain.twist_in_base(twist)).collect()
}

/// Twists as columns of six.
pub fn flatten(twists: impl IntoIterator<Item = Twist>) -> Vec<Expr> {
    twists.into_iter().flat_map(|(v, w)| v.into_iter().chain(w)).collect()
}

/// A load in the working frame.
pub struct Load {
    pub force: Vec3,
    /// Beside that of the force.
    pub moment: Vec3,
    /// Where the force acts, from the tool's origin.
    pub at: Vec3,
}

/// The wrench on the tool in the working frame, about the tool's origin: force, moment.
pub fn wrench(chain: &mut Chain) -> (Vec3, Vec3) {
    let Load { force, moment, at } = load(chain);
    let own = chain.g.cross3(at, force);
    (force, chain.g.add3(moment, own))
}

/// What the wrench really is, and where it acts.
pub fn load(chain: &mut Chain) -> Load {
    let component: [Expr; 6] = core::array::from_fn(|k| chain.g.symbol(Symbol::Wrench(k)));
    let [fx, fy, fz, mx, my, mz] = component;
    let (f, m) = (chain.in_frame([fx, fy, fz]), chain.in_frame([mx, my, mz]));
    chain.g.name3(f, "fw");
    chain.g.name3(m, "mw");
    let beyond = &chain.robot.beyond;
    let scale = chain.g.number(Number::ONE + beyond.wrench_scale);
    let (force, moment) = (chain.g.scale3(scale, f), chain.g.scale3(scale, m));
    let mut at = [Expr::ZERO; 3];
    for (offset, axis) in beyond.load_point.into_iter().zip(chain.tool_axes()) {
        let offset = chain.g.number(offset);
        let part = chain.g.scale3(offset, axis);
        at = chain.g.add3(at, part);
    }
    Load { force, moment, at }
}

/// `v·f + ω·m`: the generalised force of a wrench along a twist.
pub fn power(chain: &mut Chain, (v, w): Twist, (f, m): (Vec3, Vec3)) -> Expr {
    let (linear, angular) = (chain.g.dot3(v, f), chain.g.dot3(w, m));
    chain.g.add(linear, angular)
}
