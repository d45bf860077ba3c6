//! Text for a terminal: numbers, aligned columns, bars.

use console::{measure_text_width, style};
pub use stiffarm_gap::io::listed;

/// Of a quotation that is longer nobody reads all.
const LONGEST_QUOTED: usize = 120;

/// `joint_compliance` as it is written in a sentence.
pub fn words(identifier: &str) -> String {
    // Named after people.
    let names = [("coulomb", "Coulomb"), ("stribeck", "Stribeck")];
    let words = identifier.replace('_', " ");
    names.into_iter().fold(words, |words, (from, to)| words.replace(from, to))
}

/// `1 value`, `2 values`.
pub fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

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

/// Text in lines of at most `width` (a longer word stands alone), the ones after the first moved
/// right by `hanging`. Spaces at its beginning stay.
pub fn wrapped(text: &str, width: usize, hanging: usize) -> String {
    let mut lines = String::new();
    let begin = text.len() - text.trim_start().len();
    let (mut line, rest) = (text[..begin].to_owned(), &text[begin..]);
    let mut empty = true;
    for word in rest.split(' ') {
        let longer = measure_text_width(&line) + usize::from(!empty) + measure_text_width(word);
        if !empty && longer > width {
            lines.push_str(line.trim_end());
            lines.push('\n');
            (line, empty) = (" ".repeat(hanging), true);
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    lines.push_str(line.trim_end());
    lines.push('\n');
    lines
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

/// A number with so many digits behind the point; what rounds to nothing has no sign.
pub fn fixed(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        _ => minus(text),
    }
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

/// A bar of what there was, of which a part is left: `██░░░░`.
pub fn left_bar(before: f64, after: f64, width: usize) -> String {
    let cells = |part: f64| (part.clamp(0.0, 1.0) * width as f64).round() as usize;
    let (before, after) = (cells(before), cells(after));
    format!("{}{}", "█".repeat(after), "░".repeat(before.saturating_sub(after)))
}

/// A sentence whose quotations, between `` ` ``, are cut where they are no longer read.
pub fn clipped(message: &str) -> String {
    let cut = |(k, part): (usize, &str)| {
        let length = part.chars().count();
        match k % 2 == 1 && length > LONGEST_QUOTED {
            true => {
                let head: String = part.chars().take(LONGEST_QUOTED / 2).collect();
                format!("{head}… ({} characters)", thousands(length))
            }
            false => part.to_owned(),
        }
    };
    message.split('`').enumerate().map(cut).collect::<Vec<_>>().join("`")
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
        assert_eq!(fixed(-0.004, 2), "0.00");
        assert_eq!(fixed(-0.006, 2), "−0.01");
        assert_eq!(fixed(12.0, 0), "12");
    }

    #[test]
    fn long_quotations_are_cut() {
        let asked = |found: &str| clipped(&format!("found `{found}`, expected `mm`"));
        assert_eq!(asked("é".repeat(120).as_str()).chars().count(), 143);
        let cut = format!("found `{}… (20,000 characters)`, expected `mm`", "é".repeat(60));
        assert_eq!(asked("é".repeat(20_000).as_str()), cut);
    }

    #[test]
    fn bars_are_proportional() {
        assert_eq!(bar(1.0, 3), "███");
        assert_eq!(bar(0.5, 3), "█▌");
        assert_eq!(bar(1e-9, 3), "▏");
        assert_eq!(bar(0.0, 3), "");
    }

    #[test]
    fn long_lines_are_wrapped() {
        assert_eq!(wrapped("one two three", 8, 2), "one two\n  three\n");
        assert_eq!(wrapped("  one", 4, 4), "  one\n");
        assert_eq!(wrapped("  one two", 5, 4), "  one\n    two\n");
        assert_eq!(wrapped("name    text", 20, 0), "name    text\n");
        assert_eq!(left_bar(1.0, 0.25, 4), "█░░░");
        assert_eq!(left_bar(0.5, 0.0, 4), "░░");
    }

    #[test]
    fn columns_are_aligned() {
        let rows = [vec!["a".to_owned(), "1.5".to_owned()], vec!["µm".to_owned(), "22".to_owned()]];
        let text = table(&rows, &[Align::Left, Align::Right]);
        assert_eq!(text, "a   1.5\nµm   22\n");
        assert_eq!(indented("a\n\nb\n", 2), "  a\n\n  b\n");
    }
}
