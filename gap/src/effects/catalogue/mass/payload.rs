use crate::effects::prelude::*;

/// Ten numbers of what the last link carries in a run, in the tool frame, beyond what is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Payload;

const TORQUE: &Facts = &Facts {
    identifier: "payload",
    reality: "In one run the tool carries something else than in the others, or holds it \
        otherwise.",
    signature: "Torques of all joints, in one run alone, as a body at the tool asks.",
    confused_with: "`link_inertia` of the last link, exactly so if every run has it; \
        `torque_scale`.",
    separated_by: "The same motion without it.",
    formula: "τ → τ + Y(q, q̇, q̈) φ in one run, φ the ten numbers",
    parameters: &BODY,
    at: At::Held,
    counts_once: true,
    ..Facts::TORQUE
};

impl Law for Payload {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for Payload {
    /// Runs beyond the first: of one run alone, and of all together, it is the last link.
    fn spots(&self, scene: &LogScene<'_>) -> Vec<Spot> {
        let runs = scene.signals.spans.iter().map(|span| span.run).max().unwrap_or(0);
        let named = scene.payloads.iter().filter(|name| name.is_some()).count();
        let bare = scene.payloads.len() - named;
        // Where some run carries nothing, what the others carry; else what each has beyond the first.
        let of = |run: &usize| if bare > 0 { scene.payloads[*run].is_some() } else { *run > 0 };
        let held = |run: usize| Spot::at(Place::Held(run + 1));
        if named == 0 { Vec::new() } else { (0..=runs).filter(of).map(held).collect() }
    }

    fn columns(&self, _: &LogScene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        Vec::new()
    }

    fn carried(&self, arm: &Arm, spot: Spot) -> Option<Carried> {
        let Place::Held(run) = spot.place else { return None };
        let numbers = units().map(|unit| moved(&arm.tool, &unit)).collect();
        Some(Carried { link: arm.dof() - 1, run: Some(run - 1), numbers })
    }
}
