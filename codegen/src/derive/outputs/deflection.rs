//! Deflection of the tool: joints as springs on the loaded geometry, links as beams.

use stiffarm_kernels::{Output, Part};

use super::compliance::joint_compliances;
use super::stiffness::{matrix, tool_load};
use super::{Derivation, Derived, beam, margin, weight};
use crate::derive::chain::{
    Chain, Chord, Levers, Point, beam_mass, flatten, gravity, mass_beyond, power, twists, wrench,
};
use crate::derive::program::Solve;
use crate::expr::{Expr, Symbol, Twist, Vec3};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] = &[
    (Output::DeflectionFirstOrder, first_order),
    (Output::Deflection, |chain| deflection(chain, Output::Deflection)),
    (Output::DeflectionWithGravity, |chain| deflection(chain, Output::DeflectionWithGravity)),
    (Output::ComplianceRegressor, compliance_regressor),
];

/// J Kθ⁻¹ Jᵀ w and the links under the wrench: to first order in the load.
fn first_order(chain: &mut Chain) -> Derived {
    let w = wrench(chain);
    let twists = twists(chain);
    let compliances = joint_compliances(chain);
    let mut sum = Sum::default();
    for (twist, compliance) in twists.into_iter().zip(compliances) {
        if let Some(compliance) = compliance {
            let torque = power(chain, twist, w);
            let turn = chain.g.mul(compliance, torque);
            sum.add(chain, twist, turn);
        }
    }
    links(chain, &mut sum, false);
    sum.in_base(chain).into()
}

/// J (Kθ − K_C)⁻¹ Jᵀ w over the joints that are not rigid, and the links; where the weights enter
/// `output`, K_C and the torque include them.
pub(super) fn deflection(chain: &mut Chain, output: Output) -> Derived {
    let weights = output.depends_on(Part::Weights);
    let w = wrench(chain);
    let twists = twists(chain);
    let load = tool_load(chain, &twists);
    let k_c = matrix(chain, &load, "kc");
    let weight = weights.then(|| weight::load(chain));
    let k_g = weight.as_ref().map(|load| matrix(chain, load, "kg"));
    let stiffness: Vec<Option<Expr>> = (0..chain.dof())
        .map(|j| {
            let k = chain.robot.joints[j].stiffness.clone();
            k.map(|k| chain.value(&k))
        })
        .collect();
    let compliant: Vec<usize> = (0..chain.dof()).filter(|j| stiffness[*j].is_some()).collect();
    let mut system = Vec::new();
    for &column in &compliant {
        for &row in &compliant {
            let at = column * chain.dof() + row;
            let total = k_g.as_ref().map_or(k_c[at], |k_g| chain.g.add(k_c[at], k_g[at]));
            let diagonal = if row == column { stiffness[row] } else { None };
            let entry = chain.g.sub(diagonal.unwrap_or(Expr::ZERO), total);
            chain.g.name(entry, || format!("k_{}{}", row + 1, column + 1));
            system.push(entry);
        }
    }
    let mut sum = Sum::default();
    let (mut torques, mut unknowns) = (Vec::new(), Vec::new());
    for &j in &compliant {
        let tool = power(chain, twists[j], w);
        let own =
            weight.as_ref().map_or(Expr::ZERO, |load| chain.g.dot3(load.force[j], load.arms[j]));
        let torque = chain.g.add(tool, own);
        chain.g.name(torque, || format!("tau{}", j + 1));
        torques.push(torque);
        let unknown = chain.g.symbol(Symbol::Deflection { joint: j, weights });
        unknowns.push(unknown);
        sum.add(chain, twists[j], unknown);
    }
    links(chain, &mut sum, weights);
    let margin = margin::margin(chain.robot, weights);
    let solve = Solve { output, matrix: system, right: torques, unknowns, margin };
    Derived { entries: sum.in_base(chain), solve: (!compliant.is_empty()).then_some(solve) }
}

/// Adds the beams: each of their springs gives by its compliance times the load on it.
fn links(chain: &mut Chain, sum: &mut Sum, weights: bool) {
    if chain.robot.joints.iter().all(|j| j.beam.is_none()) {
        return;
    }
    let w = wrench(chain);
    let levers = Levers::to_tool(chain);
    let moments = weights.then(|| Levers::of_mass(chain));
    for row in 0..chain.dof() {
        let Some(link) = chain.robot.joints[row].beam.clone() else { continue };
        let (chord, springs) = beam::springs(chain, &levers, row, &link);
        let mut loads: Vec<Expr> = springs.iter().map(|s| power(chain, s.twist, w)).collect();
        if let Some(moments) = &moments {
            let weight = weight_on(chain, moments, row, &chord, &springs);
            loads = loads.into_iter().zip(weight).map(|(a, b)| chain.g.add(a, b)).collect();
        }
        for (spring, load) in springs.iter().zip(loads) {
            let give = chain.g.mul(spring.compliance, load);
            sum.add(chain, spring.twist, give);
        }
    }
}

/// What the weights beyond a beam, and its own, put on each of its springs.
fn weight_on(
    chain: &mut Chain,
    moments: &Levers,
    row: usize,
    chord: &Chord,
    springs: &[beam::Spring; 6],
) -> [Expr; 6] {
    let g = gravity(chain);
    let mass = mass_beyond(chain, chord.end);
    let to_end = chord.to_end.map(|(half, axis)| (chain.g.mul(mass, half), axis));
    let mass_of_beam = beam_mass(chain, row);
    let own = chain.g.scale3(mass_of_beam, g);
    let mut loads = beam::own_weight(chain, chord, own);
    for (spring, load) in springs.iter().zip(&mut loads) {
        let outer = if spring.angular {
            let from = Point::Boundary(chord.end);
            let moment = moments.extended(&mut chain.g, from, &to_end, Some(spring.axis));
            let arm = chain.g.cross3(spring.axis, moment);
            chain.g.dot3(arm, g)
        } else {
            let along = chain.g.dot3(spring.axis, g);
            chain.g.mul(mass, along)
        };
        *load = chain.g.add(*load, outer);
    }
    loads
}

/// ∂(first-order deflection)/∂(compliance of joint j) = J_j J_jᵀ w, 6×n, base axes.
fn compliance_regressor(chain: &mut Chain) -> Derived {
    let w = wrench(chain);
    let twists = twists(chain);
    let columns: Vec<Twist> = twists
        .into_iter()
        .map(|twist| {
            let torque = power(chain, twist, w);
            let scaled = twist_times(chain, twist, torque);
            (chain.in_base(scaled.0), chain.in_base(scaled.1))
        })
        .collect();
    flatten(columns).into()
}

fn twist_times(chain: &mut Chain, (v, w): Twist, factor: Expr) -> Twist {
    (chain.g.scale3(factor, v), chain.g.scale3(factor, w))
}

/// A displacement summed in the working frame.
struct Sum(Vec3, Vec3);

impl Default for Sum {
    fn default() -> Self {
        Sum([Expr::ZERO; 3], [Expr::ZERO; 3])
    }
}

impl Sum {
    fn add(&mut self, chain: &mut Chain, twist: Twist, by: Expr) {
        let (v, w) = twist_times(chain, twist, by);
        self.0 = chain.g.add3(self.0, v);
        self.1 = chain.g.add3(self.1, w);
    }

    fn in_base(self, chain: &mut Chain) -> Vec<Expr> {
        flatten([(chain.in_base(self.0), chain.in_base(self.1))])
    }
}
