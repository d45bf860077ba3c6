//! Documentation of generated Rust.

use crate::emit::lines::{Lines, WIDTH};

impl Lines {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn documentation_is_wrapped_at_words() {
        let mut lines = Lines::at(0);
        lines.doc(&"word ".repeat(40));
        assert!(lines.finish().lines().all(|l| l.starts_with("///") && l.len() <= WIDTH));
    }
}
