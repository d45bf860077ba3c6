//! Logs as text: cells between commas, semicolons, tabs or spaces.

use std::io::{BufRead, BufReader, Read};

use csv::{ByteRecord, ReaderBuilder};
use stiffarm_kernels::Motion;

use super::table::{Cell, Header, Table};
use super::{Log, LogError, Names, TorqueSide};

/// What may separate cells; of equally many the first.
const SEPARATORS: [u8; 4] = [b',', b';', b'\t', b' '];

/// What stands above the rows.
struct Top {
    side: Option<TorqueSide>,
    /// The line of the names, from 1, and their text.
    line: u64,
    names: Vec<u8>,
}

pub(super) fn read(
    file: &str,
    source: impl Read,
    motions: &[Motion],
    names: &Names,
) -> Result<Log, LogError> {
    let broken = |error: String| LogError::Unreadable { file: file.to_owned(), message: error };
    let mut lines = BufReader::new(source);
    let Top { side, line, names: header } = top(file, &mut lines)?;
    let mut rows = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(separator(&header))
        .comment(Some(b'#'))
        .from_reader(header.as_slice().chain(lines));
    let mut record = ByteRecord::new();
    let mut next = |record: &mut ByteRecord| {
        let there = rows.read_byte_record(record).map_err(|e| broken(e.to_string()))?;
        Ok::<bool, LogError>(there)
    };
    next(&mut record)?;
    let said: Vec<String> =
        record.iter().map(|cell| String::from_utf8_lossy(cell).trim().to_owned()).collect();
    let mut more = next(&mut record)?;
    // What the first row holds in brackets is one column for each of its numbers.
    let lists: Vec<Option<usize>> =
        (0..said.len()).map(|k| Some(list(record.get(k)?)?.count())).collect();
    let names_of = |(name, list): (&String, &Option<usize>)| -> Vec<String> {
        match list {
            None => vec![name.clone()],
            Some(count) => (0..*count).map(|k| format!("{name}[{k}]")).collect(),
        }
    };
    let header = Header {
        names: said.iter().zip(&lists).flat_map(names_of).collect(),
        at: format!("line {line}"),
        row: "line",
        side,
    };
    let mut table = Table::new(file, &header, motions, names)?;
    let has_lists = lists.iter().any(Option::is_some);
    while more {
        let at = line - 1 + record.position().map_or(0, csv::Position::line);
        if has_lists {
            let each = record.iter().enumerate().flat_map(|(k, cell)| {
                let is_list = lists.get(k).is_some_and(Option::is_some);
                let parts = is_list.then(|| list(cell)).flatten();
                parts
                    .map_or_else(|| vec![Cell::Text(cell)], |parts| parts.map(Cell::Text).collect())
            });
            table.push(at, each.collect::<Vec<Cell<'_>>>().into_iter());
        } else {
            let cells: &ByteRecord = &record;
            table.push(at, (0..cells.len()).map(|k| Cell::Text(&cells[k])));
        }
        more = next(&mut record)?;
    }
    table.end()
}

/// The cells of `[1, 2, 3]`.
fn list(cell: &[u8]) -> Option<impl Iterator<Item = &[u8]>> {
    let inner = cell.trim_ascii().strip_prefix(b"[")?.strip_suffix(b"]")?;
    Some(inner.split(|b| *b == b',').map(<[u8]>::trim_ascii))
}

/// What comments say of the torque side, and the first line that is none. Comments further below are
/// not searched: a log has a million rows.
fn top(file: &str, lines: &mut impl BufRead) -> Result<Top, LogError> {
    let mut side = None;
    let mut text = Vec::new();
    for line in 1.. {
        text.clear();
        let read = lines.read_until(b'\n', &mut text);
        let read = read.map_err(|error| LogError::Unreadable {
            file: file.to_owned(),
            message: error.to_string(),
        })?;
        if read == 0 {
            break;
        }
        if line == 1 && text.starts_with(b"\xef\xbb\xbf") {
            text.drain(..3);
        }
        match text.strip_prefix(b"#") {
            Some(comment) => side = said(file, line, &String::from_utf8_lossy(comment))?.or(side),
            None if text.trim_ascii().is_empty() => {}
            None => return Ok(Top { side, line, names: text }),
        }
    }
    Err(LogError::NoHeader { file: file.to_owned() })
}

/// `torque_side = motor`.
fn said(file: &str, line: u64, comment: &str) -> Result<Option<TorqueSide>, LogError> {
    let Some((_, value)) = comment.split_once('=').filter(|(name, _)| name.trim() == "torque_side")
    else {
        return Ok(None);
    };
    let word: String = value.trim().chars().take_while(|c| c.is_alphanumeric()).collect();
    match TorqueSide::named(&word) {
        None => {
            Err(LogError::Side { file: file.to_owned(), at: format!("line {line}"), found: word })
        }
        side => Ok(side),
    }
}

fn separator(header: &[u8]) -> u8 {
    let count = |s: &u8| header.iter().filter(|b| *b == s).count();
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(b',')
}
