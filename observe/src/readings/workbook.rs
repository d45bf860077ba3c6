//! A sheet of a workbook (xlsx, ods) as the text of a table, with a line for each row.
//!
//! What is a date or a time there becomes seconds: a date since 1970, as those of texts are, whatever the workbook counts
//! from; a time of day and a duration by themselves.

use std::io::Cursor;

use calamine::{Data, ExcelDateTime, Reader, open_workbook_auto_from_rs};

use super::Map;
use super::clock::{DAY, days};
use crate::io::Fault;

/// The text of the map's sheet, else of the first; says which, and what its times are.
pub(super) fn text(bytes: &[u8], map: &Map, said: &mut Vec<String>) -> Result<Vec<u8>, Fault> {
    let wrong = |reason: calamine::Error| {
        Fault::new("a workbook that cannot be read", "one", reason.to_string())
    };
    let mut book = open_workbook_auto_from_rs(Cursor::new(bytes)).map_err(wrong)?;
    let known = book.sheet_names();
    let sheet = map.sheet.clone().or_else(|| known.first().cloned()).unwrap_or_default();
    if !known.contains(&sheet) {
        let expected = format!("one of {}", known.join(", "));
        return Err(Fault::new(format!("no sheet `{sheet}`"), expected, ""));
    }
    if known.len() > 1 {
        said.push(format!("sheet `{sheet}` of {}", known.join(", ")));
    }
    let range = book.worksheet_range(&sheet).map_err(wrong)?;
    let mut has_times = false;
    let mut cell = |data: &Data| {
        let seconds = match data {
            Data::DateTime(at) => Some(seconds(at)),
            Data::DurationIso(text) => duration(text),
            _ => None,
        };
        has_times |= seconds.is_some();
        match (seconds, data) {
            // A double holds a day of this century to a microsecond.
            (Some(seconds), _) => ((seconds * 1e6).round() / 1e6).to_string(),
            (None, Data::Empty | Data::Error(_)) => String::new(),
            // A line is a row.
            (None, other) => other.to_string().replace(['\n', '\r'], " "),
        }
    };
    let above = range.start().map_or(0, |(row, _)| row as usize);
    let mut writer =
        csv::WriterBuilder::new().comment(Some(b'#')).from_writer("\n".repeat(above).into_bytes());
    for row in range.rows() {
        // Into memory nothing fails.
        let _ = writer.write_record(row.iter().map(&mut cell));
    }
    let times = "dates are read as seconds since 1970, times of day and durations as seconds";
    said.extend(has_times.then(|| times.to_owned()));
    Ok(writer.into_inner().unwrap_or_default())
}

/// Of a number of days that is formatted as a date or a time. What has no whole day is a time of day.
fn seconds(at: &ExcelDateTime) -> f64 {
    let number = at.as_f64();
    if at.is_duration() || (0.0..1.0).contains(&number) {
        return DAY * number;
    }
    let (year, month, day, ..) = at.to_ymd_hms_milli();
    let since = days(&format!("{year}-{month}-{day}"));
    DAY * since.map_or(number, |since| since + number.fract())
}

/// Of `PT10H03M05.2S`, as an ods file has times of day.
fn duration(text: &str) -> Option<f64> {
    let mut rest = text.strip_prefix("PT")?;
    let mut sum = 0.0;
    for (letter, seconds) in [('H', 3600.0), ('M', 60.0), ('S', 1.0)] {
        if let Some((number, behind)) = rest.split_once(letter) {
            sum += seconds * number.replace(',', ".").parse::<f64>().ok()?;
            rest = behind;
        }
    }
    rest.is_empty().then_some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_read() {
        assert_eq!(duration("PT10H03M05.25S"), Some(36_185.25));
        assert_eq!(
            (duration("PT30M"), duration("10:03"), duration("PT1X")),
            (Some(1800.0), None, None)
        );
    }
}
