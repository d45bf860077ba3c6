//! Expressions of the statement tree, and how a language spells them.

use std::rc::Rc;

use crate::number::Number;

/// A name in generated text.
pub(crate) type Name = Rc<str>;

/// An expression, with every sign where it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Term {
    Number(Number),
    /// A local of the function.
    Local(Name),
    /// A field of the constants; in the constants themselves a parameter of the table.
    Constant(Name),
    /// An entry of an array: `q[2]`, `e[1][3]`.
    Entry(&'static str, Vec<usize>),
    Negative(Box<Term>),
    Sum(Box<[Term; 2]>),
    Difference(Box<[Term; 2]>),
    Product(Box<[Term; 2]>),
    /// `a·b + c`, rounded once.
    Fused(Box<[Term; 3]>),
    Of(Operation, Box<[Term]>),
}

/// What is done to one number, or to as many as it says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operation {
    Reciprocal,
    Root,
    Sign,
    Sine,
    Cosine,
    /// The angle of the direction (x, y) of y and x.
    Atan2,
    /// The second of three where the first is above zero, else the third.
    Select,
}

/// How a language spells the pieces of an expression.
pub(crate) trait Style {
    /// A constant.
    fn number(&self, n: Number) -> String;
    /// An operation on numbers, which are bare.
    fn of(&self, operation: Operation, numbers: &[String]) -> String;
    /// A local.
    fn local(&self, name: &str) -> String {
        name.to_string()
    }
    /// A field of the constants, or a parameter where there are none.
    fn constant(&self, name: &str) -> String {
        name.to_string()
    }
    /// An entry of an array.
    fn entry(&self, array: &str, at: &[usize]) -> String {
        at.iter().fold(array.to_string(), |text, k| format!("{text}[{k}]"))
    }
    /// A product.
    fn product(&self, a: &str, b: &str) -> String {
        format!("{a} * {b}")
    }
    /// A bracketed expression.
    fn bracket(&self, inner: &str) -> String {
        format!("({inner})")
    }
    /// `a·b + c`, each bare.
    fn fused(&self, a: &str, b: &str, c: &str) -> String {
        self.bracket(&format!("{} + {c}", self.product(&self.bracket(a), &self.bracket(b))))
    }
}

/// How strongly an expression binds: what decides whether it needs brackets.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Sum,
    Negation,
    Product,
    Atom,
}

impl Term {
    pub fn local(name: impl Into<Name>) -> Term {
        Term::Local(name.into())
    }

    /// The sum of signed terms, from the left.
    pub fn sum(terms: impl IntoIterator<Item = (Term, bool)>) -> Term {
        let add = |sum: Option<Term>, (term, negative)| match (sum, negative) {
            (None, false) => Some(term),
            (None, true) => Some(Term::Negative(Box::new(term))),
            (Some(sum), false) => Some(Term::Sum(Box::new([sum, term]))),
            (Some(sum), true) => Some(Term::Difference(Box::new([sum, term]))),
        };
        terms.into_iter().fold(None, add).unwrap_or(Term::Number(Number::ZERO))
    }

    /// The expressions that it is made of.
    pub fn operands(&self) -> &[Term] {
        match self {
            Term::Negative(a) => core::slice::from_ref(a),
            Term::Of(_, all) => all,
            Term::Sum(both) | Term::Difference(both) | Term::Product(both) => &both[..],
            Term::Fused(all) => &all[..],
            _ => &[],
        }
    }

    /// Calls `with` on every name, entry and number.
    pub fn leaves<'t>(&'t self, with: &mut impl FnMut(&'t Term)) {
        match self.operands() {
            [] => with(self),
            operands => operands.iter().for_each(|operand| operand.leaves(with)),
        }
    }

    /// Whether some name, entry or number is so.
    pub fn any(&self, is: impl Fn(&Term) -> bool) -> bool {
        let mut found = false;
        self.leaves(&mut |leaf| found |= is(leaf));
        found
    }

    /// The text in a language. The order of operations is kept: a sum on the right is bracketed.
    pub fn print(&self, style: &dyn Style) -> String {
        let bracketed = |term: &Term, least: Binds| match term.binds() < least {
            true => style.bracket(&term.print(style)),
            false => term.print(style),
        };
        let sum = |[a, b]: &[Term; 2], operator: &str| {
            format!("{} {operator} {}", a.print(style), bracketed(b, Binds::Product))
        };
        match self {
            Term::Number(n) => style.number(*n),
            Term::Local(name) => style.local(name),
            Term::Constant(name) => style.constant(name),
            Term::Entry(array, at) => style.entry(array, at),
            Term::Negative(a) => format!("-{}", bracketed(a, Binds::Negation)),
            Term::Sum(both) => sum(both, "+"),
            Term::Difference(both) => sum(both, "-"),
            Term::Product(both) => {
                let [a, b] = both.as_ref();
                style.product(&bracketed(a, Binds::Negation), &bracketed(b, Binds::Atom))
            }
            Term::Fused(all) => {
                let [a, b, c] = all.each_ref().map(|term| term.print(style));
                style.fused(&a, &b, &c)
            }
            Term::Of(operation, all) => {
                let numbers: Vec<String> = all.iter().map(|term| term.print(style)).collect();
                style.of(*operation, &numbers)
            }
        }
    }

    fn binds(&self) -> Binds {
        match self {
            Term::Sum(_) | Term::Difference(_) => Binds::Sum,
            Term::Negative(_) => Binds::Negation,
            Term::Product(_) => Binds::Product,
            _ => Binds::Atom,
        }
    }
}
