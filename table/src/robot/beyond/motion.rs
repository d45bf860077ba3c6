//! Effects of the arm in motion, which a joint log shows: no kernel is made of them.
//!
//! What the table has entries for (`coulomb`, `viscous`, `rotor_inertia`, masses and inertias) stands in these, and is
//! compiled. An `[[effect]]` of motion is what it has none for; some have a name that arms at rest know too, and are told
//! by the keys of their numbers.

use super::super::model::Effect;

/// Their identifiers and the keys of their numbers.
const EFFECTS: &[(&str, &[&str])] = &[
    ("coulomb_friction", &["coulomb"]),
    ("viscous_friction", &["viscous"]),
    ("friction_curve", &["root"]),
    ("stribeck", &["torque", "speed"]),
    ("presliding", &["torque", "distance"]),
    ("load_friction", &["part"]),
    ("torque_saturation", &["part"]),
    ("asymmetric_friction", &["half_difference"]),
    ("torque_offset", &["offset"]),
    ("torque_scale", &["scale"]),
    ("rotor_inertia", &["inertia"]),
    ("link_inertia", BODY),
    ("payload", BODY),
    ("gravity_direction", &["rx", "ry", "rz"]),
    ("counterbalance", &["cos", "sin"]),
    ("joint_coupling", &["inertia", "viscous", "coulomb"]),
    ("torque_ripple", &["order", "cos", "sin"]),
    ("joint_elasticity", &["compliance"]),
    ("warm_up", &["rate"]),
    ("latency", &["delay"]),
    ("tracking_lag", &["lag", "inertia"]),
    ("servo_droop", &["compliance"]),
    // Of earlier versions; a whole `width` is that of an arm at rest, of which kernels are made.
    ("backlash", &["half_width"]),
];

const BODY: &[&str] = &["m", "mx", "my", "mz", "xx", "xy", "yy", "xz", "yz", "zz"];

/// Whether a table is of motion: it has numbers, and all of them are such an effect's.
pub(super) fn is_of_motion(table: &Effect) -> bool {
    let all = |keys: &[&str]| table.numbers.iter().all(|n| keys.contains(&n.key.as_str()));
    !table.numbers.is_empty() && EFFECTS.iter().any(|(id, keys)| *id == table.id.value && all(keys))
}
