//! Names with their subscripts, and what only stands where letters are matrices.

use std::sync::Arc;

use super::{Bracket, Count, Lexeme, Lexer};
use crate::latex::letters::{letter, matched};
use crate::latex::mistake::Mistake;
use crate::latex::name::Name;

/// Typefaces, which do not tell two names apart.
const FACES: [&str; 5] = ["\\mathbf", "\\boldsymbol", "\\mathrm", "\\mathit", "\\text"];

/// Accents, which do.
const ACCENTS: [&str; 3] = ["\\dot", "\\overline", "\\bar"];

impl Lexer<'_> {
    /// A name with its subscript, or `None` where none begins.
    pub(super) fn name(&mut self) -> Result<Option<Lexeme>, Mistake> {
        let start = self.at;
        let mut base = String::new();
        if self.matrices && self.eat("{}^") {
            base.push('^');
            base.push_str(&self.group(start)?);
        }
        let Some(letters) = self.letters()? else {
            let alone =
                Mistake::new(start..self.at, "an index stands here without a letter behind it");
            return if base.is_empty() { Ok(None) } else { Err(alone) };
        };
        base.push_str(&letters);
        while self.eat("'") {
            base.push('\'');
        }
        let mark = self.skip(self.at);
        let mut sub = None;
        if self.text[mark..].starts_with('_') {
            self.at = mark + 1;
            sub = Some(self.group(mark)?);
        }
        let name = Name::new(base, sub, &self.text[start..self.at]);
        Ok(Some(Lexeme::Name(Arc::new(name))))
    }

    /// The letters of a name: a letter, Greek letter or longer name; of a matrix in whatever
    /// typeface and with whatever accent.
    fn letters(&mut self) -> Result<Option<String>, Mistake> {
        let start = self.at;
        if self.matrices {
            self.at = self.skip(self.at);
            if FACES.iter().any(|face| self.eat(face)) {
                return self.group(start).map(Some);
            }
            if let Some(accent) = ACCENTS.iter().find(|accent| self.eat(accent)) {
                let braced = self.eat("{");
                let inner = self.letters()?;
                if inner.is_none() || braced && !self.eat("}") {
                    return Err(Mistake::new(
                        start..self.at,
                        "a letter is expected under this accent",
                    ));
                }
                return Ok(inner.map(|inner| format!("{}{inner}", &accent[1..])));
            }
        }
        let rest = self.rest();
        let long =
            self.names.iter().find_map(|name| matched(rest, name).map(|n| (name.clone(), n)));
        let found = long.or_else(|| letter(rest).map(|length| (rest[..length].to_owned(), length)));
        Ok(found.map(|(base, length)| {
            self.at += length;
            base
        }))
    }

    /// What stands in braces, or a single letter, without spaces and typefaces; `mark` is the place
    /// of what it belongs to.
    fn group(&mut self, mark: usize) -> Result<String, Mistake> {
        self.at = self.skip(self.at);
        if FACES.iter().any(|face| self.eat(face)) {
            return self.group(mark);
        }
        let start = self.at;
        let rest = self.rest();
        if let Some(inner) = rest.strip_prefix('{') {
            let Some(end) = inner.find('}') else {
                return Err(Mistake::new(start..start + 1, "this subscript is never closed"));
            };
            self.at = start + end + 2;
            let plain = FACES.iter().fold(inner[..end].to_owned(), |t, face| t.replace(face, ""));
            return Ok(plain.chars().filter(|c| !c.is_whitespace() && *c != '{').collect());
        }
        let command =
            |rest: &str| rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let length = match rest.chars().next() {
            Some(c) if c.is_alphanumeric() || c == '#' && self.matrices => c.len_utf8(),
            Some('\\') => 1 + command(&rest[1..]),
            _ => return Err(Mistake::new(mark..mark + 1, "nothing stands in this subscript")),
        };
        self.at = start + length;
        Ok(rest[..length].to_owned())
    }

    /// A token that only stands where letters are matrices.
    pub(super) fn of_matrices(&mut self) -> Result<Option<Lexeme>, Mistake> {
        for (mark, is) in [
            ("&", Lexeme::Cell),
            ("\\\\", Lexeme::Row),
            ("\\|", Lexeme::Bar),
            ("\\begin{bmatrix}", Lexeme::Open(Bracket::Matrix)),
            ("\\end{bmatrix}", Lexeme::Close(Bracket::Matrix)),
            ("\\text{tr}", Lexeme::Trace),
            ("\\mathrm{tr}", Lexeme::Trace),
        ] {
            if self.eat(mark) {
                return Ok(Some(is));
            }
        }
        let start = self.at;
        if !self.eat("\\prod") {
            return Ok(None);
        }
        let wrong = |end| Mistake::new(start..end, "a product is written \\prod_{j=1}^{n}");
        if !self.eat("_") {
            return Err(wrong(self.at));
        }
        let bounds = self.group(start)?;
        let (index, from) = bounds.split_once('=').ok_or_else(|| wrong(self.at))?;
        self.at = self.skip(self.at);
        if !self.eat("^") {
            return Err(wrong(self.at));
        }
        let to = self.group(start)?;
        Ok(Some(Lexeme::Over(Count { index: index.to_owned(), from: from.to_owned(), to })))
    }
}
