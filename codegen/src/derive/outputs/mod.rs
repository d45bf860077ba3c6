//! The outputs' derivations: one file for each family, with a row for each of its outputs.

mod beam;
mod by_joints;
mod compliance;
mod deflection;
mod dynamics;
mod frames;
mod jacobian;
mod manipulability;
mod margin;
mod parameters;
mod springs;
mod stiffness;
mod torque;
mod weight;

pub(super) use deflection::gives;
use stiffarm_kernels::Output;

use super::chain::Chain;
use super::program::Solve;
use crate::expr::Expr;

/// An output of one arm as expressions.
pub struct Derived {
    /// Its entries, column-major in [`Output::shape`].
    pub entries: Vec<Expr>,
    /// The linear system whose unknowns they use.
    pub solve: Option<Solve>,
}

impl From<Vec<Expr>> for Derived {
    fn from(entries: Vec<Expr>) -> Self {
        Derived { entries, solve: None }
    }
}

/// How an output is derived.
pub type Derivation = fn(&mut Chain) -> Derived;

/// By output, from the tables of this folder's files; an output without a derivation does not compile.
const DERIVATIONS: [Derivation; Output::EACH.len()] = Output::one_each(&[
    by_joints::DERIVED,
    compliance::DERIVED,
    deflection::DERIVED,
    dynamics::DERIVED,
    frames::DERIVED,
    jacobian::DERIVED,
    manipulability::DERIVED,
    parameters::DERIVED,
    stiffness::DERIVED,
    torque::DERIVED,
    weight::DERIVED,
]);

/// Derives an output.
pub fn derived(chain: &mut Chain, output: Output) -> Derived {
    DERIVATIONS[output as usize](chain)
}
