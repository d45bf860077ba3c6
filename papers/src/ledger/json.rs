//! The ledger for machines.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::Formatter;

use crate::ledger::Ledger;

impl Ledger {
    /// A list of entries in JSON, one in a line; what is not known is null.
    pub fn to_json(&self) -> String {
        let mut out = Vec::new();
        let mut writer = serde_json::Serializer::with_formatter(&mut out, Lines);
        // Strings, numbers and maps by strings, written to memory: nothing of it can fail.
        let written = self.entries.serialize(&mut writer);
        debug_assert!(written.is_ok());
        out.push(b'\n');
        String::from_utf8_lossy(&out).into_owned()
    }
}

/// Entries line by line, spaces behind commas and colons.
struct Lines;

impl Formatter for Lines {
    fn begin_array<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"[\n")
    }

    fn begin_array_value<W: Write + ?Sized>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        writer.write_all(if first { b"  " } else { b",\n  " })
    }

    fn end_array<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n]")
    }

    fn begin_object_key<W: Write + ?Sized>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        writer.write_all(if first { b"" } else { b", " })
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
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
        assert!(json.contains("\"verdict\": \"misprint\""), "{json}");
        assert!(json.contains("\"degrees\": {\"theta1\": 20.0}"), "{json}");
    }
}
