//! What was found about a printed equation or a cell of a printed table.

use serde::{Serialize, Serializer};

/// The finding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Printed and derived are the same, exactly.
    Agrees,
    /// They agree at many random points; there is no exact form to compare.
    AgreesAtPoints,
    /// They differ.
    Misprint,
    /// There is nothing that could be wrong.
    #[default]
    Definition,
    /// The printed formula cannot be read, and no small change makes it readable and true.
    Unreadable,
    /// What it should be could not be derived.
    NotJudged,
    /// A cell: right to the last printed digit.
    Reproduced,
    /// A cell: within one unit of the last printed digit.
    Close,
    /// A cell: not met.
    #[serde(rename = "not_reproducible")]
    NotReproduced,
    /// A cell: given, not computed.
    Given,
}

impl Verdict {
    /// Every verdict, and it in words.
    pub const EACH: [(Verdict, &'static str); 10] = [
        (Verdict::Agrees, "agrees"),
        (Verdict::AgreesAtPoints, "agrees at random points"),
        (Verdict::Misprint, "misprint"),
        (Verdict::Definition, "definition"),
        (Verdict::Unreadable, "cannot be read"),
        (Verdict::NotJudged, "not judged"),
        (Verdict::Reproduced, "reproduced"),
        (Verdict::Close, "within one unit of the last digit"),
        (Verdict::NotReproduced, "not reproducible"),
        (Verdict::Given, "given"),
    ];

    /// In words.
    pub fn words(self) -> &'static str {
        Self::EACH[self as usize].1
    }
}

/// A joint vector at which printed and derived differ, and both values there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Witness {
    /// Angles in degrees, by their names.
    #[serde(rename = "degrees", serialize_with = "map")]
    pub angles: Vec<(String, f64)>,
    /// Values of the other symbols.
    #[serde(serialize_with = "map")]
    pub symbols: Vec<(String, f64)>,
    /// What is printed gives this.
    pub printed: f64,
    /// What is derived gives this.
    pub derived: f64,
}

/// Equation or cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A printed equation.
    #[default]
    Equation,
    /// A cell of a printed table.
    Cell,
}

/// A line of the ledger.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Entry {
    /// Short name of the paper.
    pub paper: String,
    /// The paper's number of the equation, or table, row and column.
    pub number: String,
    /// Equation or cell.
    pub kind: Kind,
    /// As printed.
    pub printed: String,
    /// The finding.
    pub verdict: Verdict,
    /// What it should be, in the paper's own notation; the computed value of a cell.
    pub correction: Option<String>,
    /// The smallest change that was found to mend it.
    pub change: Option<String>,
    /// What it was compared with.
    #[serde(serialize_with = "text")]
    pub source: String,
    /// A remark, or why a cell cannot be reproduced.
    pub note: Option<String>,
    /// A joint vector that tells the two apart.
    pub witness: Option<Witness>,
}

impl Entry {
    /// An entry without a finding.
    pub fn new(paper: &str, number: &str, kind: Kind, printed: &str) -> Self {
        Entry {
            paper: paper.to_owned(),
            number: number.to_owned(),
            kind,
            printed: printed.to_owned(),
            ..Entry::default()
        }
    }

    /// Leaves it unjudged, and says why.
    pub(crate) fn not_judged(&mut self, why: String) {
        (self.verdict, self.note) = (Verdict::NotJudged, Some(why));
    }
}

/// Names and values as an object.
fn map<S: Serializer>(values: &[(String, f64)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(values.iter().map(|(name, value)| (name, value)))
}

/// Text, or null where there is none.
fn text<S: Serializer>(text: &str, to: S) -> Result<S::Ok, S::Error> {
    Some(text).filter(|text| !text.is_empty()).serialize(to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_verdict_has_its_own_words() {
        for (k, (verdict, _)) in Verdict::EACH.iter().enumerate() {
            assert_eq!(*verdict as usize, k);
        }
    }
}
