//! Campaigns: against a tolerance, against the last one, in several sessions, into other programs.

use serde_json::Value;

use super::plant::{Bench, SLACK, SPRING, ZERO};
use crate::support::{Run, flat, has, json, number, numbers, read, stiffarm};

/// A diagnosis that tries few effects: quick in any build.
fn diagnosed(bench: &Bench, run: &str, extra: &[&str]) -> Run {
    let tried = "joint_compliance,joint_offset,backlash";
    let arguments = ["diagnose", &bench.robot, run, "--effects", tried];
    stiffarm(&[&arguments[..], extra].concat())
}

#[test]
fn what_is_not_accepted_is_an_exit_status() {
    let bench = Bench::new();
    let run = bench.simulated("run.csv", &["--effect", SPRING]);
    diagnosed(&bench, &run, &["--accept", "0.2mm", "--json", &bench.path("a.json")]).ended(0);
    // Three coordinates of 30 µm noise are longer than 10 µm in all but few rows.
    let bad = diagnosed(&bench, &run, &["--accept", "10um"]).ended(1);
    assert!(flat(&bad.out).contains("Not accepted: with the findings 95 % of the held-out rows"));
    let accept = &json(&read(&bench.path("a.json")))["accept"];
    let reached = number(&accept["position_p95"]);
    // Of the norm of three normal numbers 95 % lie below 2.80 of their deviation; a fifth to either
    // side for 60 rows.
    assert!((reached / (2.80 * 30e-6) - 1.0).abs() < 0.2, "{reached:e}");
    assert_eq!((&accept["accepted"], &accept["of"]), (&Value::Bool(true), &"held out".into()));
    // Of another campaign, where one is checked.
    let other = bench.simulated("other.csv", &["--effect", SPRING, "--seed", "7"]);
    let checked = diagnosed(&bench, &run, &["--accept", "0.5mm", "--check", &other]);
    assert!(flat(&checked.out).contains("of the rows of"), "{}", checked.out);
}

#[test]
fn the_last_campaign_is_compared_with() {
    let bench = Bench::new();
    let last = bench.path("last.json");
    let first = bench.simulated("first.csv", &["--effect", SPRING, "--effect", ZERO]);
    diagnosed(&bench, &first, &["--json", &last]).good();
    let softer = "joint_compliance@joint 2=9e-6 rad/(N·m)";
    let second = ["--effect", softer, "--effect", SLACK, "--seed", "3"];
    let second = bench.simulated("second.csv", &second);
    let out = flat(&diagnosed(&bench, &second, &["--compare", &last]).good());
    has(&out, &["new: backlash at joint 3", "no longer found: joint offset at joint 3"]);
    has(&out, &["joint compliance at joint 2: compliance ", "] µrad/(N·m), changed"]);
    assert!(!out.contains("same measurements"), "{out}");
    let page = bench.path("page.html");
    let again = diagnosed(&bench, &first, &["--compare", &last, "--report", &page]).good();
    let again = flat(&again);
    assert!(again.contains("both diagnoses are of the same measurements"), "{again}");
    assert!(
        again.contains("µrad/(N·m), no significant change") && !again.contains("new:"),
        "{again}"
    );
    let page = read(&page);
    assert!(page.contains("<li>both diagnoses are of the same measurements</li>"));
}

#[test]
fn the_corrected_arm_is_a_urdf_and_an_mjcf() {
    let bench = Bench::new();
    let run = bench.simulated("run.csv", &["--effect", ZERO, "--effect", SLACK]);
    let [better, urdf, mjcf] = ["better.toml", "arm.urdf", "arm.xml"].map(|name| bench.path(name));
    let extra =
        ["--write-robot", &better, "--write-urdf", &urdf, "--write-mjcf", &mjcf, "--seed", "1"];
    let written = diagnosed(&bench, &run, &extra).ended(0);
    let said = flat(&written.err);
    let lost =
        "a URDF has no place for the springs of joints 1, 3, backlash at joint 3: --write-robot";
    assert!(said.contains(lost), "{said}");
    assert!(said.contains("an MJCF has no place for backlash at joint 3: "), "{said}");
    // The zero that was found is in the URDF: read back, its tool is that of the corrected robot file.
    let back = stiffarm(&["import", &urdf]).ended(0);
    let back = bench.folder.file("back.toml", back.out);
    let position = |robot: &str| -> Vec<f64> {
        // Neither side of the play.
        let sides = if robot == better { &["--sides", "0,0,0"][..] } else { &[] };
        let at = ["eval", robot, "--q", "0.3,-0.8,1.1", "--json", "-"];
        numbers(&stiffarm(&[&at[..], sides].concat()).json()["position"])
    };
    let [corrected, back, nominal] = [&better, &back, &bench.robot].map(|robot| position(robot));
    let apart =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // Angles have nine digits in a robot file.
    assert!(apart(&corrected, &back) < 1e-8, "{corrected:?} {back:?}");
    assert!(apart(&corrected, &nominal) > 1e-4, "{corrected:?} {nominal:?}");
    assert!(read(&mjcf).contains("stiffness=\"400000\""));
}

#[test]
fn sessions_are_told_and_each_has_its_base() {
    let bench = Bench::new();
    let [one, two] = ["2", "3"].map(|seed| {
        let extra = ["--effect", SPRING, "--frames", "unknown", "--seed", seed];
        bench.simulated(&format!("{seed}.csv"), &extra)
    });
    let rows = |path: &str, name: &str, head: bool| -> String {
        let text = read(path);
        let lines = text.lines().filter(|line| !line.starts_with('#')).enumerate();
        let named = lines.filter(|(k, _)| head || *k > 0).map(|(k, line)| match k {
            0 => format!("session,{line}\n"),
            _ => format!("{name},{line}\n"),
        });
        named.collect()
    };
    // The tool is one, so that the second file is measured with the first one's: its own frames are
    // another tool's.
    let whole = rows(&one, "mon", true) + &rows(&one, "tue", false);
    let both = bench.folder.file("both.csv", whole);
    let nuisance = ["--nuisance", "base_frame,tool_frame"];
    let out = flat(&diagnosed(&bench, &both, &nuisance).good());
    assert!(out.contains("in 2 sessions, each with its own frame"), "{out}");
    has(&out, &["base frame in mon at (", "base frame in tue at ("]);
    assert!(out.contains("Joint 2 twists"), "{out}");
    // A session that comes again is refused at its line.
    let mixed = rows(&one, "mon", true) + &rows(&two, "tue", false) + &rows(&one, "mon", false);
    let mixed = bench.folder.file("mixed.csv", mixed);
    let err = diagnosed(&bench, &mixed, &nuisance).refused();
    assert!(err.contains("found session `mon` again"), "{err}");
}
