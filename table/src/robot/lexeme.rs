//! The words of a cell: numbers, names and signs, from a quoted string or from Rust tokens alike.

use core::ops::Range;

use super::problem::Place;

/// What one word of a cell is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Kind {
    /// An unsigned decimal literal, as written.
    Number(String),
    /// A unit, a parameter, `pi` or `q`.
    Name(String),
    /// One sign.
    Sign(char),
    /// What has no place in a cell: a bracket group, a string.
    #[cfg(feature = "macro")]
    Other(String),
}

/// A word and its place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lexeme<L> {
    /// The word.
    pub kind: Kind,
    /// Where it stands.
    pub at: L,
}

impl<L> Lexeme<L> {
    /// The name, if the word is one.
    pub fn name(&self) -> Option<&str> {
        match &self.kind {
            Kind::Name(name) => Some(name),
            _ => None,
        }
    }

    /// Whether the word is this sign.
    pub fn is(&self, sign: char) -> bool {
        self.kind == Kind::Sign(sign)
    }
}

/// Splits a text into words; `at` turns a byte range of the text into a place.
pub(crate) fn lex<L>(text: &str, at: impl Fn(Range<usize>) -> L) -> Vec<Lexeme<L>> {
    let mut words = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        let (kind, length) = if let Some(length) = number_length(rest) {
            (Some(Kind::Number(rest[..length].to_owned())), length)
        } else if is_name_start(first) {
            let length = rest.find(|c| !is_name_part(c)).unwrap_or(rest.len());
            (Some(Kind::Name(canonical_name(&rest[..length]))), length)
        } else if let Some((exponent, length)) = superscript(rest) {
            // `m²` reads as `m^2`.
            let range = start..start + length;
            words.push(Lexeme { kind: Kind::Sign('^'), at: at(range.clone()) });
            if exponent.starts_with('-') {
                words.push(Lexeme { kind: Kind::Sign('-'), at: at(range) });
            }
            (Some(Kind::Number(exponent.trim_start_matches('-').to_owned())), length)
        } else {
            let kind = match first {
                c if c.is_whitespace() => None,
                '°' => Some(Kind::Name("deg".to_owned())),
                '·' | '⋅' | '×' => Some(Kind::Sign('*')),
                '−' => Some(Kind::Sign('-')),
                c => Some(Kind::Sign(c)),
            };
            (kind, first.len_utf8())
        };
        if let Some(kind) = kind {
            words.push(Lexeme { kind, at: at(start..start + length) });
        }
        start += length;
    }
    words
}

fn is_name_start(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

fn is_name_part(c: char) -> bool {
    // `²` and the like are numeric for Unicode; they are exponents here.
    c == '_' || c.is_alphabetic() || c.is_ascii_digit()
}

fn canonical_name(name: &str) -> String {
    match name {
        "π" => "pi".to_owned(),
        // The micro sign and the Greek letter look the same.
        _ => name.replace(['µ', 'μ'], "u"),
    }
}

/// Length of the decimal literal that the text starts with.
fn number_length(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'_').count()
    };
    let whole = if bytes.first()?.is_ascii_digit() { digits(0) } else { 0 };
    let mut end = whole;
    if bytes.get(end) == Some(&b'.') {
        let starts_digit = bytes.get(end + 1).is_some_and(u8::is_ascii_digit);
        if whole > 0 || starts_digit {
            end += 1 + if starts_digit { digits(end + 1) } else { 0 };
        }
    }
    if end == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
            end += 1 + sign + digits(end + 1 + sign);
        }
    }
    Some(end)
}

/// The exponent in plain digits and the length of the superscripts that the text starts with.
fn superscript(text: &str) -> Option<(String, usize)> {
    let mut plain = String::new();
    let mut length = 0;
    for c in text.chars() {
        let digit = match c {
            '⁻' if plain.is_empty() => '-',
            '⁰' => '0',
            '¹' => '1',
            '²' => '2',
            '³' => '3',
            '⁴'..='⁹' => char::from_digit(c as u32 - '⁰' as u32, 10)?,
            _ => break,
        };
        plain.push(digit);
        length += c.len_utf8();
    }
    plain.ends_with(|c: char| c.is_ascii_digit()).then_some((plain, length))
}

