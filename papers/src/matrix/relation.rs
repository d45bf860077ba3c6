//! A printed relation between matrices, as its data file gives it.

use crate::latex::formula::Piece;

/// A relation between matrices: what its symbols stand for, and what it is compared with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Relation {
    /// Symbols as printed, and what they stand for.
    pub matrices: Vec<(String, Piece)>,
    /// The value of the left side, or a condition on it; without one the printed left side itself.
    pub truth: Option<Piece>,
}

impl Relation {
    /// What it is compared with, in words.
    pub fn words(&self) -> String {
        let truth = self.truth.iter().map(|truth| truth.text.clone());
        let each =
            self.matrices.iter().map(|(symbol, source)| match source.text.strip_prefix('=') {
                Some(formula) => format!("{symbol} = {}", formula.trim()),
                None => format!("{symbol} is {}", source.text),
            });
        truth.chain(each).collect::<Vec<_>>().join(", ")
    }
}
