//! A relation between matrices as a tree.

use std::collections::HashMap;

/// A printed matrix symbol: its letters, and its indices, of which some may be counted over.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// Letters, without their typeface: `K`, `theta`, `^BR` for `{}^BR`, `dotq`.
    pub base: String,
    /// What stands below, between commas: `i`, `j+1`, `kin`.
    pub indices: Vec<String>,
    /// The letters as printed.
    pub printed: String,
}

impl Name {
    /// The key by which its value is known, its indices counted.
    pub fn key(&self, counted: &HashMap<String, i64>) -> String {
        let plain = |text: &String| text.replace('\\', "");
        let index = |text: &String| count(text, counted).map_or(plain(text), |n| n.to_string());
        let indices: Vec<String> = self.indices.iter().map(index).collect();
        match indices.is_empty() {
            true => self.base.clone(),
            false => format!("{}_{}", self.base, indices.join(",")),
        }
    }

    /// As printed.
    pub fn latex(&self) -> String {
        let command = self.printed.ends_with(char::is_alphabetic) && self.printed.contains('\\');
        match self.indices.as_slice() {
            [] if command => format!("{} ", self.printed),
            [] => self.printed.clone(),
            [one] if one.chars().count() == 1 || one.starts_with('\\') => {
                format!("{}_{one}", self.printed)
            }
            indices => format!("{}_{{{}}}", self.printed, indices.join(",")),
        }
    }
}

/// An index such as `i-1` as a number, if it counts.
pub fn count(text: &str, counted: &HashMap<String, i64>) -> Option<i64> {
    let mut total = 0;
    let mut rest = text;
    let mut sign = 1;
    while !rest.is_empty() {
        let end = rest.find(['+', '-']).unwrap_or(rest.len());
        let (term, after) = rest.split_at(end);
        if !term.is_empty() {
            total += sign * term.parse().ok().or_else(|| counted.get(term).copied())?;
        }
        sign = if after.starts_with('-') { -1 } else { 1 };
        rest = after.get(1..).unwrap_or_default();
    }
    (!text.is_empty()).then_some(total)
}

/// A formula of matrices.
#[derive(Clone, Debug, PartialEq)]
pub enum Tree {
    /// A number.
    Number(String),
    /// A symbol.
    Name(Name),
    /// Terms, each with whether it is subtracted.
    Sum(Vec<(bool, Tree)>),
    /// Factors.
    Product(Vec<Tree>),
    /// A quotient of numbers.
    Quotient(Box<Tree>, Box<Tree>),
    /// Rows for columns.
    Transpose(Box<Tree>),
    /// The inverse.
    Inverse(Box<Tree>),
    /// By a joint, or column by column by all of them.
    Derivative(Box<Tree>, Name),
    /// The root of a number.
    Sqrt(Box<Tree>),
    /// The sum of the diagonal.
    Trace(Box<Tree>),
    /// Frobenius' norm.
    Norm(Box<Tree>),
    /// Blocks.
    Blocks(Vec<Vec<Tree>>),
    /// A product over an index.
    Over {
        /// The index that counts.
        index: String,
        /// From here …
        from: String,
        /// … to here.
        to: String,
        /// What is multiplied.
        body: Box<Tree>,
    },
}

impl Tree {
    /// As LaTeX.
    pub fn latex(&self) -> String {
        match self {
            Tree::Number(n) => n.clone(),
            Tree::Name(name) => name.latex(),
            Tree::Sum(terms) => {
                let mut out = String::new();
                for (k, (negative, term)) in terms.iter().enumerate() {
                    out.push_str(match (negative, k) {
                        (true, 0) => "-",
                        (true, _) => " - ",
                        (false, 0) => "",
                        (false, _) => " + ",
                    });
                    out.push_str(&term.inside());
                }
                out
            }
            Tree::Product(factors) => {
                let each: Vec<String> = factors.iter().map(Tree::inside).collect();
                each.iter().map(|f| f.trim()).collect::<Vec<_>>().join(" ")
            }
            Tree::Quotient(a, b) => format!("\\frac{{{}}}{{{}}}", a.latex(), b.latex()),
            Tree::Transpose(a) => match a.as_ref() {
                Tree::Inverse(a) => format!("{}^{{-T}}", a.closed()),
                a => format!("{}^T", a.closed()),
            },
            Tree::Inverse(a) => format!("{}^{{-1}}", a.closed()),
            Tree::Derivative(a, by) => {
                format!("\\frac{{\\partial {}}}{{\\partial {}}}", a.closed(), by.latex().trim())
            }
            Tree::Sqrt(a) => format!("\\sqrt{{{}}}", a.latex()),
            Tree::Trace(a) => format!("\\text{{tr}}({})", a.latex()),
            Tree::Norm(a) => format!("\\|{}\\|", a.latex()),
            Tree::Blocks(rows) => {
                let row =
                    |row: &Vec<Tree>| row.iter().map(Tree::latex).collect::<Vec<_>>().join(" & ");
                let rows: Vec<String> = rows.iter().map(row).collect();
                format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows.join(" \\\\ "))
            }
            Tree::Over { index, from, to, body } => {
                format!("(\\prod_{{{index}={from}}}^{{{to}}} {})", body.latex())
            }
        }
    }

    /// As a factor.
    fn inside(&self) -> String {
        match self {
            Tree::Sum(_) => format!("({})", self.latex()),
            _ => self.latex(),
        }
    }

    /// As what a power stands on.
    fn closed(&self) -> String {
        match self {
            Tree::Number(_) | Tree::Name(_) | Tree::Blocks(_) => self.latex().trim().to_owned(),
            Tree::Transpose(inner) if matches!(**inner, Tree::Name(_)) => self.latex(),
            _ => format!("({})", self.latex()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_count() {
        let counted = HashMap::from([("i".to_owned(), 3), ("j".to_owned(), 1)]);
        assert_eq!(count("i-1", &counted), Some(2));
        assert_eq!(count("j+1", &counted), Some(2));
        assert_eq!((count("kin", &counted), count("", &counted)), (None, None));
        let indices = vec!["i-1".to_owned(), "kin".to_owned()];
        let name = Name { base: "K".into(), indices, printed: "K".into() };
        assert_eq!(name.key(&counted), "K_2,kin");
        assert_eq!(name.latex(), "K_{i-1,kin}");
    }
}
