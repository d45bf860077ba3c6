//! Formulas in the generator's graph: what a paper prints and what is derived of a robot meet there.

use std::cell::RefCell;
use std::collections::HashMap;

use nalgebra::DMatrix;
use num_rational::Ratio;
use stiffarm_codegen::expr::{Expr, Graph, Node, Symbol};
use stiffarm_codegen::number::Number;

use super::arithmetic::Arithmetic;
use super::field::Modular;
use super::truth::{Form, Truth};
use crate::latex::tree::{Angle, Function, Tree};

/// A graph that grows, and what names stand for in it.
#[derive(Debug, Default)]
pub struct Forms {
    pub(super) graph: RefCell<Graph>,
    /// Names that stand for a formula or a derived quantity.
    pub names: HashMap<String, Expr>,
    /// What grows without bounds.
    pub(super) infinite: Vec<Expr>,
}

/// The degree above which an integrand counts as no polynomial.
const HIGHEST: usize = 12;

/// What a symbol that grows without bounds is the reciprocal of.
const VANISHING: &str = "1/";

impl Forms {
    /// With definitions, each of which may use those before it, and symbols that grow without bounds.
    ///
    /// # Errors
    /// Which definition has no value, and why.
    pub fn new(defined: &[(String, Tree)], infinite: &[String]) -> Result<Self, String> {
        let graph = RefCell::new(Graph::new());
        let mut out = Forms { graph, ..Forms::default() };
        for name in infinite {
            let small = out.named(&format!("{VANISHING}{name}"))?;
            let large = out.recip(small);
            out.infinite.push(large);
            out.names.insert(name.clone(), large);
        }
        for (name, tree) in defined {
            let value = out.tree(tree).map_err(|why| format!("`{name}`: {why}"))?;
            out.names.insert(name.clone(), value);
        }
        Ok(out)
    }

    /// Reciprocals of products are products of reciprocals: a factor that grows without bounds then
    /// shows as one that vanishes.
    fn recip(&self, a: Expr) -> Expr {
        let node = self.graph.borrow().node(a);
        let Node::Mul(x, y) = node else { return self.graph.borrow_mut().recip(a) };
        let (x, y) = (self.recip(x), self.recip(y));
        self.graph.borrow_mut().mul(x, y).signed(a.is_negative())
    }

    /// The factors of a product, without their signs.
    fn factors(&self, product: Expr) -> Vec<Expr> {
        let (graph, mut open, mut out) = (self.graph.borrow(), vec![product.abs()], Vec::new());
        while let Some(factor) = open.pop() {
            match graph.node(factor) {
                Node::Mul(x, y) => open.extend([x, y]),
                _ => out.push(factor),
            }
        }
        out
    }

    /// The root of a product of squares of numbers and plain symbols, which are taken as positive.
    fn root(&self, a: Expr) -> Option<Expr> {
        let mut factors = self.factors(a);
        factors.sort();
        let mut graph = self.graph.borrow_mut();
        let (mut root, mut single) = (Expr::ONE, None);
        for factor in factors {
            if let Node::Number(_) = graph.node(factor) {
                let number = graph.sqrt(factor);
                graph.number_of(number)?;
                root = graph.mul(root, number);
                continue;
            }
            let symbol = match graph.node(factor) {
                Node::Recip(inner) => graph.node(inner),
                node => node,
            };
            single = match (symbol, single) {
                (Node::Symbol(_), None) => Some(factor),
                (Node::Symbol(_), Some(same)) if same == factor => {
                    root = graph.mul(root, factor);
                    None
                }
                _ => return None,
            };
        }
        (single.is_none() && !a.is_negative()).then_some(root)
    }

    /// [`Forms::truth`] of a whole matrix.
    pub(crate) fn truth_of(self, matrix: &DMatrix<Expr>) -> Result<Truth, String> {
        self.truth(matrix.ncols(), matrix.transpose().as_slice().to_vec())
    }

    /// The entries of a matrix, row by row, in the limit of the symbols that grow without bounds.
    ///
    /// # Errors
    /// There is no limit.
    pub fn truth(mut self, columns: usize, entries: Vec<Expr>) -> Result<Truth, String> {
        let vanishes =
            |s: &Symbol| matches!(s, Symbol::Parameter(name) if name.starts_with(VANISHING));
        let limit = self.graph.get_mut().at_zero(&entries, vanishes);
        let entries =
            limit.ok_or("the equation grows with a symbol that is said to be infinite")?;
        Ok(Truth { graph: self.graph.into_inner(), columns, entries, names: self.names })
    }

