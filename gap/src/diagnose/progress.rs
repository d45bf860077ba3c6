//! How far a diagnosis is.

/// How far a diagnosis is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Simulating the rows and fitting the unknown frames.
    Align,
    /// Looking for effects, with so many found.
    Search(usize),
    /// Judging so many findings.
    Judge(usize),
}
