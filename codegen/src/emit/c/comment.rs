//! What C needs beside statements: braces, text as it is, and comments that nothing ends early.

use crate::emit::lines::{Lines, WIDTH};

/// What stands before and behind declarations that a C++ compiler takes, too.
pub(in crate::emit) const FOR_CPP: [&str; 2] =
    ["#ifdef __cplusplus\nextern \"C\" {\n#endif\n", "#ifdef __cplusplus\n}\n#endif\n"];

impl Lines {
    /// `{`, what `inner` writes, `}`.
    pub fn braces(&mut self, inner: impl FnOnce(&mut Self)) {
        self.within("{", "}", inner);
    }

    /// Sentences as one comment, each from a new line, wrapped at words.
    pub fn comment(&mut self, sentences: &[String]) {
        let mut start = "/* ";
        for sentence in sentences {
            // Room for the end of the comment.
            self.wrapped_to(WIDTH - 3, &harmless(sentence), [start, " * "]);
            start = " * ";
        }
        // The end of the comment stands behind its last word.
        self.text.truncate(self.text.trim_end().len());
        self.text.push_str(" */\n");
    }
}

/// Text that may stand in a comment: nothing that ends it or that a compiler warns of.
pub(in crate::emit) fn harmless(text: &str) -> String {
    let visible = |c: char| if c.is_ascii_graphic() || c.is_alphabetic() { c } else { ' ' };
    let text: String = text.chars().map(visible).collect();
    text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?").replace('\\', "/")
}

/// Formulas in plain characters.
pub(in crate::emit) fn plain(text: &str) -> String {
    let spelled = [
        ("⁻¹", "^-1"),
        ("⁺", "^+"),
        ("q̈", "qdd"),
        ("q̇", "qd"),
        ("J̇", "Jd"),
        ("²", "^2"),
        ("ᵀ", "'"),
        ("×", "x"),
        ("·", "*"),
        ("−", "-"),
        ("…", "..."),
        ("∂", "d"),
        ("√", "sqrt "),
        ("Σ", "sum"),
        ("τ", "tau"),
        ("θ", "theta"),
        ("δ", "delta "),
        ("π", "pi"),
    ];
    let all = spelled.into_iter();
    all.fold(text.to_string(), |text, (sign, letters)| text.replace(sign, letters))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derive::Held;

    #[test]
    fn formulas_of_all_outputs_are_plain() {
        for output in stiffarm_kernels::Output::EACH {
            for text in crate::emit::docs::docs(&Held::Output(output), 6, "") {
                assert!(plain(&text).is_ascii(), "{}", plain(&text));
            }
        }
    }

    #[test]
    fn a_comment_cannot_be_left() {
        let mut lines = Lines::default();
        lines.comment(&["a */ int x; /* ??/".to_string(), "line\nbreak\u{202e}".to_string()]);
        let text = lines.finish();
        assert_eq!(text.matches("*/").count(), 1);
        assert_eq!(text.matches("/*").count(), 1);
        assert!(!text.contains("??") && !text.contains('\u{202e}'));
        assert_eq!(text.lines().count(), 2);
    }
}
