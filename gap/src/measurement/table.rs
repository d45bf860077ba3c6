//! From bytes to records, each with the line of the file on which it begins.

use csv::{Reader, ReaderBuilder, StringRecord, Trim};

use super::mistake::{Column, Fault, Mistake};

/// A record and its line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Record {
    /// From 1.
    pub(crate) line: u64,
    /// Cells, trimmed.
    pub(crate) cells: StringRecord,
}

/// The records of a file one after the other: comment lines and blank lines left out, a byte order
/// mark and either line ending accepted.
pub(crate) struct Records<'t> {
    reader: Reader<&'t [u8]>,
    lines: Lines<'t>,
    cells: StringRecord,
}

/// The records of a text, whose cells the byte `separator` separates.
pub(crate) fn records(text: &str, separator: u8) -> Records<'_> {
    let text = text.as_bytes();
    let reader = ReaderBuilder::new()
        .has_headers(false)
        .delimiter(separator)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text);
    let lines = Lines { text, at: 0, line: 1 };
    Records { reader, lines, cells: StringRecord::new() }
}

impl Iterator for Records<'_> {
    type Item = Record;

    fn next(&mut self) -> Option<Record> {
        while self.reader.read_record(&mut self.cells).unwrap_or(false) {
            // The csv crate's position is where it began to read: before comments and blank lines.
            let from = self.cells.position().map_or(0, csv::Position::byte);
            let line = self.lines.of_record_from(usize::try_from(from).unwrap_or(usize::MAX));
            let blank = self.cells.len() == 1 && self.cells[0].is_empty();
            if !blank && !self.cells[0].starts_with('#') {
                return Some(Record { line, cells: self.cells.clone() });
            }
        }
        None
    }
}

/// The text of a file, without a byte order mark, or the first place at which it is none.
pub(crate) fn text(bytes: &[u8]) -> Result<&str, Box<Mistake>> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(Box::new(Mistake { line: 1, column: None, fault: Fault::Utf16 }));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    core::str::from_utf8(bytes).map_err(|e| {
        let at = e.valid_up_to();
        let mut lines = Lines { text: bytes, at: 0, line: 1 };
        lines.advance(at);
        let start = bytes[..at].iter().rposition(|b| *b == b'\n').map_or(0, |p| p + 1);
        let number = 1 + bytes[start..at].iter().filter(|b| **b == b',').count();
        Box::new(Mistake {
            line: lines.line,
            column: Some(Column { number, header: String::new() }),
            fault: Fault::NotUtf8 { byte: bytes[at] },
        })
    })
}

/// Counts line ends (LF, CRLF, or CR alone) up to a growing offset.
struct Lines<'a> {
    text: &'a [u8],
    at: usize,
    line: u64,
}

impl Lines<'_> {
    fn advance(&mut self, to: usize) {
        let to = to.min(self.text.len());
        while self.at < to {
            let here = self.text[self.at];
            let crlf = here == b'\r' && self.text.get(self.at + 1) == Some(&b'\n');
            self.line += u64::from(here == b'\n' || (here == b'\r' && !crlf));
            self.at += 1;
        }
    }

    /// The line of the first record at or after `offset`.
    fn of_record_from(&mut self, offset: usize) -> u64 {
        self.advance(offset);
        loop {
            match self.text.get(self.at) {
                Some(b'\n' | b'\r') => self.advance(self.at + 1),
                Some(b'#') => {
                    let rest = &self.text[self.at..];
                    let end = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
                    self.advance(self.at + end);
                }
                _ => return self.line,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(bytes: &[u8]) -> Vec<(u64, String)> {
        let records = records(text(bytes).expect("a text"), b',');
        records.map(|r| (r.line, r.cells.iter().collect::<Vec<_>>().join("|"))).collect()
    }

    fn want(expected: &[(u64, &str)]) -> Vec<(u64, String)> {
        expected.iter().map(|(l, t)| (*l, (*t).to_owned())).collect()
    }

    #[test]
    fn counts_lines_through_comments_and_blanks() {
        let text = b"# a, b\n\n#c\na,b\n1,2\n\n  \n  # d\n#e\n3, 4 \n#f\n\n5,6";
        assert_eq!(lines(text), want(&[(4, "a|b"), (5, "1|2"), (10, "3|4"), (13, "5|6")]));
    }

    #[test]
    fn accepts_bom_and_crlf_and_quotes() {
        let text = b"\xef\xbb\xbfa,b\r\n#x\r\n1,\"2\n2\"\r\n\r\n3,4\r\n";
        assert_eq!(lines(text), want(&[(1, "a|b"), (3, "1|2\n2"), (6, "3|4")]));
        assert_eq!(lines(b"a,b\r1,2\r"), want(&[(1, "a|b"), (2, "1|2")]));
    }

    #[test]
    fn says_where_the_text_ends() {
        let not_text = text(b"a,b\n1,2\n3,\xe9\n").unwrap_err();
        assert_eq!((not_text.line, not_text.column.map(|c| c.number)), (3, Some(2)));
        assert_eq!(not_text.fault, Fault::NotUtf8 { byte: 0xe9 });
        assert_eq!(text(b"\xff\xfea\0").unwrap_err().fault, Fault::Utf16);
    }
}
