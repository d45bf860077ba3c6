//! A derived set of outputs: the graph, what it stores, what it solves, and in which frame it was
//! worked out.

use core::fmt;

use super::chain::{Chain, ROW};
use super::output::Output;
use super::{compliance, deflection, frames, gravity, jacobian, parameters, stiffness, torque};
use crate::expr::{Expr, Graph, OpCount, Symbol};
use crate::robot::Robot;

/// Expressions for a set of outputs of one arm.
#[derive(Clone, Debug)]
pub struct Program {
    /// The graph that all expressions live in.
    pub graph: Graph,
    /// The outputs in the order in which they were asked for.
    pub blocks: Vec<Block>,
    /// The linear systems whose unknowns the outputs use.
    pub solves: Vec<Solve>,
    /// Boundary of the chain (0 = base, four steps a row) whose frame everything was worked out in.
    pub cut: usize,
    /// Number of joints.
    pub dof: usize,
}

/// One output's entries, column-major in [`Output::shape`].
#[derive(Clone, Debug)]
pub struct Block {
    /// Which output.
    pub output: Output,
    /// Its entries.
    pub entries: Vec<Expr>,
}

/// `matrix · unknowns = right`; the matrix is column-major.
#[derive(Clone, Debug)]
pub struct Solve {
    /// Kθ − K_C over the compliant joints.
    pub matrix: Vec<Expr>,
    /// The torques on them.
    pub right: Vec<Expr>,
    /// The symbols that stand for their deflections.
    pub unknowns: Vec<Expr>,
}

/// The load has no stable equilibrium, so the linear system of the deflection has no meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unstable;

impl fmt::Display for Unstable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the arm is not stable under this load")
    }
}

impl core::error::Error for Unstable {}

/// More joints than this, and only a few working frames are tried.
const EXHAUSTIVE: usize = 8;

/// Derives `outputs` in the working frame in which they cost least.
pub fn derive(robot: &Robot, outputs: &[Output]) -> Program {
    let cuts = Chain::cuts(robot);
    let stride = if robot.dof() <= EXHAUSTIVE { 1 } else { cuts.len().div_ceil(4) };
    let tried = cuts.iter().step_by(stride).map(|cut| derive_in(robot, outputs, *cut));
    // The first of equals wins: the frame nearest the base.
    let best = tried.min_by_key(|program| program.ops().cost());
    best.unwrap_or_else(|| derive_in(robot, outputs, 0))
}

/// Derives `outputs` with the working frame at boundary `cut`.
pub fn derive_in(robot: &Robot, outputs: &[Output], cut: usize) -> Program {
    let mut chain = Chain::new(robot, cut);
    let mut solves = Vec::new();
    let mut blocks = Vec::new();
    for &output in outputs {
        let c = &mut chain;
        let entries = match output {
            Output::Pose => frames::pose(c),
            Output::Frames => frames::frames(c),
            Output::Jacobian => jacobian::jacobian(c),
            Output::JacobianTool => jacobian::jacobian_tool(c),
            Output::ComplementaryStiffness => stiffness::complementary_stiffness(c),
            Output::JointTorque => torque::joint_torque(c),
            Output::GravityTorque => gravity::gravity_torque(c),
            Output::GravityStiffness => gravity::gravity_stiffness(c),
            Output::Compliance => compliance::compliance(c),
            Output::DeflectionFirstOrder => deflection::first_order(c),
            Output::ParameterJacobian => parameters::parameter_jacobian(c),
            Output::StiffnessRegressor => deflection::stiffness_regressor(c),
            Output::Deflection | Output::DeflectionWithGravity => {
                let weights = output == Output::DeflectionWithGravity;
                let (entries, solve) = deflection::deflection(c, weights);
                solves.extend(solve);
                entries
            }
        };
        blocks.push(Block { output, entries });
    }
    Program { graph: chain.g, blocks, solves, cut, dof: robot.dof() }
}

impl Program {
    /// Every expression that the program computes.
    pub fn roots(&self) -> Vec<Expr> {
        let solves = self.solves.iter().flat_map(|s| s.matrix.iter().chain(&s.right));
        solves.chain(self.blocks.iter().flat_map(|b| &b.entries)).copied().collect()
    }

    /// Operations beyond the solve itself.
    pub fn ops(&self) -> OpCount {
        self.graph.count(&self.roots())
    }

    /// The working frame in words.
    pub fn frame(&self) -> String {
        match (self.cut / ROW, self.cut % ROW) {
            (0, 0) => "base axes".to_string(),
            (row, 0) => format!("the axes of frame {row}"),
            (row, _) => format!("the axes of frame {} turned by joint {}", row, row + 1),
        }
    }

    /// Evaluates every block at joint values `q`, under `wrench`, with the parameters' values.
    ///
    /// # Errors
    /// [`Unstable`] where a deflection has no stable equilibrium.
    pub fn evaluate(
        &self,
        q: &[f64],
        wrench: &[f64; 6],
        parameter: impl Fn(&str) -> f64,
    ) -> Result<Vec<Vec<f64>>, Unstable> {
        let mut solved: Vec<(Expr, f64)> = Vec::new();
        let value = |symbol: &Symbol, solved: &[(Expr, f64)]| match symbol {
            Symbol::Joint(joint) => q[*joint],
            Symbol::Wrench(component) => wrench[*component],
            Symbol::Parameter(name) => parameter(name),
            Symbol::Deflection { .. } => {
                let mut graph_symbol = solved.iter().filter(|(e, _)| {
                    matches!(self.graph.node(*e), crate::expr::Node::Symbol(s)
                        if self.graph.symbol_of(s) == symbol)
                });
                graph_symbol.next().map_or(0.0, |(_, x)| *x)
            }
        };
        for solve in &self.solves {
            let inputs: Vec<Expr> = solve.matrix.iter().chain(&solve.right).copied().collect();
            let mut values = self.graph.evaluate(&inputs, |s| value(s, &solved));
            let right = values.split_off(solve.matrix.len());
            let x = eliminate(values, right)?;
            solved.extend(solve.unknowns.iter().copied().zip(x));
        }
        let blocks = self.blocks.iter();
        Ok(blocks.map(|b| self.graph.evaluate(&b.entries, |s| value(s, &solved))).collect())
    }
}

/// Gaussian elimination of a column-major system whose symmetric part is positive definite.
fn eliminate(mut a: Vec<f64>, mut b: Vec<f64>) -> Result<Vec<f64>, Unstable> {
    let n = b.len();
    for k in 0..n {
        let pivot = a[k * n + k];
        if !pivot.is_finite() || pivot <= 0.0 {
            return Err(Unstable);
        }
        for i in k + 1..n {
            let factor = a[k * n + i] / pivot;
            for c in k + 1..n {
                a[c * n + i] -= factor * a[c * n + k];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] /= a[k * n + k];
        for i in 0..k {
            b[i] -= a[k * n + i] * b[k];
        }
    }
    Ok(b)
}
