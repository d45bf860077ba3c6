//! Reads single TOML values into cells; what does not fit is reported and leaves a broken cell.

use core::ops::Range;

use ::toml::Spanned;
use ::toml::de::{DeArray, DeValue};

use super::super::dimension::Dimension;
use super::super::draft::JointName;
use super::super::draft::{Cell, INERTIA, Vector, broken};
use super::super::frames::Asked;
use super::super::lexeme::{Lexeme, lex};
use super::super::model::{Angle, Motion, Spot, Value};
use super::super::problem::{Problem, Report};
use super::super::suggest::advice;
use super::super::symbols::Symbolic;
use super::super::{angle, quantity};

type At = Range<usize>;
type Node<'i> = Spanned<DeValue<'i>>;

/// The file's text and what has been found wrong in it.
pub(super) struct Reader<'a> {
    text: &'a str,
    /// All that has been found so far.
    pub report: Report<At>,
}

/// What a value is, in words.
pub(super) fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "a truth value",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "an array",
        DeValue::Table(_) => "a table",
    }
}

impl<'a> Reader<'a> {
    /// A reader of this text.
    pub fn new(text: &'a str) -> Self {
        Reader { text, report: Report::new() }
    }

    /// The place of some bytes.
    pub fn spot(&self, span: At) -> Spot {
        let before = self.text.get(..span.start).unwrap_or_default();
        Spot { line: before.matches('\n').count() + 1, span }
    }

    /// Reports that another kind of value is expected.
    fn expected(&mut self, value: &Node<'_>, expected: &str) {
        let message = format!("{} stands where {expected} is expected", kind(value.get_ref()));
        self.report.error(Problem::new(value.span(), message));
    }

    /// A string.
    pub fn string(&mut self, value: &Node<'_>) -> Cell<String, At> {
        let at = value.span();
        match value.get_ref() {
            DeValue::String(text) => Cell::new(text.clone().into_owned(), at),
            _ => {
                self.expected(value, "a string");
                Cell::broken(at)
            }
        }
    }

