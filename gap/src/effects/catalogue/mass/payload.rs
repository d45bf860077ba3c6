use crate::effects::prelude::*;

/// Ten numbers of what the last link carries in a run, and in all others that name the same, in the tool frame, beyond what
/// is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Payload;

const TORQUE: &Facts = &Facts {
    identifier: "payload",
    reality: "In some runs the tool carries something else than in the others, or than the robot file \
        says.",
    signature: "Torques of all joints, in runs of one name alone, as a body at the tool asks.",
    confused_with: "`link_inertia` of the last link, exactly so if every run has it; \
        `torque_scale`.",
    separated_by: "The same motion without it.",
    formula: "τ → τ + Y(q, q̇, q̈) φ in runs of one name, φ the ten numbers",
    parameters: &BODY,
    at: At::Held,
    ..Facts::TORQUE
};

impl Law for Payload {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for Payload {
    /// The first run of each name, where some run carries nothing; else of each but the first name: what all runs carry is
    /// the last link.
    fn spots(&self, scene: &LogScene<'_>) -> Vec<Spot> {
        let names = scene.payloads;
        let is_first = |run: &usize| names[*run].is_some() && !names[..*run].contains(&names[*run]);
        let firsts: Vec<usize> = (0..names.len()).filter(is_first).collect();
        let all = usize::from(!names.contains(&None));
        firsts.into_iter().skip(all).map(|run| Spot::at(Place::Held(run + 1))).collect()
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
