//! Where a cell of a measurement file stands among its bytes.

use std::ops::Range;

use super::failure::LONGEST;

/// The bytes of a cell; lines and columns from 1, the whole line without a column. `None` where the
/// text has no such place or its line is too long to be shown.
pub fn cell(text: &str, line: u64, column: Option<usize>) -> Option<Range<usize>> {
    let whole = line_span(text, usize::try_from(line).ok()?.checked_sub(1)?)?;
    let found = &text[whole.clone()];
    if found.chars().count() > LONGEST {
        return None;
    }
    let within = match column {
        None => 0..found.len(),
        Some(number) => cells(found).nth(number.checked_sub(1)?)?,
    };
    let padded = &found[within.clone()];
    let start = within.start + (padded.len() - padded.trim_start().len());
    let end = start.max(within.start + padded.trim_end().len());
    Some(whole.start + start..whole.start + end)
}

/// The bytes of a line, without its end; lines end with LF, CRLF or CR.
fn line_span(text: &str, index: usize) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let mut start = 0;
    let mut seen = 0;
    for at in 0..=bytes.len() {
        let ends = match bytes.get(at) {
            None | Some(b'\n') => true,
            Some(b'\r') => bytes.get(at + 1) != Some(&b'\n'),
            Some(_) => false,
        };
        if !ends {
            continue;
        }
        if seen == index {
            let crlf = at > start && bytes.get(at) == Some(&b'\n') && bytes[at - 1] == b'\r';
            return Some(start..at - usize::from(crlf));
        }
        seen += 1;
        start = at + 1;
    }
    None
}

/// The ranges between commas that stand outside quotes.
fn cells(line: &str) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut quoted = false;
    let mut start = 0;
    let ends = line.char_indices().chain([(line.len(), ',')]).filter_map(move |(at, c)| {
        quoted ^= c == '"';
        (c == ',' && (!quoted || at == line.len())).then_some(at)
    });
    ends.map(move |end| {
        let cell = start..end;
        start = end + 1;
        cell
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_found() {
        let text = "q1,dy\r\n 0.1 , \"a,b\",x\n\nlast";
        let at = |line, column| cell(text, line, column).map(|span| &text[span]);
        assert_eq!(at(1, Some(2)), Some("dy"));
        assert_eq!(at(2, Some(1)), Some("0.1"));
        assert_eq!(at(2, Some(2)), Some("\"a,b\""));
        assert_eq!(at(2, Some(3)), Some("x"));
        assert_eq!(at(2, None), Some("0.1 , \"a,b\",x"));
        assert_eq!(at(3, None), Some(""));
        assert_eq!(at(4, Some(1)), Some("last"));
        for (line, column) in [(0, None), (5, None), (1, Some(3)), (1, Some(0))] {
            assert_eq!(at(line, column), None);
        }
        assert_eq!(cell("a\rb,c", 2, Some(2)), Some(4..5));
    }
}
