//! A file with some of its numbers written anew, and every other byte as it was.

use std::ops::Range;

/// A number of a file: its value, and its bytes with the sign.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// As the file has it.
    pub value: f64,
    /// Metres or radians of its unit; 1 of what has none.
    pub unit: f64,
    /// Where it stands.
    pub span: Range<usize>,
}

/// A text that takes a number's place.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Which bytes.
    pub span: Range<usize>,
    /// What stands there then.
    pub text: String,
}

/// To what a number is written, m, rad, or of a quaternion: a tenth of the micrometre and microradian to which
/// set-points are searched.
const FINE: f64 = 1e-7;

impl Cell {
    /// The value in SI.
    pub fn si(&self) -> f64 {
        self.value * self.unit
    }

    /// The cell with another value (SI), with as many decimals as it has in the file, and more where the value
    /// needs them; `None` where that is what stands there.
    pub fn change(&self, text: &[u8], si: f64) -> Option<Change> {
        let value = si / self.unit;
        let least = (self.unit / FINE).log10().ceil().max(0.0) as usize;
        let old = String::from_utf8_lossy(&text[self.span.clone()]);
        let had = match old.split_once('.') {
            _ if old.contains(['e', 'E']) => 0,
            Some((_, decimals)) => decimals.len(),
            None => 0,
        };
        let decimals = had.max(least);
        if (value - self.value).abs() < 0.5 * 10.0_f64.powi(-(decimals as i32)) {
            return None;
        }
        let mut new = format!("{value:.decimals$}");
        let spare = new.len() - new.trim_end_matches('0').len();
        new.truncate(new.len() - spare.min(decimals - had));
        if new.ends_with('.') {
            new.pop();
        }
        if new.starts_with('-') && !new.contains(|c: char| ('1'..='9').contains(&c)) {
            new.remove(0);
        }
        Some(Change { span: self.span.clone(), text: new })
    }

    /// The cell with another whole number; `None` where that is what stands there.
    pub fn whole(&self, value: i64) -> Option<Change> {
        let differs = (self.value - value as f64).abs() > 0.5;
        differs.then(|| Change { span: self.span.clone(), text: value.to_string() })
    }
}

/// Values in SI.
pub fn si(cells: &[Cell]) -> Vec<f64> {
    cells.iter().map(Cell::si).collect()
}

/// The line of a byte, from 1.
pub fn line(text: &[u8], at: usize) -> usize {
    1 + text[..at].iter().filter(|byte| **byte == b'\n').count()
}

/// The text with the changes made; of two that overlap the first.
pub fn edited(text: &[u8], mut changes: Vec<Change>) -> Vec<u8> {
    changes.sort_by_key(|change| change.span.start);
    let mut out = Vec::with_capacity(text.len() + 8 * changes.len());
    let mut at = 0;
    for Change { span, text: new } in changes {
        if span.start < at {
            continue;
        }
        out.extend_from_slice(&text[at..span.start]);
        out.extend_from_slice(new.as_bytes());
        at = span.end;
    }
    out.extend_from_slice(&text[at..]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_decimals_and_get_those_they_need() {
        let written = |old: &str, value: f64| {
            let cell = Cell { value: old.parse().unwrap(), unit: 1e-4, span: 1..1 + old.len() };
            let text = format!("<{old}>").into_bytes();
            let change = cell.change(&text, value * 1e-4);
            String::from_utf8(edited(&text, change.into_iter().collect())).unwrap()
        };
        for (old, value, new) in [
            ("12", 12.3456, "<12.346>"),
            ("12.50000", 12.5000049, "<12.50000>"),
            ("12.50000", 12.500006, "<12.50001>"),
            ("-1", 0.0001, "<0>"),
            ("1.0", 1.0004, "<1.0>"),
            ("1.0", 2.0001, "<2.0>"),
            ("0.0100", -0.0000001, "<0.0000>"),
            ("9E3", 9001.25, "<9001.25>"),
            ("7", 100.0, "<100>"),
        ] {
            assert_eq!(written(old, value), new, "{old}");
        }
        let cell = Cell { value: 2.0, unit: 1.0, span: 0..1 };
        assert_eq!((cell.whole(2), cell.whole(-1).map(|c| c.text)), (None, Some("-1".into())));
    }
}
