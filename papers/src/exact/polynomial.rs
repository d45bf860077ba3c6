//! Polynomials over symbols, sines and cosines with s² + c² = 1 eliminated: a canonical form, so
//! that equality is decided and not sampled. Powers of plain symbols may be negative.

use std::collections::BTreeMap;
use std::sync::Arc;

use num_rational::Ratio;
use num_traits::{CheckedAdd, CheckedMul, One, Signed, Zero};

use crate::latex::tree::{Angle, Function};

/// An unknown of a polynomial.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Variable {
    /// A plain symbol.
    Symbol(Arc<str>),
    /// The cosine of an angle.
    Cos(Arc<str>),
    /// The sine of an angle; never in a higher power than the first.
    Sin(Arc<str>),
}

/// Powers of variables, in their order, none of them zero.
pub type Monomial = Vec<(Variable, i32)>;

/// A sum of monomials with exact coefficients, none of them zero.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polynomial(BTreeMap<Monomial, Ratio<i128>>);

/// The exact form is too long, or a coefficient too large: equality is then decided by evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLong;

const MOST_TERMS: usize = 30_000;

impl Polynomial {
    /// A constant.
    pub fn number(n: Ratio<i128>) -> Self {
        let mut p = Polynomial::default();
        if !n.is_zero() {
            p.0.insert(Vec::new(), n);
        }
        p
    }

    /// A single variable.
    pub fn variable(v: Variable) -> Self {
        Polynomial(BTreeMap::from([(vec![(v, 1)], Ratio::one())]))
    }

    /// A plain symbol.
    pub fn symbol(name: &str) -> Self {
        Self::variable(Variable::Symbol(name.into()))
    }

    /// One.
    pub fn one() -> Self {
        Self::number(Ratio::one())
    }

