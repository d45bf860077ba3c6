//! Expressions with the operators of numbers, so that an equation reads as one, and vectors of them. What is written
//! first is the older node of the graph: the text is in that order.

use core::cell::RefCell;
use core::ops::{Add, Div, Mul, Neg, Sub};
use core::panic::Location;

use crate::expr::{Expr, Graph, Symbol};
use crate::number::Number;

/// One thing that is wrong with a function, at a place of the build script where it has one.
#[derive(Clone, Debug)]
pub(crate) struct Mistake {
    pub at: Option<&'static Location<'static>>,
    pub text: String,
}

/// What all expressions of one function stand on.
pub(crate) struct Sheet {
    pub graph: RefCell<Graph>,
    pub mistakes: RefCell<Vec<Mistake>>,
}

impl Sheet {
    pub fn new(graph: Graph) -> Sheet {
        Sheet { graph: RefCell::new(graph), mistakes: RefCell::default() }
    }

    /// What the graph makes.
    pub fn with<T>(&self, makes: impl FnOnce(&mut Graph) -> T) -> T {
        makes(&mut self.graph.borrow_mut())
    }

    pub fn symbol(&self, symbol: Symbol) -> Term<'_> {
        self.term(self.with(|g| g.symbol(symbol)))
    }

    pub fn exact(&self, n: Number) -> Term<'_> {
        self.term(self.with(|g| g.number(n)))
    }

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
        self.exact(number.unwrap_or(Number::ZERO))
    }

    pub fn term(&self, e: Expr) -> Term<'_> {
        Term { e, sheet: self }
    }
}

/// A scalar: a number, an entry of an input, or what is made of them by `+ − × ÷`, [`Term::sqrt`], [`Term::sin`] and
/// [`Term::cos`]; `f64` on one side of an operator is a constant. What is written twice is worked out once.
#[derive(Clone, Copy)]
pub struct Term<'f> {
    pub(crate) e: Expr,
    pub(crate) sheet: &'f Sheet,
}

impl<'f> Term<'f> {
    /// The square root. Of what is negative at run time it is not finite, and where it is zero its derivative is not.
    #[track_caller]
    pub fn sqrt(self) -> Self {
        let known = self.sheet.with(|g| g.number_of(self.e));
        if let Some(n) = known.filter(|n| n.is_negative()) {
            self.sheet.mistake(format!(
                "found the square root of {n}, expected one of what is not negative"
            ));
            return self;
        }
        self.made(|g| g.sqrt(self.e))
    }

    /// The sine of an angle in rad. That of a sum of joint values is taken with the posture, any other by the function.
    pub fn sin(self) -> Self {
        self.made(|g| g.sin(self.e))
    }

    /// The cosine of an angle in rad.
    pub fn cos(self) -> Self {
        self.made(|g| g.cos(self.e))
    }

    /// What the graph makes of it.
    pub(crate) fn made(self, makes: impl FnOnce(&mut Graph) -> Expr) -> Self {
        self.sheet.term(self.sheet.with(makes))
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
        self.made(|g| {
            let inverse = g.recip(divisor.e);
            g.mul(self.e, inverse)
        })
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident)+) => {$(
        impl $operator for Term<'_> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.made(|g| g.$method(self.e, other.e))
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

/// Components along the axes of one frame.
pub(crate) type Components<'f> = [Term<'f>; 3];

/// `a + b`.
pub(crate) fn plus<'f>(a: Components<'f>, b: Components<'f>) -> Components<'f> {
    core::array::from_fn(|k| a[k] + b[k])
}

/// `a × b`.
pub(crate) fn cross<'f>(a: Components<'f>, b: Components<'f>) -> Components<'f> {
    core::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}
