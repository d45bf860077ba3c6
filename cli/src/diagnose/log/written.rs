//! The arm with what a log has shown, as a robot file and as simulators read it.

use stiffarm_codegen::robot::Robot;
use stiffarm_document::words::capital;
use stiffarm_gap::log::corrected::corrected;
use stiffarm_gap::log::{Log, LogDiagnosis, Model};
use stiffarm_gap::report::{Finding, Parameter};
use stiffarm_kernels::generic::Arm;

use super::super::corrected::{stands_in, without_own};
use crate::terminal::failure::Failure;

/// A robot with what was found in it, and what that is.
pub struct Written {
    pub robot: Robot,
    /// What was put in, line by line.
    pub lines: Vec<String>,
    /// A sentence on effects of one's own.
    pub lost: Option<String>,
}

impl Written {
    /// Of a diagnosis.
    pub fn of(
        robot: &Robot,
        arm: &Arm,
        log: &Log,
        found: &LogDiagnosis,
        model: &Model,
    ) -> Result<Written, Failure> {
        let mut corrected = corrected(robot, arm, log, found, model)
            .map_err(|error| Failure::new(format!("{}: {error}", found.files.join(", "))))?;
        let mut lines = vec!["Put in, with 95 % intervals:".to_owned()];
        let pairs = found.findings.iter().zip(&corrected.entries);
        lines.extend(pairs.flat_map(|(finding, entry)| told(finding, entry)));
        if found.findings.is_empty() {
            lines.push("  nothing".to_owned());
        }
        if let Some(part) = corrected.bodies {
            lines.push(format!(
                "Masses, centres and inertias are bodies whose torques are those fitted to the log within {:.2} % of \
                 their spread; what the motion does not tell of them is near to the file before.",
                100.0 * part
            ));
        }
        let lost = without_own(&mut corrected.robot);
        lines.extend(lost.as_ref().map(|lost| capital(lost) + "."));
        Ok(Written { robot: corrected.robot, lines, lost })
    }
}

fn told<'a>(finding: &'a Finding, entry: &'a str) -> impl Iterator<Item = String> + 'a {
    let entry = stands_in(&finding.effect, entry);
    finding.parameters.iter().map(move |Parameter { name, value, unit, ci95, .. }| {
        let [low, high] = ci95;
        format!(
            "  {} at {}: {name} {value:.6e} {unit} [{low:.3e} to {high:.3e}], in {entry}",
            finding.effect, finding.place
        )
    })
}
