//! Evaluation of formulas and of their exact forms, in doubles or modulo a prime.

use num_rational::Ratio;
use num_traits::ToPrimitive;

use super::polynomial::{Polynomial, Variable};
use super::rational::Rational;
use crate::latex::tree::{Angle, Function, Tree};

/// Numbers of some kind, and the values of the symbols among them.
pub trait Arithmetic {
    /// A number.
    type Value: Copy + PartialEq;
    /// An exact number.
    fn number(&self, n: Ratio<i128>) -> Option<Self::Value>;
    /// The value of a symbol; `None` if it has none.
    fn symbol(&self, name: &str) -> Option<Self::Value>;
    /// Sine or cosine of a combination of angles.
    fn trig(&self, function: Function, angle: &Angle) -> Option<Self::Value>;
    /// Sum.
    fn add(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// Difference.
    fn sub(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// Product.
    fn mul(&self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// Quotient; `None` for a division by zero.
    fn div(&self, a: Self::Value, b: Self::Value) -> Option<Self::Value>;
    /// Square root, if there is one.
    fn sqrt(&self, a: Self::Value) -> Option<Self::Value>;

    /// A whole power.
    fn power(&self, base: Self::Value, n: i32) -> Option<Self::Value> {
        let one = self.number(Ratio::from(1))?;
        let p = (0..n.unsigned_abs()).fold(one, |p, _| self.mul(p, base));
        if n < 0 { self.div(one, p) } else { Some(p) }
    }

    /// The value of a formula; `None` where it has none.
    fn tree(&self, tree: &Tree) -> Option<Self::Value> {
        match tree {
            Tree::Number(n) => self.number(*n),
            Tree::Symbol(name) => self.symbol(name),
            Tree::Trig(function, angle) => self.trig(*function, angle),
            Tree::Sum(terms) => {
                terms.iter().try_fold(self.number(Ratio::from(0))?, |sum, (negative, term)| {
                    let term = self.tree(term)?;
                    Some(if *negative { self.sub(sum, term) } else { self.add(sum, term) })
                })
            }
            Tree::Product(factors) => factors
                .iter()
                .try_fold(self.number(Ratio::from(1))?, |p, f| Some(self.mul(p, self.tree(f)?))),
            Tree::Quotient(a, b) => self.div(self.tree(a)?, self.tree(b)?),
            Tree::Power(base, n) => self.power(self.tree(base)?, *n),
            Tree::Sqrt(inner) => self.sqrt(self.tree(inner)?),
            Tree::Integral { .. } | Tree::Derivative(..) => None,
        }
    }

    /// The value of a polynomial.
    fn polynomial(&self, p: &Polynomial) -> Option<Self::Value> {
        p.terms().try_fold(self.number(Ratio::from(0))?, |sum, (monomial, c)| {
            let term = monomial.iter().try_fold(self.number(*c)?, |product, (variable, n)| {
                let base = match variable {
                    Variable::Symbol(name) => self.symbol(name)?,
                    Variable::Sin(name) => self.trig(Function::Sin, &Angle::single(name))?,
                    Variable::Cos(name) => self.trig(Function::Cos, &Angle::single(name))?,
                };
                Some(self.mul(product, self.power(base, *n)?))
            })?;
            Some(self.add(sum, term))
        })
    }

    /// The value of a quotient.
    fn rational(&self, r: &Rational) -> Option<Self::Value> {
        self.div(self.polynomial(&r.above)?, self.polynomial(&r.below)?)
    }
}

/// Doubles, with values given by a function; angles in radians.
pub struct Real<F>(pub F);

impl<F: Fn(&str) -> Option<f64>> Arithmetic for Real<F> {
    type Value = f64;

    fn number(&self, n: Ratio<i128>) -> Option<f64> {
        Some(n.numer().to_f64()? / n.denom().to_f64()?)
    }

    fn symbol(&self, name: &str) -> Option<f64> {
        (self.0)(name)
    }

    fn trig(&self, function: Function, angle: &Angle) -> Option<f64> {
        let total: f64 =
            angle.terms().map(|(n, k)| Some((self.0)(n)? * k as f64)).sum::<Option<f64>>()?;
        Some(if function == Function::Sin { total.sin() } else { total.cos() })
    }

    fn add(&self, a: f64, b: f64) -> f64 {
        a + b
    }

    fn sub(&self, a: f64, b: f64) -> f64 {
        a - b
    }

    fn mul(&self, a: f64, b: f64) -> f64 {
        a * b
    }

    fn div(&self, a: f64, b: f64) -> Option<f64> {
        (b != 0.0).then(|| a / b)
    }

    fn sqrt(&self, a: f64) -> Option<f64> {
        (a >= 0.0).then(|| a.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::exact::field::Modular;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

    #[test]
    fn a_formula_and_its_exact_form_have_one_value() {
        let text = "\\frac{a^3-2b\\sin(\\theta_1-\\theta_2)}{a+\\cos^2\\theta_1} - 0.5";
        let tree = parse(text, &Notation::default()).unwrap();
        let exact = Rational::of_tree(&tree, &HashMap::new()).unwrap();
        let modular = Modular::point(5);
        assert_eq!(modular.tree(&tree), modular.rational(&exact));
        let real = Real(|name: &str| Some(if name == "a" { 1.5 } else { 0.3 }));
        let (x, y) = (real.tree(&tree).unwrap(), real.rational(&exact).unwrap());
        assert!((x - y).abs() < 1e-14, "{x} {y}");
        let expected = 1.5f64.powi(3) / (1.5 + 0.3f64.cos().powi(2)) - 0.5;
        assert!((x - expected).abs() < 1e-14);
    }
}
