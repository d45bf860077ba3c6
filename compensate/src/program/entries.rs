//! Assignments of a KUKA data list: `$MAMES[1]=0.0`.

use super::Language;
use super::cursor::Cursor;
use super::edit::{Cell, line as line_of};
use super::lexer::{self, Kind};

/// What is assigned to an element of an array.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// In the brackets.
    pub index: String,
    /// Its line, from 1.
    pub line: usize,
    /// As it stands.
    pub text: String,
    /// The number, if it is one.
    pub value: Option<Cell>,
}

/// Every assignment to an element of the array of that name (in small letters).
pub fn entries(text: &[u8], array: &str) -> Vec<Entry> {
    let tokens = lexer::tokens(text, &Language::Krl.style());
    let mut found = Vec::new();
    for line in tokens.split(|token| token.kind == Kind::Newline) {
        let mut at = Cursor::new(text, line);
        if at.word().as_deref() != Some(array) {
            continue;
        }
        let Some(index) = at.index().filter(|_| at.mark(b'=')) else { continue };
        let index = index.rest();
        let (shown, start) = (at.rest(), at.span().start);
        let value = at.number(1.0).filter(|_| at.is_at_end());
        found.push(Entry { index, line: line_of(text, start), text: shown, value });
    }
    found
}
