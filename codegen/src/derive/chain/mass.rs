//! What the links weigh, and where along the chain their masses are fixed.

use super::chord::beam_mass;
use super::layout::Chain;
use super::place::ROW;
use crate::expr::{Expr, Graph, Vec3};
use crate::number::Number;
use crate::robot::Convention;

/// A mass fixed somewhere along the chain.
pub struct Mass {
    pub mass: Expr,
    /// It moves with every step before this boundary.
    pub boundary: usize,
    /// Its offset along the axes of that boundary's frame.
    pub com: Vec3,
    /// For the distributed weight of a beam: the two translations along whose half its centre lies.
    pub half: Option<(usize, usize)>,
}

impl Mass {
    /// How much of the mass a translation at step `s` carries with its full length.
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
pub fn masses(chain: &mut Chain) -> Vec<Mass> {
    let mut masses = Vec::new();
    for row in 0..chain.dof() {
        let joint = chain.robot.joints[row].clone();
        if let Some(mass) = &joint.mass {
            let mass = chain.value(mass);
            let com = joint.com.each_ref().map(|c| chain.value(c));
            masses.push(Mass { mass, boundary: ROW * (row + 1), com, half: None });
        }
        let of_beam = beam_mass(chain, row);
        if !of_beam.is_zero() {
            // In the standard convention the link moves with its own joint, the row's first step; in
            // the modified one the chord lies before the joint.
            let boundary = match chain.robot.convention {
                Convention::Standard => ROW * row + 1,
                Convention::Modified => ROW * row,
            };
            let half = Some(chain.row_translations(row));
            masses.push(Mass { mass: of_beam, boundary, com: [Expr::ZERO; 3], half });
        }
    }
    masses
}

/// Gravity in the working frame, m/s².
pub fn gravity(chain: &mut Chain) -> Vec3 {
    let components = chain.robot.gravity.clone();
    let base = components.each_ref().map(|c| chain.value(c));
    let g = chain.of_base(base);
    chain.g.name3(g, "gw");
    g
}

/// The mass that moves with everything beyond `from`, distributed weight of beams included.
pub fn mass_beyond(chain: &mut Chain, boundary: usize) -> Expr {
    let masses = masses(chain);
    masses
        .iter()
        .filter(|m| m.boundary >= boundary)
        .fold(Expr::ZERO, |sum, m| chain.g.add(sum, m.mass))
}