    /// One of a few words.
    pub fn choice<T: Copy>(
        &mut self,
        value: &Node<'_>,
        choices: &[(&'static str, T)],
    ) -> Cell<T, At> {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let Cell { value: Some(found), at } = self.string(value) else {
            return Cell::broken(value.span());
        };
        if let Some((_, choice)) = choices.iter().find(|(word, _)| *word == found) {
            return Cell::new(*choice, at);
        }
        let message = format!("`{found}` stands where one of {} is expected", words.join(", "));
        self.report.error(Problem::new(at.clone(), message).help(advice(&found, &words)));
        Cell::broken(at)
    }

    /// The words of a number or of a quoted cell.
    fn words(&mut self, value: &Node<'_>, expected: Dimension) -> Option<Vec<Lexeme<At>>> {
        let at = value.span();
        match value.get_ref() {
            DeValue::String(text) => {
                // Within a string without escapes each word has its own place.
                let inner = self.text.get(at.clone()).and_then(|s| s.find(text.as_ref()));
                Some(lex(text, |r| match inner {
                    Some(offset) => at.start + offset + r.start..at.start + offset + r.end,
                    None => at.clone(),
                }))
            }
            DeValue::Integer(n) if n.radix() == 10 => Some(lex(n.as_str(), |_| at.clone())),
            DeValue::Integer(_) => {
                self.report.error(Problem::new(at, "a decimal number is expected here"));
                None
            }
            DeValue::Float(x) => Some(lex(x.as_str(), |_| at.clone())),
            _ => {
                let example = expected.example();
                self.expected(value, &format!("{expected} (e.g. `{example}`)"));
                None
            }
        }
    }

    /// A quantity or a parameter.
    pub fn value(&mut self, value: &Node<'_>, expected: Dimension) -> Cell<Value, At> {
        let at = value.span();
        let Some(words) = self.words(value, expected) else { return Cell::broken(at) };
        let read = quantity::read(&words, expected, &at);
        Cell { value: self.report.keep(read), at }
    }

    /// An angle or a parameter.
    pub fn angle(&mut self, value: &Node<'_>) -> Cell<Angle, At> {
        self.angle_if(value, |read| read)
    }

    /// An angle or a parameter, after a look at the doubt about it.
    fn angle_if(
        &mut self,
        value: &Node<'_>,
        look: impl Fn(angle::Doubted<At>) -> angle::Doubted<At>,
    ) -> Cell<Angle, At> {
        let at = value.span();
        let Some(words) = self.words(value, Dimension::Angle) else { return Cell::broken(at) };
        let read = self.report.keep(angle::read(&words, &at)).map(look);
        let read = read.map(|(angle, doubt)| {
            doubt.into_iter().for_each(|d| self.report.warn(d));
            angle
        });
        Cell { value: read, at }
    }

    /// The cell, unless it is a parameter where only a number will do.
    fn known<T: Symbolic>(&mut self, cell: Cell<T, At>, reason: &str) -> Cell<T, At> {
        let Some(name) = cell.value.as_ref().and_then(Symbolic::symbol) else { return cell };
        let message = format!("`{name}` stands where a number is expected");
        self.report.error(Problem::new(cell.at.clone(), message).help(reason));
        Cell::broken(cell.at)
    }

    /// A quantity that must be a number.
    pub fn number(
        &mut self,
        value: &Node<'_>,
        expected: Dimension,
        reason: &str,
    ) -> Cell<Value, At> {
        let cell = self.value(value, expected);
        self.known(cell, reason)
    }

    /// An array of exactly `N` entries.
    pub fn array<'v, 'i, const N: usize>(
        &mut self,
        value: &'v Node<'i>,
        expected: &str,
    ) -> Option<[&'v Node<'i>; N]> {
        let DeValue::Array(array) = value.get_ref() else {
            self.expected(value, expected);
            return None;
        };
        let entries: Vec<&Node<'i>> = array.iter().collect();
        let found = entries.len();
        entries.try_into().ok().or_else(|| {
            let message = format!("an array of {found} where {expected} is expected");
            self.report.error(Problem::new(value.span(), message));
            None
        })
    }

    /// Three quantities of one dimension.
    pub fn values(&mut self, value: &Node<'_>, dimension: Dimension) -> Vector<Value, At> {
        match self.array::<3>(value, "[x, y, z]") {
            Some(entries) => entries.map(|entry| self.value(entry, dimension)),
            None => broken(&value.span()),
        }
    }

    /// The six entries of a tensor of inertia.
    pub fn inertia(&mut self, value: &Node<'_>) -> [Cell<Value, At>; 6] {
        match self.array::<6>(value, INERTIA) {
            Some(entries) => entries.map(|entry| self.value(entry, Dimension::Inertia)),
            None => broken(&value.span()),
        }
    }

    /// The same, which must be numbers, and why.
    pub fn known_inertia(&mut self, value: &Node<'_>, reason: &str) -> [Cell<Value, At>; 6] {
        self.inertia(value).map(|cell| self.known(cell, reason))
    }

    /// Three lengths that must be numbers, and why.
    pub fn known_lengths(&mut self, value: &Node<'_>, reason: &str) -> Vector<Value, At> {
        let cells = self.values(value, Dimension::Length);
        cells.map(|cell| self.known(cell, reason))
    }

    /// A rotation vector, which must be numbers.
    pub fn rotation(&mut self, value: &Node<'_>) -> Vector<Angle, At> {
        match self.array::<3>(value, "a rotation vector [rx, ry, rz]") {
            Some(entries) => entries.map(|entry| {
                let cell = self.angle(entry);
                self.known(cell, "a frame's rotation cannot stay symbolic")
            }),
            None => broken(&value.span()),
        }
    }

    /// Joint limits, in radians or metres.
    pub fn limits(&mut self, value: &Node<'_>, motion: Motion) -> Cell<[f64; 2], At> {
        let at = value.span();
        let Some(entries) = self.array::<2>(value, "[lower, upper]") else {
            return Cell::broken(at);
        };
        let reason = "joint limits are numbers";
        let bounds = entries.map(|entry| match motion {
            Motion::Revolute => {
                let cell = self.angle_if(entry, angle::limit_doubt);
                self.known(cell, reason).value.as_ref().and_then(Angle::radians)
            }
            Motion::Prismatic => {
                let cell = self.number(entry, Dimension::Length, reason);
                cell.value.as_ref().and_then(Value::number).map(|n| n.to_f64())
            }
        });
        match bounds {
            [Some(lower), Some(upper)] => Cell::new([lower, upper], at),
            _ => Cell::broken(at),
        }
    }

    /// A joint by its number from 1 or by its name.
    pub fn joint(&mut self, value: &Node<'_>) -> Cell<JointName, At> {
        let at = value.span();
        if let DeValue::Integer(number) = value.get_ref() {
            let text = number.as_str();
            let told = usize::from_str_radix(text, number.radix());
            let told = told.map_or_else(|_| JointName::Label(text.to_owned()), JointName::Number);
            return Cell::new(told, at);
        }
        let Cell { value, at } = self.string(value);
        Cell { value: value.map(JointName::Label), at }
    }

    /// Names of outputs, one or more, each with the frame at which it is asked for.
    pub fn outputs(&mut self, value: &Node<'_>) -> Vec<Cell<Asked, At>> {
        let DeValue::Array(names) = value.get_ref() else {
            self.expected(value, "an array of outputs");
            return Vec::new();
        };
        if names.is_empty() {
            let problem = Problem::new(value.span(), "an array of no outputs");
            self.report.error(problem.help("leave `outputs` out for all of them"));
        }
        names.iter().map(|name| self.asked(name)).collect()
    }

    fn asked(&mut self, name: &Node<'_>) -> Cell<Asked, At> {
        let Cell { value, at } = self.string(name);
        let read = value.map(|text| Asked::read(&text)).transpose();
        let read = read.map_err(|no| Problem::new(at.clone(), no.message).help(no.help));
        Cell { value: self.report.keep(read).flatten(), at }
    }

    /// The tables of an array of tables; an error if it is something else.
    pub fn tables<'v, 'i>(
        &mut self,
        value: &'v Node<'i>,
        name: &str,
    ) -> impl Iterator<Item = &'v Node<'i>> + use<'v, 'i> {
        let array = match value.get_ref() {
            DeValue::Array(array) => Some(array),
            other => {
                let found = kind(other);
                let message = format!("{found} stands where [[{name}]] tables are expected");
                let problem = Problem::new(value.span(), message);
                let help = format!("write [[{name}]] with two brackets, once for each");
                self.report.error(problem.help(help));
                None
            }
        };
        array.into_iter().flat_map(|array: &DeArray<'i>| array[..].iter())
    }
}
