//! Pass or fail: the corrected arm against a tolerance.

use stiffarm_document::beside::{Accepted, Check};
use stiffarm_gap::Diagnosis;
use stiffarm_gap::gap::Statistics;

use crate::terminal::failure::Failure;

/// Judges a diagnosis, by the check of another file where there is one.
pub fn judge(
    tolerance: f64,
    found: &Diagnosis,
    check: Option<&Check>,
    has_positions: bool,
) -> Result<Accepted, Failure> {
    if !has_positions {
        let text = "--accept: found no positions among what is measured, expected some";
        return Err(Failure::with_help(text, "a tolerance is a length"));
    }
    let (of, judged): (&str, Option<&Statistics>) = match check {
        Some(check) => (&check.file, check.after.as_ref()),
        None => ("held out", Some(&found.gap.after)),
    };
    let position_p95 = judged.map(|judged| judged.position_p95).ok_or_else(|| {
        Failure::with_help(
            format!("--accept: no row of {of} lies within the joint ranges and loads of the data"),
            "diagnose with data that reach as far",
        )
    })?;
    let accepted = position_p95 <= tolerance;
    Ok(Accepted { tolerance, position_p95, accepted, of: of.to_owned() })
}
