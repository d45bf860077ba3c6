//! The findings: how far each closes the gap, how large it is, what else it could be.

use stiffarm_gap::report::{Alternative, Finding, Parameter};
use stiffarm_kernels::Motion;

use super::size::Size;
use super::unit::{INCH, POUND};
use super::{MOST, Screen, WIDTH, less, percent};
use crate::terminal::text::{
    bad, bold, decimals, dim, fixed, good, left_bar, listed, table, wrapped,
};

/// Findings that are shown with their numbers.
const DETAILED: usize = 4;

/// Numbers of a finding that are shown; a calibration has dozens.
const MOST_NUMBERS: usize = 8;

/// Where the details of a finding begin.
const MARGIN: usize = 5;

/// Width of a finding's bar.
const NARROW: usize = 12;

impl Screen<'_> {
    pub(super) fn findings(&self) -> String {
        let found = &self.found.findings;
        if found.is_empty() {
            return String::new();
        }
        let rows: Vec<Vec<String>> =
            found.iter().enumerate().map(|(k, f)| self.line(k + 1, f)).collect();
        let lines = table(&rows, &[]);
        let what = dim("in the order in which they were added; the gap with it, held out");
        let mut text = format!("\n{}  {what}\n", bold("Findings"));
        for (k, (line, finding)) in lines.lines().zip(found).enumerate() {
            text.push_str(&format!("  {line}\n"));
            if k < DETAILED {
                text.push_str(&self.details(finding));
            }
        }
        if found.len() > DETAILED {
            text.push_str("  the numbers of those from 5 on: --json\n");
        }
        text
    }

    /// `1  joint compliance at joint 2  1.23 → 0.21 mm  ██░░░░  83 % less [79 to 86]`.
    fn line(&self, number: usize, finding: &Finding) -> Vec<String> {
        let (held, shown) = (&finding.held_out, self.main());
        let [whole, _] = self.rms();
        let part = |x: f64| if whole > 0.0 { x / whole } else { 0.0 };
        vec![
            number.to_string(),
            good(Self::named(&finding.effect, &finding.place)),
            format!("{} → {}", shown.number(held.before()), shown.with_unit(held.after())),
            left_bar(part(held.before()), part(held.after()), NARROW),
            held.shrink().map_or_else(String::new, less),
        ]
    }

    /// All numbers with their intervals, the joint's spring as a whole behind them; of many those that
    /// are told from zero.
    pub(super) fn numbers(&self, finding: &Finding) -> Vec<String> {
        let few = finding.parameters.len() <= MOST_NUMBERS;
        let is_told = |ci: [f64; 2]| ci[0] > 0.0 || ci[1] < 0.0;
        let shown = finding.parameters.iter().filter(|p| few || is_told(p.ci95));
        let shown = shown.map(|p| self.parameter(finding, p));
        shown.chain(self.stiffness(finding)).collect()
    }

    fn details(&self, finding: &Finding) -> String {
        let mut numbers = self.numbers(finding);
        let rest = numbers.len().saturating_sub(MOST_NUMBERS);
        if rest > 0 {
            numbers.truncate(MOST_NUMBERS);
            numbers.push(format!("and {rest} more"));
        }
        let mut text = paragraph(&numbers.join("; "));
        let (p, again) = (chance(finding.p_value), percent(finding.stability.unwrap_or_default()));
        let mut evidence = format!("{p}, found again on {again} of halves");
        let (same, other): (Vec<_>, Vec<_>) =
            finding.alternatives.iter().partition(|a| !a.separable());
        let name = |a: &Alternative| Self::named(&a.effect, &a.place);
        let left = |a: &Alternative| self.main().with_unit(a.left.size());
        if let (true, Some(next)) = (same.is_empty(), other.first()) {
            evidence.push_str(&format!("; next best: {} ({})", name(next), left(next)));
        }
        text.push_str(&paragraph(&evidence));
        if !same.is_empty() {
            let names: Vec<String> =
                same.into_iter().map(|a| format!("{} (leaves {})", name(a), left(a))).collect();
            let verdict = bad("this data cannot tell it from");
            text.push_str(&paragraph(&format!("{verdict}: {}", listed(&names, MOST))));
        }
        if let Some(advice) = finding.advice() {
            text.push_str(&paragraph(&format!("to tell them apart: {advice}")));
        }
        text
    }

    /// A number with its interval.
    fn parameter(&self, finding: &Finding, p: &Parameter) -> String {
        let size = self.size(finding, p);
        if p.unit == "rows" {
            return format!("{} row {:.0}", p.name, p.value);
        }
        if p.ci95[0] == p.ci95[1] {
            return format!("{} {}", p.name, size.with_unit(p.value));
        }
        let added = match self.spring(finding) {
            Some(joint) if joint.compliance > 0.0 => ", added",
            _ => "",
        };
        let mut text = format!("{}{added} {}", p.name, sized(size, p.value, p.ci95));
        if let Some([_, imperial]) = self.imperial(finding) {
            text.push_str(&format!(" = {}", sized(imperial, p.value, p.ci95)));
        }
        text
    }

    /// The joint's spring as a whole, what the file has and what was found, as a stiffness.
    fn stiffness(&self, finding: &Finding) -> Option<String> {
        let joint = self.spring(finding)?;
        let p = finding.parameters.first()?;
        let [low, high] = p.ci95.map(|c| joint.compliance + c);
        let whole = joint.compliance + p.value;
        if !(whole > 0.0 && low > 0.0) {
            return None;
        }
        let name = match joint.motion {
            Motion::Revolute => "N·m/rad",
            Motion::Prismatic => "N/m",
        };
        let (value, bounds) = (1.0 / whole, [1.0 / high, 1.0 / low]);
        let mut text = format!("stiffness {}", sized(Size { name, si: 1.0 }, value, bounds));
        if let Some([imperial, _]) = self.imperial(finding) {
            text.push_str(&format!(" = {}", sized(imperial, value, bounds)));
        }
        Some(text)
    }

    /// The joint of a compliance that was found.
    fn spring(&self, finding: &Finding) -> Option<&stiffarm_kernels::generic::Joint> {
        self.effect(finding)?.spring(self.arm, finding.place.parse().ok()?)
    }

    /// Stiffness and compliance in pounds and inches, if the file has such units.
    fn imperial(&self, finding: &Finding) -> Option<[Size<'static>; 2]> {
        let joint = self.spring(finding).filter(|_| self.pounds())?;
        let (names, si) = match joint.motion {
            Motion::Revolute => (["in·lbf/rad", "rad/(in·lbf)"], POUND * INCH),
            Motion::Prismatic => (["lbf/in", "in/lbf"], POUND / INCH),
        };
        Some([Size { name: names[0], si }, Size { name: names[1], si: 1.0 / si }])
    }
}

/// A number with its interval: three digits, or as many as the interval says something about.
fn sized(size: Size, value: f64, [low, high]: [f64; 2]) -> String {
    let (shown, half) = (value.abs() / size.si, (high - low).abs() / (2.0 * size.si));
    let plain = (1e-3..1e4).contains(&shown.max(half));
    let told = [(shown, 3), (half, 2)].into_iter().filter(|(x, _)| *x > 0.0);
    let digits = told.map(|(x, digits)| decimals(x, digits)).min().unwrap_or(0);
    let number = |x: f64| match plain {
        true => fixed(x / size.si, digits),
        false => size.number(x),
    };
    format!("{} {} [{} to {}]", number(value), size.name, number(low), number(high))
}

fn paragraph(text: &str) -> String {
    let margin = " ".repeat(MARGIN);
    wrapped(&format!("{margin}{text}"), WIDTH, MARGIN + 2)
}

/// A probability with two digits; one that is smaller than rounding is only bounded.
pub fn chance(p: f64) -> String {
    match p {
        p if p < 1e-15 => "p < 1e-15".to_owned(),
        p if p < 1e-3 => format!("p = {p:.1e}"),
        p => format!("p = {p:.*}", decimals(p, 2)),
    }
}
