//! A printed equation: its left side, its right sides, and the cells of a matrix.

use core::ops::Range;

/// A piece of text and where it begins in what it stands in: an equation, or a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Piece {
    /// The text; of an equation trimmed.
    pub text: String,
    /// Byte at which it begins.
    pub at: usize,
}

impl Piece {
    /// Where it stands.
    pub fn place(&self) -> Range<usize> {
        self.at..self.at + self.text.len()
    }
}

/// One right side: a formula, or a matrix of formulas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Side {
    /// Rows of cells; a formula is one cell.
    pub rows: Vec<Vec<Piece>>,
    /// Whether it was printed as a matrix or vector.
    pub matrix: bool,
}

/// An equation taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// What stands before the first equals sign; empty without one.
    pub left: String,
    /// What stands behind the equals signs.
    pub sides: Vec<Side>,
}

/// The sides of an equation, cut at its equals signs.
pub fn sides(latex: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut start = 0;
    for cut in top_level(latex, "=") {
        pieces.push(piece(latex, start, cut));
        start = cut + 1;
    }
    pieces.push(piece(latex, start, latex.len()));
    pieces
}

/// Takes an equation apart.
pub fn formula(latex: &str) -> Formula {
    let mut pieces = sides(latex);
    let left = if pieces.len() > 1 { pieces.remove(0).text } else { String::new() };
    Formula {
        left: left.trim_matches(['&', ' ']).to_owned(),
        sides: pieces.iter().map(side).collect(),
    }
}

fn piece(latex: &str, start: usize, end: usize) -> Piece {
    let part = &latex[start..end];
    let trimmed = part.trim_matches(|c: char| c.is_whitespace() || c == '&');
    let lead = part.len() - part.trim_start_matches(|c: char| c.is_whitespace() || c == '&').len();
    let stop = trimmed.strip_suffix([',', '.']).unwrap_or(trimmed).trim_end();
    Piece { text: stop.to_owned(), at: start + lead }
}

fn side(printed: &Piece) -> Side {
    let text = &printed.text;
    let single = Side { rows: vec![vec![printed.clone()]], matrix: false };
    if let Some(inner) = text.strip_prefix("\\begin{") {
        let (Some(open), Some(close)) = (inner.find('}'), text.rfind("\\end{")) else {
            return single;
        };
        let mut start = "\\begin{".len() + open + 1;
        // An array's column specification.
        if text[start..].starts_with('{') {
            start += text[start..].find('}').map_or(0, |i| i + 1);
        }
        if start > close {
            return single;
        }
        return grid(printed, start, close, "&");
    }
    let row = text.starts_with('[') || text.starts_with("\\left[");
    let transposed = ["]^T", "]^{T}", "\\right]^T"].iter().find(|end| text.ends_with(**end));
    match transposed.filter(|_| row && text.contains("\\quad")) {
        Some(end) => {
            let start = text.find('[').map_or(0, |i| i + 1);
            let side = grid(printed, start, text.len() - end.len(), "\\quad");
            // A transposed row is a column.
            let cells = side.rows.into_iter().flatten().filter(|cell| !cell.text.is_empty());
            Side { rows: cells.map(|cell| vec![cell]).collect(), matrix: true }
        }
        None => single,
    }
}

fn grid(printed: &Piece, start: usize, end: usize, between: &str) -> Side {
    let mut rows = Vec::new();
    let text = &printed.text;
    for (from, to) in parts(text, start, end, "\\\\") {
        if text[from..to].trim().is_empty() {
            continue;
        }
        let cells = parts(text, from, to, between);
        rows.push(
            cells
                .into_iter()
                .map(|(a, b)| {
                    let inner = piece(text, a, b);
                    Piece { text: inner.text, at: printed.at + inner.at }
                })
                .collect(),
        );
    }
    Side { rows, matrix: true }
}

fn parts(text: &str, start: usize, end: usize, between: &str) -> Vec<(usize, usize)> {
    let mut out = Vec::new();
    let mut from = start;
    while let Some(at) = text[from..end].find(between) {
        out.push((from, from + at));
        from += at + between.len();
    }
    out.push((from, end));
    out
}

/// Places of a mark outside braces, brackets and environments.
fn top_level(text: &str, mark: &str) -> Vec<usize> {
    let mut depth = 0i32;
    let mut found = Vec::new();
    for (at, c) in text.char_indices() {
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth -= 1,
            _ if depth <= 0 && text[at..].starts_with(mark) => found.push(at),
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(latex: &str) -> Vec<Vec<String>> {
        let side = formula(latex).sides.remove(0);
        side.rows.into_iter().map(|r| r.into_iter().map(|c| c.text).collect()).collect()
    }

    #[test]
    fn sides_are_cut_at_equals_signs() {
        let f = formula("J_{11} &= -a \\\\ & + b = c,");
        assert_eq!(f.left, "J_{11}");
        assert_eq!(f.sides.len(), 2);
        assert_eq!(f.sides[1].rows[0][0], Piece { text: "c".into(), at: 24 });
        assert_eq!(formula("a + b").left, "");
    }

    #[test]
    fn matrices_are_cut_into_cells() {
        assert_eq!(
            cells("R = \\begin{bmatrix} 1 & 0 \\\\ -s & c \\end{bmatrix}"),
            [["1", "0"], ["-s", "c"]]
        );
        assert_eq!(cells("F = [a \\quad -b \\\\ 0 \\quad c]^T"), [["a"], ["-b"], ["0"], ["c"]]);
        assert_eq!(cells("\\begin{array}{cc} a & b \\end{array}"), [["a", "b"]]);
        assert_eq!(cells("x = \\begin{bmatrix"), [["\\begin{bmatrix"]]);
    }

    proptest::proptest! {
        #[test]
        fn no_text_panics(text in "[=&{}\\[\\]a\\\\ T^quadbegin]{0,40}") {
            formula(&text);
        }
    }
}
