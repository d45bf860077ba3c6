//! Evaluation of formulas: over doubles, modulo a prime, exactly or over matrices, by one walk of the
//! tree.

use num_rational::Ratio;
use num_traits::ToPrimitive;

use super::polynomial::{Polynomial, Variable};
use super::rational::Rational;
use crate::latex::name::Name;
use crate::latex::tree::{Angle, Function, Tree};

/// Values of some kind, and those of the symbols among them.
pub trait Arithmetic {
    /// A value.
    type Value: Clone;
    /// Why there is none.
    type Error;
    /// An exact number.
    fn number(&self, n: Ratio<i128>) -> Result<Self::Value, Self::Error>;
    /// The value of a symbol by its name in the graph.
    fn named(&self, key: &str) -> Result<Self::Value, Self::Error>;
    /// Sine or cosine of a combination of angles.
    fn trig(&self, function: Function, angle: &Angle) -> Result<Self::Value, Self::Error>;
    /// Sum.
    fn add(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, Self::Error>;
    /// Difference.
    fn sub(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, Self::Error>;
    /// Product.
    fn mul(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, Self::Error>;
    /// Quotient.
    fn div(&self, a: Self::Value, b: Self::Value) -> Result<Self::Value, Self::Error>;
    /// Square root.
    fn sqrt(&self, a: Self::Value) -> Result<Self::Value, Self::Error>;
    /// What only some values have: derivatives, integrals, transposes, traces, norms, blocks,
    /// products over an index.
    fn other(&self, tree: &Tree) -> Result<Self::Value, Self::Error>;

    /// The value of a printed symbol.
    fn symbol(&self, name: &Name) -> Result<Self::Value, Self::Error> {
        self.named(&name.key)
    }

    /// A whole power.
    fn power(&self, base: Self::Value, n: i32) -> Result<Self::Value, Self::Error> {
        let one = self.number(Ratio::from(1))?;
        let p = (0..n.unsigned_abs()).try_fold(one.clone(), |p, _| self.mul(p, base.clone()))?;
        if n < 0 { self.div(one, p) } else { Ok(p) }
    }

    /// The value of a formula.
    fn tree(&self, tree: &Tree) -> Result<Self::Value, Self::Error> {
        match tree {
            Tree::Number(n) => self.number(*n),
            Tree::Symbol(name) => self.symbol(name),
            Tree::Trig(function, angle) => self.trig(*function, angle),
            Tree::Sum(terms) => {
                terms.iter().try_fold(self.number(Ratio::from(0))?, |sum, (negative, term)| {
                    let term = self.tree(term)?;
                    if *negative { self.sub(sum, term) } else { self.add(sum, term) }
                })
            }
            Tree::Product(factors) => factors
                .iter()
                .try_fold(self.number(Ratio::from(1))?, |p, f| self.mul(p, self.tree(f)?)),
            Tree::Quotient(a, b) => self.div(self.tree(a)?, self.tree(b)?),
            Tree::Power(base, n) => self.power(self.tree(base)?, *n),
            Tree::Sqrt(inner) => self.sqrt(self.tree(inner)?),
            other => self.other(other),
        }
    }

    /// The value of a polynomial.
    fn polynomial(&self, p: &Polynomial) -> Result<Self::Value, Self::Error> {
        p.terms().try_fold(self.number(Ratio::from(0))?, |sum, (monomial, c)| {
            let term = monomial.iter().try_fold(self.number(*c)?, |product, (variable, n)| {
                let base = match variable {
                    Variable::Symbol(name) => self.named(name)?,
                    Variable::Sin(name) => self.trig(Function::Sin, &Angle::single(name))?,
                    Variable::Cos(name) => self.trig(Function::Cos, &Angle::single(name))?,
                };
                self.mul(product, self.power(base, *n)?)
            })?;
            self.add(sum, term)
        })
    }

    /// The value of a quotient.
    fn rational(&self, r: &Rational) -> Result<Self::Value, Self::Error> {
        self.div(self.polynomial(&r.above)?, self.polynomial(&r.below)?)
    }
}

/// There is no value: a symbol has none, a division by zero, a root of what is no square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoValue;

/// Doubles, with values given by a function; angles in radians.
pub struct Real<F>(pub F);

impl<F: Fn(&str) -> Option<f64>> Arithmetic for Real<F> {
    type Value = f64;
    type Error = NoValue;

    fn number(&self, n: Ratio<i128>) -> Result<f64, NoValue> {
        Ok(n.numer().to_f64().ok_or(NoValue)? / n.denom().to_f64().ok_or(NoValue)?)
    }

    fn named(&self, key: &str) -> Result<f64, NoValue> {
        (self.0)(key).ok_or(NoValue)
    }

    fn trig(&self, function: Function, angle: &Angle) -> Result<f64, NoValue> {
        let each = angle.terms().map(|(n, k)| Some((self.0)(n)? * k as f64));
        let total = each.sum::<Option<f64>>().ok_or(NoValue)?;
        Ok(if function == Function::Sin { total.sin() } else { total.cos() })
    }

    fn add(&self, a: f64, b: f64) -> Result<f64, NoValue> {
        Ok(a + b)
    }

    fn sub(&self, a: f64, b: f64) -> Result<f64, NoValue> {
        Ok(a - b)
    }

    fn mul(&self, a: f64, b: f64) -> Result<f64, NoValue> {
        Ok(a * b)
    }

    fn div(&self, a: f64, b: f64) -> Result<f64, NoValue> {
        if b != 0.0 { Ok(a / b) } else { Err(NoValue) }
    }

    fn sqrt(&self, a: f64) -> Result<f64, NoValue> {
        if a >= 0.0 { Ok(a.sqrt()) } else { Err(NoValue) }
    }

    fn other(&self, _: &Tree) -> Result<f64, NoValue> {
        Err(NoValue)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::exact::field::Modular;
    use crate::exact::rational::Exact;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

    #[test]
    fn a_formula_and_its_exact_form_have_one_value() {
        let text = "\\frac{a^3-2b\\sin(\\theta_1-\\theta_2)}{a+\\cos^2\\theta_1} - 0.5";
        let tree = parse(text, &Notation::default()).unwrap();
        let exact = Exact(&HashMap::new()).tree(&tree).unwrap();
        let modular = Modular::point(5);
        assert_eq!(modular.tree(&tree), modular.rational(&exact));
        let real = Real(|name: &str| Some(if name == "a" { 1.5 } else { 0.3 }));
        let (x, y) = (real.tree(&tree).unwrap(), real.rational(&exact).unwrap());
        assert!((x - y).abs() < 1e-14, "{x} {y}");
        let expected = 1.5f64.powi(3) / (1.5 + 0.3f64.cos().powi(2)) - 0.5;
        assert!((x - expected).abs() < 1e-14);
    }
}
