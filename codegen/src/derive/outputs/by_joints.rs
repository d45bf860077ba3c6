//! Derivatives by the joint values, from the graph's own: of the Jacobian, of the compliance, of the deflection.

use stiffarm_kernels::Output;

use super::compliance::compliance;
use super::deflection::deflection;
use super::jacobian::jacobian;
use super::{Derivation, Derived};
use crate::derive::chain::Chain;
use crate::expr::{Expr, Symbol};

/// The outputs of this file.
pub(super) const DERIVED: &[(Output, Derivation)] = &[
    (Output::Hessian, hessian),
    (Output::JacobianRate, jacobian_rate),
    (Output::ComplianceByJoints, compliance_by_joints),
    (Output::DeflectionByJoints, deflection_by_joints),
];

/// ∂J/∂q_i, n matrices 6×n, base axes.
fn hessian(chain: &mut Chain) -> Derived {
    let entries = jacobian(chain).entries;
    by_joints(chain, &entries).into()
}

/// J̇ = Σ ∂J/∂q_i q̇_i, 6×n, base axes: one derivative along the rates.
fn jacobian_rate(chain: &mut Chain) -> Derived {
    let entries = jacobian(chain).entries;
    let rates: Vec<Expr> = (0..chain.dof()).map(|j| chain.g.symbol(Symbol::Rate(j))).collect();
    let along = |symbol: &Symbol| match symbol {
        Symbol::Joint(joint) => rates[*joint],
        _ => Expr::ZERO,
    };
    chain.g.slopes(&entries, along).into()
}

/// ∂C/∂q_i, n matrices 6×6, base axes.
fn compliance_by_joints(chain: &mut Chain) -> Derived {
    let entries = compliance(chain).entries;
    by_joints(chain, &entries).into()
}

/// ∂δd/∂q_i, 6×n, base axes. The joints' deflections x solve A x = τ; differentiated, A ∂x/∂q_i = ∂τ/∂q_i − ∂A/∂q_i x:
/// the same system with other right-hand sides, solved in the graph once the load was found to be borne.
fn deflection_by_joints(chain: &mut Chain) -> Derived {
    let Derived { entries, solve } = deflection(chain, Output::DeflectionByJoints);
    let Some(solve) = solve else { return by_joints(chain, &entries).into() };
    let n = solve.right.len();
    let rights: Vec<Vec<Expr>> = (0..chain.dof())
        .map(|joint| {
            let symbol = Symbol::Joint(joint);
            let matrix = chain.g.derivative(&solve.matrix, &symbol);
            let mut right = chain.g.derivative(&solve.right, &symbol);
            for (column, unknown) in solve.unknowns.iter().enumerate() {
                for (row, right) in right.iter_mut().enumerate() {
                    let part = chain.g.mul(matrix[column * n + row], *unknown);
                    *right = chain.g.sub(*right, part);
                }
            }
            right
        })
        .collect();
    let moved = chain.g.eliminated(&solve.matrix, rights);
    // The unknowns are those of the joints that have springs, base to tip.
    let springs = chain.robot.joints.iter().enumerate().filter(|(_, j)| j.stiffness.is_some());
    let joints: Vec<usize> = springs.map(|(joint, _)| joint).collect();
    let mut columns = Vec::with_capacity(6 * chain.dof());
    for (joint, moved) in moved.into_iter().enumerate() {
        let along = |symbol: &Symbol| match symbol {
            Symbol::Joint(of) if *of == joint => Expr::ONE,
            Symbol::Deflection { joint, .. } => {
                joints.iter().position(|of| of == joint).map_or(Expr::ZERO, |at| moved[at])
            }
            _ => Expr::ZERO,
        };
        columns.extend(chain.g.slopes(&entries, along));
    }
    Derived { entries: columns, solve: Some(solve) }
}

/// The derivatives of `entries` by each joint value, one after the other.
fn by_joints(chain: &mut Chain, entries: &[Expr]) -> Vec<Expr> {
    (0..chain.dof()).flat_map(|j| chain.g.derivative(entries, &Symbol::Joint(j))).collect()
}