/// The words as one readable text: `-90 deg`, `3.8e6 N*m/rad`, `t2 + pi/2`.
pub(crate) fn show<L>(words: &[Lexeme<L>]) -> String {
    let mut text = String::new();
    let mut glued = true;
    for (i, word) in words.iter().enumerate() {
        let (piece, sign) = match &word.kind {
            Kind::Number(s) | Kind::Name(s) => (s.clone(), false),
            #[cfg(feature = "macro")]
            Kind::Other(s) => (s.clone(), false),
            Kind::Sign(c) => (c.to_string(), true),
        };
        let is_sum = i > 0 && is_sum_sign(words, i);
        if (!glued && !sign) || is_sum {
            text.push(' ');
        }
        text.push_str(&piece);
        if is_sum && i + 1 < words.len() {
            text.push(' ');
        }
        glued = sign;
    }
    text
}

/// Whether the word at `i > 0` adds or subtracts (rather than being the sign of an exponent).
fn is_sum_sign<L>(words: &[Lexeme<L>], i: usize) -> bool {
    (words[i].is('+') || words[i].is('-')) && !matches!(words[i - 1].kind, Kind::Sign(_))
}

/// The place of the first sign that adds or subtracts, if the words are a sum.
pub(crate) fn sum_sign<L: Place>(words: &[Lexeme<L>]) -> Option<L> {
    (1..words.len()).find(|i| is_sum_sign(words, *i)).map(|i| words[i].at.clone())
}

/// The place of all words together; `None` if there are none.
pub(crate) fn extent<L: Place>(words: &[Lexeme<L>]) -> Option<L> {
    Some(words.first()?.at.to(&words.last()?.at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        lex(text, |r| r).iter().map(|w| show(core::slice::from_ref(w))).collect()
    }

    #[test]
    fn numbers_names_and_signs() {
        assert_eq!(words("-90 deg"), ["-", "90", "deg"]);
        assert_eq!(words("3.8e6 N*m/rad"), ["3.8e6", "N", "*", "m", "/", "rad"]);
        assert_eq!(words("350mm"), ["350", "mm"]);
        assert_eq!(words("3pi/4"), ["3", "pi", "/", "4"]);
        assert_eq!(words("1_000.5E-3in"), ["1_000.5E-3", "in"]);
        assert_eq!(words(".5 1. 2e"), [".5", "1.", "2", "e"]);
        assert_eq!(words("a2_x"), ["a2_x"]);
        assert_eq!(words(""), [""; 0]);
    }

    #[test]
    fn print_signs_of_paper_are_understood() {
        assert_eq!(words("N·m²"), ["N", "*", "m", "^", "2"]);
        assert_eq!(words("s⁻²"), ["s", "^", "-", "2"]);
        assert_eq!(words("mm⁴"), ["mm", "^", "4"]);
        assert_eq!(words("−90°"), ["-", "90", "deg"]);
        assert_eq!(words("π/2 5 µm"), ["pi", "/", "2", "5", "um"]);
        assert_eq!(words("⁻"), ["⁻"]);
    }

    #[test]
    fn places_are_byte_ranges() {
        let found: Vec<_> = lex("5 µm·s", |r| r).into_iter().map(|w| w.at).collect();
        assert_eq!(found, [0..1, 2..5, 5..7, 7..8]);
    }

    #[test]
    fn words_are_shown_readably() {
        for text in ["-90 deg", "3.8e6 N*m/rad", "t2 + pi/2", "1 m^-2", "q - 5 mm"] {
            assert_eq!(show(&lex(text, |r| r)), text);
        }
        assert_eq!(sum_sign(&lex("1 m^-2", |r| r)), None);
        assert_eq!(sum_sign(&lex("t2 + 1", |r| r)), Some(3..4));
        assert_eq!(extent(&lex(" t2 + 1 ", |r| r)), Some(1..7));
    }
}
