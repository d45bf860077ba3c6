//! Tokens of a formula.

use core::ops::Range;
use std::sync::Arc;

use num_rational::Ratio;

use super::name::Name;
use super::tree::Function;

/// A bracket's shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bracket {
    /// `( )`
    Round,
    /// `[ ]`
    Square,
    /// `\{ \}`
    Brace,
    /// `{ }`, which LaTeX does not print.
    Group,
    /// `\begin{bmatrix} \end{bmatrix}`
    Matrix,
}

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub enum Lexeme {
    /// A decimal number.
    Number(Ratio<i128>),
    /// A letter, Greek letter or longer name, with its subscript.
    Name(Arc<Name>),
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `\cdot`, `\times`, `*`
    Times,
    /// `/`
    Slash,
    /// `=`
    Equals,
    /// An opening bracket.
    Open(Bracket),
    /// A closing bracket.
    Close(Bracket),
    /// `^2`
    Power(i32),
    /// `^T`, or `^{-T}` of the inverse.
    Transposed {
        /// Of the inverse.
        inverse: bool,
    },
    /// `\sin`, `\cos`
    Function(Function),
    /// `\frac`
    Frac,
    /// `\sqrt`
    Sqrt,
    /// `\int`; its ends follow as groups.
    Integral,
    /// `\partial`
    Partial,
    /// `\text{tr}`
    Trace,
    /// `\|`
    Bar,
    /// `\prod_{j=1}^{n}`
    Over(Count),
    /// `&`, where it parts the cells of a matrix.
    Cell,
    /// `\\`, where it parts the rows of a matrix.
    Row,
}

/// An index that counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Count {
    /// The index.
    pub index: String,
    /// From here …
    pub from: String,
    /// … to here.
    pub to: String,
}

impl Lexeme {
    /// Whether a term may begin behind it.
    pub fn opens(&self) -> bool {
        matches!(self, Lexeme::Open(_) | Lexeme::Cell | Lexeme::Row)
    }

    /// Whether a term ends before it.
    pub fn closes(&self) -> bool {
        matches!(self, Lexeme::Close(_) | Lexeme::Cell | Lexeme::Row)
    }
}

/// A token.
#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    /// What it is.
    pub is: Lexeme,
    /// As it was written.
    pub text: String,
    /// Where.
    pub at: Range<usize>,
}
