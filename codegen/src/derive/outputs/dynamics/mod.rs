//! The equations of motion, each link in its own axes: what a motion costs, joint by joint.

mod bodies;
mod composite;
mod line;
mod moments;
mod newton_euler;
mod regressor;

use stiffarm_kernels::Output;

use super::{Derivation, Derived};
use crate::derive::chain::{Chain, expression};
use crate::derive::program::Solve;
use crate::expr::{Expr, Symbol, Vec3};
use line::{Link, line, weightless};
use newton_euler::{Motion, newton_euler};

/// The outputs of this folder.
pub(super) const DERIVED: &[(Output, Derivation)] = &[
    (Output::InverseDynamics, inverse_dynamics),
    (Output::Bias, bias),
    (Output::MassMatrix, |chain| mass_matrix(chain).into()),
    (Output::InverseDynamicsByJoints, by_joints),
    (Output::InverseDynamicsByRates, by_rates),
    (Output::ForwardDynamics, forward_dynamics),
    (Output::TorqueRegressor, regressor),
];

/// τ(q, q̇, q̈).
fn inverse_dynamics(chain: &mut Chain) -> Derived {
    let accelerations = symbols(chain, Symbol::Acceleration);
    torques(chain, accelerations).into()
}

/// τ(q, q̇, 0).
fn bias(chain: &mut Chain) -> Derived {
    let none = vec![Expr::ZERO; chain.dof()];
    torques(chain, none).into()
}

/// ∂τ/∂q_i, n×n.
fn by_joints(chain: &mut Chain) -> Derived {
    if chain.passes.bodies {
        let [by_joints, _] = by_bodies(chain);
        return by_joints.into();
    }
    let accelerations = symbols(chain, Symbol::Acceleration);
    let torques = torques(chain, accelerations);
    by(chain, &torques, Symbol::Joint)
}

/// ∂τ/∂q̇_i, n×n: that of the bias, for M q̈ has no rate in it.
fn by_rates(chain: &mut Chain) -> Derived {
    if chain.passes.bodies {
        let [_, by_rates] = by_bodies(chain);
        return by_rates.into();
    }
    let none = vec![Expr::ZERO; chain.dof()];
    let torques = torques(chain, none);
    by(chain, &torques, Symbol::Rate)
}

/// Both, each in closed form.
fn by_bodies(chain: &mut Chain) -> [Vec<Expr>; 2] {
    let (rates, accelerations) =
        (symbols(chain, Symbol::Rate), symbols(chain, Symbol::Acceleration));
    let gravity = gravity(chain);
    let links = line(chain);
    let motion = Motion { rates: &rates, accelerations: &accelerations, gravity };
    let [by_joints, mut by_rates] = bodies::derivatives(&mut chain.g, &links, &motion);
    let n = chain.dof();
    for k in 0..n {
        let own = &mut by_rates[k * n + k];
        let viscous = viscous(chain, k);
        *own = chain.g.add(*own, viscous);
    }
    [by_joints, by_rates]
}

fn by(chain: &mut Chain, torques: &[Expr], symbol: fn(usize) -> Symbol) -> Derived {
    let symbols: Vec<Symbol> = (0..chain.dof()).map(symbol).collect();
    chain.g.derivatives(torques, &symbols).concat().into()
}

/// M⁻¹ (τ − b).
fn forward_dynamics(chain: &mut Chain) -> Derived {
    let matrix = mass_matrix(chain);
    let none = vec![Expr::ZERO; chain.dof()];
    let bias = torques(chain, none);
    let given = symbols(chain, Symbol::Torque);
    let right = given.into_iter().zip(bias).map(|(tau, b)| chain.g.sub(tau, b)).collect();
    let unknowns = symbols(chain, Symbol::Response);
    let (output, margin) = (Output::ForwardDynamics, None);
    let solve = Solve { output, matrix, right, unknowns: unknowns.clone(), margin };
    Derived { entries: unknowns, solve: Some(solve) }
}

