//! Text in lines of at most 100 columns.

/// Longest line that is written where it can be broken.
const WIDTH: usize = 100;

/// Generated text with its indentation.
#[derive(Default)]
pub(super) struct Lines {
    text: String,
    depth: usize,
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

    /// A line of documentation, wrapped at words; a table's row stays one line.
    pub fn doc(&mut self, line: &str) {
        if line.starts_with('|') {
            return self.push(4 * self.depth, &format!("/// {line}"));
        }
        let room = WIDTH - 4 * self.depth - 4;
        let mut current = String::new();
        for word in line.split(' ') {
            if !current.is_empty() && current.chars().count() + 1 + word.chars().count() > room {
                self.push(4 * self.depth, format!("/// {current}").trim_end());
                current.clear();
            }
            if !current.is_empty() {
                current.push(' ');
            }
            current.push_str(word);
        }
        self.push(4 * self.depth, format!("/// {current}").trim_end());
    }

    pub fn blank(&mut self) {
        self.text.push('\n');
    }

    pub fn finish(self) -> String {
        self.text
    }

    fn push(&mut self, indent: usize, line: &str) {
        if !line.is_empty() {
            self.text.extend(std::iter::repeat_n(' ', indent));
            self.text.push_str(line);
        }
        self.text.push('\n');
    }
}

/// The last place within `room` columns where a line may be broken.
fn break_before(line: &str, room: usize) -> Option<usize> {
    let mut last = None;
    for (columns, (at, _)) in line.char_indices().enumerate() {
        if columns > room {
            break;
        }
        let rest = &line[at..];
        let operator = [" + ", " - ", " * "].iter().any(|o| rest.starts_with(o));
        let comma = at > 0 && line[..at].ends_with(", ");
        if at > 0 && (operator || comma) {
            last = Some(at);
        }
    }
    last
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

    #[test]
    fn documentation_is_wrapped_at_words() {
        let mut lines = Lines::at(0);
        lines.doc(&"word ".repeat(40));
        assert!(lines.finish().lines().all(|l| l.starts_with("///") && l.len() <= WIDTH));
    }
}
