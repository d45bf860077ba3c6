//! Deflection of the tool: joints as springs on the loaded geometry, links as beams.

use stiffarm_kernels::{Output, Part};

use super::compliance::joint_compliances;
use super::stiffness::{Load, matrix, tool_load};
use super::{Derivation, Derived, margin, springs, weight};
use crate::derive::chain::{Chain, Levers, flatten, power, twists, wrench};
use crate::derive::program::Solve;
use crate::expr::{Expr, Symbol, Twist, Vec3};
use crate::number::Number;

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
    sum.turn(chain, friction, None);
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
    let (mut torques, mut unknowns) = (Vec::new(), Vec::new());
    for &j in &compliant {
        torques.push(torque(chain, j, w, weight.as_ref()));
        unknowns.push(chain.g.symbol(Symbol::Deflection { joint: j, weights }));
    }
    let margin = margin::margin(chain.robot, weights);
    let solve = Solve { output, matrix: system, right: torques, unknowns, margin };
    let mut sum = Sum::default();
    // In the order in which the unknowns become known, so that little is left to do after the last.
    let (last, known) = (0..compliant.len()).partition::<Vec<_>, _>(|k| *k >= solve.leading());
    for k in known.into_iter().rev().chain(last) {
        sum.add(chain, twists[compliant[k]], solve.unknowns[k]);
    }
    links(chain, &mut sum, weights);
    sum.turn(chain, friction, weight.as_ref());
    sum.turn(chain, hardening, weight.as_ref());
    Derived { entries: sum.in_base(chain), solve: (!compliant.is_empty()).then_some(solve) }
}

/// What a load on the tool, and weights where they count, put on a joint.
fn torque(chain: &mut Chain, j: usize, w: (Vec3, Vec3), weight: Option<&Load>) -> Expr {
    let twist = twists(chain)[j];
    let tool = power(chain, twist, w);
    let own = weight.map_or(Expr::ZERO, |load| chain.g.dot3(load.force[j], load.arms[j]));
    let torque = chain.g.add(tool, own);
    chain.g.name(torque, || format!("tau{}", j + 1));
    torque
}

/// What gives at the posture in which the arm is at rest under the wrench and its weights: each joint, by its spring, its
/// friction and its hardening, and the tool's displacement by all else.
pub(crate) fn gives(chain: &mut Chain) -> [Vec<Expr>; 2] {
    let w = wrench(chain);
    let weight = weight::load(chain);
    let mut joints = vec![Expr::ZERO; chain.dof()];
    for (j, compliance) in joint_compliances(chain).into_iter().enumerate() {
        if let Some(compliance) = compliance {
            let torque = torque(chain, j, w, Some(&weight));
            joints[j] = chain.g.mul(compliance, torque);
        }
    }
    for law in [friction, hardening] {
        for (j, by) in law(chain, Some(&weight)) {
            joints[j] = chain.g.add(joints[j], by);
        }
    }
    let mut sum = Sum::default();
    links(chain, &mut sum, true);
    [joints, sum.in_base(chain)]
}

/// By how much some joints turn under the wrench, and the weights where they count.
type Law = fn(&mut Chain, Option<&Load>) -> Vec<(usize, Expr)>;

/// What friction keeps wound up: by the torque's size, behind the approach.
fn friction(chain: &mut Chain, weight: Option<&Load>) -> Vec<(usize, Expr)> {
    let (w, windup) = (wrench(chain), &chain.robot.beyond.windup);
    let wound = |(j, windup): &(usize, Number)| {
        let torque = torque(chain, *j, w, weight);
        let square = chain.g.mul(torque, torque);
        let size = chain.g.sqrt(square);
        let (windup, side) = (chain.g.number(*windup), chain.g.symbol(Symbol::Side(*j)));
        let by = chain.g.mul(side, size);
        (*j, -chain.g.mul(windup, by))
    };
    windup.iter().map(wound).collect()
}

/// What joints give by the cube of their torque.
fn hardening(chain: &mut Chain, weight: Option<&Load>) -> Vec<(usize, Expr)> {
    let (w, hardening) = (wrench(chain), &chain.robot.beyond.hardening);
    let cubic = |(j, cubic): &(usize, Number)| {
        let torque = torque(chain, *j, w, weight);
        let square = chain.g.mul(torque, torque);
        let cube = chain.g.mul(square, torque);
        let cubic = chain.g.number(*cubic);
        (*j, chain.g.mul(cubic, cube))
    };
    hardening.iter().map(cubic).collect()
}

/// Adds what else gives: each spring by its compliance times the load on it.
fn links(chain: &mut Chain, sum: &mut Sum, weights: bool) {
    let elastics = springs::elastics(chain);
    if elastics.is_empty() {
        return;
    }
    let w = wrench(chain);
    let levers = Levers::to_tool(chain);
    let moments = weights.then(|| Levers::of_mass(chain));
    for elastic in elastics {
        let (place, springs) = springs::springs(chain, &levers, &elastic);
        let mut loads: Vec<Expr> = springs.iter().map(|s| power(chain, s.twist, w)).collect();
        if let Some(moments) = &moments {
            let weight = place.weight_on(chain, moments, &springs);
            loads = loads.into_iter().zip(weight).map(|(a, b)| chain.g.add(a, b)).collect();
        }
        for (spring, load) in springs.iter().zip(loads) {
            let give = chain.g.mul(spring.compliance, load);
            sum.add(chain, spring.twist, give);
        }
    }
}

/// ∂(first-order deflection)/∂(compliance of joint j) = J_j J_jᵀ w, 6×n, base axes.
fn compliance_regressor(chain: &mut Chain) -> Derived {
    let w = wrench(chain);
    let twists = twists(chain);
    let columns = twists.into_iter().map(|twist| {
        let torque = power(chain, twist, w);
        let scaled = twist_times(chain, twist, torque);
        chain.twist_in_base(scaled)
    });
    flatten(columns).into()
}

fn twist_times(chain: &mut Chain, (v, w): Twist, factor: Expr) -> Twist {
    (chain.g.scale3(factor, v), chain.g.scale3(factor, w))
}

/// A displacement summed in the working frame.
#[derive(Default)]
struct Sum(Vec3, Vec3);

impl Sum {
    fn add(&mut self, chain: &mut Chain, twist: Twist, by: Expr) {
        let (v, w) = twist_times(chain, twist, by);
        self.0 = chain.g.add3(self.0, v);
        self.1 = chain.g.add3(self.1, w);
    }

    /// Adds the turns of joints.
    fn turn(&mut self, chain: &mut Chain, law: Law, weight: Option<&Load>) {
        for (j, by) in law(chain, weight) {
            let twist = twists(chain)[j];
            self.add(chain, twist, by);
        }
    }

    fn in_base(self, chain: &mut Chain) -> Vec<Expr> {
        flatten([chain.twist_in_base((self.0, self.1))])
    }
}
