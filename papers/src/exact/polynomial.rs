//! A formula multiplied out, as a correction is printed: quotients of polynomials over symbols, sines
//! and cosines with s² + c² = 1 eliminated. Powers of plain symbols may be negative.

use std::collections::BTreeMap;
use std::sync::Arc;

use num_rational::Ratio;
use num_traits::{CheckedAdd, CheckedMul, One, Zero};

use super::arithmetic::Arithmetic;
use crate::latex::tree::{Angle, Function};

/// An unknown of a polynomial.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variable {
    /// A plain symbol.
    Symbol(Arc<str>),
    /// The cosine of an angle.
    Cos(Arc<str>),
    /// The sine of an angle; never in a higher power than the first.
    Sin(Arc<str>),
}

/// Powers of variables, none of them zero.
pub type Monomial = BTreeMap<Variable, i32>;

/// A sum of monomials with exact coefficients, none of them zero.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polynomial(BTreeMap<Monomial, Ratio<i128>>);

const TOO_LONG: &str = "the formula is too long when multiplied out";
const MOST_TERMS: usize = 30_000;

impl Polynomial {
    fn term(m: Monomial, c: Ratio<i128>) -> Self {
        Polynomial(if c.is_zero() { BTreeMap::new() } else { BTreeMap::from([(m, c)]) })
    }

    fn variable(v: Variable) -> Self {
        Self::term(Monomial::from([(v, 1)]), Ratio::one())
    }

    /// One.
    pub fn one() -> Self {
        Self::term(Monomial::new(), Ratio::one())
    }

    /// Terms in canonical order.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Monomial, &Ratio<i128>)> {
        self.0.iter()
    }

    fn plus(mut self, other: &Self, sign: i128) -> Result<Self, &'static str> {
        for (m, c) in &other.0 {
            self.put(m.clone(), *c * sign)?;
        }
        Ok(self)
    }

    fn times(&self, other: &Self) -> Result<Self, &'static str> {
        let mut out = Polynomial::default();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                let mut m = a.clone();
                b.iter().for_each(|(v, power)| raise(&mut m, v.clone(), *power));
                out.put(m, x.checked_mul(y).ok_or(TOO_LONG)?)?;
            }
            if out.0.len() > MOST_TERMS {
                return Err(TOO_LONG);
            }
        }
        Ok(out)
    }

    /// `1/self` of a single term in plain symbols.
    fn reciprocal(&self) -> Option<Self> {
        let mut terms = self.terms();
        let (Some((m, c)), None) = (terms.next(), terms.next()) else { return None };
        let plain = m.keys().all(|v| matches!(v, Variable::Symbol(_)));
        let inverse = m.iter().map(|(v, power)| (v.clone(), -power)).collect();
        plain.then(|| Self::term(inverse, c.recip()))
    }

    /// Sine or cosine of a combination of angles, in those of each angle.
    fn trig(function: Function, angle: &Angle) -> Result<Self, &'static str> {
        let (mut s, mut c) = (Polynomial::default(), Self::one());
        for (name, times) in angle.terms() {
            let name: Arc<str> = name.into();
            let cosine = Self::variable(Variable::Cos(name.clone()));
            let sine = Self::variable(Variable::Sin(name));
            if times.unsigned_abs() > 16 {
                return Err(TOO_LONG);
            }
            let sign = i128::from(times.signum());
            for _ in 0..times.unsigned_abs() {
                let up = s.times(&cosine)?.plus(&c.times(&sine)?, sign)?;
                c = c.times(&cosine)?.plus(&s.times(&sine)?, -sign)?;
                s = up;
            }
        }
        Ok(if function == Function::Sin { s } else { c })
    }

    fn put(&mut self, mut m: Monomial, c: Ratio<i128>) -> Result<(), &'static str> {
        let squared = m.iter().find_map(|(v, power)| match v {
            Variable::Sin(angle) if *power > 1 => Some(angle.clone()),
            _ => None,
        });
        // s² = 1 − c² for a sine that met itself.
        if let Some(angle) = squared {
            raise(&mut m, Variable::Sin(angle.clone()), -2);
            self.put(m.clone(), c)?;
            raise(&mut m, Variable::Cos(angle), 2);
            return self.put(m, -c);
        }
        let known = self.0.remove(&m).unwrap_or_else(Ratio::zero);
        let sum = known.checked_add(&c).ok_or(TOO_LONG)?;
        if !sum.is_zero() {
            self.0.insert(m, sum);
        }
        Ok(())
    }
}

