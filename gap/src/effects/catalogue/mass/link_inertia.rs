use crate::effects::prelude::*;

/// Ten numbers of a link, in its row's frame, beyond those of the robot file.
#[derive(Clone, Copy, Debug)]
pub struct LinkInertia;

const TORQUE: &Facts = &Facts {
    identifier: "link_inertia",
    reality: "A link is heavier, or otherwise balanced, than the robot file says.",
    signature: "Torques of the joints below, as the link's weight and acceleration ask.",
    confused_with: "Neighbouring links, exactly so in the numbers that only their sum shows; \
        `payload`.",
    separated_by: "Folded and stretched postures, slow and fast.",
    formula: "τ → τ + Y(q, q̇, q̈) φ, φ the ten numbers",
    parameters: &BODY,
    at: At::Links,
    ..Facts::TORQUE
};

impl Law for LinkInertia {
    fn facts(&self) -> &'static Facts {
        TORQUE
    }
}

impl InMotion for LinkInertia {
    fn columns(&self, _: &LogScene<'_>, _: Spot, _: &[f64]) -> Vec<Column> {
        Vec::new()
    }

    fn carried(&self, _: &Arm, spot: Spot) -> Option<Carried> {
        Some(Carried { link: spot.row(), run: None, numbers: units().collect() })
    }

    fn excluded(&self, scene: &LogScene<'_>) -> Option<String> {
        weightless(scene)
    }
}
