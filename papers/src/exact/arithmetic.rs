//! Arithmetic of some kind of values: one walk of a printed formula serves doubles, residues, matrices
//! and expressions of the graph.

use num_rational::Ratio;
use num_traits::ToPrimitive;

use crate::latex::name::Name;
use crate::latex::tree::{Angle, Function, Tree};

/// Values of some kind, and those of the symbols among them.
pub trait Arithmetic {
    /// A value.
    type Value: Clone;
    /// Why there is none.
    type Error: From<&'static str>;
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
    fn other(&self, _: &Tree) -> Result<Self::Value, Self::Error> {
        Err("a derivative, an integral or a matrix has no value here".into())
    }

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
}

const TOO_LARGE: &str = "a number is too large";

/// Doubles, with values given by a function; angles in radians.
pub struct Real<F>(pub F);

impl<F: Fn(&str) -> Option<f64>> Real<F> {
    fn of(&self, key: &str) -> Result<f64, &'static str> {
        (self.0)(key).ok_or("a symbol of the formula has no value")
    }
}

impl<F: Fn(&str) -> Option<f64>> Arithmetic for Real<F> {
    type Value = f64;
    type Error = &'static str;

    fn number(&self, n: Ratio<i128>) -> Result<f64, &'static str> {
        Ok(n.numer().to_f64().ok_or(TOO_LARGE)? / n.denom().to_f64().ok_or(TOO_LARGE)?)
    }

    fn named(&self, key: &str) -> Result<f64, &'static str> {
        self.of(key)
    }

    fn trig(&self, function: Function, angle: &Angle) -> Result<f64, &'static str> {
        let mut total = 0.0;
        for (name, times) in angle.terms() {
            total += self.of(name)? * times as f64;
        }
        Ok(if function == Function::Sin { total.sin() } else { total.cos() })
    }

    fn add(&self, a: f64, b: f64) -> Result<f64, &'static str> {
        Ok(a + b)
    }

    fn sub(&self, a: f64, b: f64) -> Result<f64, &'static str> {
        Ok(a - b)
    }

    fn mul(&self, a: f64, b: f64) -> Result<f64, &'static str> {
        Ok(a * b)
    }

    fn div(&self, a: f64, b: f64) -> Result<f64, &'static str> {
        if b != 0.0 { Ok(a / b) } else { Err("a division by zero") }
    }

    fn sqrt(&self, a: f64) -> Result<f64, &'static str> {
        if a >= 0.0 { Ok(a.sqrt()) } else { Err("a root of a negative number") }
    }
}
