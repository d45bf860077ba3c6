//! Symbolic derivatives: by one symbol forwards, of one expression backwards, of many by many as it costs less.

use super::graph::{Expr, Graph, Node, Symbol};

impl Graph {
    /// `∂e/∂symbol` of each expression, shared subexpressions differentiated once.
    pub fn derivative(&mut self, outputs: &[Expr], symbol: &Symbol) -> Vec<Expr> {
        self.slopes(outputs, |of| if of == symbol { Expr::ONE } else { Expr::ZERO })
    }

    /// The derivative of each expression along a direction: `along` tells how fast each symbol changes.
    pub fn slopes(&mut self, outputs: &[Expr], along: impl Fn(&Symbol) -> Expr) -> Vec<Expr> {
        let last = outputs.iter().map(|e| e.node()).max().unwrap_or(0);
        let mut slopes: Vec<Expr> = Vec::with_capacity(last + 1);
        for at in 0..=last {
            let slope = |e: Expr| slopes[e.node()].signed(e.is_negative());
            let d = match self.nodes()[at] {
                Node::Symbol(s) => along(self.symbol_of(s)),
                Node::Select(on, a, b) => self.select(on, slope(a), slope(b)),
                _ => {
                    let partials = self.partials(at).into_iter().flatten();
                    self.products(partials.map(|(operand, partial)| (slope(operand), partial)))
                }
            };
            slopes.push(d);
        }
        outputs.iter().map(|e| slopes[e.node()].signed(e.is_negative())).collect()
    }

    /// `∂output/∂symbol` for each symbol: adjoints from the output down (reverse accumulation), as many steps as
    /// the output has nodes, however many symbols there are.
    pub fn gradient(&mut self, output: Expr, symbols: &[Symbol]) -> Vec<Expr> {
        let last = output.node();
        let mut adjoints = vec![Expr::ZERO; last + 1];
        adjoints[last] = Expr::ONE.signed(output.is_negative());
        for at in (0..=last).rev() {
            let adjoint = adjoints[at];
            if adjoint.is_zero() {
                continue;
            }
            let parts = match self.nodes()[at] {
                Node::Select(on, a, b) => [
                    Some((a, self.select(on, adjoint, Expr::ZERO))),
                    Some((b, self.select(on, Expr::ZERO, adjoint))),
                ],
                _ => self.partials(at).map(|known| {
                    known.map(|(operand, partial)| (operand, self.mul(adjoint, partial)))
                }),
            };
            for (operand, part) in parts.into_iter().flatten() {
                let part = part.signed(operand.is_negative());
                let sum = self.add(adjoints[operand.node()], part);
                adjoints[operand.node()] = sum;
            }
        }
        let of = |g: &mut Graph, symbol: &Symbol| g.symbol(symbol.clone()).node();
        let nodes: Vec<usize> = symbols.iter().map(|symbol| of(self, symbol)).collect();
        nodes.into_iter().map(|at| adjoints.get(at).copied().unwrap_or_default()).collect()
    }

    /// `∂output/∂symbol`, a column for each symbol: forwards or backwards, whichever leaves fewer operations
    /// beside the outputs themselves.
    pub fn derivatives(&mut self, outputs: &[Expr], symbols: &[Symbol]) -> Vec<Vec<Expr>> {
        let forwards: Vec<Vec<Expr>> =
            symbols.iter().map(|symbol| self.derivative(outputs, symbol)).collect();
        let rows: Vec<Vec<Expr>> =
            outputs.iter().map(|output| self.gradient(*output, symbols)).collect();
        let backwards: Vec<Vec<Expr>> =
            (0..symbols.len()).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
        let cost = |columns: &[Vec<Expr>]| {
            let all: Vec<Expr> = columns.iter().flatten().chain(outputs).copied().collect();
            self.count(&all).cost()
        };
        if cost(&backwards) < cost(&forwards) { backwards } else { forwards }
    }

    /// The operands of a node that is no choice, and what it changes by with each.
    fn partials(&mut self, at: usize) -> [Option<(Expr, Expr)>; 2] {
        let here = Expr::new(at, false);
        let one = |operand: Expr, partial: Expr| [Some((operand, partial)), None];
        match self.nodes()[at] {
            // A sign is flat but for its step at zero.
            Node::Number(_) | Node::Symbol(_) | Node::Sign(_) | Node::Select(..) => [None; 2],
            Node::Add(a, b) => [a, b].map(|operand| Some((operand, Expr::ONE))),
            Node::Mul(a, b) => [Some((a, b)), Some((b, a))],
            Node::Recip(a) => one(a, -self.mul(here, here)),
            Node::Sqrt(a) => {
                let twice = self.add(here, here);
                one(a, self.recip(twice))
            }
            Node::Sin(a) => one(a, self.cos(a)),
            Node::Cos(a) => one(a, -self.sin(a)),
            Node::Atan2(y, x) => {
                let square = self.products([(y, y), (x, x)]);
                let inverse = self.recip(square);
                [Some((y, self.mul(x, inverse))), Some((x, -self.mul(y, inverse)))]
            }
        }
    }

