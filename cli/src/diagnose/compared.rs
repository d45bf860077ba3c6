//! This diagnosis against an earlier one of the same arm, in JSON.

use std::path::Path;

use stiffarm_document::beside::{Compared, Hashes, Last};
use stiffarm_gap::report::Diagnosis;

use crate::host::Host;
use crate::input::source;
use crate::terminal::failure::Failure;

/// Compares with the diagnosis in `file`.
pub fn with(
    file: &Path,
    found: &Diagnosis,
    now: &Hashes,
    host: &Host,
) -> Result<Compared, Failure> {
    let text = source::text(file, host)?;
    let name = file.display().to_string();
    let last: Last = serde_json::from_str(&text).map_err(|error| {
        Failure::with_help(
            format!("{name}: {error}: expected a diagnosis (JSON)"),
            "write one with stiffarm diagnose … --json",
        )
    })?;
    if last.report.robot != found.robot {
        return Err(Failure::new(format!(
            "{name}: found a diagnosis of `{}`, expected one of `{}`",
            last.report.robot, found.robot
        )));
    }
    Ok(Compared::with(name, last, found, now))
}
