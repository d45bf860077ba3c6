//! The findings: how far each reduces the error, how large it is, what else it could be.

use stiffarm_gap::report::{Finding, Parameter};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Joint;

use super::Campaign;
use crate::report::explained;
use crate::unit::imperial;
use crate::words::{less, percent};
use crate::{Block, Unit};

/// Of more parameters those are shown whose interval does not contain zero; a calibration has dozens.
const MOST_PARAMETERS: usize = 8;

impl Campaign<'_> {
    /// The findings; `None` where there are none.
    pub(super) fn findings(&self) -> Option<Block> {
        let (shown, [whole, _]) = (self.main(), self.rms());
        let leaves = |a: &stiffarm_gap::report::Alternative| {
            format!("leaves {}", shown.with_unit(a.left.size()))
        };
        let one = |number, f: &Finding| {
            let plain = crate::Finding::of(number, f, whole, leaves);
            let again = percent(f.stability.unwrap_or_default());
            crate::Finding {
                said: self.said(f),
                error: shown.change(f.held_out.before(), f.held_out.after()),
                less: f.held_out.shrink().map_or_else(String::new, less),
                parameters: self.parameters(f),
                evidence: format!(
                    "{}, found in {again} of random halves of the poses",
                    plain.evidence
                ),
                ..plain
            }
        };
        let remark = "in order of addition; rms without → with the finding, held out".to_owned();
        let has_rivals = self.found.findings.iter().any(|f| !f.alternatives.is_empty());
        let lists =
            &["findings.parameters", "findings.alternatives"][..1 + usize::from(has_rivals)];
        explained(&self.found.findings, remark, one, |size| shown.with_unit(size), lists)
    }

    /// The parameters with their intervals, the joint's whole spring behind them.
    fn parameters(&self, finding: &Finding) -> Vec<String> {
        let few = finding.parameters.len() <= MOST_PARAMETERS;
        let is_told = |ci: [f64; 2]| ci[0] > 0.0 || ci[1] < 0.0;
        let shown = finding.parameters.iter().filter(|p| few || is_told(p.ci95));
        shown.map(|p| self.parameter(finding, p)).chain(self.stiffness(finding)).collect()
    }

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
        let mut text = format!("{}{added} {}", p.name, size.interval(p.value, p.ci95));
        if let Some([_, imperial]) = self.imperial(finding) {
            text.push_str(&format!(" = {}", imperial.interval(p.value, p.ci95)));
        }
        text
    }

    /// The joint's whole spring, of the file and what was found, as a stiffness.
    fn stiffness(&self, finding: &Finding) -> Option<String> {
        let joint = self.spring(finding)?;
        let p = finding.parameters.first()?;
        let [low, high] = p.ci95.map(|c| joint.compliance + c);
        let whole = joint.compliance + p.value;
        if !(whole > 0.0 && low > 0.0) {
            return None;
        }
        let name = if is_revolute(joint) { "N·m/rad" } else { "N/m" };
        let (value, bounds) = (1.0 / whole, [1.0 / high, 1.0 / low]);
        let mut text = format!("stiffness {}", Unit::of(name, value).interval(value, bounds));
        if let Some([imperial, _]) = self.imperial(finding) {
            text.push_str(&format!(" = {}", imperial.interval(value, bounds)));
        }
        Some(text)
    }

    /// The joint of a compliance that was found.
    fn spring(&self, finding: &Finding) -> Option<&Joint> {
        let effect = self.options.catalogue.named(&finding.effect)?;
        effect.spring(self.arm, finding.place.parse().ok()?)
    }

    /// Stiffness and compliance in pounds and inches, if the file has such units.
    fn imperial(&self, finding: &Finding) -> Option<[Unit<'static>; 2]> {
        let joint = self.spring(finding).filter(|_| self.units().pounds)?;
        Some(imperial(is_revolute(joint)))
    }

    /// The unit for all parameters of a finding that have the unit of `p`, and for the intervals of those that the data
    /// hardly decide.
    pub(super) fn size<'a>(&self, finding: &Finding, p: &'a Parameter) -> Unit<'a> {
        let alike = finding.parameters.iter().filter(|other| other.unit == p.unit);
        let half = |[low, high]: [f64; 2]| (high - low).abs() / 2.0;
        let most = alike.map(|other| other.value.abs().max(half(other.ci95))).fold(0.0, f64::max);
        self.unit(finding, &p.unit, most)
    }

    /// The unit for parameters up to `most`.
    pub(super) fn unit<'a>(&self, finding: &Finding, unit: &'a str, most: f64) -> Unit<'a> {
        let effect = self.options.catalogue.named(&finding.effect).filter(|_| unit != "m");
        let shown = effect.map_or(unit, |effect| effect.shown_in(unit));
        self.units().parameter(shown, most)
    }
}

fn is_revolute(joint: &Joint) -> bool {
    joint.motion == Motion::Revolute
}
