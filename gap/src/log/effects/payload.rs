//! In one run the tool carries something else than in the others, or holds it otherwise.

use super::{BODY, Carried, LogEffect, Number, Spot, units};
use crate::effects::About;
use crate::log::rigid::moved;
use crate::log::scene::{Column, Scene};
use stiffarm_kernels::generic::Arm;

/// Ten numbers of what the last link carries in a run, in the tool frame, beyond what is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Payload;

impl LogEffect for Payload {
    fn identifier(&self) -> &'static str {
        "payload"
    }

    fn about(&self) -> About {
        About {
            reality: "In one run the tool carries something else than in the others, or holds it otherwise.",
            signature: "Torques of all joints, in one run alone, as a body at the tool asks.",
            confused_with: "`link_inertia` of the last link, exactly so if every run has it; `torque_scale`.",
            separated_by: "The same motion without it.",
        }
    }

    /// Runs beyond the first: of one run alone, and of all together, it is the last link.
    fn spots(&self, scene: &Scene<'_>) -> Vec<Spot> {
        let runs = scene.signals.spans.iter().map(|span| span.run).max().unwrap_or(0);
        let named = scene.payloads.iter().filter(|name| name.is_some()).count();
        let bare = scene.payloads.len() - named;
        // Where some run carries nothing, what the others carry; else what each has beyond the first.
        let of = |run: &usize| if bare > 0 { scene.payloads[*run].is_some() } else { *run > 0 };
        if named == 0 { Vec::new() } else { (0..=runs).filter(of).map(Spot::Tool).collect() }
    }

    fn numbers(&self) -> &'static [Number] {
        &BODY
    }

    fn things(&self) -> usize {
        1
    }

    fn columns(&self, _: &Scene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        Vec::new()
    }

    fn carried(&self, arm: &Arm, spot: Spot) -> Option<Carried> {
        let Spot::Tool(run) = spot else { return None };
        let numbers = units().map(|unit| moved(&arm.tool, &unit)).collect();
        Some(Carried { link: arm.dof() - 1, run: Some(run), numbers })
    }
}
