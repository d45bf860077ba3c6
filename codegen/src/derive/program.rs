//! A derived set of outputs: the graph, what it stores, what it solves, and in which frame it was
//! worked out.

use num_traits::Float;
use stiffarm_kernels::{Output, Unstable};

use super::chain::ROW;
use super::readings::{Given, Readings};
use crate::expr::{Expr, Graph, OpCount, Symbol};
use crate::number::Number;

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
    /// What the joint values are that its joints stand for.
    pub readings: Readings,
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
    /// Force and moment, N and N·m, within whose ellipsoid every load is borne in every posture, so that the
    /// test of stability can be left out; where the table says them.
    pub margin: Option<[Number; 2]>,
}

impl Solve {
    /// Size of the leading block, whose unknowns are solved for together: nothing depends on the others,
    /// so that each follows from its own row. A tool on the axis of the last joint is not moved by it.
    pub fn leading(&self) -> usize {
        let n = self.right.len();
        let diagonal = |column: usize| {
            let entries = self.matrix[column * n..(column + 1) * n].iter().enumerate();
            entries.filter(|(row, _)| *row != column).all(|(_, e)| e.is_zero())
        };
        (1..n).rev().take_while(|column| diagonal(*column)).last().unwrap_or(n)
    }
}

impl Program {
    /// Every expression that the program computes.
    pub fn roots(&self) -> Vec<Expr> {
        let outputs: Vec<Output> = self.blocks.iter().map(|b| b.output).collect();
        self.roots_of(&outputs)
    }

    /// What it computes for some of its outputs.
    pub(super) fn roots_of(&self, outputs: &[Output]) -> Vec<Expr> {
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

    /// Evaluates every block at readings `q`, under `wrench`, with the parameters' values.
    ///
    /// # Errors
    /// [`Unstable`] where a deflection has no stable equilibrium.
    pub fn evaluate<T: Float>(
        &self,
        q: &[T],
        wrench: &[T; 6],
        parameter: impl Fn(&str) -> T,
    ) -> Result<Vec<Vec<T>>, Unstable> {
        self.evaluate_given(q, wrench, parameter, &Given::default())
    }

    /// The same of joints that came from some sides, of an arm that has warmed.
    ///
    /// # Errors
    /// [`Unstable`] where a deflection has no stable equilibrium.
    pub fn evaluate_given<T: Float>(
        &self,
        q: &[T],
        wrench: &[T; 6],
        parameter: impl Fn(&str) -> T,
        given: &Given,
    ) -> Result<Vec<Vec<T>>, Unstable> {
        let (q, growth) = self.readings.evaluate(q, given);
        let mut solved: Vec<(Expr, T)> = Vec::new();
        let value = |symbol: &Symbol, solved: &[(Expr, T)]| match symbol {
            Symbol::Joint(joint) => q[*joint],
            Symbol::Wrench(component) => wrench[*component],
            Symbol::Parameter(name) => parameter(name),
            Symbol::Growth => growth,
            Symbol::Side(_) | Symbol::Warming => given.value(symbol),
            // An undisplaced chain; no output of a table has displacements.
            Symbol::Displacement { .. } => T::zero(),
            Symbol::Deflection { .. } => {
                let known = solved.iter().find(|(e, _)| {
                    matches!(self.graph.node(*e), crate::expr::Node::Symbol(s)
                        if self.graph.symbol_of(s) == symbol)
                });
                known.map_or_else(T::zero, |(_, x)| *x)
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
fn eliminate<T: Float>(mut a: Vec<T>, mut b: Vec<T>) -> Result<Vec<T>, Unstable> {
    let n = b.len();
    let mut symmetric: Vec<T> = (0..n * n).map(|at| a[at] + a[at % n * n + at / n]).collect();
    reduce(&mut symmetric, &mut vec![T::zero(); n])?;
    reduce(&mut a, &mut b)?;
    for k in (0..n).rev() {
        b[k] = b[k] / a[k * n + k];
        for i in 0..k {
            b[i] = b[i] - a[k * n + i] * b[k];
        }
    }
    Ok(b)
}

/// The system as a triangular one.
fn reduce<T: Float>(a: &mut [T], b: &mut [T]) -> Result<(), Unstable> {
    let n = b.len();
    for k in 0..n {
        let pivot = a[k * n + k];
        if !pivot.is_finite() || pivot <= T::zero() {
            return Err(Unstable);
        }
        for i in k + 1..n {
            let factor = a[k * n + i] / pivot;
            for c in k + 1..n {
                a[c * n + i] = a[c * n + i] - factor * a[c * n + k];
            }
            b[i] = b[i] - factor * b[k];
        }
    }
    Ok(())
}
