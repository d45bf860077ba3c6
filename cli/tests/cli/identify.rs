//! `stiffarm identify`.

use nalgebra::Vector6;
use serde_json::Value;

use crate::support::{Folder, arm, flat, has, list, moved, number, read, stiffarm};

/// Stiffnesses of the arm that is measured; the robot file has others.
const TRUE: [f64; 6] = [3.0e6, 5.0e6, 4.2e6, 6.0e5, 5.0e5, 4.0e5];

/// A file of a KR 240-2 with the true springs: `poses` postures, each under some loads, read to
/// a hundredth of a millimetre.
fn run(folder: &Folder, poses: usize, loads: &[[f64; 3]]) -> (String, String) {
    let mut robot = read("robots/arms/kuka_kr240.toml");
    robot.push_str("\n[tool]\ntranslation = [0.1, 0.0, 0.15]\n");
    let mut arm = arm("kuka_kr240");
    arm.tool = nalgebra::Isometry3::translation(0.1, 0.0, 0.15);
    for (joint, k) in arm.joints.iter_mut().zip(TRUE) {
        joint.compliance = 1.0 / k;
    }
    let mut rows =
        "# by hand\nq1[deg],q2[deg],q3[deg],q4[deg],q5[deg],q6[deg],fx[kN],fy[kN],fz[kN],\
                    dx[mm],dy[mm],dz[mm]\n"
            .to_owned();
    for k in 0..poses {
        let turn = |j: usize| ((k * (17 + 12 * j) + 31 * j) % 97) as f64 - 48.0;
        let q: [f64; 6] = [turn(0), turn(1) + 60.0, turn(2) - 60.0, turn(3), turn(4), turn(5)];
        let radians = q.map(f64::to_radians);
        for force in loads {
            let wrench = Vector6::new(force[0], force[1], force[2], 0.0, 0.0, 0.0) * 1e3;
            let moved = moved(&arm, &radians, &wrench) * 1e3;
            let cells = q.iter().chain(force).map(f64::to_string);
            let read = moved.iter().map(|x| format!("{x:.2}"));
            rows.push_str(&cells.chain(read).collect::<Vec<_>>().join(","));
            rows.push('\n');
        }
    }
    (folder.file("arm.toml", robot), folder.file("run.csv", rows))
}

#[test]
fn a_row_with_a_hole_is_left_out_and_said() {
    let folder = Folder::new();
    let (robot, data) = run(&folder, 20, &LOADS);
    let mut lines: Vec<String> = read(&data).lines().map(str::to_owned).collect();
    let cut = lines[5].rfind(',').expect("cells");
    lines[5].truncate(cut + 1);
    let holed = folder.file("holed.csv", lines.join("\n") + "\n");
    let run = stiffarm(&["identify", &robot, &holed]).ended(0);
    assert!(run.err.contains("1 row of 60 left out"), "{}", run.err);
    assert!(run.err.contains("line 6, column 12 `dz[mm]`: found an empty cell"), "{}", run.err);
    let quiet = stiffarm(&["--quiet", "identify", &robot, &holed]);
    assert_eq!((quiet.status, quiet.err.as_str()), (0, ""));
}

const LOADS: [[f64; 3]; 3] = [[0.0, 0.0, -2.0], [1.5, -1.0, 0.0], [0.0, 1.5, 0.5]];

fn json(arguments: &[&str]) -> Value {
    stiffarm(&[&["identify"], arguments, &["--json", "-"]].concat()).json()
}

