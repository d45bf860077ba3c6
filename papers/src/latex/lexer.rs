//! LaTeX into tokens, each with its place and its own spelling, so that a mended formula is printed
//! back as it stood.

mod names;

use super::mistake::Mistake;
use super::notation::Notation;
pub use super::token::{Bracket, Count, Lexeme, Token};
use super::tree::Function;

/// Splits LaTeX into tokens.
///
/// # Errors
/// The first character that cannot begin a token.
pub fn lex(text: &str, notation: &Notation) -> Result<Vec<Token>, Mistake> {
    let (names, matrices) = (notation.long_names(), notation.matrices);
    let mut lexer = Lexer { text, at: 0, names, matrices, ends: false };
    let mut tokens = Vec::new();
    while let Some(token) = lexer.next()? {
        // A line that breaks at a sign repeats it.
        let repeated = tokens.last().is_some_and(|last: &Token| {
            matches!(token.is, Lexeme::Plus | Lexeme::Minus)
                && last.is == token.is
                && text[last.at.end..token.at.start].contains("\\\\")
        });
        if !repeated {
            tokens.push(token);
        }
    }
    Ok(tokens)
}

struct Lexer<'t> {
    text: &'t str,
    at: usize,
    names: Vec<String>,
    matrices: bool,
    /// Whether a `^` still belongs to an integral.
    ends: bool,
}

/// Marks that only lay the formula out; where letters are matrices, the first two part cells.
const IGNORED: [&str; 12] = [
    "\\\\",
    "&",
    "\\,",
    "\\;",
    "\\!",
    "\\:",
    "\\ ",
    "~",
    "\\begin{aligned}",
    "\\end{aligned}",
    "\\begin{split}",
    "\\end{split}",
];

/// Commands that only space or size.
const SILENT: &str = "quad qquad big Big bigg Bigg bigl bigr Bigl Bigr displaystyle mathrm mathbf \
                      boldsymbol mathit limits nonumber text";