fn raise(m: &mut Monomial, v: Variable, by: i32) {
    let power = m.remove(&v).unwrap_or(0) + by;
    if power != 0 {
        m.insert(v, power);
    }
}

/// `above / below`; the denominator is one wherever it is a single term in plain symbols.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quotient {
    /// Numerator.
    pub above: Polynomial,
    /// Denominator, not zero.
    pub below: Polynomial,
}

impl From<Polynomial> for Quotient {
    fn from(above: Polynomial) -> Self {
        Quotient { above, below: Polynomial::one() }
    }
}

impl Quotient {
    fn plus(&self, other: &Self, sign: i128) -> Result<Self, &'static str> {
        if self.below == other.below {
            let above = self.above.clone().plus(&other.above, sign)?;
            return Ok(Quotient { above, below: self.below.clone() });
        }
        let (left, right) = (self.above.times(&other.below)?, other.above.times(&self.below)?);
        Ok(Quotient { above: left.plus(&right, sign)?, below: self.below.times(&other.below)? })
    }
}

/// The arithmetic of formulas that are multiplied out.
pub struct Expanded;

impl Arithmetic for Expanded {
    type Value = Quotient;
    type Error = &'static str;

    fn number(&self, n: Ratio<i128>) -> Result<Quotient, &'static str> {
        Ok(Polynomial::term(Monomial::new(), n).into())
    }

    fn named(&self, key: &str) -> Result<Quotient, &'static str> {
        Ok(Polynomial::variable(Variable::Symbol(key.into())).into())
    }

    fn trig(&self, function: Function, angle: &Angle) -> Result<Quotient, &'static str> {
        Ok(Polynomial::trig(function, angle)?.into())
    }

    fn add(&self, a: Quotient, b: Quotient) -> Result<Quotient, &'static str> {
        a.plus(&b, 1)
    }

    fn sub(&self, a: Quotient, b: Quotient) -> Result<Quotient, &'static str> {
        a.plus(&b, -1)
    }

    fn mul(&self, a: Quotient, b: Quotient) -> Result<Quotient, &'static str> {
        Ok(Quotient { above: a.above.times(&b.above)?, below: a.below.times(&b.below)? })
    }

    fn div(&self, a: Quotient, b: Quotient) -> Result<Quotient, &'static str> {
        let inverse = match b.above.reciprocal() {
            Some(inverse) => b.below.times(&inverse)?.into(),
            None if b.above == Polynomial::default() => return Err("a division by zero"),
            None => Quotient { above: b.below, below: b.above },
        };
        self.mul(a, inverse)
    }

    fn sqrt(&self, _: Quotient) -> Result<Quotient, &'static str> {
        Err("a root has no quotient of polynomials")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::latex::notation::Notation;
    use crate::latex::parser::parse;

    fn expanded(text: &str) -> Result<Quotient, &'static str> {
        Expanded.tree(&parse(text, &Notation::default()).unwrap())
    }

    #[test]
    fn what_is_equal_is_multiplied_out_alike() {
        for (a, b) in [
            ("\\sin(\\alpha+\\beta-\\gamma)^2 + \\cos(\\alpha+\\beta-\\gamma)^2", "1"),
            ("\\sin(2\\alpha)", "2\\sin\\alpha\\cos\\alpha"),
            ("(a + b)(a - b) - \\frac{a^3}{a}", "-b^2"),
            ("\\frac{1}{a}\\frac{b}{c} a c", "b"),
            ("\\frac{a}{a+b} + \\frac{b}{a+b}", "\\frac{a+b}{a+b}"),
        ] {
            assert_eq!(expanded(a), expanded(b), "{a}");
        }
    }

    #[test]
    fn what_is_too_long_says_so() {
        let digits = "9".repeat(30);
        assert_eq!(expanded(&format!("{digits}^2 a")), Err(TOO_LONG));
        assert!(expanded("\\frac{a}{b - b}").is_err() && expanded("\\sqrt{a}").is_err());
    }
}
