//! The ledger for machines.

use crate::ledger::Ledger;

impl Ledger {
    /// A list of entries in JSON, one in a line; what is not known is null.
    pub fn to_json(&self) -> String {
        // Strings, numbers and maps by strings, written to memory: nothing of it can fail.
        let line = |entry| serde_json::to_string(entry).unwrap_or_default();
        let lines: Vec<String> = self.entries.iter().map(line).collect();
        format!("[\n{}\n]\n", lines.join(",\n"))
    }
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
        assert!(json.contains("\"verdict\":\"misprint\""), "{json}");
        assert!(json.contains("\"degrees\":{\"theta1\":20.0}"), "{json}");
    }
}
