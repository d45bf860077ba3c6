//! The steps of a diagnosis from the gap to the noise.

use stiffarm_gap::report::Finding;
use stiffarm_gap::shrink::Shrink;

use super::Report;
use super::waterfall::Step;
use crate::screen::{less, noise_from};

/// From the whole gap, finding by finding, to the noise.
pub fn steps(report: &Report<'_>) -> Vec<Step> {
    let gap = &report.found.gap;
    let main = |position: f64, rotation: f64| {
        if report.has_positions() { position } else { rotation }
    };
    let before = main(gap.before.position_rms, gap.before.rotation_rms);
    let after = main(gap.after.position_rms, gap.after.rotation_rms);
    let noise = main(gap.noise.position_rms, gap.noise.rotation_rms);
    let unit = report.main_unit();
    let plain = |label: &str, class, size: f64| Step {
        label: label.to_owned(),
        class,
        from: 0.0,
        to: size,
        interval: None,
        text: unit.with_unit(size),
    };
    let mut steps = vec![plain(report.found.before_is(), "whole", before)];
    steps.extend(report.found.findings.iter().map(|finding| taken(report, finding)));
    if !report.found.findings.is_empty() {
        steps.push(plain("left, held out", "left", after));
    }
    let anew = [("searched anew", &gap.nested), ("searched anew, in time", &gap.nested_in_time)];
    for (label, of) in anew {
        let size = of.as_ref().map(|gap| main(gap.position_rms, gap.rotation_rms));
        steps.extend(size.map(|size| plain(label, "left", size)));
    }
    steps.push(plain(&format!("noise, {}", noise_from(&gap.noise.from)), "noise", noise));
    steps
}

/// What a finding takes away, with the interval of what it leaves.
fn taken(report: &Report<'_>, finding: &Finding) -> Step {
    let held = &finding.held_out;
    let (before, after) = (held.before(), held.after());
    let less = held.shrink().map_or_else(String::new, |shrink| format!(", {}", less(shrink)));
    let unit = report.main_unit();
    Step {
        label: format!("{} at {}", finding.effect.replace('_', " "), finding.place),
        class: "removed",
        from: after.min(before),
        to: after.max(before),
        interval: held.shrink().map(Shrink::after_ci95),
        text: format!("→ {}{less}", unit.with_unit(after)),
    }
}
