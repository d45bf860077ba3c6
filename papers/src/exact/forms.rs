//! Formulas in the generator's graph: what a paper prints and what is derived of a robot meet there.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

use num_rational::Ratio;
use stiffarm_codegen::expr::{Expr, Graph, Node, Symbol};
use stiffarm_codegen::number::Number;

use super::arithmetic::{Arithmetic, Real};
use super::field::Modular;
use crate::latex::tree::{Angle, Function, Tree};

/// What stands for the joints and the wrench of a robot's graph in a paper's notation.
#[derive(Clone, Debug, Default)]
pub struct Reading<V> {
    /// The angle of each joint.
    pub joints: Vec<Angle>,
    /// The wrench on the tool; zero where it is not given.
    pub wrench: Vec<V>,
}

impl<V: Clone> Reading<V> {
    /// The values of some expressions of a graph.
    ///
    /// # Errors
    /// Why one has none.
    pub fn values<A: Arithmetic<Value = V>>(
        &self,
        to: &A,
        graph: &Graph,
        outputs: &[Expr],
    ) -> Result<Vec<V>, A::Error> {
        let used = graph.reachable(outputs);
        let mut values: Vec<Option<V>> = vec![None; used.len()];
        for at in (0..used.len()).filter(|at| used[*at]) {
            values[at] = Some(self.node(to, graph, graph.nodes()[at], &values)?);
        }
        outputs.iter().map(|e| signed(to, &values, *e)).collect()
    }

    fn node<A: Arithmetic<Value = V>>(
        &self,
        to: &A,
        graph: &Graph,
        node: Node,
        values: &[Option<V>],
    ) -> Result<V, A::Error> {
        let of = |e: Expr| signed(to, values, e);
        let trig = |function, of| {
            let mut angle = Angle::default();
            self.collect(graph, of, 1, &mut angle)?;
            to.trig(function, &angle)
        };
        match node {
            Node::Number(Number::Exact(n)) => to.number(n),
            Node::Number(Number::Rounded(_)) => Err("a rounded constant has no exact form".into()),
            Node::Symbol(s) => match graph.symbol_of(s) {
                Symbol::Wrench(k) => {
                    self.wrench.get(*k).cloned().map_or_else(|| to.number(Ratio::from(0)), Ok)
                }
                other => to.named(&self.angle(other).ok_or(UNNAMED)?.to_string()),
            },
            Node::Add(a, b) => to.add(of(a)?, of(b)?),
            Node::Mul(a, b) => to.mul(of(a)?, of(b)?),
            Node::Recip(a) => to.div(to.number(Ratio::from(1))?, of(a)?),
            Node::Sqrt(a) => to.sqrt(of(a)?),
            Node::Sign(_) | Node::Select(..) => {
                Err("a choice by the sign of a quantity has no exact form".into())
            }
            Node::Atan2(..) => Err("the angle of a direction has no exact form".into()),
            Node::Sin(a) => trig(Function::Sin, a),
            Node::Cos(a) => trig(Function::Cos, a),
        }
    }

    /// A symbol as an angle; a prismatic joint's coordinate is a length of its own name.
    fn angle(&self, symbol: &Symbol) -> Option<Angle> {
        Some(match symbol {
            Symbol::Parameter(name) => Angle::single(name),
            Symbol::Joint(joint) => match self.joints.get(*joint) {
                Some(angle) => angle.clone(),
                None => Angle::single(&format!("q{}", joint + 1)),
            },
            // The notation of Jweeg & Al-Khafaji: `\delta x_1`, `d\phi_1`.
            Symbol::Displacement { place, component } => {
                let names = ["deltax", "deltay", "deltaz", "dpsi", "dbeta", "dphi"];
                Angle::single(&format!("{}{place}", names[*component]))
            }
            _ => return None,
        })
    }

    fn collect(
        &self,
        graph: &Graph,
        e: Expr,
        times: i64,
        into: &mut Angle,
    ) -> Result<(), &'static str> {
        let times = if e.is_negative() { -times } else { times };
        match graph.node(e) {
            Node::Symbol(s) => {
                let angle = self.angle(graph.symbol_of(s)).ok_or(UNNAMED)?;
                angle.terms().for_each(|(name, k)| into.add(name, k * times));
                Ok(())
            }
            Node::Add(a, b) => {
                self.collect(graph, a, times, into)?;
                self.collect(graph, b, times, into)
            }
            Node::Mul(a, b) => match graph.number_of(a) {
                Some(Number::Exact(n)) if n.is_integer() && n.numer().abs() < 1000 => {
                    self.collect(graph, b, times * *n.numer() as i64, into)
                }
                _ => Err(NO_ANGLE),
            },
            _ => Err(NO_ANGLE),
        }
    }
}

const UNNAMED: &str = "a quantity that no paper's notation names";
const NO_ANGLE: &str = "an angle that is no sum of angles";

fn signed<A: Arithmetic>(
    to: &A,
    values: &[Option<A::Value>],
    e: Expr,
) -> Result<A::Value, A::Error> {
    let value = values[e.node()].clone().ok_or("an operand stands behind its use")?;
    if e.is_negative() { to.sub(to.number(Ratio::from(0))?, value) } else { Ok(value) }
}

