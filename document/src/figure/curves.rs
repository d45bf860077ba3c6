//! The findings of a diagnosis that are a function of one thing, as curves.

use stiffarm_gap::Measurements;
use stiffarm_gap::diagnose::{Diagnosis, Finding};
use stiffarm_gap::effects::{Catalogue, Place};
use stiffarm_gap::measurement::Row;

use super::shape::Shaped;
use crate::words::named;

/// The curves of all findings that have one. Of a displacement only what is in proportion to the load
/// is a function of one state.
pub fn curves<'a>(
    found: &'a Diagnosis,
    data: &Measurements,
    catalogue: &Catalogue,
) -> Vec<Shaped<'a>> {
    let displaced = data.kind.is_difference();
    // A joint's part of a reading is told only where the thing that is read is known.
    let is_unknown = |row: &Row| row.aim.as_ref().is_some_and(|aim| !aim.free.is_empty());
    if data.rows.iter().any(is_unknown) {
        return Vec::new();
    }
    let curve = |finding: &'a Finding| {
        let Ok(Place::Joint(joint)) = finding.place.parse() else { return None };
        let curve = catalogue.named(&finding.effect)?.curve(&finding.parameters)?;
        let title = named(&finding.effect, &finding.place);
        (curve.proportional || !displaced).then(|| Shaped { title, joint: joint - 1, curve })
    };
    found.findings.iter().filter_map(curve).collect()
}
