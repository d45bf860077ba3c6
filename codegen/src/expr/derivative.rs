//! Symbolic derivative with respect to a symbol.

use super::graph::{Expr, Graph, Node, Symbol};

impl Graph {
    /// `∂e/∂symbol` of each expression, shared subexpressions differentiated once.
    pub fn derivative(&mut self, outputs: &[Expr], symbol: &Symbol) -> Vec<Expr> {
        let last = outputs.iter().map(|e| e.node()).max().unwrap_or(0);
        let mut slopes: Vec<Expr> = Vec::with_capacity(last + 1);
        for at in 0..=last {
            let here = Expr::new(at, false);
            let node = self.nodes()[at];
            let slope = |e: Expr| slopes[e.node()].signed(e.is_negative());
            let d = match node {
                Node::Number(_) => Expr::ZERO,
                Node::Symbol(s) if self.symbol_of(s) == symbol => Expr::ONE,
                Node::Symbol(_) => Expr::ZERO,
                Node::Add(a, b) => {
                    let (da, db) = (slope(a), slope(b));
                    self.add(da, db)
                }
                Node::Mul(a, b) => {
                    let (da, db) = (slope(a), slope(b));
                    let (left, right) = (self.mul(da, b), self.mul(a, db));
                    self.add(left, right)
                }
                Node::Recip(a) => {
                    let da = slope(a);
                    let square = self.mul(here, here);
                    -self.mul(da, square)
                }
                Node::Sqrt(a) => {
                    let da = slope(a);
                    let twice = self.add(here, here);
                    let inverse = self.recip(twice);
                    self.mul(da, inverse)
                }
                // Flat but for the step at zero.
                Node::Sign(_) => Expr::ZERO,
                Node::Sin(a) => {
                    let da = slope(a);
                    let cosine = self.cos(a);
                    self.mul(da, cosine)
                }
                Node::Cos(a) => {
                    let da = slope(a);
                    let sine = self.sin(a);
                    -self.mul(da, sine)
                }
            };
            slopes.push(d);
        }
        outputs.iter().map(|e| slopes[e.node()].signed(e.is_negative())).collect()
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
        let f = g.sub(product, quotient);
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

    #[test]
    fn constants_have_no_slope() {
        let mut g = Graph::new();
        let y = g.symbol(Symbol::Joint(1));
        assert_eq!(g.derivative(&[y, Expr::ONE], &Symbol::Joint(0)), [Expr::ZERO; 2]);
    }
}
