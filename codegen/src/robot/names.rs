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
pub(crate) fn is_keyword(name: &str) -> bool {
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

#[cfg(test)]
mod tests {
    use super::super::Robot;

    fn messages(lines: &str) -> Vec<String> {
        let text = format!(
            "name = \"x\"\nconvention = \"modified\"\n[[joint]]\ntype = \"revolute\"\n{lines}\n"
        );
        match Robot::from_toml(&text, "x.toml") {
            Ok(_) => Vec::new(),
            Err(error) => error.errors.into_iter().map(|e| e.message).collect(),
        }
    }

    #[test]
    fn a_parameter_is_one_quantity() {
        assert_eq!(
            messages("theta = \"x\"\na = \"x\"\nmass = \"x\""),
            [
                "`x` is an angle where it first stands, and a length here",
                "`x` is an angle where it first stands, and a mass here"
            ]
        );
        assert!(messages("d = \"x\"\na = \"x\"\nmass = 1\ncom = [\"x\", 0, 0]").is_empty());
    }

    /// What syn reads as a name is one, but for `gen`, which it does not know as a keyword.
    #[cfg(feature = "macro")]
    #[test]
    fn keywords_are_those_of_rust() {
        for name in super::KEYWORDS.into_iter().filter(|name| *name != "gen") {
            assert!(syn::parse_str::<syn::Ident>(name).is_err(), "{name}");
        }
    }

    #[test]
    fn a_parameter_can_be_a_field() {
        assert!(messages("a = \"L1\"\nd = \"d_1\"\ntheta = \"tE\"").is_empty());
        let refused = |name: &str| messages(&format!("a = \"{name}\""));
        assert_eq!(
            refused("q"),
            ["`q` is the joint variable: it stands in theta or d, nowhere else"]
        );
        assert_eq!(refused("w"), ["`w` is the wrench in the generated code"]);
        assert_eq!(refused("type"), ["`type` is a keyword of Rust"]);
        assert_eq!(refused("Self"), ["`Self` is a keyword of Rust"]);
        assert_eq!(refused("_a"), ["`_a` cannot be a parameter's name"]);
        assert_eq!(refused("länge"), ["`länge` cannot be a parameter's name"]);
        // One mistake, however often the name is used.
        assert_eq!(messages("a = \"fn\"\nd = \"fn\""), ["`fn` is a keyword of Rust"]);
    }

    #[test]
    fn joints_and_markers_have_names_of_their_own() {
        assert_eq!(
            messages(
                "name = \"a\"\n[[joint]]\ntype = \"revolute\"\nname = \"a\"\n\
                 [[marker]]\nname = \"m\"\n[[marker]]\nname = \"m\"\n[[marker]]\nname = \"\""
            ),
            ["two joints are called `a`", "two markers are called `m`", "a marker without a name"]
        );
    }
}
