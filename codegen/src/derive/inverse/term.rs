//! What the inverse does with [terms](crate::term) beside, and with vectors of them.

use crate::derive::chain::expression;
use crate::expr::Expr;
use crate::number::Number;
use crate::robot::Value;
pub(super) use crate::term::{Components as Vector, Sheet, Term, cross, plus};

impl Sheet {
    /// A cell of the table.
    pub(super) fn value(&self, value: &Value) -> Term<'_> {
        self.term(self.with(|g| expression(g, value)))
    }
}

impl<'g> Term<'g> {
    /// A number on the same sheet.
    pub(super) fn exact(self, n: Number) -> Term<'g> {
        self.sheet.exact(n)
    }

    pub(super) fn zero(self) -> Term<'g> {
        self.sheet.term(Expr::ZERO)
    }

    pub(super) fn one(self) -> Term<'g> {
        self.sheet.term(Expr::ONE)
    }

    pub(super) fn is_zero(self) -> bool {
        self.e.is_zero()
    }

    pub(super) fn recip(self) -> Term<'g> {
        self.made(|g| g.recip(self.e))
    }

    /// The larger of zero and this.
    pub(super) fn positive_part(self) -> Term<'g> {
        self.made(|g| g.positive_part(self.e))
    }

    /// `a` where this is above zero, else `b`.
    pub(super) fn select(self, a: Term<'g>, b: Term<'g>) -> Term<'g> {
        self.made(|g| g.select(self.e, a.e, b.e))
    }

    /// The angle of the direction (x, this).
    pub(super) fn atan2(self, x: Term<'g>) -> Term<'g> {
        self.made(|g| g.atan2(self.e, x.e))
    }

    /// The value of what has no symbol.
    pub(super) fn constant(self) -> f64 {
        self.sheet.with(|g| g.evaluate(&[self.e], |_| f64::NAN)[0])
    }
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
