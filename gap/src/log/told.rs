//! How the numbers of a log's diagnosis are reported: gaps, findings, their units and what was left before each.

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::effects::{LogEffect, Spot};
use super::read::TorqueSide;
use super::scene::Domain;
use super::search::Round;
use super::search::case::Case;
use super::search::dictionary::Dictionary;
use super::search::fit::Term;
use super::search::judge::{Judged, Verdict};
use super::search::unseen::Unseen;
use crate::effects::Place;
use crate::infer::interval;
use crate::report::log::JointGap;
use crate::report::{Alternative, Finding, HeldOutGap, Left, Parameter};
use crate::shrink::Shrink;

/// What was left before anything was found.
#[derive(Default)]
pub(super) struct Before {
    /// Of each joint.
    pub(super) left: Vec<f64>,
    /// What the model shows nothing of.
    pub(super) hidden: Vec<(&'static dyn LogEffect, Spot)>,
    /// Values of the links' columns, where they are fitted.
    pub(super) alone: Vec<f64>,
}

impl Before {
    /// What the first round leaves.
    pub(super) fn of(dict: &Dictionary<'_>, first: &Round) -> Before {
        let blind = first.asked.candidates.iter().filter(|c| !c.seen);
        Before {
            left: Unseen::of(dict, &first.now.fit, &first.now.sizes, &first.blocks).sizes,
            hidden: blind.map(|c| (c.term.effect, c.term.spot)).collect(),
            alone: first.now.fit.values.clone(),
        }
    }
}

/// How numbers are told.
pub(super) struct Told<'a> {
    pub(super) case: &'a Case<'a>,
    pub(super) arm: &'a Arm,
    pub(super) kind: (Domain, Option<TorqueSide>),
    pub(super) current: bool,
    /// Sizes of the joints' torques, or of their position errors.
    pub(super) sizes: Vec<f64>,
}

impl Told<'_> {
    /// A place; of what is held all runs that name it.
    fn place(&self, spot: Spot) -> String {
        let Place::Held(first) = spot.place else { return spot.to_string() };
        let case = self.case;
        let runs = (0..case.payloads.len()).filter(|run| case.held_as(*run) == first - 1);
        let runs: Vec<String> = runs.map(|run| (run + 1).to_string()).collect();
        match runs.as_slice() {
            [before @ .., last] if !before.is_empty() => {
                format!("the tool in runs {} and {last}", before.join(", "))
            }
            _ => spot.to_string(),
        }
    }

    /// What a joint's gap is measured in.
    fn gap_unit(&self, joint: usize) -> &'static str {
        match (self.kind.0, self.arm.joints[joint].motion) {
            (Domain::Torque, _) if self.current => "A",
            (Domain::Torque, Motion::Revolute) => "N·m",
            (Domain::Torque, Motion::Prismatic) => "N",
            (Domain::Position, Motion::Revolute) => "rad",
            (Domain::Position, Motion::Prismatic) => "m",
        }
    }

    /// The unit of an effect's number at a spot.
    fn unit(&self, unit: &str, spot: Spot) -> String {
        let joint = spot.joint().or(spot.pair().map(|[first, _]| first));
        let slides = joint.is_some_and(|j| self.arm.joints[j].motion == Motion::Prismatic);
        let unit = match (slides, unit) {
            (true, "kg·m²") if !self.current => "kg".to_owned(),
            (true, unit) => unit.replace("N·m", "N").replace("rad", "m"),
            (false, unit) => unit.to_owned(),
        };
        match (self.current, unit.as_str()) {
            (false, _) => unit,
            (true, "kg·m²") => "A·s²/rad".to_owned(),
            (true, unit) => unit.replace("N·m", "A").replace('N', "A"),
        }
    }

    /// Of each joint, before and with the findings.
    pub(super) fn gap(
        &self,
        before: &[f64],
        after: &[f64],
        nested: Option<&[f64]>,
    ) -> Vec<JointGap> {
        let pairs = before.iter().zip(after).zip(&self.sizes);
        let told = |(joint, ((before, after), size)): (usize, ((&f64, &f64), &f64))| JointGap {
            unit: self.gap_unit(joint).into(),
            size: *size,
            before: *before,
            after: *after,
            nested: nested.map(|nested| nested[joint]),
        };
        pairs.enumerate().map(told).collect()
    }

    /// From what is left of the joints before to what is left with all findings, the logarithm of whose ratio
    /// scatters by `spread` over logs of so many blocks.
    pub(super) fn shrink(&self, left: [&[f64]; 2], spread: f64, blocks: usize) -> Shrink {
        let [before, after] = left.map(|left| self.mean(left));
        let shrink = if before > 0.0 { 1.0 - after / before } else { 0.0 };
        Shrink { before, after, shrink, shrink_ci95: interval(shrink, spread, blocks) }
    }

    /// Mean over the joints of what is left, as a part of their sizes.
    pub(super) fn mean(&self, left: &[f64]) -> f64 {
        let own = left.iter().zip(&self.sizes).zip(self.case.left_out);
        let parts: Vec<f64> =
            own.filter(|(_, out)| !**out).map(|((left, whole), _)| left / whole).collect();
        parts.iter().sum::<f64>() / parts.len().max(1) as f64
    }

    fn alternative(&self, (term, leaves): &(Term, f64)) -> Alternative {
        Alternative {
            effect: term.effect.identifier().into(),
            place: self.place(term.spot),
            left: Left::InMotion { leaves: *leaves },
        }
    }

    /// Each with what is `left` of the joints before it, and after the last.
    pub(super) fn findings(
        &self,
        left: &[f64],
        verdict: &Verdict,
        unseen: &Unseen,
        by_command: Option<&[f64]>,
    ) -> Vec<Finding> {
        let base = verdict.now.fit.columns.len()
            - verdict.now.fit.terms.iter().map(|t| t.values.len()).sum::<usize>();
        let mut widths = unseen.half_widths[base..].iter();
        let mut told_by_command = by_command.into_iter().flatten().copied();
        let mut tell = |(judged, left_by): (&Judged, &[f64])| {
            let term = &judged.term;
            let numbers =
                term.effect.parameters().iter().zip(self.case.at_least_none(term)).zip(&mut widths);
            let held_out =
                HeldOutGap::InMotion { held_out_before: left_by[0], held_out_after: left_by[1] };
            Finding {
                effect: term.effect.identifier().into(),
                place: self.place(term.spot),
                parameters: numbers
                    .map(|((parameter, value), width)| Parameter {
                        name: parameter.key.into(),
                        value,
                        unit: self.unit(parameter.quantity.unit(), term.spot).into(),
                        ci95: [value - width, value + width],
                        by_command: told_by_command.next(),
                    })
                    .collect(),
                share: held_out.share(left[0]),
                held_out,
                p_value: judged.doubt.p_value,
                stability: None,
                alternatives: judged.rivals.iter().map(|rival| self.alternative(rival)).collect(),
                to_separate: (!judged.rivals.is_empty())
                    .then(|| Some(term.effect.facts().separated_by.to_owned())),
            }
        };
        verdict.findings.iter().zip(left.windows(2)).map(&mut tell).collect()
    }
}
