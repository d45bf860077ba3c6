//! Tokens of a formula.

use core::ops::Range;

use num_rational::Ratio;

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
}

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub enum Lexeme {
    /// A decimal number.
    Number(Ratio<i128>),
    /// A letter, Greek letter or longer name, with its subscript.
    Name {
        /// Without spaces.
        base: String,
        /// Without braces and spaces.
        sub: Option<String>,
    },
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
