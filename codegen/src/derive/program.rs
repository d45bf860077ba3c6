//! A derived set of outputs: the graph, what it stores, what it solves, and in which frame it was
//! worked out.

use num_traits::Float;
use stiffarm_kernels::{Input, Output, Unstable};

use super::chain::ROW;
use super::own::{Held, Own};
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
    /// What it says of itself, where it is a function of one's own.
    pub own: Option<Own>,
}

/// The entries of one output or result, column-major in [`Held::shape`].
#[derive(Clone, Debug)]
pub struct Block {
    /// Which one.
    pub held: Held,
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
    /// Matrix and right-hand side.
    pub fn inputs(&self) -> impl Iterator<Item = &Expr> {
        self.matrix.iter().chain(&self.right)
    }

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
        let systems = self.solves.iter().flat_map(Solve::inputs);
        systems.chain(self.blocks.iter().flat_map(|b| &b.entries)).copied().collect()
    }

    /// What it computes for some of its outputs.
    pub(super) fn roots_of(&self, outputs: &[Output]) -> Vec<Expr> {
        let solves = self.solves.iter().filter(|s| outputs.contains(&s.output));
        let asked = |block: &&Block| block.held.output().is_some_and(|o| outputs.contains(&o));
        let blocks = self.blocks.iter().filter(asked);
        solves.flat_map(Solve::inputs).chain(blocks.flat_map(|b| &b.entries)).copied().collect()
    }

    /// What is given to some output, or enters a function of one's own, in the order of arguments.
    pub fn inputs(&self) -> impl Iterator<Item = Input> {
        let reached = self.own.as_ref().map(|_| self.graph.reachable(&self.roots()));
        let entered = reached.map(|reached| {
            let nodes = reached.into_iter().enumerate().filter(|(_, reached)| *reached);
            let inputs = nodes.filter_map(|(at, _)| Some(self.graph.symbol_at(at)?.input()?.0));
            inputs.chain([Input::Joints]).collect::<Vec<Input>>()
        });
        let taken = move |input: &Input| match &entered {
            Some(entered) => entered.contains(input),
            None => self.blocks.iter().any(|b| b.held.output().is_some_and(|o| o.takes(*input))),
        };
        Input::EACH.into_iter().filter(taken)
    }

    /// Operations beyond the solve itself.
    pub fn ops(&self) -> OpCount {
        self.graph.count(&self.roots())
    }

    /// The working frame in words.
    pub fn frame(&self) -> String {
        if self.blocks.iter().all(|block| block.held.output().is_some_and(Output::is_of_motion)) {
            return "the links' own axes".to_string();
        }
        match (self.cut / ROW, self.cut % ROW) {
            (0, 0) => "base axes".to_string(),
            (row, 0) => format!("the axes of frame {row}"),
            (row, _) => format!("the axes of frame {} turned by joint {}", row, row + 1),
        }
    }

    /// Evaluates every block at a state, under `wrench`, with the parameters' values. The state is the
    /// readings and behind them rates, accelerations and torques as far as some block takes them, in the
    /// order of [`Input::EACH`].
    ///
    /// # Errors
    /// [`Unstable`] where a system has no solution: a deflection no stable equilibrium, an acceleration no mass.
    pub fn evaluate<T: Float>(
        &self,
        state: &[T],
        wrench: &[T; 6],
        parameter: impl Fn(&str) -> T,
    ) -> Result<Vec<Vec<T>>, Unstable> {
        self.evaluate_given(state, wrench, parameter, &Given::default())
    }

    /// The same of joints that came from some sides, of an arm that has warmed.
    ///
    /// # Errors
    /// [`Unstable`] where a deflection has no stable equilibrium.
    pub fn evaluate_given<T: Float>(
        &self,
        state: &[T],
        wrench: &[T; 6],
        parameter: impl Fn(&str) -> T,
        given: &Given,
    ) -> Result<Vec<Vec<T>>, Unstable> {
        let joints = self.readings.evaluate(state, given);
        self.evaluate_joints(&joints, state, wrench, parameter, given)
    }

    /// The same at joint values, and with all lengths so much larger.
    pub(super) fn evaluate_joints<T: Float>(
        &self,
        (q, growth): &(Vec<T>, T),
        state: &[T],
        wrench: &[T; 6],
        parameter: impl Fn(&str) -> T,
        given: &Given,
    ) -> Result<Vec<Vec<T>>, Unstable> {
        let mut solved: Vec<(Expr, T)> = Vec::new();
        let taken: Vec<Input> = self.inputs().collect();
        let joints = |input: Input| {
            let at = taken.iter().position(|known| *known == input).unwrap_or(0);
            &state[at * self.dof..]
        };
        let value = |symbol: &Symbol, solved: &[(Expr, T)]| match symbol {
            Symbol::Joint(k) => q[*k],
            Symbol::Rate(k) => joints(Input::Rates)[*k],
            Symbol::Acceleration(k) => joints(Input::Accelerations)[*k],
            Symbol::Torque(k) => joints(Input::Torques)[*k],
            Symbol::Wrench(component) => wrench[*component],
            Symbol::Parameter(name) => parameter(name),
            Symbol::Growth => *growth,
            Symbol::Side(_) | Symbol::Warming => given.value(symbol),
            // An undisplaced chain; no output of a table has displacements or inputs of one's own.
            Symbol::Displacement { .. } | Symbol::Own { .. } => T::zero(),
            Symbol::Deflection { .. } | Symbol::Response(_) => {
                let is = |e: Expr| self.graph.symbol_at(e.node()) == Some(symbol);
                let known = solved.iter().find(|(e, _)| is(*e));
                known.map_or_else(T::zero, |(_, x)| *x)
            }
        };
        for solve in &self.solves {
            let inputs: Vec<Expr> = solve.inputs().copied().collect();
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
