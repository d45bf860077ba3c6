//! Diagnoses of plants: arms with effects that only the test knows.

use serde_json::Value;
use stiffarm_gap::measurement::Kind;
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Frames, Noise, Plant, Truth, csv};

use super::line;
use crate::support::{Folder, arm_of, flat, has, json, list, number, read, stiffarm};

const ROBOT: &str = include_str!("shoulder.toml");

pub const SPRING: &str = "joint_compliance@joint 2=6e-6 rad/(N·m)";
pub const ZERO: &str = "joint_offset@joint 3=0.8 mrad";
pub const SLACK: &str = "backlash@joint 3=0.5 mrad";

/// A folder with the robot file, and measurements of it.
pub struct Bench {
    pub folder: Folder,
    pub robot: String,
}

impl Bench {
    pub fn new() -> Bench {
        let folder = Folder::new();
        let robot = folder.file("arm.toml", ROBOT);
        Bench { folder, robot }
    }

    pub fn path(&self, name: &str) -> String {
        self.folder.name(name)
    }

    /// By the command itself.
    pub fn simulated(&self, name: &str, extra: &[&str]) -> String {
        let path = self.path(name);
        let arguments = ["simulate", &self.robot, "--poses", "20", "--csv", &path];
        stiffarm(&[&arguments[..], extra].concat()).good();
        path
    }

    /// By a plant with these truths.
    pub fn measured(&self, name: &str, truths: &[&str], seed: u64, unknown_frames: bool) -> String {
        let arm = arm();
        let truths: Vec<Truth> =
            truths.iter().map(|t| Truth::parse(t, &arm).expect("an effect of this arm")).collect();
        let design = Design {
            shape: Shape::Payload,
            poses: 16,
            repeats: 1,
            payload: 15.0,
            kind: Kind::Pose { orientation: true },
            seed,
        };
        let mut plant = Plant::new(&arm, &truths).expect("a plant");
        if unknown_frames {
            plant = plant.with_frames(Frames::unknown(seed));
        }
        let noise = Noise { position: 2e-5, rotation: 4e-5 };
        let measured = plant.measure(&design.rows(&arm), noise, seed).expect("it stands");
        self.folder.file(name, csv(&arm, &measured, &[]))
    }

    fn diagnose(&self, robot: &str, data: &str, extra: &[&str]) -> String {
        stiffarm(&[&["diagnose", robot, data], extra].concat()).good()
    }

    fn json(&self, robot: &str, data: &str, extra: &[&str]) -> Value {
        let out = self.diagnose(robot, data, &[extra, &["--json", "-"]].concat());
        json(&out)
    }
}

/// The arm of the robot file.
fn arm() -> Arm {
    arm_of(ROBOT)
}

/// `effect at place`, in order.
fn findings(found: &Value) -> Vec<String> {
    let name = |f: &Value| {
        let word = |key: &str| f[key].as_str().expect("a word").to_owned();
        format!("{} at {}", word("effect"), word("place"))
    };
    list(&found["findings"]).iter().map(name).collect()
}

#[test]
fn two_effects_are_told_in_one_screen() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SPRING, ZERO], 1, false);
    let out = bench.diagnose(&bench.robot, &run, &[]);
    let lines: Vec<&str> = out.lines().collect();
    assert!(lines.len() <= 40 && lines.iter().all(|l| l.chars().count() <= 100), "{out}");
    assert_eq!(lines[0], "shoulder and elbow");
    let whole = flat(&out);
    has(
        &whole,
        &[
            "oint 2 twists 6.0",
            " µrad/(N·m) more than modelled",
            "he zero of joint 3 is off by 0.80",
            "; modelling both removes ",
            " % of the position error, ",
            "stiffness 1.6",
        ],
    );
    for number in ["1", "2"] {
        let title = line(&out, &format!("{number}  "));
        assert!(title.contains(&"→") && title.contains(&"less"), "{out}");
        assert!(title.iter().any(|word| word.contains('░')), "{out}");
    }
    assert!(out.contains("joint compliance at joint 2") && out.contains("joint offset at joint 3"));
    has(&out, &["with the findings, held out", "Located at  ", "Unobservable  ", "Depends on    "]);
}

#[test]
fn what_is_found_adds_to_what_the_file_has() {
    let bench = Bench::new();
    // Joint 3 is three times as soft as its file says.
    let run = bench.measured("run.csv", &["joint_compliance@joint 3=6.667e-6"], 10, false);
    let text = read(&run);
    let lines = text.lines().enumerate();
    let longer = lines.map(|(k, l)| format!("{l},{}\n", if k == 0 { "temprature" } else { "21" }));
    let run = bench.folder.file("run.csv", longer.collect::<String>());
    let noise = ["--noise-position", "20um", "--noise-rotation", "0.04mrad", "--folds", "4"];
    let out = bench.diagnose(&bench.robot, &run, &noise);
    has(&out, &["held out in 4 folds of poses", "noise, as given", "joint compliance at joint 3"]);
    let said = flat(&out);
    let after = |begins: &str| {
        let found = said.split(begins).nth(1).unwrap_or_else(|| panic!("no {begins} in {out}"));
        found.split(' ').next().and_then(|n| n.parse::<f64>().ok()).expect("a number")
    };
    assert!((after("compliance, added ") - 6.667).abs() < 0.1, "{out}");
    assert!((after("; stiffness ") / 1e5 - 1.0).abs() < 0.02, "{out}");
    assert!(said.contains(" µrad/(N·m) [") && !out.contains("lbf"), "{out}");
    assert!(said.contains("Unexplained nothing beyond the noise"), "{out}");
    assert!(said.contains("column temprature (did you mean temperature?)"), "{out}");
}

