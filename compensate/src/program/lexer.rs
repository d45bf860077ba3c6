//! A program's bytes as tokens, by the lexical rules of its language.
//!
//! Bytes that are not ASCII stand in comments and texts alone, so that a file in any encoding can be read
//! and is kept.

use std::ops::Range;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// A name or a keyword.
    Word,
    /// A number without its sign.
    Number(f64),
    /// A text with its quotation marks.
    Text,
    /// Any other byte.
    Mark(u8),
    /// The end of a line.
    Newline,
}

/// A token and its bytes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) span: Range<usize>,
}

/// Lexical rules.
pub(super) struct Style {
    /// Begins a comment that ends with its line.
    pub(super) comment: u8,
    /// Begins a line that is no program text (`&` in KRL).
    pub(super) header: Option<u8>,
    /// Bytes that begin a word beside letters and `_`.
    pub(super) sigils: &'static [u8],
    /// Bytes that enclose a text; a text ends with its line.
    pub(super) quotes: &'static [u8],
}

/// The tokens of a text, without its comments and spaces.
pub(super) fn tokens(text: &[u8], style: &Style) -> Vec<Token> {
    let mut found = Vec::new();
    let mut at = 0;
    let mut begins = true;
    while let Some(&byte) = text.get(at) {
        let end = match byte {
            b'\n' | b'\r' => {
                found.push(Token { kind: Kind::Newline, span: at..at + 1 });
                begins = true;
                at += 1;
                continue;
            }
            b' ' | b'\t' => {
                at += 1;
                continue;
            }
            _ if byte == style.comment || begins && Some(byte) == style.header => {
                at = line_end(text, at);
                continue;
            }
            _ => token_end(text, at, style),
        };
        begins = false;
        let span = at..end;
        let kind = match byte {
            _ if is_word(byte) && !byte.is_ascii_digit() || style.sigils.contains(&byte) => {
                Kind::Word
            }
            _ if style.quotes.contains(&byte) => Kind::Text,
            _ => number(&text[span.clone()]).map_or(Kind::Mark(byte), Kind::Number),
        };
        found.push(Token { kind, span });
        at = end;
    }
    found
}

/// The same of a language in which the end of a line ends nothing.
pub(super) fn unbroken(text: &[u8], style: &Style) -> Vec<Token> {
    let mut found = tokens(text, style);
    found.retain(|token| token.kind != Kind::Newline);
    found
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

fn line_end(text: &[u8], from: usize) -> usize {
    let ends = |byte: &u8| matches!(byte, b'\n' | b'\r');
    text[from..].iter().position(ends).map_or(text.len(), |length| from + length)
}

fn token_end(text: &[u8], at: usize, style: &Style) -> usize {
    let while_is = |from: usize, is: &dyn Fn(u8) -> bool| {
        text[from..].iter().position(|b| !is(*b)).map_or(text.len(), |n| from + n)
    };
    let digits = |from: usize| while_is(from, &|b| b.is_ascii_digit());
    let byte = text[at];
    if style.quotes.contains(&byte) {
        let line = line_end(text, at);
        let close = text[at + 1..line].iter().position(|b| *b == byte);
        return close.map_or(line, |n| at + n + 2);
    }
    if is_word(byte) && !byte.is_ascii_digit() || style.sigils.contains(&byte) {
        return while_is(at + 1, &is_word);
    }
    let next_is_digit = |at: usize| text.get(at).is_some_and(u8::is_ascii_digit);
    if !(byte.is_ascii_digit() || byte == b'.' && next_is_digit(at + 1)) {
        return at + 1;
    }
    let mut end = digits(at);
    if text.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(text.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(text.get(end + 1), Some(b'+' | b'-')));
        if next_is_digit(end + 1 + sign) {
            end = digits(end + 1 + sign);
        }
    }
    end
}

fn number(bytes: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(bytes).ok()?;
    text.parse().ok().filter(|x: &f64| text.contains(|c: char| c.is_ascii_digit()) && x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_words_and_texts_are_told_apart() {
        let style = Style { comment: b';', header: Some(b'&'), sigils: b"$#", quotes: b"\"" };
        let text = b"&ACCESS R 9E\n$BASE={X -1.5E-3,A1 .5} ; 7 \xe4\nPTP \"a;b\" #ON 2.\n'";
        let found: Vec<String> = tokens(text, &style)
            .iter()
            .map(|token| match token.kind {
                Kind::Number(x) => x.to_string(),
                Kind::Newline => "/".to_owned(),
                _ => String::from_utf8_lossy(&text[token.span.clone()]).into_owned(),
            })
            .collect();
        let expected = [
            "/", "$BASE", "=", "{", "X", "-", "0.0015", ",", "A1", "0.5", "}", "/", "PTP",
            "\"a;b\"", "#ON", "2", "/", "'",
        ];
        assert_eq!(found, expected);
    }
}
