//! A derived set of outputs: the graph, what it stores, what it solves, and in which frame it was
//! worked out.

use core::fmt;

use super::chain::{Chain, ROW};
use super::output::Output;
use super::passes::Passes;
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
    /// The output that it is for.
    pub output: Output,
    /// Kθ − K_C over the compliant joints.
    pub matrix: Vec<Expr>,
    /// The torques on them.
    pub right: Vec<Expr>,
    /// The symbols that stand for their deflections.
    pub unknowns: Vec<Expr>,
}

impl Solve {
    /// How many unknowns, the first ones, are to be solved for together: on the others nothing depends, so
    /// that each follows from its own row. A tool on the axis of the last joint is not moved by it.
    pub fn together(&self) -> usize {
        let n = self.right.len();
        let alone = |column: usize| {
            let entries = self.matrix[column * n..(column + 1) * n].iter().enumerate();
            entries.filter(|(row, _)| *row != column).all(|(_, e)| e.is_zero())
        };
        (1..n).rev().take_while(|column| alone(*column)).last().unwrap_or(n)
    }
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

/// Derives `outputs` in the way in which they cost least.
pub fn derive(robot: &Robot, outputs: &[Output]) -> Program {
    derive_with(robot, outputs, Passes::ALL)
}

/// The same with some of the passes switched off.
pub fn derive_with(robot: &Robot, outputs: &[Output], passes: Passes) -> Program {
    let way = best_ways(robot, &[outputs], passes)[0];
    derive_by(robot, outputs, way)
}

/// Derives each of several sets of outputs in the way in which it costs least.
pub fn derive_each(robot: &Robot, sets: &[&[Output]]) -> Vec<Program> {
    let ways = best_ways(robot, sets, Passes::ALL);
    sets.iter().zip(ways).map(|(outputs, way)| derive_by(robot, outputs, way)).collect()
}

/// Derives `outputs` with the working frame at boundary `cut`, twists from the axes of the frames.
pub fn derive_in(robot: &Robot, outputs: &[Output], cut: usize) -> Program {
    derive_by(robot, outputs, Way { cut, passes: Passes { runs: false, ..Passes::ALL } })
}

/// One way to work things out: in which frame, and twists run by run or not.
#[derive(Clone, Copy)]
struct Way {
    cut: usize,
    passes: Passes,
}

/// The cheapest way for each set: every frame is laid out once, with all outputs in it; run by run only
/// those that are then the cheapest of some set.
fn best_ways(robot: &Robot, sets: &[&[Output]], passes: Passes) -> Vec<Way> {
    let cuts = if passes.frame { Chain::cuts(robot) } else { vec![0] };
    let stride = if robot.dof() <= EXHAUSTIVE { 1 } else { cuts.len().div_ceil(4) };
    let plain = Passes { runs: false, ..passes };
    let mut best = vec![(u32::MAX, Way { cut: 0, passes: plain }); sets.len()];
    for cut in cuts.into_iter().step_by(stride) {
        try_way(robot, sets, Way { cut, passes: plain }, &mut best);
    }
    if passes.runs {
        let mut cuts: Vec<usize> = best.iter().map(|(_, way)| way.cut).collect();
        cuts.sort_unstable();
        cuts.dedup();
        for cut in cuts {
            try_way(robot, sets, Way { cut, passes }, &mut best);
        }
    }
    best.into_iter().map(|(_, way)| way).collect()
}

/// Takes a way for the sets that cost less in it. The first of equals stays: the frame nearest the base.
/// Run by run is for the sets whose frame it is already, so that a set's way does not depend on the
/// other sets.
fn try_way(robot: &Robot, sets: &[&[Output]], way: Way, best: &mut [(u32, Way)]) {
    let mut wanted: Vec<Output> = sets.iter().flat_map(|set| set.iter().copied()).collect();
    wanted.sort_unstable();
    wanted.dedup();
    let laid_out = derive_by(robot, &wanted, way);
    let free = laid_out.graph.parameter_only();
    for (set, best) in sets.iter().zip(best) {
        let cost = laid_out.graph.count_without(&free, &laid_out.roots_of(set)).cost();
        if cost < best.0 && (!way.passes.runs || way.cut == best.1.cut) {
            *best = (cost, way);
        }
    }
}

fn derive_by(robot: &Robot, outputs: &[Output], Way { cut, passes }: Way) -> Program {
    let mut chain = Chain::new(robot, cut, passes);
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
        let outputs: Vec<Output> = self.blocks.iter().map(|b| b.output).collect();
        self.roots_of(&outputs)
    }

    /// What it computes for some of its outputs.
    fn roots_of(&self, outputs: &[Output]) -> Vec<Expr> {
        let solves = self.solves.iter().filter(|s| outputs.contains(&s.output));
        let blocks = self.blocks.iter().filter(|b| outputs.contains(&b.output));
        let systems = solves.flat_map(|s| s.matrix.iter().chain(&s.right));
        systems.chain(blocks.flat_map(|b| &b.entries)).copied().collect()
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
            // An undisplaced chain; no output of a table has displacements.
            Symbol::Displacement { .. } => 0.0,
            Symbol::Deflection { .. } => {
                let known = solved.iter().find(|(e, _)| {
                    matches!(self.graph.node(*e), crate::expr::Node::Symbol(s)
                        if self.graph.symbol_of(s) == symbol)
                });
                known.map_or(0.0, |(_, x)| *x)
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
    let mut symmetric: Vec<f64> = (0..n * n).map(|at| a[at] + a[at % n * n + at / n]).collect();
    reduce(&mut symmetric, &mut vec![0.0; n])?;
    reduce(&mut a, &mut b)?;
    for k in (0..n).rev() {
        b[k] /= a[k * n + k];
        for i in 0..k {
            b[i] -= a[k * n + i] * b[k];
        }
    }
    Ok(b)
}

/// The system as a triangular one.
fn reduce(a: &mut [f64], b: &mut [f64]) -> Result<(), Unstable> {
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
    Ok(())
}
