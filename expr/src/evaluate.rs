//! Numeric evaluation: the graph read as a program for doubles or singles.

use num_traits::Float;

use super::graph::{Expr, Graph, Node, Symbol};

impl Graph {
    /// The values of `outputs` with each symbol replaced by what `value` says. The trigonometry is the
    /// standard library's, so that an evaluation shares nothing with the kernels that it checks.
    pub fn evaluate<T: Float>(&self, outputs: &[Expr], value: impl Fn(&Symbol) -> T) -> Vec<T> {
        let last = outputs.iter().map(|e| e.node()).max().unwrap_or(0);
        let mut values: Vec<T> = Vec::with_capacity(last + 1);
        let signed = |values: &[T], e: Expr| {
            let x = values[e.node()];
            if e.is_negative() { -x } else { x }
        };
        for node in &self.nodes()[..=last] {
            let of = |e| signed(&values, e);
            let x = match *node {
                Node::Number(n) => from(n.to_f64()),
                Node::Symbol(s) => value(self.symbol_of(s)),
                Node::Add(a, b) => of(a) + of(b),
                Node::Mul(a, b) => of(a) * of(b),
                Node::Recip(a) => of(a).recip(),
                Node::Sqrt(a) => of(a).sqrt(),
                Node::Sign(a) if of(a).is_zero() => T::zero(),
                Node::Sign(a) => of(a).signum(),
                Node::Sin(a) => of(a).sin(),
                Node::Cos(a) => of(a).cos(),
                // The sum has no negative zero, whose angle would be −π.
                Node::Atan2(y, x) => (of(y) + T::zero()).atan2(of(x)),
                Node::Select(on, a, _) if of(on) > T::zero() => of(a),
                Node::Select(_, _, b) => of(b),
            };
            values.push(x);
        }
        outputs.iter().map(|e| signed(&values, *e)).collect()
    }
}

/// The nearest number of the type.
pub fn from<T: Float>(x: f64) -> T {
    T::from(x).unwrap_or_else(T::nan)
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm_table::number::Number;

    #[test]
    fn evaluates_every_kind_of_node() {
        let mut g = Graph::new();
        let x = g.symbol(Symbol::Joint(0));
        let half = g.number(Number::ratio(1, 2));
        let sum = g.sub(half, x);
        let (s, c) = (g.sin(x), g.cos(x));
        let (angle, larger) = (g.atan2(-half, -x), g.select(sum, sum, -x));
        let outputs = [sum, g.mul(-s, c), g.recip(x), g.sqrt(x), angle, larger];
        let values = g.evaluate(&outputs, |_| 2.0);
        let angle = 0.25f64.atan() - core::f64::consts::PI;
        let expected = [-1.5, -(2f64.sin() * 2f64.cos()), 0.5, 2f64.sqrt(), angle, -2.0];
        assert_eq!(values, expected);
    }
}
