//! The cells of a table: what is a number, what begins its decimals, and what says that there is none.

use std::borrow::Cow;

use super::map::Map;
use super::mistake::Fault;
use super::table::Separator;

/// Whether a cell says that it holds nothing.
pub fn is_none(text: &str) -> bool {
    ["", "-", "--", "na", "n/a", "nan"].iter().any(|none| none.eq_ignore_ascii_case(text))
}

/// A finite number with a point before its decimals; `expected` is what the message asks for.
pub fn number(cell: &str, expected: impl Fn() -> String) -> Result<f64, Fault> {
    let number = cell.parse().ok().filter(|x: &f64| x.is_finite());
    number.ok_or_else(|| no_number(cell, &expected()))
}

fn no_number(cell: &str, expected: &str) -> Fault {
    let (found, again) = (format!("`{cell}`"), "remove the row or measure again");
    match cell.parse::<f64>() {
        Err(_) if cell.is_empty() => empty(expected),
        Ok(value) if value.is_nan() => Fault::hole(found + ", not a number", expected, again),
        Ok(_) if cell.contains(['n', 'N']) => Fault::new(found + ", infinity", expected, again),
        Ok(_) => too_large(cell, expected),
        Err(_) if with_comma(cell).is_some() => {
            Fault::new(found + ", a decimal comma", "", "write 1.5, not 1,5")
        }
        Err(_) => {
            let has_digits = cell.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
            let unit = if has_digits { "; a unit belongs in the header, `name[unit]`" } else { "" };
            Fault::new(found, expected, format!("write a plain number{unit}"))
        }
    }
}

/// A number that its unit makes too large.
pub fn too_large(cell: &str, expected: &str) -> Fault {
    Fault::new(format!("`{cell}`, too large for a double"), expected, "mend the exponent")
}

/// A cell without anything in it.
pub fn empty(expected: &str) -> Fault {
    Fault::hole("an empty cell", expected, "fill it in, or remove the row")
}

/// A finite number of a cell in which a comma begins the decimals, and points may stand between thousands.
fn with_comma(cell: &str) -> Option<f64> {
    let number = match cell.contains('.') {
        true if !is_grouped(cell) => None,
        true => cell.replace('.', "").replace(',', ".").parse().ok(),
        false => cell.replacen(',', ".", 1).parse().ok(),
    };
    number.filter(|x: &f64| x.is_finite())
}

/// Whether points stand before each three digits of a number: `1.200`, `-1.200.300,5`.
fn is_grouped(text: &str) -> bool {
    let text = text.strip_prefix(['+', '-']).unwrap_or(text);
    let (whole, decimals) = text.split_once(',').unwrap_or((text, "0"));
    let are_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let mut groups = whole.split('.');
    let first = groups.next().is_some_and(|group| are_digits(group) && group.len() <= 3);
    first && are_digits(decimals) && groups.all(|group| are_digits(group) && group.len() == 3)
}

/// What begins the decimals of a file's numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Decimals {
    /// Whether a comma may: it does not separate cells, or the map says so.
    may_comma: bool,
    /// Whether the map says so.
    is_told: bool,
    /// Whether it does, as far as cells were looked at.
    pub comma: bool,
}

impl Decimals {
    /// Of a file whose cells are separated so, of which no cell was looked at.
    pub fn of(separator: Separator, map: &Map) -> Decimals {
        let is_told = map.decimal == Some(',');
        let may_comma = is_told || separator != Separator::Byte(b',');
        Decimals { may_comma, is_told, comma: is_told }
    }

    /// The number of a cell, if it is one, whichever character begins its decimals.
    pub fn found(self, cell: &str) -> Option<f64> {
        match cell.contains(',') {
            false => cell.parse().ok().filter(|x: &f64| x.is_finite()),
            true => with_comma(cell).filter(|_| self.may_comma),
        }
    }