impl<'t> Lexer<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn eat(&mut self, mark: &str) -> bool {
        let found = self.rest().starts_with(mark);
        self.at += if found { mark.len() } else { 0 };
        found
    }

    fn next(&mut self) -> Result<Option<Token>, Mistake> {
        let mut start = self.skip(self.at);
        self.at = start;
        // A size command belongs to the bracket that follows it.
        let sized = self.size_command();
        if sized {
            self.at = self.skip(self.at);
            if self.rest().starts_with('.') {
                self.at += 1;
                return self.next();
            }
        }
        if self.matrices
            && let Some(is) = self.of_matrices()?
        {
            return Ok(Some(self.token(is, start)));
        }
        if let Some(name) = self.name()? {
            return Ok(Some(self.token(name, start)));
        }
        let rest = self.rest();
        let Some(c) = rest.chars().next() else { return Ok(None) };
        if c == '\\' {
            let command: String = rest[1..].chars().take_while(char::is_ascii_alphabetic).collect();
            let dots = self.matrices && ["dots", "ldots", "cdots"].contains(&command.as_str());
            if dots || SILENT.split(' ').any(|silent| silent == command) {
                self.at += 1 + command.len();
                return self.next();
            }
            start = if sized { start } else { self.at };
            return self.command(&command, start).map(Some);
        }
        if c.is_ascii_digit() || (c == '.' && rest[1..].starts_with(|d: char| d.is_ascii_digit())) {
            return self.number().map(Some);
        }
        if c == '^' && self.ends {
            self.ends = false;
            self.at += 1;
            return self.next();
        }
        if c == '^' {
            return self.power().map(Some);
        }
        let is = match c {
            '+' => Lexeme::Plus,
            '-' | '−' => Lexeme::Minus,
            '*' | '·' => Lexeme::Times,
            '/' => Lexeme::Slash,
            '=' => Lexeme::Equals,
            '(' => Lexeme::Open(Bracket::Round),
            ')' => Lexeme::Close(Bracket::Round),
            '[' => Lexeme::Open(Bracket::Square),
            ']' => Lexeme::Close(Bracket::Square),
            '{' => Lexeme::Open(Bracket::Group),
            '}' => Lexeme::Close(Bracket::Group),
            '_' => {
                let at = self.at..self.at + 1;
                return Err(Mistake::new(at, "a subscript stands here without a letter before it"));
            }
            c => {
                let at = self.at..self.at + c.len_utf8();
                return Err(Mistake::new(at, format!("`{c}` cannot stand in a formula")));
            }
        };
        self.at += c.len_utf8();
        Ok(Some(self.token(is, start)))
    }

    fn token(&self, is: Lexeme, start: usize) -> Token {
        Token { is, text: self.text[start..self.at].to_owned(), at: start..self.at }
    }

    /// The first place from `at` on that is not space, a line break or an alignment mark.
    fn skip(&self, mut at: usize) -> usize {
        loop {
            let rest = &self.text[at..];
            let ignored = &IGNORED[if self.matrices { 2 } else { 0 }..];
            if let Some(mark) = ignored.iter().find(|mark| rest.starts_with(**mark)) {
                at += mark.len();
            } else if let Some(c) = rest.chars().next().filter(|c| c.is_whitespace()) {
                at += c.len_utf8();
            } else {
                return at;
            }
        }
    }

    /// Steps over `\left` or `\right`.
    fn size_command(&mut self) -> bool {
        for command in ["\\left", "\\right"] {
            if let Some(rest) = self.rest().strip_prefix(command)
                && !rest.starts_with(|c: char| c.is_ascii_alphabetic())
            {
                self.at += command.len();
                return true;
            }
        }
        false
    }

    fn command(&mut self, command: &str, start: usize) -> Result<Token, Mistake> {
        let is = match command {
            "sin" => Lexeme::Function(Function::Sin),
            "cos" => Lexeme::Function(Function::Cos),
            "frac" | "dfrac" | "tfrac" => Lexeme::Frac,
            "sqrt" => Lexeme::Sqrt,
            "cdot" | "times" => Lexeme::Times,
            "int" => Lexeme::Integral,
            "partial" => Lexeme::Partial,
            "" if self.rest().starts_with("\\{") => Lexeme::Open(Bracket::Brace),
            "" if self.rest().starts_with("\\}") => Lexeme::Close(Bracket::Brace),
            _ => {
                let shown: String = self.rest().chars().take(1 + command.len().max(1)).collect();
                let at = self.at..self.at + shown.len();
                return Err(Mistake::new(at, format!("`{shown}` is no command of a formula"))
                    .help(
                        "Greek letters, \\sin, \\cos, \\frac, \\sqrt, \\cdot, \\left, \\right are",
                    ));
            }
        };
        self.at += 1 + command.len().max(usize::from(command.is_empty()));
        if is == Lexeme::Integral {
            // The ends are written `_{a}^{b}`; the marks themselves say nothing more.
            self.drop_mark('_');
            self.ends = true;
        }
        Ok(self.token(is, start))
    }

    fn drop_mark(&mut self, mark: char) {
        let at = self.skip(self.at);
        if self.text[at..].starts_with(mark) {
            self.at = at + 1;
        }
    }

    fn number(&mut self) -> Result<Token, Mistake> {
        let start = self.at;
        let rest = self.rest();
        let length = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let value = stiffarm_codegen::number::Number::from_decimal(&rest[..length]);
        self.at += length;
        match value {
            Some(stiffarm_codegen::number::Number::Exact(value)) => {
                Ok(self.token(Lexeme::Number(value), start))
            }
            _ => Err(Mistake::new(start..self.at, "this is no decimal number")),
        }
    }

    fn power(&mut self) -> Result<Token, Mistake> {
        let start = self.at;
        let at = self.skip(self.at + 1);
        let rest = &self.text[at..];
        let (inner, length) = match rest.strip_prefix('{') {
            Some(inner) => match inner.find('}') {
                Some(end) => (&inner[..end], end + 2),
                None => return Err(Mistake::new(at..at + 1, "this power is never closed")),
            },
            None => {
                let length = rest.chars().next().map_or(0, char::len_utf8);
                (&rest[..length], length)
            }
        };
        let power = inner.trim().parse::<i32>().ok().filter(|p| p.abs() <= 64);
        let is = match (power, inner.trim()) {
            (Some(power), _) => Lexeme::Power(power),
            (None, "T") if self.matrices => Lexeme::Transposed { inverse: false },
            (None, "-T") if self.matrices => Lexeme::Transposed { inverse: true },
            _ => {
                let found = if inner.is_empty() { "nothing" } else { inner };
                let expected = match self.matrices {
                    true => "is no power of a matrix: T, -T or a whole number",
                    false => "stands where a whole-number power is expected",
                };
                let message = format!("`{found}` {expected}");
                return Err(Mistake::new(start..at + length, message));
            }
        };
        self.at = at + length;
        Ok(self.token(is, start))
    }
}

#[cfg(test)]
mod tests;
