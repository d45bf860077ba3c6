//! Scalar expressions with the operators of numbers.

use core::cell::RefCell;
use core::ops::{Add, Div, Mul, Neg, Sub};
use core::panic::Location;

use super::mistake::Mistake;
use crate::expr::{Expr, Graph};
use crate::number::Number;

/// What all expressions of one function stand on.
#[derive(Default)]
pub(super) struct Sheet {
    pub graph: RefCell<Graph>,
    pub mistakes: RefCell<Vec<Mistake>>,
}

impl Sheet {
    /// Notes what is wrong at the caller's place; the function is then refused.
    #[track_caller]
    pub fn mistake(&self, text: impl Into<String>) {
        let at = Location::caller();
        self.mistakes.borrow_mut().push(Mistake { at: Some(at), text: text.into() });
    }

    /// The exact value of the shortest decimal that is read as `x`.
    #[track_caller]
    pub fn number(&self, x: f64) -> Term<'_> {
        let number = Number::from_decimal(&format!("{x:?}"));
        if number.is_none() {
            self.mistake(format!("found the number {x}, expected a finite one"));
        }
        self.term(self.graph.borrow_mut().number(number.unwrap_or(Number::ZERO)))
    }

    pub fn term(&self, e: Expr) -> Term<'_> {
        Term { e, sheet: self }
    }
}

/// A scalar: a number, an entry of an input, or what is made of them by `+ − × ÷`, [`Term::sqrt`], [`Term::sin`] and
/// [`Term::cos`]; `f64` on one side of an operator is a constant. What is written twice is worked out once.
#[derive(Clone, Copy)]
pub struct Term<'f> {
    pub(super) e: Expr,
    pub(super) sheet: &'f Sheet,
}

impl<'f> Term<'f> {
    /// The square root. Of what is negative at run time it is not finite, and where it is zero its derivative is not.
    #[track_caller]
    pub fn sqrt(self) -> Self {
        let mut g = self.sheet.graph.borrow_mut();
        if let Some(n) = g.number_of(self.e).filter(|n| n.is_negative()) {
            self.sheet.mistake(format!(
                "found the square root of {n}, expected one of what is not negative"
            ));
            return self;
        }
        self.sheet.term(g.sqrt(self.e))
    }

    /// The sine of an angle in rad. That of a sum of joint values is taken with the posture, any other by the function.
    pub fn sin(self) -> Self {
        self.sheet.term(self.sheet.graph.borrow_mut().sin(self.e))
    }

    /// The cosine of an angle in rad.
    pub fn cos(self) -> Self {
        self.sheet.term(self.sheet.graph.borrow_mut().cos(self.e))
    }

    fn with(self, other: Self, does: impl Fn(&mut Graph, Expr, Expr) -> Expr) -> Self {
        self.sheet.term(does(&mut self.sheet.graph.borrow_mut(), self.e, other.e))
    }
}

impl Neg for Term<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.sheet.term(-self.e)
    }
}

impl Div for Term<'_> {
    type Output = Self;
    #[track_caller]
    fn div(self, divisor: Self) -> Self {
        if divisor.e.is_zero() {
            self.sheet.mistake("found a division by what is always zero");
            return self;
        }
        self.with(divisor, |g, a, b| {
            let inverse = g.recip(b);
            g.mul(a, inverse)
        })
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident)+) => {$(
        impl $operator for Term<'_> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.with(other, Graph::$method)
            }
        }
    )+};
}
operators!(Add add  Sub sub  Mul mul);

macro_rules! with_constants {
    ($($operator:ident $method:ident)+) => {$(
        impl<'f> $operator<f64> for Term<'f> {
            type Output = Term<'f>;
            #[track_caller]
            fn $method(self, other: f64) -> Term<'f> {
                $operator::$method(self, self.sheet.number(other))
            }
        }
        impl<'f> $operator<Term<'f>> for f64 {
            type Output = Term<'f>;
            #[track_caller]
            fn $method(self, other: Term<'f>) -> Term<'f> {
                $operator::$method(other.sheet.number(self), other)
            }
        }
    )+};
}
with_constants!(Add add  Sub sub  Mul mul  Div div);
