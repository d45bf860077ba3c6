//! Reads single values; what does not fit is reported at its place and leaves nothing.

use super::node::{Content, Node};
use crate::robot::lexeme::{Lexeme, show};
use crate::robot::names::plain;
use crate::robot::problem::{Place, Problem, Report};
use crate::robot::suggest::advice;
use crate::robot::{Angle, Dimension, Motion, Value, angle, quantity};

/// m. Products of six lengths, as a diagnosis makes them, are numbers still.
const LONGEST: f64 = 1e50;

/// The language of the input, which decides some words of its messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Language {
    /// A robot file.
    File,
    /// The macro's tokens.
    #[cfg_attr(not(feature = "macro"), allow(dead_code))]
    Macro,
}

/// A parameter that stands in a cell.
pub(crate) struct Use<L> {
    pub name: String,
    pub dimension: Dimension,
    pub at: L,
}

/// What has been read so far besides the model: mistakes, and the parameters in their order.
pub(crate) struct Reader<'r, L> {
    pub language: Language,
    pub report: &'r mut Report<L>,
    pub uses: Vec<Use<L>>,
    /// How the joint moves whose table is being read; `None` where that could not be read.
    pub motion: Option<Motion>,
    /// The labels of the joints.
    pub labels: Vec<String>,
    /// The arm's lengths that stand without a unit: as written, m, and where.
    pub lengths: Vec<(String, f64, L)>,
}

/// What a cell is to hold.
#[derive(Clone, Copy)]
pub(crate) struct Expected {
    /// What it measures.
    pub dimension: Dimension,
    /// Why no parameter may stand there; `None` if one may.
    pub number: Option<&'static str>,
}

impl<'r, L: Place> Reader<'r, L> {
    /// A reader of a language.
    pub fn new(language: Language, report: &'r mut Report<L>) -> Self {
        let (uses, labels, lengths) = (Vec::new(), Vec::new(), Vec::new());
        Reader { language, report, uses, motion: None, labels, lengths }
    }

    /// Reports a mistake with its advice.
    pub fn refuse(&mut self, at: &L, message: impl Into<String>, help: impl Into<String>) {
        let (problem, help) = (Problem::new(at.clone(), message), help.into());
        self.report.error(if help.is_empty() { problem } else { problem.help(help) });
    }

    /// Reports that something else is expected, unless the value has been reported.
    pub fn expected(&mut self, node: &Node<L>, expected: &str) {
        let message = match node.kind {
            _ if node.is_broken() => return,
            Some(found) => format!("{found} stands where {expected} is expected"),
            None => format!("{expected} is expected here"),
        };
        self.refuse(&node.at, message, "");
    }

    /// A text of one line.
    pub fn text(&mut self, node: &Node<L>) -> Option<String> {
        let text = self.word(node)?;
        plain(&text, &node.at, self.report);
        Some(text)
    }

    /// A text whose words are then looked up.
    pub fn word(&mut self, node: &Node<L>) -> Option<String> {
        if let Content::Text(text) = &node.content {
            return Some(text.clone());
        }
        self.expected(
            node,
            match self.language {
                Language::File => "a string",
                Language::Macro => "a text in quotes",
            },
        );
        None
    }

    /// One of a few words.
    pub fn choice<T: Copy>(&mut self, node: &Node<L>, choices: &[(&str, T)]) -> Option<T> {
        let found = self.word(node)?;
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let choice = choices.iter().find(|(word, _)| *word == found).map(|(_, choice)| *choice);
        if choice.is_none() {
            let message = format!("`{found}` stands where one of {} is expected", words.join(", "));
            self.refuse(&node.at, message, advice(&found, &words));
        }
        choice
    }