#[test]
fn unknown_frames_are_fitted_along() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SPRING], 2, true);
    let frames = ["--nuisance", "base_frame,tool_frame"];
    let out = bench.diagnose(&bench.robot, &run, &frames);
    has(&out, &["with unknown frames fitted", "Co-estimated  base frame at ("]);
    let found = bench.json(&bench.robot, &run, &frames);
    assert_eq!(findings(&found), ["joint_compliance at joint 2"]);
    assert_eq!(found["nuisances"][1]["name"], "tool_frame");

    // Tool and base go into the robot file: nothing is unknown then.
    let better = bench.path("better.toml");
    bench.diagnose(&bench.robot, &run, &[&frames[..], &["--write-robot", &better]].concat());
    let written = read(&better);
    for frame in ["tool_frame", "base_frame"] {
        assert!(written.contains(&format!("#   {frame}, co-estimated: at [")), "{written}");
    }
    assert!(written.contains("\n[base]\n") && written.contains("\n[tool]\n"), "{written}");
    assert_eq!(findings(&bench.json(&better, &run, &[])), [""; 0]);
}

#[test]
fn the_corrected_robot_has_no_gap_left() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SPRING, ZERO], 3, false);
    let better = bench.folder.file("better.toml", "before");
    let first = bench.diagnose(&bench.robot, &run, &["--write-robot", &better]);
    assert!(first.contains("Findings"), "{first}");
    let written = read(&better);
    assert!(written.starts_with("# Corrected by stiffarm "), "{written}");
    has(&written, &["#   joint_compliance at joint 2: compliance ", ", in stiffness of joint 2\n"]);
    assert!(written.contains(", in theta of joint 3\n"), "{written}");
    // What was not found stays as it was, exact angles and all.
    has(&written, &["alpha = \"pi/2\"", "theta = \"-pi/2\"", "stiffness = 400000.0", "\"pi/4\"]"]);
    let again = bench.json(&better, &run, &[]);
    assert_eq!(findings(&again), [""; 0]);
    assert_eq!(again["unexplained"]["present"], false);
    // The same from other measurements of the arm.
    let other = bench.measured("other.csv", &[SPRING, ZERO], 4, false);
    assert_eq!(findings(&bench.json(&better, &other, &[])), [""; 0]);
    let said = bench.diagnose(&better, &other, &["--noise-position", "20um"]);
    let said = flat(&said);
    assert!(said.contains("is noise (") && said.contains("is missing from the model"), "{said}");

    let twice = bench.path("twice.toml");
    bench.diagnose(&bench.robot, &run, &["--write-robot", &twice]);
    assert_eq!(read(&twice), written);
    assert_eq!(bench.diagnose(&bench.robot, &run, &["--write-robot", &twice, "--quiet"]), "");
    assert_eq!(bench.diagnose(&bench.robot, &run, &["--write-robot", "-"]), written);
}

#[test]
fn what_the_table_cannot_hold_is_an_effect() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SLACK], 5, false);
    let better = bench.path("better.toml");
    bench.diagnose(&bench.robot, &run, &["--write-robot", &better]);
    let written = read(&better);
    has(&written, &["#   backlash at joint 3: width ", "], in an [[effect]]\n"]);
    // A diagnosis is a robot to every command: the one that it found.
    let json = bench.path("found.json");
    bench.diagnose(&bench.robot, &run, &["--json", &json]);
    let gap = |robot: &str| bench.json(robot, &run, &[])["gap"].clone();
    assert_eq!(gap(&json), gap(&better));
    let none = bench.folder.file("none.json", "{}");
    let err = stiffarm(&["diagnose", &none, &run]).refused();
    assert!(err.contains("none.json: found no `corrected`, expected a diagnosis"), "{err}");
    let effect = "\n[[effect]]\nid = \"backlash\"\nplace = \"joint 3\"\nwidth = ";
    assert!(written.contains(effect), "{written}");
    assert_eq!(findings(&bench.json(&better, &run, &[])), [""; 0]);
}

