//! Splits the tokens of the table into rows.

use proc_macro2::TokenTree;

use super::spot::is_sign;

/// The rows, header first. By lines where the tokens know theirs, which gives a missing cell its
/// true place; by counting cells where they do not (a table that another macro has written).
pub(super) fn split(tokens: &[TokenTree]) -> Vec<Vec<TokenTree>> {
    if lines_are_known(tokens) { by_line(tokens) } else { by_count(tokens) }
}

fn start_line(token: &TokenTree) -> usize {
    token.span().start().line
}

fn end_line(token: &TokenTree) -> usize {
    match token {
        TokenTree::Group(group) => group.span_close().end().line,
        token => token.span().end().line,
    }
}

/// Whether the tokens stand on several lines, and in order: a substitution by `macro_rules!` brings
/// tokens from elsewhere.
fn lines_are_known(tokens: &[TokenTree]) -> bool {
    let ordered = tokens.windows(2).all(|pair| start_line(&pair[1]) >= end_line(&pair[0]));
    let several = match (tokens.first(), tokens.last()) {
        (Some(first), Some(last)) => start_line(first) < start_line(last),
        _ => false,
    };
    ordered && several
}

fn by_line(tokens: &[TokenTree]) -> Vec<Vec<TokenTree>> {
    let mut rows: Vec<Vec<TokenTree>> = Vec::new();
    for token in tokens {
        let continues = rows.last().and_then(|row| row.last()).is_some_and(|last| {
            start_line(token) == end_line(last) || is_sign(token, '|') || is_sign(last, '|')
        });
        match rows.last_mut() {
            Some(row) if continues => row.push(token.clone()),
            _ => rows.push(vec![token.clone()]),
        }
    }
    rows
}

/// With n columns, every (n−1)-th stretch between separators holds the last cell of one row and the
/// first of the next, which is one token: the joint's name.
fn by_count(tokens: &[TokenTree]) -> Vec<Vec<TokenTree>> {
    let stretches: Vec<&[TokenTree]> = tokens.split(|token| is_sign(token, '|')).collect();
    // A column's name is one token: the first stretch of more ends the header.
    let Some(separators) = stretches.iter().position(|s| s.len() > 1).filter(|n| *n > 0) else {
        return vec![tokens.to_vec()];
    };
    let mut rows: Vec<Vec<TokenTree>> = Vec::new();
    let mut row = Vec::new();
    let mut count = 0;
    let last = stretches.len() - 1;
    for (i, stretch) in stretches.iter().enumerate() {
        match stretch.split_last() {
            Some((name, cell)) if count == separators && i < last => {
                row.extend_from_slice(cell);
                rows.push(core::mem::replace(&mut row, vec![name.clone()]));
                count = 0;
            }
            _ => row.extend_from_slice(stretch),
        }
        // The separator behind this stretch stays in the row.
        let behind: usize = stretches[..=i].iter().map(|s| s.len() + 1).sum::<usize>() - 1;
        row.extend(tokens.get(behind).cloned());
        count += 1;
    }
    rows.push(row);
    rows
}

#[cfg(test)]
mod tests {
    use proc_macro2::{Span, TokenStream};

    use super::super::spot::flatten;
    use super::*;

    fn rows(text: &str, without_lines: bool) -> Vec<String> {
        let mut tokens = flatten(text.parse::<TokenStream>().unwrap());
        if without_lines {
            tokens.iter_mut().for_each(|token| token.set_span(Span::call_site()));
        }
        let text = |row: Vec<TokenTree>| row.into_iter().collect::<TokenStream>().to_string();
        split(&tokens).into_iter().map(text).collect()
    }

    #[test]
    fn one_line_is_one_row() {
        let table = "joint | theta | d\n a1 | q | 0\n a2 | q\n | 1 mm\n a3 | q |\n 2 mm\n a4 | q";
        let expected =
            ["joint | theta | d", "a1 | q | 0", "a2 | q | 1 mm", "a3 | q | 2 mm", "a4 | q"];
        assert_eq!(rows(table, false), expected);
    }

    #[test]
    fn a_group_over_several_lines_stays_in_its_row() {
        let table = "joint | beam | d\n a1 | {\n x: 1\n } | 0\n a2 | - | 0";
        assert_eq!(rows(table, false)[1..], ["a1 | { x : 1 } | 0", "a2 | - | 0"]);
    }

    #[test]
    fn without_lines_cells_are_counted() {
        let table = "joint | theta | d\n a1 | q + pi/2 | 350 mm\n a2 | q | -5 mm\n a3 | q | 0";
        assert_eq!(rows(table, true), rows(table, false));
        assert_eq!(rows("joint | theta", true), ["joint | theta"]);
        assert_eq!(rows("joint theta", true), ["joint theta"]);
        assert_eq!(rows("", true), [""]);
    }
}
