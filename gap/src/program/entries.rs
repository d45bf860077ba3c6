//! Assignments of a KUKA data list: `$MAMES[1]=0.0`.

use super::Language;
use super::cursor::Cursor;
use super::edit::Cell;
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
        if at.word().as_deref() != Some(array) || !at.mark(b'[') {
            continue;
        }
        let index = at.until(b"]").rest();
        if !(at.mark(b']') && at.mark(b'=')) {
            continue;
        }
        let (shown, start) = (at.rest(), at.span().start);
        let number = 1 + text[..start].iter().filter(|byte| **byte == b'\n').count();
        let value = at.number(1.0).filter(|_| at.is_at_end());
        found.push(Entry { index, line: number, text: shown, value });
    }
    found
}
