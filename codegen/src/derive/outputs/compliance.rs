//! Everything elastic in the arm as springs, and the 6×6 compliance that they make together.

use stiffarm_kernels::Output;

use super::{Derivation, Derived, springs};
use crate::derive::chain::{Chain, Levers, base_twists};
use crate::expr::{Expr, Vec3, parallel3};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] = &[(Output::Compliance, compliance)];

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
///
/// Twists with one rotation w in common are taken together: their part is `[Σ c v vᵀ, (Σ c v) wᵀ;
/// w (Σ c v)ᵀ, (Σ c) w wᵀ]`, so only the translations cost something by twist.
pub(super) fn compliance(chain: &mut Chain) -> Derived {
    let elements = elements(chain);
    let mut lower = [Expr::ZERO; 36];
    for group in groups(elements, chain.passes.parallel) {
        let rotation = [group[0].twist[3], group[0].twist[4], group[0].twist[5]];
        let (mut first, mut total) = ([Expr::ZERO; 3], Expr::ZERO);
        for Element { compliance, twist } in &group {
            let v = [twist[0], twist[1], twist[2]];
            let scaled = chain.g.scale3(*compliance, v);
            for (column, a) in scaled.into_iter().enumerate() {
                for (row, b) in v.into_iter().enumerate().skip(column) {
                    add(chain, &mut lower, (column, row), (a, b));
                }
            }
            first = chain.g.add3(first, scaled);
            total = chain.g.add(total, *compliance);
        }
        let scaled = chain.g.scale3(total, rotation);
        for (row, b) in rotation.into_iter().enumerate() {
            for (column, a) in first.into_iter().enumerate() {
                add(chain, &mut lower, (column, 3 + row), (a, b));
            }
            for (column, a) in scaled.into_iter().enumerate().take(row + 1) {
                add(chain, &mut lower, (3 + column, 3 + row), (a, b));
            }
        }
    }
    let at = (0..36).map(|at| (at / 6, at % 6));
    at.map(|(c, r)| lower[6 * c.min(r) + c.max(r)]).collect::<Vec<Expr>>().into()
}

/// Adds a product to an entry.
fn add(chain: &mut Chain, sums: &mut [Expr; 36], (column, row): (usize, usize), of: (Expr, Expr)) {
    let at = 6 * column + row;
    let term = chain.g.mul(of.0, of.1);
    sums[at] = chain.g.add(sums[at], term);
}

/// Elements whose twists have one rotation, known by its expressions being equal up to one sign; turned
/// round, an element is the same. Each by itself unless `together`.
fn groups(elements: Vec<Element>, together: bool) -> Vec<Vec<Element>> {
    let mut groups: Vec<Vec<Element>> = Vec::new();
    for element in elements {
        let rotation = |e: &Element| [e.twist[3], e.twist[4], e.twist[5]];
        let own = rotation(&element);
        let alike = groups.iter().position(|group| parallel3(rotation(&group[0]), own));
        match alike.filter(|_| together) {
            None => groups.push(vec![element]),
            Some(at) if rotation(&groups[at][0]) == own => groups[at].push(element),
            Some(at) => groups[at]
                .push(Element { twist: element.twist.map(|component| -component), ..element }),
        }
    }
    groups
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
    for elastic in springs::elastics(chain) {
        let (_, springs) = springs::springs(chain, &levers, &elastic);
        for spring in springs {
            let (v, w) = chain.twist_in_base(spring.twist);
            elements.push(Element { compliance: spring.compliance, twist: six(v, w) });
        }
    }
    elements
}

fn six(v: Vec3, w: Vec3) -> [Expr; 6] {
    [v[0], v[1], v[2], w[0], w[1], w[2]]
}
