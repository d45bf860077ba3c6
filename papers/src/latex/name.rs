//! A printed name: its letters, and its indices, of which some may be counted over.

use std::collections::HashMap;

/// A letter, Greek letter or longer name, with its subscript. Two typefaces of one name are equal.
#[derive(Clone, Debug)]
pub struct Name {
    /// Letters, without spaces and typeface: `\theta`, `RL`, `^BR` for `{}^BR`.
    pub base: String,
    /// What stands below, without braces and spaces: `23`, `i-1,kin`.
    pub sub: Option<String>,
    /// Its name in the graph, letters and digits: `RL_4` is `RL4`, `\lambda_6` is `lambda6`.
    pub key: String,
    /// The letters as printed.
    letters: String,
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        (&self.base, &self.sub) == (&other.base, &other.sub)
    }
}

impl Name {
    /// A name; `printed` is how all of it is printed.
    pub fn new(base: String, sub: Option<String>, printed: &str) -> Self {
        let mut depth = 0i32;
        let below = printed.find(|c| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            c == '_' && depth == 0
        });
        let letters = printed[..below.unwrap_or(printed.len())].trim().to_owned();
        Name { key: key(&base, sub.as_deref()), base, sub, letters }
    }

    /// The indices, between commas.
    pub fn indices(&self) -> impl Iterator<Item = &str> {
        self.sub.iter().flat_map(|sub| sub.split(','))
    }

    /// The same letters with another subscript.
    pub fn under(&self, sub: String) -> Self {
        Self::new(self.base.clone(), Some(sub), &self.letters)
    }

    /// Whether it stands for one thing for each index.
    pub fn is_family(&self) -> bool {
        self.indices().any(|index| index == "#")
    }

    /// The key of a symbol of matrices, its indices counted: `K_{i-1,kin}` is `K_2,kin` for i = 3.
    pub fn counted(&self, counted: &HashMap<String, i64>) -> String {
        let plain = |text: &str| text.replace('\\', "");
        let index = |text| count(text, counted).map_or_else(|| plain(text), |n| n.to_string());
        let indices: Vec<String> = self.indices().map(index).collect();
        match indices.is_empty() {
            true => plain(&self.base),
            false => format!("{}_{}", plain(&self.base), indices.join(",")),
        }
    }

    /// As LaTeX.
    pub fn latex(&self) -> String {
        let letters = &self.letters;
        let command = letters.ends_with(char::is_alphabetic) && letters.contains('\\');
        match self.sub.as_deref() {
            None if command => format!("{letters} "),
            None => letters.clone(),
            Some(one) if one.chars().count() == 1 || one.starts_with('\\') => {
                format!("{letters}_{one}")
            }
            Some(indices) => format!("{letters}_{{{indices}}}"),
        }
    }
}

/// Letters and digits of a name.
pub(crate) fn key(base: &str, sub: Option<&str>) -> String {
    let letters = base.chars().chain(sub.unwrap_or_default().chars());
    letters.filter(|c| c.is_alphanumeric() || *c == '\'').collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_identifiers() {
        assert_eq!(key("\\lambda", Some("6")), "lambda6");
        assert_eq!(key("\\delta x", Some("{2}")), "deltax2");
    }

    #[test]
    fn indices_count() {
        let counted = HashMap::from([("i".to_owned(), 3), ("j".to_owned(), 1)]);
        assert_eq!(count("i-1", &counted), Some(2));
        assert_eq!(count("j+1", &counted), Some(2));
        assert_eq!((count("kin", &counted), count("", &counted)), (None, None));
        let name = Name::new("K".into(), Some("i-1,kin".into()), "K_{i-1, kin}");
        assert_eq!(name.counted(&counted), "K_2,kin");
        assert_eq!(name.latex(), "K_{i-1,kin}");
        let name = Name::new("^{A1}w".into(), Some("2".into()), "{}^{A_1}w_2");
        assert_eq!(name.latex(), "{}^{A_1}w_2");
    }
}
