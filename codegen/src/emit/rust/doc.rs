//! Documentation of generated Rust.

use crate::emit::lines::Lines;

impl Lines {
    /// A line of documentation, wrapped at words; a table's row stays one line.
    pub fn doc(&mut self, line: &str) {
        if line.starts_with('|') {
            return self.push(4 * self.depth, &format!("/// {line}"));
        }
        self.wrapped(line, "/// ");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emit::lines::WIDTH;

    #[test]
    fn documentation_is_wrapped_at_words() {
        let mut lines = Lines::at(0);
        lines.doc(&"word ".repeat(40));
        assert!(lines.finish().lines().all(|l| l.starts_with("///") && l.len() <= WIDTH));
    }
}
