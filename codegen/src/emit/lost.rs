//! What a simulator's file has no place for.

use crate::robot::{Joint, Robot};

/// What a URDF cannot hold of a robot, a phrase each; nothing where it holds all.
pub fn lost_in_urdf(robot: &Robot) -> Vec<String> {
    let springs = joints(robot, "the springs", |joint| joint.stiffness.is_some());
    let rotors = joints(robot, "the rotors", |joint| joint.drive.rotor_inertia.is_some());
    springs.into_iter().chain(rotors).chain(lost_in_mjcf(robot)).collect()
}

/// The same of an MJCF, which has the joints' springs.
pub fn lost_in_mjcf(robot: &Robot) -> Vec<String> {
    let beams = joints(robot, "the bending links", |joint| joint.beam.is_some());
    let effects = robot
        .effects
        .iter()
        .map(|effect| format!("{} at {}", effect.id.value.replace('_', " "), effect.place.value));
    beams.into_iter().chain(effects).collect()
}

fn joints(robot: &Robot, what: &str, has: impl Fn(&Joint) -> bool) -> Option<String> {
    let of = robot.joints.iter().enumerate().filter(|(_, joint)| has(joint));
    let numbers: Vec<String> = of.map(|(k, _)| (k + 1).to_string()).collect();
    let word = if numbers.len() == 1 { "joint" } else { "joints" };
    (!numbers.is_empty()).then(|| format!("{what} of {word} {}", numbers.join(", ")))
}
