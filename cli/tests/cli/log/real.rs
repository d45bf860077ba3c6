//! Real logs: a Stäubli TX40 with published parameters, and a small arm of position servos.
//!
//! The data are not part of this repository. The tests look for `logs/tx40.csv`, `logs/tx40.urdf` and
//! `logs/so101.csv` in the directory that `STIFFARM_DATA` names, or in `shared/data` beside the
//! checkout; they are ignored unless `-- --ignored` asks for them.

use serde_json::Value;

use crate::support::{self, Folder, list, number, stiffarm};

fn data(name: &str) -> String {
    support::data(&format!("logs/{name}"))
}

fn diagnosed(arguments: &[&str]) -> Value {
    stiffarm(&[&["diagnose"], arguments, &["--quiet", "--json", "-"]].concat()).json()
}

fn numbers(found: &Value, effect: &str, place: &str) -> Vec<f64> {
    let mut findings = list(&found["findings"]).iter();
    let finding = findings.find(|f| f["effect"] == effect && f["place"] == place);
    let finding = finding.unwrap_or_else(|| panic!("no {effect} at {place}: {found:#}"));
    list(&finding["parameters"]).iter().map(|p| number(&p["value"])).collect()
}

/// What is left of all joints on unseen time, as a part of their sizes.
fn left(found: &Value) -> f64 {
    let gaps = list(&found["gap"]);
    let part = |g: &Value| number(&g["after"]) / number(&g["size"]);
    gaps.iter().map(part).sum::<f64>() / gaps.len() as f64
}

fn tx40(folder: &Folder) -> String {
    let robot = folder.name("tx40.toml");
    stiffarm(&["import", &data("tx40.urdf"), "--toml", &robot, "--quiet"]).good();
    robot
}

/// Published: Gautier, Janot & Vandanjon's TX40, as figaroh-examples has it.
#[test]
#[ignore = "reads logs that are not part of the repository: STIFFARM_DATA"]
fn a_tx40_has_the_friction_that_is_published() {
    let folder = Folder::new();
    let model = "coulomb_friction,viscous_friction,rotor_inertia,joint_coupling,torque_offset";
    let found = diagnosed(&[&tx40(&folder), &data("tx40.csv"), "--effects", model]);
    let close = |value: f64, published: f64, part: f64, what: &str| {
        assert!((value / published - 1.0).abs() < part, "{what}: {value}, published {published}");
    };
    for (joint, viscous, coulomb) in
        [(1, 8.05, 7.14), (2, 5.53, 8.26), (3, 1.97, 6.34), (4, 1.11, 2.48), (5, 1.86, 3.03)]
    {
        let place = format!("joint {joint}");
        close(numbers(&found, "viscous_friction", &place)[0], viscous, 0.02, "viscous");
        close(numbers(&found, "coulomb_friction", &place)[0], coulomb, 0.02, "Coulomb");
    }
    let coupling = numbers(&found, "joint_coupling", "joints 5 + 6");
    close(coupling[1], 0.616, 0.05, "the wrist's viscous friction");
    close(coupling[2], 1.95, 0.05, "the wrist's Coulomb friction");
    // Not told from zero in these 9 s, and there: the coupling's would take a part of it.
    let own = numbers(&found, "coulomb_friction", "joint 6")[0];
    assert!((0.1..0.5).contains(&own), "{own}, published 0.28");
}

#[test]
#[ignore = "reads logs that are not part of the repository: STIFFARM_DATA"]
fn of_a_tx40s_torques_less_than_a_tenth_is_left() {
    let folder = Folder::new();
    let found = diagnosed(&[&tx40(&folder), &data("tx40.csv")]);
    assert!(left(&found) < 0.096, "{}", left(&found));
    // The wrist's coupling, and no other.
    let coupling = numbers(&found, "joint_coupling", "joints 5 + 6");
    for (value, published) in [(coupling[1], 0.616), (coupling[2], 1.95)] {
        assert!((value / published - 1.0).abs() < 0.05, "{value}, published {published}");
    }
    let coupled = list(&found["findings"]).iter().filter(|f| f["effect"] == "joint_coupling");
    assert_eq!(coupled.count(), 1, "{found:#}");
}

/// Kinematics and masses of TheRobotStudio/SO-ARM100, Simulation/SO101/so101_new_calib.urdf, as
/// `stiffarm import` writes them.
const SO101: &str = include_str!("so101.toml");

#[test]
#[ignore = "reads logs that are not part of the repository: STIFFARM_DATA"]
fn a_small_arm_is_late_then_droops() {
    let folder = Folder::new();
    let robot = folder.file("so101.toml", SO101);
    let late = diagnosed(&[&robot, &data("so101.csv"), "--effects", "latency,servo_droop"]);
    let delay = numbers(&late, "latency", "the interface")[0];
    assert!((0.1..0.12).contains(&delay), "{delay}");
    let found = diagnosed(&[&robot, &data("so101.csv")]);
    let findings = list(&found["findings"]);
    assert!(findings[0]["effect"] == "latency" && findings[1]["effect"] == "servo_droop");
    // The play of all servos takes a part of it.
    let delay = numbers(&found, "latency", "the interface")[0];
    assert!((0.08..0.11).contains(&delay), "{delay}");
    assert_eq!(findings.iter().filter(|f| f["effect"] == "backlash").count(), 5, "{found:#}");
    assert_eq!(found["evidence"]["held_out_by"], "run");
    let gaps = list(&found["gap"]);
    let square: f64 = gaps.iter().map(|g| number(&g["after"]).powi(2)).sum();
    let rms = (square / gaps.len() as f64).sqrt().to_degrees();
    // Ten of the fifty runs.
    assert!(rms < 0.85, "{rms}");
}
