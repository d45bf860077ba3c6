//! From bytes to records, each with the line of the file on which it begins.
//!
//! Comment lines and blank lines are left out, a byte order mark and any line ending (LF, CRLF, CR) are
//! accepted. Only the record at hand is held in memory.

use std::io::{self, BufRead};

use csv_core::{ReadRecordResult, Reader, ReaderBuilder};

use super::mistake::{Column, Fault, Mistake};

/// What separates the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// One character of ASCII.
    Byte(u8),
    /// So many spaces or more.
    Spaces(usize),
}

/// What may separate cells: of those in equally many lines the last.
const SEPARATORS: [u8; 4] = [b'|', b',', b'\t', b';'];

/// Lines in which the separator is looked for.
const LOOKED_AT: usize = 50;

impl Separator {
    /// Of a file that begins so: what most lines have; a decimal comma stands within cells, so that commas
    /// do not separate where anything else does.
    pub(crate) fn sniffed(head: &[u8]) -> Separator {
        let lines: Vec<&[u8]> = head
            .split(|b| matches!(b, b'\n' | b'\r'))
            .map(<[u8]>::trim_ascii)
            .filter(|line| !line.is_empty() && !line.starts_with(b"#"))
            .take(LOOKED_AT)
            .collect();
        let lines_with = |is: &dyn Fn(&[u8]) -> bool| lines.iter().filter(|line| is(line)).count();
        let count = |c: u8| lines_with(&|line| line.contains(&c));
        let most = SEPARATORS.into_iter().max_by_key(|c| (count(*c), *c != b',')).unwrap_or(b',');
        let gap = |three: &[u8]| three[1..] == *b"  " && !b" ,;|\t".contains(&three[0]);
        let wide = lines_with(&|line| line.windows(3).any(gap));
        if 2 * wide > lines.len() && (most == b',' || count(most) == 0) {
            Separator::Spaces(2)
        } else if count(most) > 0 {
            Separator::Byte(most)
        } else if count(b' ') > 0 {
            Separator::Spaces(1)
        } else {
            Separator::Byte(b',')
        }
    }

    /// Of a character of ASCII; any other separates nothing.
    pub fn of(separator: char) -> Separator {
        match u8::try_from(separator) {
            Ok(b' ') => Separator::Spaces(1),
            other => Separator::Byte(other.unwrap_or_default()),
        }
    }

    /// The byte by which the records are split; spaces are replaced by it.
    fn byte(self) -> u8 {
        match self {
            Separator::Byte(byte) => byte,
            Separator::Spaces(_) => b'\t',
        }
    }

    /// In words, after `cells are separated by`.
    pub fn words(self) -> String {
        match self {
            Separator::Byte(b',') => "commas".to_owned(),
            Separator::Byte(b'\t') => "tabs".to_owned(),
            Separator::Byte(byte) => format!("`{}`", char::from(byte)),
            Separator::Spaces(_) => "spaces".to_owned(),
        }
    }
}

/// A line of a table in cells.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// The line on which it begins, from 1.
    pub line: u64,
    text: Vec<u8>,
    ends: Vec<usize>,
    /// How many of the ends are in use.
    cells: usize,
}

impl Record {
    /// A cell without the space around it.
    pub fn cell(&self, k: usize) -> Option<&[u8]> {
        let end = *self.ends[..self.cells].get(k)?;
        let start = if k == 0 { 0 } else { self.ends[k - 1] };
        Some(self.text[start..end].trim_ascii())
    }

    /// All of them.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[u8]> + Clone {
        (0..self.cells).map(|k| self.cell(k).unwrap_or_default())
    }

    /// All cells as text.
    pub fn texts(&self) -> Result<Vec<&str>, Mistake> {
        let each = self.cells().enumerate().map(|(k, cell)| match core::str::from_utf8(cell) {
            Ok(text) => Ok(text.trim()),
            Err(error) => {
                let column = Column { number: k + 1, header: String::new() };
                let found = format!("byte 0x{:02x}", cell[error.valid_up_to()]);
                Err(not_utf8(&found).at(self.line, Some(column)))
            }
        });
        each.collect()
    }
}

fn not_utf8(found: &str) -> Fault {
    Fault::new(found, "UTF-8 text", "save the file as UTF-8")
}

/// The records of a file one after the other.
pub struct Records<R> {
    source: R,
    separator: Separator,
    core: Reader,
    /// Lines read so far, and the last of them without its end.
    lines: u64,
    line: Vec<u8>,
    /// Whether that line ended in CR, which an LF may follow.
    is_cr: bool,
    record: Record,
    /// The comments above the first record, each with its line.
    pub above: Vec<(u64, String)>,
}