/// ∂τ/∂π, n×10n.
fn regressor(chain: &mut Chain) -> Derived {
    let (rates, accelerations) =
        (symbols(chain, Symbol::Rate), symbols(chain, Symbol::Acceleration));
    let gravity = gravity(chain);
    let links = weightless(chain);
    let motion = Motion { rates: &rates, accelerations: &accelerations, gravity };
    regressor::regressor(&mut chain.g, &links, &motion).into()
}

/// ∂τ/∂q̈, n×n.
fn mass_matrix(chain: &mut Chain) -> Vec<Expr> {
    let links = line(chain);
    let mut mass = composite::mass_matrix(&mut chain.g, &links);
    let n = chain.dof();
    for k in 0..n {
        let rotor = rotor(chain, k);
        mass[k * n + k] = chain.g.add(mass[k * n + k], rotor);
        for row in k..n {
            chain.g.name(mass[k * n + row], || format!("m_{}{}", row + 1, k + 1));
        }
    }
    mass
}

/// In base axes, m/s².
fn gravity(chain: &mut Chain) -> Vec3 {
    chain.robot.gravity.each_ref().map(|c| expression(&mut chain.g, c))
}

fn torques(chain: &mut Chain, accelerations: Vec<Expr>) -> Vec<Expr> {
    let rates = symbols(chain, Symbol::Rate);
    let gravity = gravity(chain);
    let mut links = line(chain);
    let rotors: Vec<Expr> = (0..chain.dof()).map(|k| rotor(chain, k)).collect();
    // The first joint turns its rotor as it turns its link: one moment of inertia for both.
    let first = take_rotor(chain, &mut links[0], rotors[0]);
    let motion = Motion { rates: &rates, accelerations: &accelerations, gravity };
    let loads = newton_euler(&mut chain.g, &links, &motion);
    let each = loads.into_iter().enumerate().map(|(k, load)| {
        let rotor = if k == 0 { first } else { rotors[k] };
        let rotor = chain.g.mul(rotor, accelerations[k]);
        let moved = chain.g.add(load, rotor);
        let friction = friction(chain, k, rates[k]);
        let torque = chain.g.add(moved, friction);
        chain.g.name(torque, || format!("tau_{}", k + 1));
        torque
    });
    each.collect()
}

/// Adds a rotor's inertia to the link's about its own axis, where it is that of a turning joint; what is
/// left of it.
fn take_rotor(chain: &mut Chain, link: &mut Link, rotor: Expr) -> Expr {
    if link.slide.is_some() {
        return rotor;
    }
    let xx = &mut link.moments.second[0][0];
    *xx = chain.g.add(*xx, rotor);
    Expr::ZERO
}

/// `coulomb · sign(q̇) + viscous · q̇`.
fn friction(chain: &mut Chain, joint: usize, rate: Expr) -> Expr {
    let dry = chain.robot.joints[joint].drive.coulomb.as_ref();
    let dry = dry.map_or(Expr::ZERO, |c| expression(&mut chain.g, c));
    let viscous = viscous(chain, joint);
    let sign = if dry.is_zero() { Expr::ZERO } else { chain.g.sign(rate) };
    let (dry, viscous) = (chain.g.mul(dry, sign), chain.g.mul(viscous, rate));
    chain.g.add(dry, viscous)
}

fn viscous(chain: &mut Chain, joint: usize) -> Expr {
    let viscous = chain.robot.joints[joint].drive.viscous.as_ref();
    viscous.map_or(Expr::ZERO, |c| expression(&mut chain.g, c))
}

/// The rotor's inertia as the joint feels it, `gear² J`.
fn rotor(chain: &mut Chain, joint: usize) -> Expr {
    let drive = chain.robot.joints[joint].drive.clone();
    let Some(inertia) = drive.rotor_inertia else { return Expr::ZERO };
    let gear = drive.gear.map_or(Expr::ONE, |gear| expression(&mut chain.g, &gear));
    let inertia = expression(&mut chain.g, &inertia);
    let square = chain.g.mul(gear, gear);
    chain.g.mul(square, inertia)
}

fn symbols(chain: &mut Chain, symbol: fn(usize) -> Symbol) -> Vec<Expr> {
    (0..chain.dof()).map(|k| chain.g.symbol(symbol(k))).collect()
}
