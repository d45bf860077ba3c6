//! Quotients of polynomials: what a printed formula is, exactly.

use std::collections::{BTreeSet, HashMap};

use num_rational::Ratio;
use num_traits::Zero;

use super::evaluate::Arithmetic;
use super::polynomial::{Polynomial, TooLong, Variable};
use crate::latex::tree::{Angle, Function, Tree};

/// Why an expression has no exact form here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inexact {
    /// It is too long.
    TooLong,
    /// A root of something that is no square.
    Root,
    /// A division by zero.
    Zero,
    /// An integral of something that is no polynomial in the variable.
    Integral,
    /// It is of matrices.
    Matrix,
    /// A rounded constant, or an angle with an offset that is no multiple of a quarter turn.
    Rounded,
}

impl From<TooLong> for Inexact {
    fn from(_: TooLong) -> Self {
        Inexact::TooLong
    }
}

/// `numerator / denominator`; the denominator is one wherever it is a single term in plain symbols.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rational {
    /// Numerator.
    pub above: Polynomial,
    /// Denominator, not zero.
    pub below: Polynomial,
}

impl From<Polynomial> for Rational {
    fn from(above: Polynomial) -> Self {
        Rational { above, below: Polynomial::one() }
    }
}

impl Rational {
    /// A number.
    pub fn number(n: Ratio<i128>) -> Self {
        Polynomial::number(n).into()
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    /// `self + sign · other`.
    pub fn plus(&self, other: &Self, sign: i128) -> Result<Self, Inexact> {
        let sign = Ratio::from(sign);
        if self.below == other.below {
            let above = self.above.clone().plus(&other.above, sign)?;
            return Ok(Rational { above, below: self.below.clone() });
        }
        let left = self.above.times(&other.below)?;
        let right = other.above.times(&self.below)?;
        Ok(Rational { above: left.plus(&right, sign)?, below: self.below.times(&other.below)? })
    }

    /// `self · other`.
    pub fn times(&self, other: &Self) -> Result<Self, Inexact> {
        let above = self.above.times(&other.above)?;
        Ok(Rational { above, below: self.below.times(&other.below)? })
    }

    /// `1/self`.
    pub fn reciprocal(&self) -> Result<Self, Inexact> {
        if self.is_zero() {
            return Err(Inexact::Zero);
        }
        match self.above.reciprocal() {
            Some(inverse) => Ok(self.below.times(&inverse)?.into()),
            None => Ok(Rational { above: self.below.clone(), below: self.above.clone() }),
        }
    }

    /// A whole power.
    pub fn power(&self, n: i32) -> Result<Self, Inexact> {
        let base = if n < 0 { self.reciprocal()? } else { self.clone() };
        let n = n.unsigned_abs();
        Ok(Rational { above: base.above.power(n)?, below: base.below.power(n)? })
    }

    /// The square root of a single term.
    pub fn root(&self) -> Result<Self, Inexact> {
        let root = |p: &Polynomial| p.root().ok_or(Inexact::Root);
        Ok(Rational { above: root(&self.above)?, below: root(&self.below)? })
    }

    /// Whether the two are the same function.
    pub fn equals(&self, other: &Self) -> Result<bool, Inexact> {
        if self.below == other.below {
            return Ok(self.above == other.above);
        }
        Ok(self.above.times(&other.below)? == other.above.times(&self.below)?)
    }

    /// Adds the angles and the plain symbols in it.
    pub fn names(&self, angles: &mut BTreeSet<String>, symbols: &mut BTreeSet<String>) {
        let monomials = self.above.terms().chain(self.below.terms());
        for (variable, _) in monomials.flat_map(|(m, _)| m) {
            match variable {
                Variable::Symbol(name) => symbols.insert(name.to_string()),
                Variable::Sin(name) | Variable::Cos(name) => angles.insert(name.to_string()),
            };
        }
    }

    /// The numerator, if the denominator is one.
    pub fn polynomial(self) -> Option<Polynomial> {
        (self.below == Polynomial::one()).then_some(self.above)
    }
}

/// The polynomial with a plain symbol replaced.
fn substitute(p: &Polynomial, name: &str, value: &Rational) -> Result<Rational, Inexact> {
    p.by_power(name).into_iter().try_fold(Rational::number(Ratio::zero()), |sum, (power, rest)| {
        sum.plus(&value.power(power)?.times(&rest.into())?, 1)
    })
}

/// Exact forms; the names in the table stand for what they are given there.
pub struct Exact<'d>(pub &'d HashMap<String, Rational>);

impl Arithmetic for Exact<'_> {
    type Value = Rational;
    type Error = Inexact;

    fn number(&self, n: Ratio<i128>) -> Result<Rational, Inexact> {
        Ok(Rational::number(n))
    }

    fn named(&self, key: &str) -> Result<Rational, Inexact> {
        Ok(self.0.get(key).cloned().unwrap_or_else(|| Polynomial::symbol(key).into()))
    }

    fn trig(&self, function: Function, angle: &Angle) -> Result<Rational, Inexact> {
        Ok(Polynomial::trig(function, angle)?.into())
    }

    fn add(&self, a: Rational, b: Rational) -> Result<Rational, Inexact> {
        a.plus(&b, 1)
    }

    fn sub(&self, a: Rational, b: Rational) -> Result<Rational, Inexact> {
        a.plus(&b, -1)
    }

    fn mul(&self, a: Rational, b: Rational) -> Result<Rational, Inexact> {
        a.times(&b)
    }

    fn div(&self, a: Rational, b: Rational) -> Result<Rational, Inexact> {
        a.times(&b.reciprocal()?)
    }

    fn sqrt(&self, a: Rational) -> Result<Rational, Inexact> {
        a.root()
    }

    fn power(&self, base: Rational, n: i32) -> Result<Rational, Inexact> {
        base.power(n)
    }

    fn other(&self, tree: &Tree) -> Result<Rational, Inexact> {
        let polynomial = |tree| self.tree(tree)?.polynomial().ok_or(Inexact::Integral);
        match tree {
            Tree::Derivative(body, by) => Ok(polynomial(body)?.derivative(&by.key).into()),
            Tree::Integral { body, over, ends } => {
                let rising = polynomial(body)?.integral(over).ok_or(Inexact::Integral)?;
                let (from, to) = (self.tree(&ends.0)?, self.tree(&ends.1)?);
                substitute(&rising, over, &to)?.plus(&substitute(&rising, over, &from)?, -1)
            }
            _ => Err(Inexact::Matrix),
        }
    }
}

#[cfg(test)]
mod tests;
