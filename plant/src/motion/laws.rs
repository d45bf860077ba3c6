//! The effects that this plant can have: names, places and numbers are those of the catalogue, as they are written of
//! logs. The laws are the plant's own.

use std::sync::LazyLock;

use stiffarm_kernels::generic::Arm;

use crate::effects::{At, IN_MOTION, Place, Spot};
use crate::log::Domain;

/// What the plant has a law for, in the order in which cases are drawn.
const NAMES: &str = "coulomb_friction viscous_friction friction_curve stribeck presliding load_friction \
                     torque_saturation asymmetric_friction torque_offset torque_scale rotor_inertia counterbalance \
                     joint_coupling torque_ripple joint_elasticity warm_up link_inertia payload gravity_direction \
                     joint_offset latency tracking_lag servo_droop backlash";

/// An effect.
#[derive(Debug, PartialEq)]
pub struct Law {
    /// Its identifier.
    pub name: &'static str,
    /// Where it shows.
    pub rows: Vec<Domain>,
    at: At,
    /// Names and SI units: of several forms the first one's.
    pub numbers: Vec<(&'static str, &'static str)>,
}

/// All of them.
pub static LAWS: LazyLock<Vec<Law>> =
    LazyLock::new(|| NAMES.split(' ').filter_map(Law::of).collect());

impl Law {
    fn of(name: &'static str) -> Option<Law> {
        let forms = || IN_MOTION.iter().filter(|effect| effect.identifier() == name);
        let facts = forms().next()?.facts();
        let numbers = facts.parameters.iter().map(|p| (p.key, p.quantity.unit())).collect();
        Some(Law { name, rows: forms().map(|form| form.domain()).collect(), at: facts.at, numbers })
    }

    /// The effect of a name.
    pub fn named(name: &str) -> Option<&'static Law> {
        LAWS.iter().find(|law| law.name == name)
    }

    /// Where on this arm it may act, in so many runs.
    pub fn spots(&self, arm: &Arm, runs: usize) -> Vec<Spot> {
        let mut places = match self.at {
            At::Held => (1..=runs).map(Place::Held).collect(),
            at => at.places(arm),
        };
        places.sort_by_key(|place| *place == Place::Arm);
        places.into_iter().map(Spot::at).collect()
    }

    /// Numbers that say what the effect is like, not how large it is.
    pub fn is_form(&self, number: &str) -> bool {
        ["speed", "distance", "order"].contains(&number)
    }
}
