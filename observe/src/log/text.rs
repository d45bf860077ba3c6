//! Logs as text: cells between commas, semicolons, tabs or spaces.

use std::io::{BufRead, BufReader, Read};

use stiffarm_kernels::Motion;

use super::table::{Cell, Header, Table};
use super::{Log, Names, TorqueSide};
use crate::io::cell::Decimals;
use crate::io::encoding::Encoding;
use crate::io::table::{Record, Records, commented};
use crate::io::{Fault, Map, Mistake, ReadError};

pub(super) fn read(
    file: &str,
    source: impl Read,
    motions: &[Motion],
    names: &Names,
) -> Result<Log, ReadError> {
    let wrong = |mistake: Mistake| mistake.of(file);
    let mut source = BufReader::with_capacity(1 << 16, source);
    // What cannot be read is told by who reads it next.
    let encoding = source.fill_buf().map_or(Encoding::Utf8, Encoding::of_head);
    let map = names.map();
    let mut records = Records::new(encoding.decoded(source), map.separator()).map_err(wrong)?;
    let (mut top, given) = (None, map.header.unwrap_or(0));
    while top.is_none()
        && let Some(record) = records.read().map_err(wrong)?
    {
        top = (record.line >= given).then(|| (record.line, words(record)));
    }
    let Some((line, said)) = top.filter(|(line, _)| given == 0 || *line == given) else {
        if given > 0 {
            return Err(wrong(Map::no_header(given)));
        }
        let expected = "a row of names: t[s], q1[rad] …, tau1[N*m] …";
        return Err(Fault::new("no header", expected, "").of(file));
    };
    let side = side(&records.above).map_err(wrong)?;
    let separator = records.separator();
    let mut record = records.read().map_err(wrong)?;
    // What the first row holds in brackets is one column for each of its numbers.
    let cells = |record: &Record, k: usize| Some(list(record.cell(k)?)?.count());
    let lists: Vec<Option<usize>> =
        (0..said.len()).map(|k| record.and_then(|record| cells(record, k))).collect();
    let names_of = |(name, list): (&String, &Option<usize>)| -> Vec<String> {
        match list {
            None => vec![name.clone()],
            Some(count) => (0..*count).map(|k| format!("{name}[{k}]")).collect(),
        }
    };
    let header = Header {
        names: said.iter().zip(&lists).flat_map(names_of).collect(),
        line: Some(line),
        row: "line",
        side,
        decimals: Decimals::of(separator, map),
    };
    let mut table = Table::new(file, &header, motions, names)?;
    let has_lists = lists.iter().any(Option::is_some);
    while let Some(row) = record {
        if has_lists {
            let each = row.cells().enumerate().flat_map(|(k, cell)| {
                let is_list = lists.get(k).is_some_and(Option::is_some);
                let parts = is_list.then(|| list(cell)).flatten();
                parts
                    .map_or_else(|| vec![Cell::Text(cell)], |parts| parts.map(Cell::Text).collect())
            });
            table.push(row.line, each.collect::<Vec<Cell<'_>>>().into_iter());
        } else {
            table.push(row.line, row.cells().map(Cell::Text));
        }
        record = records.read().map_err(wrong)?;
    }
    table.end()
}

/// The names of the columns of a text that begins so.
pub(super) fn header(head: &[u8]) -> Option<Vec<String>> {
    let mut records = Records::new(Encoding::of_head(head).decoded(head), None).ok()?;
    records.read().ok()?.map(words)
}

fn words(record: &Record) -> Vec<String> {
    record.cells().map(|cell| String::from_utf8_lossy(cell).into_owned()).collect()
}

/// The cells of `[1, 2, 3]`.
fn list(cell: &[u8]) -> Option<impl Iterator<Item = &[u8]>> {
    let inner = cell.trim_ascii().strip_prefix(b"[")?.strip_suffix(b"]")?;
    Some(inner.split(|b| *b == b',').map(<[u8]>::trim_ascii))
}

/// What the comments above the header say of the torque side: `torque_side = motor`.
fn side(comments: &[(u64, String)]) -> Result<Option<TorqueSide>, Mistake> {
    let mut side = None;
    for (line, word) in commented(comments, "torque_side") {
        side = Some(TorqueSide::said(word).map_err(|fault| fault.at(line, None))?);
    }
    Ok(side)
}
