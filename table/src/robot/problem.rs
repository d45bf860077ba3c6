//! What was found wrong, and where: the two readers share the words and differ in the place.

use core::ops::Range;

use super::model::Spot;

/// A place in the input: a byte range of a file, or a pair of token spans.
pub(crate) trait Place: Clone {
    /// From the start of this place to the end of the other.
    fn to(&self, end: &Self) -> Self;

    /// The same as the model keeps it: [`Spot`], whose line the reader of the file fills in.
    fn spot(&self) -> Spot;
}

impl Place for Range<usize> {
    fn to(&self, end: &Self) -> Self {
        self.start.min(end.start)..self.end.max(end.end)
    }

    fn spot(&self) -> Spot {
        Spot { span: self.clone(), line: 0 }
    }
}

/// One mistake: what was found and what was expected there.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem<L> {
    /// Where the mistake stands.
    pub at: L,
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it, where that is known.
    pub help: Option<String>,
    /// What made it, where one habit makes many: a file tells these once. Empty for a mistake of its own.
    pub cause: &'static str,
}

impl<L> Problem<L> {
    /// A mistake at a place.
    pub fn new(at: L, message: impl Into<String>) -> Self {
        Problem { at, message: message.into(), help: None, cause: "" }
    }

    /// The same mistake with advice.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// One of many mistakes of a habit.
    pub fn cause(self, cause: &'static str) -> Self {
        Problem { cause, ..self }
    }
}

/// All mistakes of one input, collected so that they are reported together.
#[derive(Clone, Debug)]
pub(crate) struct Report<L> {
    /// What makes the table unusable.
    pub errors: Vec<Problem<L>>,
    /// What is used as written but is probably not meant.
    pub warnings: Vec<Problem<L>>,
}

impl<L> Report<L> {
    /// An empty report.
    pub fn new() -> Self {
        Report { errors: Vec::new(), warnings: Vec::new() }
    }

    /// Adds an error.
    pub fn error(&mut self, problem: Problem<L>) {
        self.errors.push(problem);
    }

    /// Adds a warning.
    pub fn warn(&mut self, problem: Problem<L>) {
        self.warnings.push(problem);
    }

    /// The value of a result; its error goes into the report.
    pub fn keep<T>(&mut self, result: Result<T, Problem<L>>) -> Option<T> {
        result.map_err(|problem| self.error(problem)).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_keeps_values_and_collects_errors() {
        let mut report = Report::new();
        assert_eq!(report.keep(Ok::<_, Problem<Range<usize>>>(1)), Some(1));
        assert_eq!(report.keep::<i32>(Err(Problem::new(3..4, "no").help("yes"))), None);
        assert_eq!(report.errors, [Problem::new(3..4, "no").help("yes")]);
    }

    #[test]
    fn places_join() {
        assert_eq!((3..5).to(&(7..9)), 3..9);
    }
}