    /// Whether the polynomial is zero.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Terms in canonical order.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Monomial, &Ratio<i128>)> {
        self.0.iter()
    }

    /// The only term, if there is one.
    pub fn single(&self) -> Option<(&Monomial, Ratio<i128>)> {
        if self.0.len() == 1 { self.0.iter().next().map(|(m, c)| (m, *c)) } else { None }
    }

    /// `self + factor · other`.
    pub fn plus(mut self, other: &Self, factor: Ratio<i128>) -> Result<Self, TooLong> {
        for (m, c) in &other.0 {
            let c = c.checked_mul(&factor).ok_or(TooLong)?;
            self.put(m.clone(), c)?;
        }
        Ok(self)
    }

    /// `self · other`.
    pub fn times(&self, other: &Self) -> Result<Self, TooLong> {
        let mut out = Polynomial::default();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                let c = x.checked_mul(y).ok_or(TooLong)?;
                out.put_product(a, b, c)?;
            }
            if out.0.len() > MOST_TERMS {
                return Err(TooLong);
            }
        }
        Ok(out)
    }

    /// A whole power, not negative.
    pub fn power(&self, n: u32) -> Result<Self, TooLong> {
        (0..n).try_fold(Self::one(), |p, _| p.times(self))
    }

    /// `1/self` of a single term in plain symbols.
    pub fn reciprocal(&self) -> Option<Self> {
        let (m, c) = self.single()?;
        let plain = m.iter().all(|(v, _)| matches!(v, Variable::Symbol(_)));
        let inverse: Monomial = m.iter().map(|(v, p)| (v.clone(), -p)).collect();
        plain.then(|| Polynomial(BTreeMap::from([(inverse, c.recip())])))
    }

    /// The square root of a single term, its symbols taken as positive.
    pub fn root(&self) -> Option<Self> {
        if self.is_zero() {
            return Some(self.clone());
        }
        let (m, c) = self.single()?;
        let even = m.iter().all(|(v, p)| p % 2 == 0 && matches!(v, Variable::Symbol(_)));
        let root = match stiffarm_codegen::number::Number::Exact(c).sqrt() {
            Some(stiffarm_codegen::number::Number::Exact(root)) if even => root,
            _ => return None,
        };
        let half: Monomial = m.iter().map(|(v, p)| (v.clone(), p / 2)).collect();
        Some(Polynomial(BTreeMap::from([(half, root)])))
    }

    /// Sine or cosine of a combination of angles, in those of each angle.
    pub fn trig(function: Function, angle: &Angle) -> Result<Self, TooLong> {
        let (mut s, mut c) = (Polynomial::default(), Self::one());
        for (name, times) in angle.terms() {
            let name: Arc<str> = name.into();
            let cosine = Self::variable(Variable::Cos(name.clone()));
            let sine = Self::variable(Variable::Sin(name));
            if times.unsigned_abs() > 16 {
                return Err(TooLong);
            }
            let sign = Ratio::from(i128::from(times.signum()));
            for _ in 0..times.unsigned_abs() {
                let up = s.times(&cosine)?.plus(&c.times(&sine)?, sign)?;
                c = c.times(&cosine)?.plus(&s.times(&sine)?, -sign)?;
                s = up;
            }
        }
        Ok(if function == Function::Sin { s } else { c })
    }

    /// The limit in which each of these symbols grows without bounds: terms with a negative power
    /// of one vanish. `None` if a term grows with it.
    pub fn limit(mut self, infinite: &[String]) -> Option<Self> {
        for name in infinite {
            let power = |m: &Monomial| {
                let is = |v: &Variable| matches!(v, Variable::Symbol(s) if **s == **name);
                m.iter().find(|(v, _)| is(v)).map_or(0, |(_, p)| *p)
            };
            if self.0.keys().any(|m| power(m) > 0) {
                return None;
            }
            self.0.retain(|m, _| power(m) == 0);
        }
        Some(self)
    }

    /// The antiderivative in a plain symbol; `None` if it is no polynomial in it.
    pub fn integral(&self, over: &str) -> Option<Self> {
        let variable = Variable::Symbol(over.into());
        self.each_power(&variable, |p, c| (p != -1).then(|| (p + 1, c / i128::from(p + 1))))
    }

    /// The derivative in a plain symbol.
    pub fn derivative(&self, by: &str) -> Self {
        let variable = Variable::Symbol(by.into());
        let slope = |p: i32, c: Ratio<i128>| Some((p - 1, c * i128::from(p)));
        self.each_power(&variable, slope).unwrap_or_default()
    }

    fn each_power(
        &self,
        variable: &Variable,
        change: impl Fn(i32, Ratio<i128>) -> Option<(i32, Ratio<i128>)>,
    ) -> Option<Self> {
        let mut out = Polynomial::default();
        for (m, c) in &self.0 {
            let power = m.iter().find(|(v, _)| v == variable).map_or(0, |(_, p)| *p);
            let (power, c) = change(power, *c)?;
            let mut m: Monomial = m.iter().filter(|(v, _)| v != variable).cloned().collect();
            if power != 0 {
                m.push((variable.clone(), power));
                m.sort();
            }
            out.put(m, c).ok()?;
        }
        Some(out)
    }

    /// Coefficients by power of a plain symbol.
    pub fn by_power(&self, name: &str) -> BTreeMap<i32, Polynomial> {
        let variable = Variable::Symbol(name.into());
        let mut out: BTreeMap<i32, Polynomial> = BTreeMap::new();
        for (m, c) in &self.0 {
            let power = m.iter().find(|(v, _)| *v == variable).map_or(0, |(_, p)| *p);
            let rest = m.iter().filter(|(v, _)| *v != variable).cloned().collect();
            out.entry(power).or_default().0.insert(rest, *c);
        }
        out
    }

    fn put(&mut self, m: Monomial, c: Ratio<i128>) -> Result<(), TooLong> {
        if c.is_zero() {
            return Ok(());
        }
        match self.0.entry(m) {
            std::collections::btree_map::Entry::Vacant(free) => {
                free.insert(c);
            }
            std::collections::btree_map::Entry::Occupied(mut taken) => {
                let sum = taken.get().checked_add(&c).ok_or(TooLong)?;
                if sum.is_zero() {
                    taken.remove();
                } else {
                    taken.insert(sum);
                }
            }
        }
        Ok(())
    }

    fn put_product(&mut self, a: &Monomial, b: &Monomial, c: Ratio<i128>) -> Result<(), TooLong> {
        let mut m: Monomial = Vec::with_capacity(a.len() + b.len());
        let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
        let mut squares: Vec<Arc<str>> = Vec::new();
        while let Some((v, p)) = match (a.peek(), b.peek()) {
            (Some(x), Some(y)) if x.0 == y.0 => {
                let sum = x.1.checked_add(y.1).ok_or(TooLong)?;
                a.next();
                b.next().map(|y| (y.0.clone(), sum))
            }
            (Some(x), Some(y)) if x.0 < y.0 => a.next().cloned(),
            (_, Some(_)) => b.next().cloned(),
            (Some(_), None) => a.next().cloned(),
            (None, None) => None,
        } {
            match (&v, p) {
                (_, 0) => {}
                (Variable::Sin(angle), 2) => squares.push(angle.clone()),
                _ => m.push((v, p)),
            }
        }
        if squares.is_empty() {
            return self.put(m, c);
        }
        // s² = 1 − c² for each sine that met itself.
        let mut terms = vec![(m, c)];
        for angle in squares {
            let cosine = vec![(Variable::Cos(angle), 2)];
            let mut next = Vec::new();
            for (m, c) in terms {
                let mut with = Polynomial::default();
                with.put_product(&m, &cosine, -c)?;
                next.extend(with.0);
                next.push((m, c));
            }
            terms = next;
        }
        terms.into_iter().try_for_each(|(m, c)| self.put(m, c))
    }
}

impl Polynomial {
    /// `self − other`.
    pub fn minus(self, other: &Self) -> Result<Self, TooLong> {
        self.plus(other, -Ratio::one())
    }

    /// Whether every coefficient is negative.
    pub fn is_negative(&self) -> bool {
        !self.is_zero() && self.0.values().all(Signed::is_negative)
    }
}

#[cfg(test)]
mod tests;
