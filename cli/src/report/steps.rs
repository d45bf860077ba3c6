//! The steps of a diagnosis from the gap to the noise.

use stiffarm_gap::diagnose::Finding;

use super::Report;
use super::waterfall::Step;
use crate::screen::noise_from;

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
    steps.push(plain(&format!("noise, {}", noise_from(gap.noise.from)), "noise", noise));
    steps
}

/// What a finding takes away, with the interval of what it leaves.
fn taken(report: &Report<'_>, finding: &Finding) -> Step {
    let held = &finding.held_out;
    let [low, high] = held.shrink_ci95;
    let percent = |x: f64| format!("{:.0}", 100.0 * x).replacen('-', "−", 1);
    let unit = report.main_unit();
    Step {
        label: format!("{} at {}", finding.effect.replace('_', " "), finding.place),
        class: "removed",
        from: held.after.min(held.before),
        to: held.after.max(held.before),
        interval: Some([held.before * (1.0 - high), held.before * (1.0 - low)]),
        text: format!(
            "→ {}, {} % less [{} to {}]",
            unit.with_unit(held.after),
            percent(held.shrink),
            percent(low),
            percent(high)
        ),
    }
}
