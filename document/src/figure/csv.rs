//! A table that the page offers as CSV.

use serde::Serialize;
use serde_json::Value;

/// Columns by name (with their unit in brackets, as measurement files have it) and rows of cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Csv {
    /// One name for each cell of a row.
    pub columns: Vec<String>,
    /// Numbers in SI, or text; `null` is an empty cell.
    pub rows: Vec<Vec<Value>>,
}

impl Csv {
    /// A table without rows.
    pub fn new(columns: &[&str]) -> Csv {
        let columns = columns.iter().map(|c| (*c).to_owned()).collect();
        Csv { columns, rows: Vec::new() }
    }
}

/// A number as it is embedded: with eight significant digits, which no measurement exceeds. One
/// that is not finite is an empty cell.
pub fn number(x: f64) -> Value {
    rounded(x, 8)
}

/// A difference of such numbers: with six.
pub fn residual(x: f64) -> Value {
    rounded(x, 6)
}

fn rounded(x: f64, digits: usize) -> Value {
    Value::from(format!("{x:.*e}", digits - 1).parse().unwrap_or(x))
}

/// Three numbers.
pub fn point(p: [f64; 3]) -> [Value; 3] {
    p.map(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_finite() {
        assert_eq!(number(0.1 + 0.2), Value::from(0.3));
        assert_eq!(number(1.234_567_891_2e-9), Value::from(1.234_567_9e-9));
        assert_eq!(number(f64::NAN), Value::Null);
    }
}
