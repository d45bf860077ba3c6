//! The robot file: TOML, read with the place of every value so that each mistake can be pointed at.

#[cfg(test)]
mod tests;

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue, Error};

use crate::robot::beyond::EffectError;
use crate::robot::lexeme::lex;
use crate::robot::problem::{Problem, Report};
use crate::robot::{Effect, FileError, Located, Robot, Warning};
use crate::schema::{self, Content, Language, Node, Pair, Table};

impl Robot {
    /// Reads a robot file. `path` is only used in messages.
    ///
    /// # Errors
    /// Every mistake in the file, in the order in which they stand.
    pub fn from_toml(text: &str, path: &str) -> Result<(Robot, Vec<Warning>), FileError> {
        let (root, errors) = DeTable::parse_recoverable(text);
        let mut report = Report::new();
        if !syntax(text, errors, &mut report) {
            return Err(FileError::new(path, text, report));
        }
        let root = node(text, root.span(), "a table", table(text, root.get_ref()));
        let mut robot = schema::read(&root, Language::File, &mut report);
        if !report.errors.is_empty() {
            return Err(FileError::new(path, text, report));
        }
        robot.effects.iter_mut().for_each(|effect| number_lines(text, effect));
        Ok((robot, Located::all(path, text, report.warnings)))
    }

    /// The same for kernels: its effects are understood ([`Robot::with_effects`]).
    ///
    /// # Errors
    /// Every mistake in the file, else every effect of which no kernel can be made.
    pub fn for_kernels(text: &str, path: &str) -> Result<(Robot, Vec<Warning>), FileError> {
        let (robot, warnings) = Robot::from_toml(text, path)?;
        let robot = robot.with_effects().map_err(|wrong| {
            let problem =
                |e: EffectError| Problem { help: e.help, ..Problem::new(e.at.span, e.message) };
            let errors = wrong.into_iter().map(problem).collect();
            FileError::new(path, text, Report { errors, ..Report::new() })
        })?;
        Ok((robot, warnings))
    }
}

/// Reports what is no TOML; whether the rest can still be read. A value without its quotes and a
/// key that stands twice leave the rest intact; behind the first other mistake all is guesswork.
fn syntax(text: &str, errors: Vec<Error>, report: &mut Report<Range<usize>>) -> bool {
    let mut broken: Option<Problem<Range<usize>>> = None;
    for error in errors {
        let at = error.span().unwrap_or(0..0);
        let found = text.get(at.clone()).unwrap_or_default();
        let message = error.message();
        if message.starts_with("string values must be quoted") {
            let problem = Problem::new(at.clone(), format!("`{found}` stands without quotes"));
            report.error(problem.help(format!("write \"{found}\"")));
        } else if message.starts_with("duplicate key") {
            report.error(Problem::new(at, format!("duplicate key `{found}`")));
        } else if broken.as_ref().is_none_or(|first| at.start < first.at.start) {
            broken = Some(Problem::new(at, format!("this is no TOML: {message}")));
        }
    }
    let readable = broken.is_none();
    if let Some(first) = &broken {
        report.errors.retain(|soft| soft.at.start < first.at.start);
    }
    report.errors.extend(broken);
    readable
}

/// The keys of a table in the order in which they stand; the parser has them by name.
fn table(text: &str, table: &DeTable<'_>) -> Content<Range<usize>> {
    let mut pairs: Vec<_> = table
        .iter()
        .map(|(key, value)| Pair {
            key: key.get_ref().to_string(),
            at: key.span(),
            value: value_node(text, value),
        })
        .collect();
    pairs.sort_by_key(|pair| pair.value.at.start);
    Content::Table(Table { pairs, meant: Vec::new() })
}

fn node(
    text: &str,
    at: Range<usize>,
    kind: &'static str,
    content: Content<Range<usize>>,
) -> Node<Range<usize>> {
    let words = match &content {
        Content::Text(inner) => {
            // Within a string without escapes each word has its own place.
            let offset = text.get(at.clone()).and_then(|quoted| quoted.find(inner.as_str()));
            Some(lex(inner, |r| match offset {
                Some(offset) => at.start + offset + r.start..at.start + offset + r.end,
                None => at.clone(),
            }))
        }
        _ => None,
    };
    Node { at, kind: Some(kind), words, content }
}

fn value_node(text: &str, value: &Spanned<DeValue<'_>>) -> Node<Range<usize>> {
    let at = value.span();
    let number = |digits: &str| Node {
        at: at.clone(),
        kind: Some("a number"),
        words: Some(lex(digits, |_| at.clone())),
        content: Content::Cell,
    };
    let (kind, content) = match value.get_ref() {
        DeValue::String(inner) => ("a string", Content::Text(inner.clone().into_owned())),
        DeValue::Integer(n) if n.radix() == 10 => return number(n.as_str()),
        DeValue::Float(x) => return number(x.as_str()),
        DeValue::Integer(_) => ("a number", Content::Cell),
        DeValue::Boolean(_) => ("a truth value", Content::Cell),
        DeValue::Datetime(_) => ("a date", Content::Cell),
        DeValue::Array(entries) => {
            let entries = entries.iter().map(|entry| value_node(text, entry));
            ("an array", Content::List(entries.collect()))
        }
        DeValue::Table(inner) => ("a table", table(text, inner)),
    };
    node(text, at, kind, content)
}

/// Tells an effect the lines in which its entries stand.
fn number_lines(text: &str, effect: &mut Effect) {
    let Effect { at, id, place, numbers } = effect;
    let entries = numbers.iter_mut().map(|number| &mut number.at);
    for spot in [at, &mut id.at, &mut place.at].into_iter().chain(entries) {
        let before = text.get(..spot.span.start).unwrap_or_default();
        spot.line = before.matches('\n').count() + 1;
    }
}
