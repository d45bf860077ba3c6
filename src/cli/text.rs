//! Text for a terminal: numbers, aligned columns, bars.

use console::{measure_text_width, style};

/// How a column is aligned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Text.
    Left,
    /// Numbers.
    Right,
}

/// Rows in columns two spaces apart, without spaces at the ends of lines. Columns beyond `align` are
/// left.
pub fn table(rows: &[Vec<String>], align: &[Align]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width =
        |c: usize| rows.iter().filter_map(|r| r.get(c)).map(|t| measure_text_width(t)).max();
    let widths: Vec<usize> = (0..columns).map(|c| width(c).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (c, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[c] - measure_text_width(cell));
            if c > 0 {
                line.push_str("  ");
            }
            match align.get(c) {
                Some(Align::Right) => line.extend([pad.as_str(), cell]),
                _ => line.extend([cell, pad.as_str()]),
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Each line moved right.
pub fn indented(text: &str, by: usize) -> String {
    let margin = " ".repeat(by);
    text.lines().map(|line| format!("{margin}{line}").trim_end().to_owned() + "\n").collect()
}

/// A number with three significant digits: `7.41`, `0.0891`, `2.14e5`.
pub fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e4).contains(&size) {
        return minus(format!("{x:.2e}"));
    }
    minus(format!("{x:.*}", decimals(size, 3)))
}

/// Digits behind the point that show `digits` significant ones of `size`.
pub fn decimals(size: f64, digits: i32) -> usize {
    if !(size.is_finite() && size > 0.0) {
        return 0;
    }
    usize::try_from(digits - 1 - size.log10().floor() as i32).unwrap_or(0)
}

/// The typographic minus sign in place of the hyphen; exponents keep theirs.
pub fn minus(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

/// A bar of a part of the whole, in eighths of a character.
pub fn bar(part: f64, width: usize) -> String {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    let eighths = (part.clamp(0.0, 1.0) * (8 * width) as f64).round() as usize;
    // What is there at all is to be seen.
    let eighths = if part > 0.0 { eighths.max(1) } else { eighths };
    format!("{}{}", "█".repeat(eighths / 8), EIGHTHS[eighths % 8])
}

/// With thousands set apart.
pub fn thousands(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (k, c) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(c);
    }
    text
}

/// A heading.
pub fn bold(text: impl AsRef<str>) -> String {
    style(text.as_ref()).bold().to_string()
}

/// What matters less.
pub fn dim(text: impl AsRef<str>) -> String {
    style(text.as_ref()).dim().to_string()
}

/// What is as it should be.
pub fn good(text: impl AsRef<str>) -> String {
    style(text.as_ref()).green().to_string()
}

/// What is not.
pub fn bad(text: impl AsRef<str>) -> String {
    style(text.as_ref()).red().bold().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (7.4103, "7.41"),
            (0.891, "0.891"),
            (0.0123, "0.0123"),
            (-12.34, "−12.3"),
            (1234.4, "1234"),
            (24174.0, "2.42e4"),
            (2.14e5, "2.14e5"),
            (-4.13e-5, "−4.13e-5"),
            (0.0, "0"),
        ];
        for (x, text) in cases {
            assert_eq!(short(x), text);
        }
        assert_eq!(thousands(1_234_567), "1,234,567");
        assert_eq!(thousands(10), "10");
    }

    #[test]
    fn bars_are_proportional() {
        assert_eq!(bar(1.0, 3), "███");
        assert_eq!(bar(0.5, 3), "█▌");
        assert_eq!(bar(1e-9, 3), "▏");
        assert_eq!(bar(0.0, 3), "");
    }

    #[test]
    fn columns_are_aligned() {
        let rows = [vec!["a".to_owned(), "1.5".to_owned()], vec!["µm".to_owned(), "22".to_owned()]];
        let text = table(&rows, &[Align::Left, Align::Right]);
        assert_eq!(text, "a   1.5\nµm   22\n");
        assert_eq!(indented("a\n\nb\n", 2), "  a\n\n  b\n");
    }
}
