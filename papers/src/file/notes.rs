//! The strings of a data file with their places; each mistake is noted and reading goes on.

use core::ops::Range;
use std::collections::BTreeMap;

use ::toml::Spanned;

use crate::latex::formula::Piece;
use crate::latex::mistake::Mistake;

/// A string, its quotes in its place.
pub type Text = Spanned<String>;

/// What names stand for.
pub type Named<T> = BTreeMap<Text, T>;

/// Mistakes found so far, and the file's text.
pub struct Notes<'t> {
    /// The file.
    pub text: &'t str,
    /// What is wrong with it.
    pub mistakes: Vec<Mistake>,
}

impl Notes<'_> {
    /// Notes a mistake.
    pub fn wrong(&mut self, at: Range<usize>, message: impl Into<String>) {
        self.mistakes.push(Mistake::new(at, message));
    }

    /// A string and where its text begins, behind the quotes.
    pub fn piece(&self, text: &Text) -> Piece {
        let (span, text) = (text.span(), text.get_ref());
        let raw = self.text.get(span.clone()).unwrap_or_default();
        // Literal strings stand in the file as they are; in others only the first escape moves places.
        Piece { text: text.clone(), at: span.start + raw.find(text.as_str()).unwrap_or(0) }
    }
}

/// The text of what may be left out.
pub fn plain(text: Option<Text>) -> Option<String> {
    text.map(Spanned::into_inner)
}
