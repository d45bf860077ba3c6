//! A finding: how far it closes the gap, how large it is, what else it could be.

use stiffarm_gap::diagnose::{Finding, ParameterReport};
use stiffarm_kernels::Motion;

use super::unit::{INCH, POUND};
use super::{MOST, Screen, more, words};
use crate::cli::text::{bad, bold, decimals, good, indented, minus, short, table};

impl Screen<'_> {
    pub(super) fn finding(&self, number: usize, finding: &Finding) -> String {
        let (held, shown) = (&finding.held_out, self.main());
        let [low, high] = held.shrink_ci95.map(|x| minus(format!("{:.0}", 100.0 * x)));
        let numbered =
            if self.found.findings.len() > 1 { format!(" {number}") } else { String::new() };
        let title = good(format!("{} at {}", words(finding.effect), finding.place));
        let mut text = format!("\n{}  {title}\n", bold(format!("Finding{numbered}")));
        let mut rows = vec![vec![
            "gap".to_owned(),
            format!("{} → {} rms", shown.number(held.before), shown.with_unit(held.after)),
            format!("{:.0} % less [{low} to {high}]", 100.0 * held.shrink),
            format!("p = {}", chance(finding.p_value)),
        ]];
        rows.extend(finding.parameters.iter().flat_map(|p| self.parameter(finding, p)));
        text.push_str(&indented(&table(&rows, &[]), 2));
        for other in finding.alternatives.iter().take(MOST) {
            let verdict = match other.separable {
                true => "worse, and this data tells them apart".to_owned(),
                false => bad("this data cannot tell them apart"),
            };
            text.push_str(&format!(
                "  instead: {} at {} leaves {}: {verdict}\n",
                words(other.effect),
                other.place,
                self.main().with_unit(other.held_out_after)
            ));
        }
        text.push_str(&more(finding.alternatives.len(), "alternative"));
        if let Some(advice) = &finding.to_separate {
            text.push_str(&format!("  to tell them apart: {advice}\n"));
        }
        text
    }

    /// A fitted number with its interval; a joint's compliance as its stiffness too.
    fn parameter(&self, finding: &Finding, p: &ParameterReport) -> Vec<Vec<String>> {
        let interval = |[low, high]: [f64; 2]| format!("[{} to {}]", short(low), short(high));
        let number = |x: f64, unit: &str| format!("{} {unit}", short(x));
        let mut row = vec![p.name.to_owned(), number(p.value, p.unit), interval(p.ci95)];
        let joint = finding.place.strip_prefix("joint ").and_then(|n| n.parse::<usize>().ok());
        let joint = joint.and_then(|n| self.arm.joints.get(n - 1));
        let (Some(joint), "joint_compliance") = (joint, finding.effect) else { return vec![row] };
        let (unit, imperial, size) = match joint.motion {
            Motion::Revolute => ("N·m/rad", ["in·lbf/rad", "rad/(in·lbf)"], POUND * INCH),
            Motion::Prismatic => ("N/m", ["lbf/in", "in/lbf"], POUND / INCH),
        };
        let imperial = Some(imperial).filter(|_| self.pounds());
        if let Some([_, softness]) = imperial {
            row.extend([number(p.value * size, softness), interval(p.ci95.map(|c| c * size))]);
        }
        let mut rows = vec![row];
        if joint.compliance > 0.0 {
            rows[0][0] = "compliance, added".to_owned();
        }
        // The joint's spring as a whole: what the file has, and what was found.
        let [low, high] = p.ci95.map(|c| joint.compliance + c);
        let whole = joint.compliance + p.value;
        if whole > 0.0 && low > 0.0 {
            let (k, bounds) = (1.0 / whole, [1.0 / high, 1.0 / low]);
            let mut row = vec!["stiffness".to_owned(), number(k, unit), interval(bounds)];
            if let Some([stiffness, _]) = imperial {
                row.extend([number(k / size, stiffness), interval(bounds.map(|b| b / size))]);
            }
            rows.push(row);
        }
        rows
    }
}

/// A probability with two digits.
fn chance(p: f64) -> String {
    if p < 1e-3 { format!("{p:.1e}") } else { format!("{p:.*}", decimals(p, 2)) }
}
