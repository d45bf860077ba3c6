//! The arm with what a log has shown, as a robot file and as simulators read it.

use stiffarm_codegen::robot::Robot;
use stiffarm_gap::log::corrected::{Corrected, corrected};
use stiffarm_gap::log::report::{Finding, Parameter};
use stiffarm_gap::log::{Log, LogDiagnosis, Model};
use stiffarm_kernels::generic::Arm;

use super::super::Args;
use super::super::corrected::{Format, comment, exported};
use crate::input::source::Source;
use crate::terminal::failure::Failure;
use crate::terminal::note::note;

/// A robot with what was found in it, and the robot file's text.
pub struct Written {
    corrected: Corrected,
    /// The robot file.
    pub text: String,
}

impl Written {
    /// Of a diagnosis.
    ///
    /// # Errors
    /// [`Failure`]: the log tells no newton-metres.
    pub fn of(
        source: &Source,
        arm: &Arm,
        log: &Log,
        found: &LogDiagnosis,
        model: &Model,
    ) -> Result<Written, Failure> {
        let mut robot: Robot = source.robot.clone();
        robot.effects.extend(source.motion.iter().cloned());
        let corrected = corrected(&robot, arm, log, found, model)
            .map_err(|error| Failure::new(format!("{}: {error}", found.files.join(", "))))?;
        let mut lines = vec![
            format!(
                "Corrected by stiffarm {} from {}, diagnosed with {}.",
                found.stiffarm,
                source.given,
                found.files.join(", ")
            ),
            String::new(),
            "Put in, with 95 % intervals:".to_owned(),
        ];
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
        let head: String = lines.iter().map(|line| comment(line)).collect();
        let text = format!("{head}\n{}", corrected.robot.to_toml());
        Ok(Written { corrected, text })
    }

    /// As another program reads it, and a sentence on what it has no place for.
    ///
    /// # Errors
    /// [`Failure`] if the table has cells that are no numbers.
    pub fn exported(&self, format: Format) -> Result<(String, Option<String>), Failure> {
        exported(&self.corrected.robot, format)
    }

    /// Writes what is asked for, and says what another program's file has no place for.
    ///
    /// # Errors
    /// [`Failure`]: a file that cannot be written.
    pub fn write(&self, args: &Args, quiet: bool) -> Result<(), Failure> {
        if let Some(target) = &args.write_robot {
            target.write(&self.text)?;
        }
        for (target, format) in [(&args.write_urdf, Format::Urdf), (&args.write_mjcf, Format::Mjcf)]
        {
            if let Some(target) = target {
                let (text, lost) = self.exported(format)?;
                target.write(&text)?;
                lost.iter().for_each(|lost| note(lost, quiet));
            }
        }
        Ok(())
    }
}

fn told<'a>(finding: &'a Finding, entry: &'a str) -> impl Iterator<Item = String> + 'a {
    finding.parameters.iter().map(move |Parameter { name, value, unit, ci95 }| {
        let [low, high] = ci95;
        format!(
            "  {} at {}: {name} {value:.6e} {unit} [{low:.3e} to {high:.3e}], in {entry}",
            finding.effect, finding.place
        )
    })
}