/// A graph that grows, and what names stand for in it.
#[derive(Debug, Default)]
pub struct Forms {
    graph: RefCell<Graph>,
    /// Names that stand for a formula or a derived quantity.
    pub names: HashMap<String, Expr>,
    /// What grows without bounds.
    infinite: Vec<Expr>,
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

    /// The entries of a matrix, in the limit of the symbols that grow without bounds.
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
        let mut factors = Vec::new();
        for large in &self.infinite {
            let small = self.recip(*large);
            if factors.is_empty() {
                factors = [self.factors(a), self.factors(b)].concat();
            }
            while let (Some(one), Some(other)) = (
                factors.iter().position(|factor| factor == large),
                factors.iter().position(|factor| *factor == small),
            ) {
                factors.remove(one.max(other));
                factors.remove(one.min(other));
                factors.push(Expr::ONE);
            }
        }
        let mut graph = self.graph.borrow_mut();
        if !factors.contains(&Expr::ONE) {
            return Ok(graph.mul(a, b));
        }
        let product = factors.into_iter().fold(Expr::ONE, |p, factor| graph.mul(p, factor));
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

/// What a printed equation should be: the entries of a matrix.
#[derive(Clone, Debug)]
pub struct Truth {
    graph: Graph,
    /// Number of columns.
    pub columns: usize,
    /// The entries, row by row.
    pub entries: Vec<Expr>,
    /// What names of the equation stand for.
    pub names: HashMap<String, Expr>,
}

impl Truth {
    /// One of its expressions.
    pub fn form(&self, of: Expr) -> Form<'_> {
        Form { graph: &self.graph, of }
    }

    /// What is printed, its names standing for what they stand for here; none where it is no formula
    /// of numbers.
    pub fn read(&self, tree: &Tree) -> Option<Truth> {
        let (graph, names) = (RefCell::new(self.graph.clone()), self.names.clone());
        let forms = Forms { graph, names, infinite: Vec::new() };
        let entries = vec![forms.tree(tree).ok()?];
        Some(Truth { graph: forms.graph.into_inner(), columns: 1, entries, names: forms.names })
    }
}

/// What cancels leaves rounding: no more than this part of the value, of formulas of a thousand terms.
const ROUNDING: f64 = 1e-9;

/// A formula of a graph whose symbols are all names.
#[derive(Clone, Copy, Debug)]
pub struct Form<'g> {
    graph: &'g Graph,
    of: Expr,
}

impl Form<'_> {
    /// Its value.
    ///
    /// # Errors
    /// Why it has none.
    pub fn value<A: Arithmetic>(self, to: &A) -> Result<A::Value, A::Error> {
        let reading = Reading { joints: Vec::new(), wrench: Vec::new() };
        let value = reading.values(to, self.graph, &[self.of])?.pop();
        value.ok_or_else(|| "no expression".into())
    }

    /// Its value in doubles, with values given by a function; what cancels needs none.
    ///
    /// # Errors
    /// A symbol on which it depends has no value.
    pub fn real(self, value: impl Fn(&str) -> Option<f64>) -> Result<f64, &'static str> {
        let with = |other: f64| self.value(&Real(|name: &str| value(name).or(Some(other))));
        let (one, other) = (with(0.7)?, with(1.3)?);
        let same = (one - other).abs() <= ROUNDING * one.abs().max(other.abs());
        same.then_some(one).ok_or("a symbol of the formula has no value")
    }

    fn nodes(self) -> impl Iterator<Item = Node> {
        let used = self.graph.reachable(&[self.of]);
        self.graph.nodes().iter().zip(used).filter(|(_, used)| *used).map(|(node, _)| *node)
    }

    /// Whether a square root stands in it.
    pub fn has_root(self) -> bool {
        self.nodes().any(|node| matches!(node, Node::Sqrt(_)))
    }

    /// Whether it is zero.
    pub fn is_zero(self) -> bool {
        self.value(&Modular::point(1)) == Ok(0)
    }

    /// Adds the angles and the plain symbols that its value depends on.
    pub fn names(self, angles: &mut BTreeSet<String>, symbols: &mut BTreeSet<String>) {
        let mut turned = BTreeSet::new();
        for node in self.nodes() {
            if let Node::Sin(a) | Node::Cos(a) = node {
                turned.extend(self.reached(a));
            }
        }
        for name in self.reached(self.of) {
            let (here, mut there) = (Modular::point(1), Modular::point(1));
            there.moved = Some(name.clone());
            if self.value(&here) != self.value(&there) {
                if turned.contains(&name) { &mut *angles } else { &mut *symbols }.insert(name);
            }
        }
    }

    fn reached(self, of: Expr) -> Vec<String> {
        let name = |node| match node {
            Node::Symbol(s) => match self.graph.symbol_of(s) {
                Symbol::Parameter(name) => Some(name.clone()),
                _ => None,
            },
            _ => None,
        };
        Form { of, ..self }.nodes().filter_map(name).collect()
    }
}

#[cfg(test)]
mod tests;
