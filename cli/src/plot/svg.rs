//! Writing SVG: numbers to a tenth of a pixel, text that cannot end its element.

use core::fmt::Write as _;

/// A place or length in pixels, to a tenth.
pub fn px(x: f64) -> String {
    let text = format!("{x:.1}");
    let short = text.strip_suffix(".0").unwrap_or(&text);
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// Text between tags or in quotes.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

/// A line of text; `anchor` is start, middle or end.
pub fn label(class: &str, anchor: &str, [x, y]: [f64; 2], text: &str) -> String {
    let (x, y, text) = (px(x), px(y), escaped(text));
    format!("<text class=\"{class}\" text-anchor=\"{anchor}\" x=\"{x}\" y=\"{y}\">{text}</text>\n")
}

/// The commands of a line through points.
pub fn path(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut commands = String::new();
    for (k, [x, y]) in points.into_iter().enumerate() {
        let letter = if k == 0 { 'M' } else { 'L' };
        // Writing into a `String` cannot fail.
        let _ = write!(commands, "{letter}{} {}", px(x), px(y));
    }
    commands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_stays_within_its_element() {
        assert_eq!(escaped("a<b & \"c\"\n>"), "a&lt;b &amp; &quot;c&quot; &gt;");
        assert_eq!(path([[0.0, 1.25], [-0.04, 2.0]]), "M0 1.2L0 2");
    }
}
