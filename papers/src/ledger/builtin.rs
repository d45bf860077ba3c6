//! The data files of the five papers that come with stiffarm.

use stiffarm_codegen::robot::FileError;

use crate::file::{Paper, read};

/// Data files with their paths in the repository.
macro_rules! files {
    ($($path:literal),* $(,)?) => {
        &[$((concat!("papers/data/", $path), include_str!(concat!("../../data/", $path)))),*]
    };
}

const FILES: &[(&str, &str)] = files![
    "dumas2011/equations.toml",
    "dumas2011/tables/tables.toml",
    "dumas2011/tables/text.toml",
    "knapczyk/equations.toml",
    "knapczyk/tables/example.toml",
    "lin1991/equations.toml",
    "lin1991/tables/elbow.toml",
    "lin1991/tables/one.toml",
    "lin1991/tables/three.toml",
    "lin1991/tables/two.toml",
    "jweeg2012/equations.toml",
    "jweeg2012/tables/numbers.toml",
    "bicchi/equations.toml",
    "bicchi/tables/cases.toml",
];

/// The five papers that stiffarm was built on.
///
/// # Errors
/// Never for the files of this package, which its tests read.
pub fn built_in() -> Result<Vec<Paper>, FileError> {
    FILES.iter().map(|(path, text)| read(text, path)).collect()
}
