//! The five papers that come with stiffarm.

use super::file::{Paper, read};
use super::ledger::Ledger;
use crate::robot::FileError;

/// The data files, by their paths in the repository.
pub const FILES: &[(&str, &str)] = &[
    (
        "tests/papers/dumas2011/equations.toml",
        include_str!("../../../tests/papers/dumas2011/equations.toml"),
    ),
    (
        "tests/papers/dumas2011/tables/tables.toml",
        include_str!("../../../tests/papers/dumas2011/tables/tables.toml"),
    ),
    (
        "tests/papers/knapczyk/equations.toml",
        include_str!("../../../tests/papers/knapczyk/equations.toml"),
    ),
    (
        "tests/papers/knapczyk/tables/example.toml",
        include_str!("../../../tests/papers/knapczyk/tables/example.toml"),
    ),
    (
        "tests/papers/lin1991/equations.toml",
        include_str!("../../../tests/papers/lin1991/equations.toml"),
    ),
    (
        "tests/papers/lin1991/tables/elbow.toml",
        include_str!("../../../tests/papers/lin1991/tables/elbow.toml"),
    ),
    (
        "tests/papers/lin1991/tables/one.toml",
        include_str!("../../../tests/papers/lin1991/tables/one.toml"),
    ),
    (
        "tests/papers/lin1991/tables/three.toml",
        include_str!("../../../tests/papers/lin1991/tables/three.toml"),
    ),
    (
        "tests/papers/lin1991/tables/two.toml",
        include_str!("../../../tests/papers/lin1991/tables/two.toml"),
    ),
    (
        "tests/papers/jweeg2012/equations.toml",
        include_str!("../../../tests/papers/jweeg2012/equations.toml"),
    ),
    (
        "tests/papers/jweeg2012/tables/numbers.toml",
        include_str!("../../../tests/papers/jweeg2012/tables/numbers.toml"),
    ),
    (
        "tests/papers/bicchi/equations.toml",
        include_str!("../../../tests/papers/bicchi/equations.toml"),
    ),
    (
        "tests/papers/bicchi/tables/cases.toml",
        include_str!("../../../tests/papers/bicchi/tables/cases.toml"),
    ),
];

/// Reads the built-in data files.
///
/// # Errors
/// A mistake in one of them.
pub fn papers() -> Result<Vec<Paper>, FileError> {
    FILES.iter().map(|(path, text)| read(text, path)).collect()
}

/// The ledger of the five papers.
///
/// # Errors
/// A mistake in a data file.
pub fn ledger() -> Result<Ledger, FileError> {
    Ok(Ledger::of(&papers()?))
}
