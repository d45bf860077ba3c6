//! The links' weights: torques on the joints, and their part of K_C.

use super::beam;
use super::chain::{Chain, ROW};
use super::lever::{From, Levers, row_slides};
use super::stiffness::{Load, matrix};
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;
use crate::robot::Convention;

/// A mass fixed somewhere along the chain.
pub(super) struct Mass {
    pub mass: Expr,
    /// It moves with every step before this boundary.
    pub boundary: usize,
    /// Its offset along the axes of that boundary's frame.
    pub com: Vec3,
    /// For the distributed weight of a beam: the two slides along whose half its centre lies.
    pub half: Option<(usize, usize)>,
}

impl Mass {
    /// How much of the mass a slide at step `s` carries with its full length.
    pub fn share_beyond(&self, g: &mut Graph, s: usize) -> Expr {
        let half = self.half.is_some_and(|(z, x)| s == z || s == x);
        if half {
            let half = g.number(Number::ratio(1, 2));
            g.mul(half, self.mass)
        } else if self.boundary > s {
            self.mass
        } else {
            Expr::ZERO
        }
    }
}

/// Lumped masses in their links' frames, and the beams' distributed weight at the middle of the chord.
pub(super) fn masses(chain: &mut Chain) -> Vec<Mass> {
    let mut masses = Vec::new();
    for row in 0..chain.dof() {
        let joint = chain.robot.joints[row].clone();
        if let Some(mass) = &joint.mass {
            let mass = chain.value(mass);
            let com = joint.com.each_ref().map(|c| chain.value(c));
            masses.push(Mass { mass, boundary: ROW * (row + 1), com, half: None });
        }
        let beam_mass = beam::mass(chain, row);
        if !beam_mass.is_zero() {
            // In the standard convention the link moves with its own joint, the row's first step; in
            // the modified one the chord lies before the joint.
            let boundary = match chain.robot.convention {
                Convention::Standard => ROW * row + 1,
                Convention::Modified => ROW * row,
            };
            let half = Some(row_slides(chain, row));
            masses.push(Mass { mass: beam_mass, boundary, com: [Expr::ZERO; 3], half });
        }
    }
    masses
}

/// Gravity in the working frame, m/s².
pub(super) fn gravity(chain: &mut Chain) -> Vec3 {
    let components = chain.robot.gravity.clone();
    let base = components.each_ref().map(|c| chain.value(c));
    let g = chain.in_frame(base);
    chain.name3(g, "gw");
    g
}

/// The mass that moves with everything beyond `from`, distributed weight of beams included.
pub(super) fn mass_beyond(chain: &mut Chain, boundary: usize) -> Expr {
    let masses = masses(chain);
    masses
        .iter()
        .filter(|m| m.boundary >= boundary)
        .fold(Expr::ZERO, |sum, m| chain.g.add(sum, m.mass))
}

/// The torque of the weights on each joint, positive like Jᵀw.
pub(super) fn gravity_torque(chain: &mut Chain) -> Vec<Expr> {
    let load = load(chain);
    let torques: Vec<Expr> =
        (0..chain.dof()).map(|j| chain.g.dot3(load.force[j], load.arms[j])).collect();
    for (j, torque) in torques.iter().enumerate() {
        chain.g.name(*torque, || format!("tg{}", j + 1));
    }
    torques
}

/// ∂(gravity torque)/∂q, n×n.
pub(super) fn gravity_stiffness(chain: &mut Chain) -> Vec<Expr> {
    let load = load(chain);
    matrix(chain, &load, "kg")
}

/// The weights as the joints feel them: gravity times the first moment of mass beyond a joint that
/// turns, times the mass beyond one that slides.
pub(super) fn load(chain: &mut Chain) -> Load {
    let g = gravity(chain);
    let moments = Levers::of_mass(chain);
    let (mut force, mut arms) = (Vec::new(), Vec::new());
    for j in 0..chain.dof() {
        let (z, step) = (chain.joint_axis(j), chain.joint_step(j));
        if chain.revolute(j) {
            let moment = moments.from(&mut chain.g, From::Step(step), Some(z));
            chain.name3(moment, &format!("s{}_", j + 1));
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