    /// The same, and notes what begins the decimals. A point in a file of commas stands between thousands.
    #[inline]
    pub fn look(&mut self, cell: &str) -> Option<f64> {
        // Most cells of a file have points, and are numbers.
        match cell.parse::<f64>() {
            Ok(number) if !self.comma => Some(number).filter(|number| number.is_finite()),
            _ => self.look_for_comma(cell),
        }
    }

    #[cold]
    fn look_for_comma(&mut self, cell: &str) -> Option<f64> {
        if !self.comma {
            self.found(cell)?;
            self.comma = true;
        }
        self.number(cell).ok().flatten()
    }

    /// A cell as it stands, with a point before its decimals if it is a number.
    pub fn plain(self, cell: &str) -> Cow<'_, str> {
        if !self.comma {
            return cell.into();
        }
        let has_comma = cell.contains(',');
        let grouped = cell.contains('.') && is_grouped(cell) && (self.is_told || has_comma);
        match (has_comma, grouped) {
            (_, true) => Cow::Owned(cell.replace('.', "").replace(',', ".")),
            (true, false) if self.found(cell).is_some() => Cow::Owned(cell.replace(',', ".")),
            _ => cell.into(),
        }
    }

    /// The number of a cell; `None` of one that says that it holds none.
    ///
    /// # Errors
    /// What is no number, or may be two: `1.100` where a comma begins the decimals.
    pub fn number(self, cell: &str) -> Result<Option<f64>, Fault> {
        let as_it_stands = cell.parse().ok().filter(|x: &f64| x.is_finite() && !self.comma);
        if as_it_stands.is_some() {
            return Ok(as_it_stands);
        }
        let text = self.plain(cell);
        if is_none(&text) {
            return Ok(None);
        }
        if self.comma && matches!(&text, Cow::Borrowed(text) if text.contains('.')) {
            let help = match is_grouped(&text) {
                true => "write 1100 or 1,1; if it is a thousand, say `decimal = \",\"` in a map",
                false => "write 1,1",
            };
            let found = format!("`{cell}` where a comma begins the decimals");
            return Err(Fault::new(found, "a number", help));
        }
        number(&text, || "a number".to_owned()).map(Some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain_and_finite() {
        for (cell, value) in [("1.5", 1.5), ("-2e-3", -2e-3), ("+7", 7.0), (".5", 0.5)] {
            assert_eq!(number(cell, String::new), Ok(value));
        }
        for (cell, told, is_hole) in [
            ("", "an empty cell", true),
            ("NaN", ", not a number", true),
            ("nan", ", not a number", true),
            ("-NAN", ", not a number", true),
            ("inf", ", infinity", false),
            ("-Infinity", ", infinity", false),
            ("INF", ", infinity", false),
            ("1e999", ", too large for a double", false),
            ("1,5", ", a decimal comma", false),
            ("abc", "`: write a plain number", false),
            ("1.5mm", "`: write a plain number; a unit", false),
            ("0x10", "`: write a plain number; a unit", false),
            ("1 2", "`: write a plain number", false),
            ("1,2,3", "`: write a plain number", false),
            ("--1", "`: write a plain number", false),
            ("e", "`: write a plain number", false),
        ] {
            let fault = number(cell, String::new).unwrap_err();
            assert!(fault.to_string().contains(told), "{fault}");
            assert_eq!(fault.is_hole, is_hole, "{cell}");
        }
    }

    #[test]
    fn a_comma_begins_decimals_where_it_separates_nothing() {
        let map = Map::default();
        let look = |separator: u8, cells: &[&str]| -> Vec<Option<f64>> {
            let mut decimals = Decimals::of(Separator::Byte(separator), &map);
            cells.iter().map(|cell| decimals.look(cell)).collect()
        };
        assert_eq!(look(b',', &["1.5", "1,5"]), [Some(1.5), None]);
        // A point is none of decimals behind the first comma that is.
        let found = look(b';', &["1.5", "1,5", "1.234", "1.234,5", "a,b", "2", "inf"]);
        assert_eq!(found, [Some(1.5), Some(1.5), None, Some(1234.5), None, Some(2.0), None]);
    }
}
