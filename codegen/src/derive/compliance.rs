//! Everything elastic in the arm as springs, and the 6×6 compliance that they make together.

use super::beam;
use super::chain::Chain;
use super::jacobian::{Twist, base_twists};
use super::lever::Levers;
use crate::expr::{Expr, Vec3};

/// A compliance with the twist that it gives the tool, base axes.
struct Element {
    compliance: Expr,
    twist: [Expr; 6],
}

/// `1/k` of every joint; `None` where the joint is rigid.
pub(super) fn joint_compliances(chain: &mut Chain) -> Vec<Option<Expr>> {
    let stiffness: Vec<_> = chain.robot.joints.iter().map(|j| j.stiffness.clone()).collect();
    let mut compliances = Vec::new();
    for (row, k) in stiffness.iter().enumerate() {
        let k = k.as_ref().map(|k| chain.value(k));
        let compliance = k.map(|k| chain.g.recip(k));
        if let Some(compliance) = compliance {
            chain.g.name(compliance, || format!("compliance{}", row + 1));
        }
        compliances.push(compliance);
    }
    compliances
}

/// `Σ c t tᵀ` over joints and the springs of beams; 6×6, base axes, at the tool origin.
pub(super) fn compliance(chain: &mut Chain) -> Vec<Expr> {
    let elements = elements(chain);
    let mut lower = [Expr::ZERO; 36];
    for Element { compliance, twist } in elements {
        for (column, component) in twist.into_iter().enumerate() {
            let scaled = chain.g.mul(compliance, component);
            for (row, other) in twist.into_iter().enumerate().skip(column) {
                let product = chain.g.mul(scaled, other);
                let at = 6 * column + row;
                lower[at] = chain.g.add(lower[at], product);
            }
        }
    }
    (0..36).map(|at| (at / 6, at % 6)).map(|(c, r)| lower[6 * c.min(r) + c.max(r)]).collect()
}

fn elements(chain: &mut Chain) -> Vec<Element> {
    let joints = joint_compliances(chain);
    let twists = base_twists(chain);
    let mut elements: Vec<Element> = Vec::new();
    for (compliance, (v, w)) in joints.into_iter().zip(twists) {
        if let Some(compliance) = compliance {
            elements.push(Element { compliance, twist: six(v, w) });
        }
    }
    let levers = Levers::to_tool(chain);
    for row in 0..chain.dof() {
        let Some(beam) = chain.robot.joints[row].beam.clone() else { continue };
        let (_, springs) = beam::springs(chain, &levers, row, &beam);
        for spring in springs {
            let (v, w): Twist = spring.twist;
            let (v, w) = (chain.in_base(v), chain.in_base(w));
            elements.push(Element { compliance: spring.compliance, twist: six(v, w) });
        }
    }
    elements
}

fn six(v: Vec3, w: Vec3) -> [Expr; 6] {
    [v[0], v[1], v[2], w[0], w[1], w[2]]
}
