//! Tables as text: comment lines, a header, and one line per row.

/// A column: its header, and its cell of a row.
type Column<'a, R> = (String, Box<dyn Fn(&R) -> String + 'a>);

/// The columns of a file.
pub struct Columns<'a, R>(Vec<Column<'a, R>>);

impl<R> core::fmt::Debug for Columns<'_, R> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self.0.iter().map(|(header, _)| header)).finish()
    }
}

impl<R> Default for Columns<'_, R> {
    fn default() -> Self {
        Columns(Vec::new())
    }
}

impl<'a, R> Columns<'a, R> {
    /// One more, behind the others.
    pub fn add(&mut self, header: impl Into<String>, cell: impl Fn(&R) -> String + 'a) {
        self.0.push((header.into(), Box::new(cell)));
    }

    /// The file of these rows.
    pub fn text(
        &self,
        comments: impl IntoIterator<Item: AsRef<str>>,
        rows: impl Iterator<Item = R>,
    ) -> String {
        let lines = |comment: &str| -> Vec<String> {
            comment.lines().map(|line| format!("# {}", line.trim_end())).collect()
        };
        let above = comments.into_iter().flat_map(|comment| lines(comment.as_ref()));
        let header = self.0.iter().map(|(header, _)| header.as_str()).collect::<Vec<_>>().join(",");
        let line = |row: R| self.0.iter().map(|(_, cell)| cell(&row)).collect::<Vec<_>>().join(",");
        above.chain([header]).chain(rows.map(line)).map(|line| line + "\n").collect()
    }
}

/// A number as a cell: the shortest text that reads as the same number; −0 is 0.
pub fn number(value: f64) -> String {
    let value = value + 0.0;
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// A number as a cell, with so many digits behind the point at most.
pub fn digits(value: f64, most: usize) -> String {
    let text = format!("{value:.most$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// An id as a cell, empty of none: in quotation marks where it needs them.
pub fn quoted(id: Option<&str>) -> String {
    let id = id.unwrap_or_default();
    if id.contains([',', '"', '\n', '\r', '#']) || id != id.trim() {
        return format!("\"{}\"", id.replace('"', "\"\""));
    }
    id.to_owned()
}

/// A number for people: three significant digits.
pub fn shown(x: f64) -> String {
    if x == 0.0 || (1e-3..1e6).contains(&x.abs()) {
        let digits = if x == 0.0 { 0.0 } else { (2.0 - x.abs().log10().floor()).max(0.0) };
        let text = format!("{x:.*}", digits as usize);
        return match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        };
    }
    format!("{x:.2e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases =
            [(0.0, "0"), (0.01234, "0.0123"), (170.0, "170"), (1234.0, "1234"), (2.5, "2.5")];
        for (x, text) in cases {
            assert_eq!(shown(x), text);
        }
        assert_eq!(shown(1e9), "1.00e9");
    }
}