    /// The words of a number or a quantity.
    fn words<'n>(&mut self, node: &'n Node<L>, expected: Dimension) -> Option<&'n [Lexeme<L>]> {
        match (&node.words, node.kind) {
            (Some(words), _) => return Some(words),
            (None, Some("a number")) => {
                self.refuse(&node.at, "a decimal number is expected here", "");
            }
            _ => self.expected(node, &format!("{expected} (e.g. `{}`)", expected.example())),
        }
        None
    }

    /// A quantity or a parameter.
    pub fn value(&mut self, node: &Node<L>, expected: Expected) -> Option<Value> {
        let words = self.words(node, expected.dimension)?;
        let value = self.report.keep(quantity::read(words, expected.dimension, &node.at))?;
        match &value {
            Value::Symbol(name) => self.parameter(name, node, expected).then_some(value),
            Value::Number(number)
                if expected.dimension == Dimension::Length && number.to_f64().abs() > LONGEST =>
            {
                let message = format!("`{}` is longer than any arm", show(words));
                self.refuse(&node.at, message, "mend the exponent");
                None
            }
            Value::Number(number) => {
                let own = expected.dimension == Dimension::Length && expected.number.is_none();
                if own && words.iter().all(|word| word.name().is_none()) {
                    self.lengths.push((show(words), number.to_f64().abs(), node.at.clone()));
                }
                Some(value)
            }
        }
    }

    /// An angle or a parameter.
    pub fn angle(&mut self, node: &Node<L>, expected: Expected) -> Option<Angle> {
        self.angle_if(node, expected, |read| read)
    }

    /// An angle or a parameter, after a look at the doubt about it.
    fn angle_if(
        &mut self,
        node: &Node<L>,
        expected: Expected,
        look: fn(angle::Doubted<L>) -> angle::Doubted<L>,
    ) -> Option<Angle> {
        let words = self.words(node, expected.dimension)?;
        let read = self.report.keep(angle::read(words, &node.at))?;
        let (angle, doubt) = look(read);
        doubt.into_iter().for_each(|doubt| self.report.warn(doubt));
        match &angle {
            Angle::Symbol(name) => self.parameter(name, node, expected).then_some(angle),
            _ => Some(angle),
        }
    }

    /// Notes a parameter; `false` where only a number will do, which is reported.
    fn parameter(&mut self, name: &str, node: &Node<L>, expected: Expected) -> bool {
        let Some(reason) = expected.number else {
            let Expected { dimension, .. } = expected;
            self.uses.push(Use { name: name.to_owned(), dimension, at: node.at.clone() });
            return true;
        };
        self.refuse(&node.at, format!("`{name}` stands where a number is expected"), reason);
        false
    }

    /// A list of exactly `N` entries.
    pub fn list<'n, const N: usize>(
        &mut self,
        node: &'n Node<L>,
        expected: &str,
    ) -> Option<&'n [Node<L>; N]> {
        let Some(entries) = node.list() else {
            self.expected(node, expected);
            return None;
        };
        let read = entries.try_into().ok();
        if read.is_none() {
            let list = match self.language {
                Language::File => "an array",
                Language::Macro => "a list",
            };
            let found = entries.len();
            let message = format!("{list} of {found} where {expected} is expected");
            self.refuse(&node.at, message, "");
        }
        read
    }

    /// Quantities of one dimension.
    pub fn values<const N: usize>(
        &mut self,
        node: &Node<L>,
        list: &str,
        expected: Expected,
    ) -> Option<[Value; N]> {
        let entries = self.list::<N>(node, list)?;
        whole(entries.each_ref().map(|entry| self.value(entry, expected)))
    }

    /// A rotation vector.
    pub fn rotation(&mut self, node: &Node<L>, expected: Expected) -> Option<[Angle; 3]> {
        let entries = self.list::<3>(node, "a rotation vector [rx, ry, rz]")?;
        whole(entries.each_ref().map(|entry| self.angle(entry, expected)))
    }

    /// Joint limits, in radians or metres.
    pub fn limits(&mut self, node: &Node<L>, expected: Expected) -> Option<[f64; 2]> {
        let entries = self.list::<2>(node, "[lower, upper]")?;
        let [lower, upper] = whole(entries.each_ref().map(|entry| match expected.dimension {
            Dimension::Angle => self.angle_if(entry, expected, angle::limit_doubt)?.radians(),
            _ => Some(self.value(entry, expected)?.number()?.to_f64()),
        }))?;
        if lower >= upper {
            let message =
                format!("the lower limit {lower:?} is not below the upper limit {upper:?}");
            self.refuse(&node.at, message, "");
        }
        Some([lower, upper])
    }
}

/// All entries, if all could be read.
fn whole<T, const N: usize>(entries: [Option<T>; N]) -> Option<[T; N]> {
    let whole: Option<Vec<T>> = entries.into_iter().collect();
    whole?.try_into().ok()
}