impl<R: BufRead> Records<R> {
    /// Of a source whose separator is known, or found in its first lines.
    pub fn new(mut source: R, separator: Option<Separator>) -> Result<Records<R>, Mistake> {
        let head = source.fill_buf().map_err(|error| unreadable(&error, 1))?;
        if head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]) {
            return Err(not_utf8("a UTF-16 byte order mark").at(1, None));
        }
        let separator = separator.unwrap_or_else(|| Separator::sniffed(head));
        if head.starts_with(b"\xef\xbb\xbf") {
            source.consume(3);
        }
        Ok(Records {
            source,
            separator,
            core: ReaderBuilder::new().delimiter(separator.byte()).build(),
            lines: 0,
            line: Vec::new(),
            is_cr: false,
            record: Record::default(),
            above: Vec::new(),
        })
    }

    /// What separates the cells.
    pub fn separator(&self) -> Separator {
        self.separator
    }

    /// The next record; `None` at the end.
    pub fn read(&mut self) -> Result<Option<&Record>, Mistake> {
        loop {
            if !self.next_line()? {
                return Ok(None);
            }
            let text = self.line.trim_ascii_start();
            if let Some(comment) = text.strip_prefix(b"#") {
                if self.record.line == 0 {
                    let comment = String::from_utf8_lossy(comment).into_owned();
                    self.above.push((self.lines, comment));
                }
            } else if !(text.is_empty() && self.line.iter().all(|b| *b != self.separator.byte())) {
                break;
            }
        }
        self.record.line = self.lines;
        self.core.reset();
        let (mut used, mut cells) = (0, 0);
        loop {
            if let Separator::Spaces(least) = self.separator {
                spaces_to_tabs(&mut self.line, least);
            }
            self.line.push(b'\n');
            // No more bytes come out than went in; a separator ends a cell, and so does the line.
            let Record { text, ends, .. } = &mut self.record;
            let separators = self.line.iter().filter(|b| **b == self.separator.byte()).count();
            text.resize(text.len().max(used + self.line.len()), 0);
            ends.resize(ends.len().max(cells + separators + 1), 0);
            let (done, _, bytes, ended) =
                self.core.read_record(&self.line, &mut text[used..], &mut ends[cells..]);
            (used, cells) = (used + bytes, cells + ended);
            if done == ReadRecordResult::Record {
                self.record.cells = cells;
                return Ok(Some(&self.record));
            }
            if !self.next_line()? {
                let fault = Fault::new("a quotation mark that is not closed", "a second one", "");
                return Err(fault.at(self.record.line, None));
            }
        }
    }

    /// Reads a line; whether there was one.
    fn next_line(&mut self) -> Result<bool, Mistake> {
        self.line.clear();
        let mut is_there = false;
        loop {
            let part = match self.source.fill_buf() {
                Ok(part) => part,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(unreadable(&error, self.lines + 1)),
            };
            if part.is_empty() {
                self.lines += u64::from(is_there);
                return Ok(is_there);
            }
            if core::mem::take(&mut self.is_cr) && part[0] == b'\n' {
                self.source.consume(1);
                continue;
            }
            is_there = true;
            let end = part.iter().position(|b| matches!(b, b'\n' | b'\r'));
            self.line.extend_from_slice(&part[..end.unwrap_or(part.len())]);
            self.is_cr = end.is_some_and(|end| part[end] == b'\r');
            let read = end.map_or(part.len(), |end| end + 1);
            self.source.consume(read);
            if end.is_some() {
                self.lines += 1;
                return Ok(true);
            }
        }
    }
}

fn unreadable(error: &io::Error, line: u64) -> Mistake {
    Fault::new(format!("no more of the file ({error})"), "its text", "").at(line, None)
}

/// What comments say of something: `# torque_side = motor`; each with its line.
pub fn commented<'c>(
    comments: &'c [(u64, String)],
    of: &'c str,
) -> impl Iterator<Item = (u64, &'c str)> {
    comments.iter().filter_map(move |(line, comment)| {
        let (name, value) = comment.split_once('=')?;
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let value = value.trim().trim_matches('"');
        let end = value.find(|c| !word(c)).unwrap_or(value.len());
        (name.trim() == of).then_some((*line, &value[..end]))
    })
}

