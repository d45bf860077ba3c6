//! C text in lines of at most 100 columns.

/// Longest line that is written where it can be broken.
const WIDTH: usize = 100;

/// Generated text with its indentation.
#[derive(Default)]
pub(super) struct Lines {
    text: String,
    depth: usize,
}

impl Lines {
    pub fn indent(&mut self) {
        self.depth += 1;
    }

    pub fn dedent(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }

    /// A statement; too long a one is continued, broken before operators and after commas.
    pub fn code(&mut self, line: &str) {
        let mut indent = 4 * self.depth;
        let mut rest = line;
        while indent + rest.len() > WIDTH {
            let Some(at) = break_before(rest, WIDTH - indent) else { break };
            self.push(indent, rest[..at].trim_end());
            rest = rest[at..].trim_start();
            indent = 4 * (self.depth + 1);
        }
        self.push(indent, rest);
    }

    /// `{`, what `inner` writes, `}`.
    pub fn braces(&mut self, inner: impl FnOnce(&mut Self)) {
        self.code("{");
        self.indent();
        inner(self);
        self.dedent();
        self.code("}");
    }

    /// Lines that are written as they are.
    pub fn verbatim(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Sentences as one comment, each from a new line, wrapped at words.
    pub fn comment(&mut self, sentences: &[String]) {
        let indent = 4 * self.depth;
        let mut start = "/* ";
        for sentence in sentences {
            let mut current = String::new();
            for word in harmless(sentence).split(' ') {
                let columns = indent + 6 + current.chars().count() + 1 + word.chars().count();
                if !current.is_empty() && columns > WIDTH {
                    self.push(indent, &format!("{start}{current}"));
                    current.clear();
                    start = " * ";
                }
                if !current.is_empty() {
                    current.push(' ');
                }
                current.push_str(word);
            }
            self.push(indent, format!("{start}{current}").trim_end());
            start = " * ";
        }
        // The end of the comment stands behind its last word.
        self.text.truncate(self.text.trim_end().len());
        self.text.push_str(" */\n");
    }

    pub fn blank(&mut self) {
        self.text.push('\n');
    }

    pub fn finish(self) -> String {
        self.text
    }

    fn push(&mut self, indent: usize, line: &str) {
        if !line.is_empty() {
            self.text.extend(core::iter::repeat_n(' ', indent));
            self.text.push_str(line);
        }
        self.text.push('\n');
    }
}

/// Text that may stand in a comment: nothing that ends it or that a compiler warns of.
pub(super) fn harmless(text: &str) -> String {
    let visible = |c: char| if c.is_ascii_graphic() || c.is_alphabetic() { c } else { ' ' };
    let text: String = text.chars().map(visible).collect();
    text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?").replace('\\', "/")
}

/// The last place within `room` columns where a line may be broken.
fn break_before(line: &str, room: usize) -> Option<usize> {
    let breakable = |at: &usize| {
        let operator = [" + ", " - ", " * "].iter().any(|o| line[*at..].starts_with(o));
        operator || line[..*at].ends_with(", ")
    };
    let places = line.char_indices().map(|(at, _)| at).take_while(|at| *at <= room);
    places.filter(|at| *at > 0).filter(breakable).last()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_broken_at_operators() {
        let mut lines = Lines::default();
        let terms: Vec<String> = (0..40).map(|k| format!("x{k}")).collect();
        let line = format!("const double y = {};", terms.join(" + "));
        lines.code(&line);
        let text = lines.finish();
        assert!(text.lines().all(|l| l.len() <= WIDTH) && text.lines().count() > 1);
        assert_eq!(text.split_whitespace().collect::<Vec<_>>().join(" "), line);
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
