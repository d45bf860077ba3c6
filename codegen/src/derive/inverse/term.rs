//! Expressions with the operators of numbers, so that an equation reads as one, and vectors of them. What is written first
//! is the older node of the graph: the text is in that order.

use core::cell::RefCell;
use core::ops::{Add, Mul, Neg, Sub};

use crate::derive::chain::expression;
use crate::expr::{Expr, Graph, Symbol};
use crate::number::Number;
use crate::robot::Value;

/// The graph on which terms stand.
pub(super) struct Sheet(RefCell<Graph>);

/// An expression on a sheet.
#[derive(Clone, Copy)]
pub(super) struct Term<'g> {
    pub e: Expr,
    sheet: &'g Sheet,
}

/// Components along the axes of one frame.
pub(super) type Vector<'g> = [Term<'g>; 3];

impl Sheet {
    pub fn new() -> Sheet {
        Sheet(RefCell::new(Graph::new()))
    }

    /// What the graph makes.
    pub fn with<T>(&self, makes: impl FnOnce(&mut Graph) -> T) -> T {
        makes(&mut self.0.borrow_mut())
    }

    pub fn term(&self, e: Expr) -> Term<'_> {
        Term { e, sheet: self }
    }

    pub fn number(&self, n: Number) -> Term<'_> {
        self.term(self.with(|g| g.number(n)))
    }

    pub fn symbol(&self, symbol: Symbol) -> Term<'_> {
        self.term(self.with(|g| g.symbol(symbol)))
    }

    /// A cell of the table.
    pub fn value(&self, value: &Value) -> Term<'_> {
        self.term(self.with(|g| expression(g, value)))
    }

    pub fn into_graph(self) -> Graph {
        self.0.into_inner()
    }
}

impl<'g> Term<'g> {
    fn made(self, makes: impl FnOnce(&mut Graph) -> Expr) -> Term<'g> {
        self.sheet.term(self.sheet.with(makes))
    }

    /// A number on the same sheet.
    pub fn number(self, n: Number) -> Term<'g> {
        self.sheet.number(n)
    }

    pub fn zero(self) -> Term<'g> {
        self.sheet.term(Expr::ZERO)
    }

    pub fn one(self) -> Term<'g> {
        self.sheet.term(Expr::ONE)
    }

    pub fn is_zero(self) -> bool {
        self.e.is_zero()
    }

    pub fn recip(self) -> Term<'g> {
        self.made(|g| g.recip(self.e))
    }

    pub fn sqrt(self) -> Term<'g> {
        self.made(|g| g.sqrt(self.e))
    }

    /// The larger of zero and this.
    pub fn positive_part(self) -> Term<'g> {
        self.made(|g| g.positive_part(self.e))
    }

    /// `a` where this is above zero, else `b`.
    pub fn select(self, a: Term<'g>, b: Term<'g>) -> Term<'g> {
        self.made(|g| g.select(self.e, a.e, b.e))
    }

    /// The angle of the direction (x, this).
    pub fn atan2(self, x: Term<'g>) -> Term<'g> {
        self.made(|g| g.atan2(self.e, x.e))
    }

    /// The value of what has no symbol.
    pub fn constant(self) -> f64 {
        self.sheet.with(|g| g.evaluate(&[self.e], |_| f64::NAN)[0])
    }
}

impl Neg for Term<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.sheet.term(-self.e)
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

/// `a + b`.
pub(super) fn plus<'g>(a: Vector<'g>, b: Vector<'g>) -> Vector<'g> {
    core::array::from_fn(|k| a[k] + b[k])
}

/// `a − b`.
pub(super) fn minus<'g>(a: Vector<'g>, b: Vector<'g>) -> Vector<'g> {
    core::array::from_fn(|k| a[k] - b[k])
}

/// `factor · v`.
pub(super) fn times<'g>(factor: Term<'g>, v: Vector<'g>) -> Vector<'g> {
    v.map(|component| factor * component)
}

/// `a · b`.
pub(super) fn dot<'g>(a: Vector<'g>, b: Vector<'g>) -> Term<'g> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a × b`.
pub(super) fn cross<'g>(a: Vector<'g>, b: Vector<'g>) -> Vector<'g> {
    core::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}
