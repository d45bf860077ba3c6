//! The ledger for machines.

use std::fmt::Write as _;

use super::verdict::{Entry, Kind};
use crate::ledger::Ledger;

impl Ledger {
    /// A list of entries in JSON; what is not known is null.
    pub fn to_json(&self) -> String {
        let entries: Vec<String> = self.entries.iter().map(entry).collect();
        format!("[\n{}\n]\n", entries.join(",\n"))
    }
}

fn entry(e: &Entry) -> String {
    let mut out = String::from("  {");
    let kind = if e.kind == Kind::Equation { "equation" } else { "cell" };
    let texts = [
        ("paper", Some(e.paper.as_str())),
        ("number", Some(&e.number)),
        ("kind", Some(kind)),
        ("printed", Some(&e.printed)),
        ("verdict", Some(e.verdict.name())),
        ("correction", e.correction.as_deref()),
        ("change", e.change.as_deref()),
        ("source", Some(e.source.as_str()).filter(|s| !s.is_empty())),
        ("note", e.note.as_deref()),
    ];
    for (name, text) in texts {
        let _ = write!(out, "\"{name}\": {}, ", text.map_or("null".into(), string));
    }
    match &e.witness {
        None => out.push_str("\"witness\": null}"),
        Some(w) => {
            let list = |values: &[(String, f64)]| {
                let each = values.iter().map(|(n, v)| format!("{}: {}", string(n), number(*v)));
                each.collect::<Vec<_>>().join(", ")
            };
            let _ = write!(
                out,
                "\"witness\": {{\"degrees\": {{{}}}, \"symbols\": {{{}}}, \"printed\": {}, \
                 \"derived\": {}}}}}",
                list(&w.angles),
                list(&w.symbols),
                number(w.printed),
                number(w.derived)
            );
        }
    }
    out
}

fn number(x: f64) -> String {
    if x.is_finite() { format!("{x:?}") } else { "null".into() }
}

fn string(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04x}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::read;

    #[test]
    fn entries_are_objects() {
        let text = "paper = 'x'\n[[equation]]\nnumber = '(1)'\n\
            latex = 'y = \\sin\\theta_1'\ntruth = '\\cos\\theta_1'\n";
        let json = Ledger::of(&[read(text, "x").unwrap()]).to_json();
        assert!(json.contains("\"verdict\": \"misprint\""), "{json}");
        assert!(json.contains("\"degrees\": {\"theta1\": 20.0}"), "{json}");
        assert_eq!(string("a\"\\\n\u{1}"), "\"a\\\"\\\\\\n\\u0001\"");
    }
}