    /// The expressions with some symbols at zero; `None` where one of them has no value there.
    pub fn at_zero(
        &mut self,
        outputs: &[Expr],
        zero: impl Fn(&Symbol) -> bool,
    ) -> Option<Vec<Expr>> {
        let reached = self.reachable(outputs);
        let mut values: Vec<Expr> = Vec::with_capacity(reached.len());
        for (at, reached) in reached.into_iter().enumerate() {
            let here = Expr::new(at, false);
            let of = |e: Expr| values[e.node()].signed(e.is_negative());
            values.push(match self.nodes()[at] {
                _ if !reached => here,
                Node::Number(_) => here,
                Node::Symbol(s) if zero(self.symbol_of(s)) => Expr::ZERO,
                Node::Symbol(_) => here,
                Node::Add(a, b) => self.add(of(a), of(b)),
                Node::Mul(a, b) => self.mul(of(a), of(b)),
                Node::Recip(a) if of(a).is_zero() => return None,
                Node::Recip(a) => self.recip(of(a)),
                Node::Sqrt(a) => self.sqrt(of(a)),
                Node::Sign(a) => self.sign(of(a)),
                Node::Sin(a) => self.sin(of(a)),
                Node::Cos(a) => self.cos(of(a)),
                Node::Atan2(y, x) => self.atan2(of(y), of(x)),
                Node::Select(on, a, b) => self.select(of(on), of(a), of(b)),
            });
        }
        Some(outputs.iter().map(|e| values[e.node()].signed(e.is_negative())).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_finite_differences() {
        let mut g = Graph::new();
        let (x, y) = (g.symbol(Symbol::Joint(0)), g.symbol(Symbol::Joint(1)));
        let sum = g.add(x, y);
        let (s, c, r, root) = (g.sin(sum), g.cos(x), g.recip(y), g.sqrt(sum));
        let product = g.mul(s, c);
        let quotient = g.mul(root, r);
        let rest = g.sub(product, quotient);
        let angle = g.atan2(rest, -s);
        let f = g.select(s, angle, rest);
        let d = g.derivative(&[f, -f], &Symbol::Joint(0));
        assert_eq!(d[0], -d[1]);
        let at = |g: &Graph, e, x: f64| {
            g.evaluate(&[e], |s| if *s == Symbol::Joint(0) { x } else { 0.7 })[0]
        };
        let h = 1e-5;
        let slope = (at(&g, f, 0.3 + h) - at(&g, f, 0.3 - h)) / (2.0 * h);
        // Central differences err by h²/6 times the third derivative, here of order 10.
        assert!((at(&g, d[0], 0.3) - slope).abs() < 1e-8);
    }

    /// A chain in which every kind of node is shared, by both ways.
    #[test]
    fn backwards_is_forwards() {
        let mut g = Graph::new();
        let symbols = [Symbol::Joint(0), Symbol::Joint(1), Symbol::Own { input: 0, entry: 2 }];
        let [x, y, z] = symbols.clone().map(|s| g.symbol(s));
        let sum = g.add(x, y);
        let (s, c) = (g.sin(sum), g.cos(sum));
        let product = g.mul(s, z);
        let square = g.mul(product, product);
        let inside = g.add(square, y);
        let root = g.sqrt(inside);
        let inverse = g.recip(root);
        let angle = g.atan2(root, -product);
        let chosen = g.select(c, angle, inverse);
        let low = g.mul(c, chosen);
        let f = g.sub(low, product);
        let value = |s: &Symbol| symbols.iter().position(|t| t == s).unwrap() as f64 + 0.3;
        for output in [f, -f, x, Expr::ONE] {
            let backwards = g.gradient(output, &symbols);
            for (symbol, backwards) in symbols.iter().zip(backwards) {
                let forwards = g.derivative(&[output], symbol)[0];
                let both = g.evaluate(&[forwards, backwards], value);
                assert!((both[0] - both[1]).abs() < 1e-15, "{both:?}");
            }
        }
        assert_eq!(g.derivatives(&[f, root], &symbols).len(), 3);
        let at = g.at_zero(&[f, root], |s| matches!(s, Symbol::Own { .. })).unwrap();
        assert_eq!(g.evaluate(&at, value)[1], 1.3_f64.sqrt());
        assert_eq!(g.at_zero(&[inverse], |_| true), None);
    }

    #[test]
    fn constants_have_no_slope() {
        let mut g = Graph::new();
        let y = g.symbol(Symbol::Joint(1));
        assert_eq!(g.derivative(&[y, Expr::ONE], &Symbol::Joint(0)), [Expr::ZERO; 2]);
    }
}
