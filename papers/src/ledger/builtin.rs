//! The data files of the five papers that come with stiffarm.

use stiffarm_codegen::robot::FileError;

use crate::file::{Paper, read};

/// The data files, by their paths in the repository.
const FILES: &[(&str, &str)] = &[
    ("papers/data/dumas2011/equations.toml", include_str!("../../data/dumas2011/equations.toml")),
    (
        "papers/data/dumas2011/tables/tables.toml",
        include_str!("../../data/dumas2011/tables/tables.toml"),
    ),
    (
        "papers/data/dumas2011/tables/text.toml",
        include_str!("../../data/dumas2011/tables/text.toml"),
    ),
    ("papers/data/knapczyk/equations.toml", include_str!("../../data/knapczyk/equations.toml")),
    (
        "papers/data/knapczyk/tables/example.toml",
        include_str!("../../data/knapczyk/tables/example.toml"),
    ),
    ("papers/data/lin1991/equations.toml", include_str!("../../data/lin1991/equations.toml")),
    ("papers/data/lin1991/tables/elbow.toml", include_str!("../../data/lin1991/tables/elbow.toml")),
    ("papers/data/lin1991/tables/one.toml", include_str!("../../data/lin1991/tables/one.toml")),
    ("papers/data/lin1991/tables/three.toml", include_str!("../../data/lin1991/tables/three.toml")),
    ("papers/data/lin1991/tables/two.toml", include_str!("../../data/lin1991/tables/two.toml")),
    ("papers/data/jweeg2012/equations.toml", include_str!("../../data/jweeg2012/equations.toml")),
    (
        "papers/data/jweeg2012/tables/numbers.toml",
        include_str!("../../data/jweeg2012/tables/numbers.toml"),
    ),
    ("papers/data/bicchi/equations.toml", include_str!("../../data/bicchi/equations.toml")),
    ("papers/data/bicchi/tables/cases.toml", include_str!("../../data/bicchi/tables/cases.toml")),
];

/// The five papers that stiffarm was built on.
///
/// # Errors
/// Never for the files of this package, which its tests read.
pub fn built_in() -> Result<Vec<Paper>, FileError> {
    FILES.iter().map(|(path, text)| read(text, path)).collect()
}