    /// `∫ body` of a polynomial, by its Taylor series at zero.
    fn integral(&self, body: Expr, over: &str, ends: [Expr; 2]) -> Result<Expr, &'static str> {
        let symbol = Symbol::Parameter(over.to_owned());
        let (mut slope, mut sum, mut factorial) = (body, Expr::ZERO, Ratio::from(1));
        for power in 0..=HIGHEST {
            let graph = self.graph.borrow().clone();
            let form = Form { graph: &graph, of: slope };
            if (1..=3).all(|seed| form.value(&Modular::point(seed)) == Ok(0)) {
                return Ok(sum);
            }
            let at_zero = self.graph.borrow_mut().at_zero(&[slope], |s| *s == symbol);
            let [coefficient] = at_zero.ok_or(NO_POLYNOMIAL)?[..] else {
                return Err(NO_POLYNOMIAL);
            };
            let powers = i32::try_from(power + 1).map_err(|_| NO_POLYNOMIAL)?;
            let [low, high] = ends.map(|end| self.power(end, powers));
            factorial *= i128::from(powers);
            let rise = self.mul(coefficient, self.sub(high?, low?)?)?;
            sum = self.add(sum, self.mul(rise, self.number(factorial.recip())?)?)?;
            slope = self.graph.borrow_mut().derivative(&[slope], &symbol)[0];
        }
        Err(NO_POLYNOMIAL)
    }
}

const NO_POLYNOMIAL: &str = "an integral of what is no polynomial in the variable";

impl Arithmetic for Forms {
    type Value = Expr;
    type Error = &'static str;

    fn number(&self, n: Ratio<i128>) -> Result<Expr, &'static str> {
        Ok(self.graph.borrow_mut().number(Number::Exact(n)))
    }

    fn named(&self, key: &str) -> Result<Expr, &'static str> {
        let symbol = || self.graph.borrow_mut().symbol(Symbol::Parameter(key.to_owned()));
        Ok(self.names.get(key).copied().unwrap_or_else(symbol))
    }

    fn trig(&self, function: Function, angle: &Angle) -> Result<Expr, &'static str> {
        let mut graph = self.graph.borrow_mut();
        let mut sum = Expr::ZERO;
        for (name, times) in angle.terms() {
            let symbol = graph.symbol(Symbol::Parameter(name.to_owned()));
            let times = graph.number(Number::integer(times.into()));
            let term = graph.mul(times, symbol);
            sum = graph.add(sum, term);
        }
        Ok(if function == Function::Sin { graph.sin(sum) } else { graph.cos(sum) })
    }

    fn add(&self, a: Expr, b: Expr) -> Result<Expr, &'static str> {
        Ok(self.graph.borrow_mut().add(a, b))
    }

    fn sub(&self, a: Expr, b: Expr) -> Result<Expr, &'static str> {
        Ok(self.graph.borrow_mut().sub(a, b))
    }

    /// What grows without bounds takes away what vanishes with it, wherever it stands in the product.
    fn mul(&self, a: Expr, b: Expr) -> Result<Expr, &'static str> {
        let mut left = match self.infinite.is_empty() {
            true => Vec::new(),
            false => [self.factors(a), self.factors(b)].concat(),
        };
        let all = left.len();
        for large in &self.infinite {
            let small = self.recip(*large);
            while let (Some(one), Some(other)) = (
                left.iter().position(|factor| factor == large),
                left.iter().position(|factor| *factor == small),
            ) {
                left.remove(one.max(other));
                left.remove(one.min(other));
            }
        }
        let mut graph = self.graph.borrow_mut();
        if left.len() == all {
            return Ok(graph.mul(a, b));
        }
        let product = left.into_iter().fold(Expr::ONE, |p, factor| graph.mul(p, factor));
        Ok(product.signed(a.is_negative() != b.is_negative()))
    }

    fn div(&self, a: Expr, b: Expr) -> Result<Expr, &'static str> {
        if b.is_zero() { Err("a division by zero") } else { self.mul(a, self.recip(b)) }
    }

    fn sqrt(&self, a: Expr) -> Result<Expr, &'static str> {
        match self.root(a) {
            Some(root) => Ok(root),
            None => Ok(self.graph.borrow_mut().sqrt(a)),
        }
    }

    fn other(&self, tree: &Tree) -> Result<Expr, &'static str> {
        match tree {
            Tree::Derivative(body, by) => {
                let (body, by) = (self.tree(body)?, Symbol::Parameter(by.key.clone()));
                Ok(self.graph.borrow_mut().derivative(&[body], &by)[0])
            }
            Tree::Integral { body, over, ends } => {
                let ends = [self.tree(&ends.0)?, self.tree(&ends.1)?];
                self.integral(self.tree(body)?, over, ends)
            }
            _ => Err("it is of matrices"),
        }
    }
}

#[cfg(test)]
mod tests;
