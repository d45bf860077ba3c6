//! The names in a table: joints, markers and symbolic parameters.

use super::problem::{Place, Problem, Report};

/// Names that a parameter cannot have because the generated code means something else by them.
const RESERVED: [(&str, &str); 3] = [
    ("q", "`q` is the joint variable: it stands in theta or d, nowhere else"),
    ("w", "`w` is the wrench in the generated code"),
    ("pi", "`pi` is the number π"),
];

/// A name stands in comments, messages and pages: a line break in it would be theirs.
pub(crate) fn plain<L: Place>(text: &str, at: &L, report: &mut Report<L>) {
    if let Some(found) = text.chars().find(|c| c.is_control()) {
        let message = format!("the control character {found:?} stands in a text");
        report.error(
            Problem::new(at.clone(), message).help("write the text on one line, without it"),
        );
    }
}

/// Why a name cannot be a module's, nor a part of names in C, and what to do.
pub(crate) fn no_module(name: &str) -> Option<(String, &'static str)> {
    let plain = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !plain {
        let help = "such a name is a lower-case letter, then lower-case letters, digits and `_`";
        return Some((format!("`{name}` cannot be the name of a module"), help));
    }
    let keyword = KEYWORDS.contains(&name);
    keyword.then(|| (format!("`{name}` is a keyword of Rust"), "choose another name"))
}

/// Why a name cannot be a parameter's, and what to do.
pub(crate) fn refused(name: &str) -> Option<(String, &'static str)> {
    let help = "choose another name";
    if let Some((_, message)) = RESERVED.iter().find(|(reserved, _)| *reserved == name) {
        return Some(((*message).to_owned(), help));
    }
    let plain = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !plain {
        let help = "a name is a letter, then letters, digits and `_`, without accents";
        return Some((format!("`{name}` cannot be a parameter's name"), help));
    }
    is_keyword(name).then(|| (format!("`{name}` is a keyword of Rust"), help))
}

/// Whether Rust means something else by a name.
pub fn is_keyword(name: &str) -> bool {
    KEYWORDS.contains(&name)
}

/// The keywords of every edition of Rust, reserved ones included (The Rust Reference, 2.3).
#[rustfmt::skip]
const KEYWORDS: [&str; 52] = [
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
    "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if",
    "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub",
    "ref", "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

#[cfg(all(test, feature = "macro"))]
mod tests {
    /// What syn reads as a name is one, but for `gen`, which it does not know as a keyword.
    #[test]
    fn keywords_are_those_of_rust() {
        for name in super::KEYWORDS.into_iter().filter(|name| *name != "gen") {
            assert!(syn::parse_str::<syn::Ident>(name).is_err(), "{name}");
        }
    }
}