/// Runs of so many spaces or more, outside quotation marks, as tabs.
fn spaces_to_tabs(line: &mut Vec<u8>, least: usize) {
    let (mut out, mut run, mut is_quoted) = (Vec::with_capacity(line.len()), 0, false);
    for byte in line.trim_ascii() {
        if *byte == b' ' && !is_quoted {
            run += 1;
            continue;
        }
        let spaces = if run >= least { &b"\t"[..] } else { &b" "[..run.min(1)] };
        out.extend_from_slice(spaces);
        run = 0;
        is_quoted ^= *byte == b'"';
        out.push(*byte);
    }
    *line = out;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines_of(bytes: &[u8], separator: Option<Separator>) -> Result<Vec<(u64, String)>, Mistake> {
        let mut records = Records::new(bytes, separator)?;
        let mut all = Vec::new();
        while let Some(record) = records.read()? {
            all.push((record.line, record.texts()?.join("|")));
        }
        Ok(all)
    }

    fn lines(bytes: &[u8]) -> Vec<(u64, String)> {
        lines_of(bytes, Some(Separator::Byte(b','))).expect("a text")
    }

    fn want(expected: &[(u64, &str)]) -> Vec<(u64, String)> {
        expected.iter().map(|(l, t)| (*l, (*t).to_owned())).collect()
    }

    #[test]
    fn counts_lines_through_comments_and_blanks() {
        let text = b"# a, b\n\n#c\na,b\n1,2\n\n  \n  # d\n#e\n3, 4 \n#f\n\n5,6\n\"#1\",2";
        assert_eq!(
            lines(text),
            want(&[(4, "a|b"), (5, "1|2"), (10, "3|4"), (13, "5|6"), (14, "#1|2")])
        );
        let mut records = Records::new(&text[..], None).unwrap();
        records.read().unwrap();
        assert_eq!(records.above, [(1, " a, b".to_owned()), (3, "c".to_owned())]);
    }

    #[test]
    fn accepts_bom_and_crlf_and_quotes() {
        let text = b"\xef\xbb\xbfa,b\r\n#x\r\n1,\"2\n2\"\r\n\r\n3,4\r\n";
        assert_eq!(lines(text), want(&[(1, "a|b"), (3, "1|2\n2"), (6, "3|4")]));
        assert_eq!(lines(b"a,b\r1,2\r"), want(&[(1, "a|b"), (2, "1|2")]));
        assert_eq!(lines(b"a,\"b \"\"c\"\"\"\n,\n"), want(&[(1, "a|b \"c\""), (2, "|")]));
    }

    /// A source may hand over one byte at a time.
    #[test]
    fn records_do_not_depend_on_the_buffer() {
        let text = b"a,b\r\n1,\"2,\r\n2\"\r\n\r\n3,4";
        let mut records =
            Records::new(io::BufReader::with_capacity(1, &text[..]), Some(Separator::Byte(b',')))
                .unwrap();
        let mut all = Vec::new();
        while let Some(record) = records.read().unwrap() {
            all.push((record.line, record.texts().unwrap().join("|")));
        }
        assert_eq!(all, lines(text));
        assert_eq!(all, want(&[(1, "a|b"), (2, "1|2,\n2"), (5, "3|4")]));
    }

    #[test]
    fn says_where_the_text_ends() {
        let refused = |bytes: &[u8]| lines_of(bytes, None).unwrap_err().to_string();
        assert_eq!(
            refused(b"a,b\n1,2\n3,\xe9\n"),
            "line 3, column 2: found byte 0xe9, expected UTF-8 text: save the file as UTF-8"
        );
        assert!(refused(b"\xff\xfea\0").starts_with("line 1: found a UTF-16 byte order mark"));
        assert_eq!(
            refused(b"a,b\n1,\"2\n3,4\n5,6\n"),
            "line 2: found a quotation mark that is not closed, expected a second one"
        );
    }

    #[test]
    fn the_separator_is_what_most_lines_have() {
        for (text, expected) in [
            ("t,q1,q2\n0,1,2\n", Separator::Byte(b',')),
            ("t, q1,  q2\n0,  1,  2\n", Separator::Byte(b',')),
            ("A1;A2\n1,5;2,5\n", Separator::Byte(b';')),
            ("Run 7, of May\n\nA1\tA2\n1,5\t2,5\n1,5\t2,5\n", Separator::Byte(b'\t')),
            ("a | b\n1 | 2\n", Separator::Byte(b'|')),
            ("# t,q\nt q1 q2\n0 1 2\n", Separator::Spaces(1)),
            ("Pos X  Pos Y   Z\n1,5    2,5     3\n", Separator::Spaces(2)),
            ("t\n1\n", Separator::Byte(b',')),
            ("", Separator::Byte(b',')),
        ] {
            assert_eq!(Separator::sniffed(text.as_bytes()), expected, "{text}");
        }
        let wide = lines_of(b"Pos X  \"a  b\"   Z \n 1,5    2     3\n", None).unwrap();
        assert_eq!(wide, want(&[(1, "Pos X|a  b|Z"), (2, "1,5|2|3")]));
    }
}