#[test]
fn stiffnesses_are_found_and_written() {
    let folder = Folder::new();
    let (robot, data) = run(&folder, 20, &LOADS);
    let found = json(&[&robot, &data]);
    for (parameter, k) in list(&found["parameters"]).iter().zip(TRUE) {
        let [low, high] = [0, 1].map(|end| number(&parameter["stiffness_ci95"][end]));
        // Four of the interval's two standard deviations.
        let middle = number(&parameter["stiffness"]);
        assert!((middle - k).abs() < 2.0 * (high - low), "{parameter}");
        assert!(high - low < 0.2 * k, "{parameter}");
        assert_eq!(parameter["status"], "determined");
    }
    let sizes = |when: &str| number(&found["gap"][when]["position_rms"]);
    // Rounding to 0.01 mm: 0.0029 mm per coordinate, 0.005 mm over three.
    assert!(sizes("held_out") < 7e-6 && sizes("before") > 2e-5, "{found}");
    let out = folder.name("stiff.toml");
    let screen = stiffarm(&["identify", &robot, &data, "--write-robot", &out]).good();
    has(&screen, &["joint 1", "N·m/rad", "with the identified springs, held out", "rms mm"]);
    let again = json(&[&out, &data]);
    let rms = number(&again["gap"]["before"]["position_rms"]);
    assert!(rms <= sizes("held_out"), "{rms}");
    assert_eq!(stiffarm(&["identify", &robot, &data]).good(), screen);
}

#[test]
fn what_a_hanging_weight_does_not_show_is_said() {
    let folder = Folder::new();
    let (robot, data) = run(&folder, 8, &LOADS[..1]);
    let screen = stiffarm(&["identify", &robot, &data]).good();
    has(&screen, &["has no effect on the rows", "joint 1: to determine it, pull along ["]);
    let held = &json(&[&robot, &data])["parameters"][0];
    assert_eq!(held["status"], "held");
    assert!(held["ci95"].is_null() && held["stiffness_ci95"].is_null(), "{held}");
    let out = folder.name("stiff.toml");
    stiffarm(&["--quiet", "identify", &robot, &data, "--write-robot", &out]).good();
    let toml = read(&out);
    has(&toml, &["# joint 1: not identified, as it was.", "stiffness = 3800000.0"]);
}

#[test]
fn a_spring_where_the_file_has_none_is_said_as_such() {
    let folder = Folder::new();
    let (robot, data) = run(&folder, 12, &LOADS);
    let soft = read(&robot);
    let springs = |line: &&str| !line.trim_start().starts_with("stiffness");
    let rigid: Vec<&str> = soft.lines().filter(springs).collect();
    let rigid = folder.file("rigid.toml", rigid.join("\n"));
    let screen = stiffarm(&["identify", &rigid, &data]).good();
    let said = flat(&screen);
    assert!(said.contains("N·m/rad where the robot file has none"), "{screen}");
    assert!(!said.contains("as in the robot file"), "{screen}");
}

#[test]
fn the_base_can_be_asked_for() {
    let folder = Folder::new();
    let (robot, data) = run(&folder, 12, &LOADS);
    let screen = stiffarm(&["identify", &robot, &data, "--base"]).good();
    has(&screen, &["base along x", "N/µm", "not distinguishable from joint 1"]);
}

/// The written robot leaves nothing of what its foundation did.
#[test]
fn the_foundation_is_written() {
    let folder = Folder::new();
    let (robot, plan) = run(&folder, 12, &LOADS);
    let founded = folder.name("founded.csv");
    let gives = "base_compliance@base:rock_x=2e-8,rock_y=3e-8,give=4e-9";
    let exact = "--noise-position 0um --quiet";
    crate::support::run(&format!(
        "simulate {robot} {plan} --effect {gives} --csv {founded} {exact}"
    ))
    .good();
    let out = folder.name("founded.toml");
    stiffarm(&["identify", &robot, &founded, "--base", "--write-robot", &out, "--quiet"]).good();
    let toml = read(&out);
    assert!(toml.contains("id = \"base_compliance\"") && toml.contains("give = "), "{toml}");
    let gap = |robot: &str| -> f64 {
        number(
            &stiffarm(&["predict", robot, &founded, "--json", "-"]).json()["gap"]["position_max"],
        )
    };
    // The file's six digits, of a foundation that is a part of what gives.
    assert!(gap(&out) < 1e-4 * gap(&robot), "{} {}", gap(&out), gap(&robot));
}
