//! How the diagnosis was made, with what it was given.

use stiffarm_gap::diagnose::Nuisance;

use super::Campaign;
use crate::report::Method;
use crate::words::noise_from;

/// What every diagnosis does.
const METHOD: &str = "\
The error is what was measured minus what the robot file's model predicts at static equilibrium under \
the row's load and the links' weight. Unknown frames are co-estimated with everything. Each effect of the \
dictionary, at each place, is linearized; the candidate with the most evidence is added if it is significant \
with the number of candidates taken into account, and if it reduces the error on held-out poses. All effects are \
then refitted together, exactly, each as a true displacement at its place; those that have become superfluous are \
removed. Intervals of the error come from resampling poses with all their rows, those of parameters from least \
squares and Student’s t, or from the jackknife over visits where that is wider. Every candidate is tried in \
place of each finding; those that resampling the poses does not separate from it are named. The residuals are \
tested for structure with free-form displacements at every place.";

/// How this one was made.
pub fn method(report: &Campaign<'_>) -> Method {
    Method { text: METHOD, facts: facts(report), lists: &["nuisances", "cannot_see"] }
}

/// Names and values of what the diagnosis was given.
fn facts(report: &Campaign<'_>) -> Vec<(&'static str, String)> {
    let (found, data, options) = (report.found, report.data, report.options);
    let folds = if found.held_out.folds == data.poses {
        format!("{}: each {} in turn", found.held_out.folds, found.held_out.grouped_by)
    } else {
        format!("{}, grouped by {}", found.held_out.folds, found.held_out.grouped_by)
    };
    let mut sizes = Vec::new();
    if report.units().positions {
        let from = found.gap.noise.position_from.as_deref().map_or("", noise_from);
        sizes.push(format!("{} {from}", report.length().with_unit(found.gap.noise.position_rms)));
    }
    if data.kind.components()[3..].contains(&true) {
        let from = found.gap.noise.rotation_from.as_deref().map_or("", noise_from);
        sizes.push(format!("{} {from}", report.angle().with_unit(found.gap.noise.rotation_rms)));
    }
    // A camera makes its frames unknown, whatever was asked for.
    let is_fitted = |frame: &Nuisance| found.nuisances.iter().any(|n| n.name == frame.identifier());
    let nuisances: Vec<&str> =
        Nuisance::ALL.into_iter().filter(is_fitted).map(Nuisance::identifier).collect();
    let named = |names: &[String], none: &str| match names {
        [] => none.to_owned(),
        names => names.join(", "),
    };
    let simulator = match data.sim_given.contains(&true) {
        true => "the file’s sim_ columns",
        false => "stiffarm’s model of the robot file",
    };
    vec![
        ("stiffarm", found.stiffarm.clone()),
        (
            "date",
            report
                .made
                .date
                .as_ref()
                .map_or_else(String::new, |(what, day)| format!("{what} {day}")),
        ),
        ("command", report.made.command.clone()),
        ("SHA-256 of the measurements", report.made.hashes.data_sha256.clone()),
        ("SHA-256 of the robot file", report.made.hashes.robot_sha256.clone()),
        ("robot", found.robot.clone()),
        ("measurements", data.file.clone()),
        ("rows", found.measurements.to_string()),
        ("poses", data.poses.to_string()),
        ("simulator", simulator.to_owned()),
        ("folds", folds),
        ("seed", options.seed.to_string()),
        ("noise, rms", sizes.join(", ")),
        ("co-estimated", if nuisances.is_empty() { "none".into() } else { nuisances.join(", ") }),
        ("effects tried", named(options.effects.as_deref().unwrap_or_default(), "all")),
        ("compared with", named(&options.rivals, "no other model")),
    ]
}
