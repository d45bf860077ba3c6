//! What a diagnosis says, as far as it is held against the truth.

use serde::Serialize;

use super::report::Named;
use crate::diagnose::Diagnosis;

/// A diagnosis in short.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Of each finding, in the order in which they were added: itself, then the alternatives that
    /// the data cannot tell from it.
    pub sets: Vec<Vec<Named>>,
    /// Whether something is left that no effect explains.
    pub unexplained: bool,
    /// Where that lies, largest share first.
    pub unexplained_places: Vec<String>,
    /// The held-out gap with the findings: position rms, m.
    pub after_position: f64,
    /// The same in rotation, rad.
    pub after_rotation: f64,
    /// How far the gap is predicted to shrink, with its 95 % interval: of a lone finding.
    pub shrink: Option<[f64; 3]>,
}

impl Verdict {
    /// Of a diagnosis.
    pub fn of(found: &Diagnosis) -> Verdict {
        let shrink = match found.findings.as_slice() {
            [only] => only.held_out.shrink().map(|held| {
                let [low, high] = held.shrink_ci95;
                [held.shrink, low, high]
            }),
            _ => None,
        };
        Verdict {
            sets: found.findings.iter().map(Named::set).collect(),
            unexplained: found.unexplained.present,
            unexplained_places: found.unexplained.places.iter().map(|s| s.place.clone()).collect(),
            after_position: found.gap.after.position_rms,
            after_rotation: found.gap.after.rotation_rms,
            shrink,
        }
    }
}
