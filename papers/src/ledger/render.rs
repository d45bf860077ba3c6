//! The ledger as text and Markdown.

use std::fmt::Write as _;

use crate::ledger::{Ledger, witness_line};
use crate::verdict::{Entry, Kind, Verdict};

impl Ledger {
    /// A line for each entry, with the correction, the change and the witness below it.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        for (id, title) in &self.titles {
            let _ = writeln!(out, "{title}\n{}", self.summary(id));
            for entry in self.paper(id) {
                let _ = writeln!(out, "  {:<34} {}", entry.number, entry.verdict.words());
                for (name, text) in details(entry) {
                    let _ = writeln!(out, "      {name}: {text}");
                }
            }
            out.push('\n');
        }
        out
    }

    /// Tables in Markdown.
    pub fn to_markdown(&self) -> String {
        let mut out = String::new();
        for (id, title) in &self.titles {
            let _ = writeln!(out, "## {title}\n\n{}.\n", self.summary(id));
            for (kind, head) in [
                (Kind::Equation, "| equation | printed | verdict | correction and change |"),
                (Kind::Cell, "| cell | printed | verdict | computed |"),
            ] {
                let mut rows = self.paper(id).filter(|e| e.kind == kind).peekable();
                if rows.peek().is_none() {
                    continue;
                }
                let _ = writeln!(out, "{head}\n|---|---|---|---|");
                for entry in rows {
                    let more: Vec<String> = details(entry)
                        .into_iter()
                        .map(|(name, text)| format!("{name}: {text}"))
                        .collect();
                    let _ = writeln!(
                        out,
                        "| {} | `{}` | {} | {} |",
                        cell(&entry.number),
                        cell(&entry.printed),
                        entry.verdict.words(),
                        cell(&more.join("<br>"))
                    );
                }
                out.push('\n');
            }
        }
        out
    }
}

/// What there is to say about an entry beyond its verdict.
pub(super) fn details(entry: &Entry) -> Vec<(&'static str, String)> {
    let mut out = Vec::new();
    let mut add = |name, text: Option<String>| out.extend(text.map(|text| (name, text)));
    let misprint = matches!(entry.verdict, Verdict::Misprint | Verdict::Unreadable);
    let correction = if entry.kind == Kind::Cell { "computed" } else { "correct" };
    if misprint || entry.kind == Kind::Cell {
        add(correction, entry.correction.clone());
        add("change", entry.change.clone());
        add("differs", witness_line(entry));
    }
    if entry.kind == Kind::Equation && !entry.source.is_empty() {
        let name = if entry.verdict == Verdict::Definition { "because" } else { "compared with" };
        add(name, Some(entry.source.clone()));
    }
    add("note", entry.note.clone());
    out
}

/// Text that may stand in a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::read;

    #[test]
    fn markdown_escapes_bars() {
        let text = "paper = 'x'\n[[equation]]\nnumber = '(1)'\nlatex = 'y = a | b'\n\
            definition = 'a name'\n";
        let text = Ledger::of(&[read(text, "x").unwrap()]).to_markdown();
        assert!(text.contains("| (1) | `y = a \\| b` | definition | because: a name |"), "{text}");
    }
}
