//! Generated text in lines of at most 100 columns.

/// Longest line that is written where it can be broken.
pub(super) const WIDTH: usize = 100;

/// Generated text with its indentation.
#[derive(Default)]
pub(super) struct Lines {
    pub(super) text: String,
    pub(super) depth: usize,
}

impl Lines {
    pub fn at(depth: usize) -> Self {
        Lines { text: String::new(), depth }
    }

    pub fn indent(&mut self) {
        self.depth += 1;
    }

    pub fn dedent(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }

    /// `head`, what `inner` writes a step further in, and `close`.
    pub fn within(&mut self, head: &str, close: &str, inner: impl FnOnce(&mut Self)) {
        self.code(head);
        self.indent();
        inner(self);
        self.dedent();
        self.code(close);
    }

    /// A statement; too long a one is continued, broken before operators and after commas.
    pub fn code(&mut self, line: &str) {
        let mut indent = 4 * self.depth;
        let mut rest = line;
        while indent + rest.chars().count() > WIDTH {
            let Some(at) = break_before(rest, WIDTH - indent) else { break };
            self.push(indent, rest[..at].trim_end());
            rest = rest[at..].trim_start();
            indent = 4 * (self.depth + 1);
        }
        self.push(indent, rest);
    }

    /// Text wrapped at words, every line behind `start`.
    pub fn wrapped(&mut self, text: &str, start: &str) {
        self.wrapped_to(WIDTH, text, [start; 2]);
    }

    /// The same in so many columns, the first line and the others behind what they begin with.
    pub fn wrapped_to(&mut self, width: usize, text: &str, [first, others]: [&str; 2]) {
        let room = width - 4 * self.depth - first.len();
        let (mut start, mut current) = (first, String::new());
        for word in text.split(' ') {
            if !current.is_empty() && current.chars().count() + 1 + word.chars().count() > room {
                self.push(4 * self.depth, format!("{start}{current}").trim_end());
                current.clear();
                start = others;
            }
            if !current.is_empty() {
                current.push(' ');
            }
            current.push_str(word);
        }
        self.push(4 * self.depth, format!("{start}{current}").trim_end());
    }

    /// Lines that are written as they are.
    pub fn verbatim(&mut self, text: &str) {
        self.text.push_str(text);
    }

    pub fn blank(&mut self) {
        self.text.push('\n');
    }

    pub fn finish(self) -> String {
        self.text
    }

    /// A line as it is, `indent` columns to the right.
    pub fn push(&mut self, indent: usize, line: &str) {
        if !line.is_empty() {
            self.text.extend(core::iter::repeat_n(' ', indent));
            self.text.push_str(line);
        }
        self.text.push('\n');
    }
}

/// The last place within `room` columns where a line may be broken.
fn break_before(line: &str, room: usize) -> Option<usize> {
    let breakable = |at: &usize| {
        let operator = [" + ", " - ", " * "].iter().any(|o| line[*at..].starts_with(o));
        operator || line[..*at].ends_with(", ")
    };
    let places = line.char_indices().map(|(at, _)| at).take(room + 1);
    places.filter(|at| *at > 0).filter(breakable).last()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_broken_at_operators() {
        let mut lines = Lines::at(1);
        let terms: Vec<String> = (0..40).map(|k| format!("x{k}")).collect();
        lines.code(&format!("let y = {};", terms.join(" + ")));
        let text = lines.finish();
        assert!(text.lines().all(|l| l.len() <= WIDTH) && text.lines().count() > 1);
        let joined: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(joined, format!("let y = {};", terms.join(" + ")));
    }
}