#[test]
fn another_file_is_predicted() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SPRING, ZERO], 6, false);
    let other = bench.measured("other.csv", &[SPRING, ZERO], 7, false);
    let found = bench.json(&bench.robot, &run, &["--check", &other]);
    let check = &found["check"];
    let keys: Vec<&String> = check.as_object().expect("an object").keys().collect();
    assert_eq!(keys, ["file", "rows", "inside", "fitted", "before", "after", "all"]);
    assert_eq!(check["fitted"], false);
    assert_eq!((check["file"].as_str(), check["rows"].as_u64()), (Some(&*other), Some(48)));
    let inside = check["inside"].as_u64().expect("a number");
    assert!(0 < inside && inside < 48, "{check}");
    let rms = |which: &str| number(&check[which]["position_rms"]);
    // Three coordinates with a standard deviation of 20 µm.
    let noise = 2e-5 * 3.0_f64.sqrt();
    assert!(rms("before") > 10.0 * noise && rms("after") < 1.3 * noise, "{check}");
    let out = bench.diagnose(&bench.robot, &run, &["--check", &other]);
    let said = flat(&out);
    let part = format!("on {inside} of the 48 rows of ");
    assert!(said.contains(&part) && said.contains("; on all rows, extrapolated, "), "{out}");
    let all = |which: usize| number(&check["all"][which]["position_rms"]);
    assert!(all(0) > all(1) && all(1) > 0.0, "{check}");

    // Rows that all lie elsewhere are not judged at all.
    let far = "q1,q2,q3,x,y,z,rx,ry,rz\n50,0,0,1,0,0,0,0,0\n51,0,0,1,0,0,0,0,0\n";
    let far = bench.folder.file("far.csv", far);
    let found = bench.json(&bench.robot, &run, &["--check", &far, "--quiet"]);
    assert_eq!(found["check"]["inside"], 0);
    assert_eq!(found["check"]["after"], Value::Null);
    let out = bench.diagnose(&bench.robot, &run, &["--check", &far, "--quiet"]);
    assert!(out.contains("none is judged"), "{out}");
    assert!(bench.json(&bench.robot, &run, &[]).get("check").is_none());
}

/// What is announced for the rows that were fitted is what `--check` says of them, and what a diagnosis
/// of the written robot begins with.
#[test]
fn the_rows_that_were_fitted_are_known_again() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SPRING, ZERO], 6, false);
    let better = bench.path("better.toml");
    let found = bench.json(&bench.robot, &run, &["--check", &run, "--write-robot", &better]);
    assert_eq!(found["check"]["fitted"], true);
    let fitted = &found["gap"]["fitted"];
    let again = bench.json(&better, &run, &[]);
    for kind in ["position_rms", "rotation_rms"] {
        let ratio = |other: &Value| number(&other[kind]) / number(&fitted[kind]);
        // From where the arm comes to rest shows in the last digits, and what is written has seven.
        assert!((ratio(&found["check"]["after"]) - 1.0).abs() < 1e-9, "{kind}");
        assert!((ratio(&again["gap"]["before"]) - 1.0).abs() < 1e-3, "{kind}");
    }
    let said = flat(&bench.diagnose(&bench.robot, &run, &["--check", &run]));
    assert!(said.contains("with the findings, on the fitted rows"), "{said}");
    assert!(said.contains("which are the fitted rows: on new rows expect"), "{said}");
}

#[test]
fn what_is_usual_may_be_told() {
    let bench = Bench::new();
    let run = bench.measured("run.csv", &[SPRING], 6, false);
    let named = |extra: &[&str]| findings(&bench.json(&bench.robot, &run, extra))[0].clone();
    let usual = named(&[]);
    // Nobody who knows that joints are a million times stiffer than that believes in a spring.
    let told = named(&["--usual", "joint_compliance=1e-14"]);
    assert!(usual.starts_with("joint_compliance") && !told.starts_with("joint_compliance"));
}

#[test]
fn a_marker_without_a_place_is_fitted() {
    let folder = Folder::new();
    let robot = folder.file("arm.toml", format!("{ROBOT}\n[[marker]]\nname = \"smr\"\n"));
    let arm = arm();
    // The marker stands at (40, −10, 25) mm of the tool; the arm is as its file says.
    let marker = nalgebra::Point3::new(0.04, -0.01, 0.025);
    let mut rows = "marker,q1,q2,q3,x[mm],y[mm],z[mm]\n".to_owned();
    for k in 0..20 {
        let angle = |by: f64| (f64::from(k) * by).sin() * 1.5;
        let q = [angle(1.3), angle(2.1), angle(0.7)];
        let loaded = stiffarm_gap::simulate::equilibrium(&arm, &q, &nalgebra::Vector6::zeros());
        let at = loaded.expect("it stands").tool * marker;
        let jitter = |by: f64| 0.01 * (f64::from(k) * by).sin();
        let [x, y, z] = [at.x, at.y, at.z].map(|x| 1e3 * x);
        let [x, y, z] = [x + jitter(12.9), y + jitter(78.2), z + jitter(37.7)];
        rows.push_str(&format!("smr,{},{},{},{x},{y},{z}\n", q[0], q[1], q[2]));
    }
    let run = folder.file("run.csv", rows);
    let out = stiffarm(&["diagnose", &robot, &run]).good();
    assert!(!out.contains("Findings"), "{out}");
    let fitted = line(&out, "Co-estimated").join(" ");
    assert!(fitted.starts_with("Co-estimated smr at (40.0, −"), "{fitted}");
}
