use crate::effects::prelude::*;

/// The servo's law `K (q_cmd − q) = D q̇ + J q̈ + g`, of which `lag` is D/K and `inertia` J/K.
#[derive(Clone, Copy, Debug)]
pub struct TrackingLag;

const POSITION: &Facts = &Facts {
    identifier: "tracking_lag",
    reality: "A position servo follows with an error: its damping over its stiffness, its inertia \
        over its stiffness.",
    signature: "An error in proportion to the speed of the joint, and to its acceleration.",
    confused_with: "`latency`, which is the same time at every joint.",
    separated_by: "A chirp; joints moved one at a time.",
    formula: "q − q_cmd = −lag · q̇ − inertia · q̈",
    // A servo does not go ahead of what it follows; its inertia may be too small to have a sign.
    parameters: &[
        Parameter::at_least("lag", Quantity::Time, 0.0),
        Parameter::free("inertia", Quantity::In("s²")),
    ],
    ..Facts::POSITION
};

impl Law for TrackingLag {
    fn facts(&self) -> &'static Facts {
        POSITION
    }
}

impl InMotion for TrackingLag {
    fn columns(&self, scene: &LogScene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        let (qd, qdd) = (&scene.signals.qd[joint], &scene.signals.qdd[joint]);
        vec![scene.column(joint, |k| -qd[k]), scene.column(joint, |k| -qdd[k])]
    }
}
