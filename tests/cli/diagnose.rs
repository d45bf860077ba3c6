//! `stiffarm diagnose`.

use serde_json::Value;

use crate::support::{Folder, stiffarm, text};

const LIN: [&str; 3] =
    ["diagnose", "robots/arms/lin_planar.toml", "robots/data/lin1991_table3.csv"];
const RIVALS: [&str; 4] = ["--rival", "ycd", "--rival", "ytd"];

fn lin(extra: &[&str]) -> String {
    stiffarm(&[&LIN[..], extra].concat()).good()
}

fn line<'a>(out: &'a str, begins: &str) -> Vec<&'a str> {
    let found = out.lines().find(|line| line.trim_start().starts_with(begins));
    found.unwrap_or_else(|| panic!("no line `{begins}` in\n{out}")).split_whitespace().collect()
}

#[test]
fn lins_gap_is_closed_by_a_spring_at_joint_1() {
    let out = lin(&RIVALS);
    // What bending links alone leave is 7.41 mil rms; with the spring 0.89 mil, leave-one-out.
    assert_eq!(line(&out, "as the robot file is")[5], "7.41");
    assert_eq!(line(&out, "with the finding, held out")[5], "0.89");
    assert!(out.contains("rms mil"), "{out}");
    assert!(out.contains("joint compliance at joint 1"), "{out}");
    assert!(out.contains("7.41 → 0.89 mil rms"), "{out}");
    let stiffness = line(&out, "stiffness").join(" ");
    assert!(stiffness.contains("N·m/rad") && stiffness.contains("2.14e5 in·lbf/rad"), "{out}");
    // Twelve points do not tell it from the paper's own explanation.
    assert!(out.contains("over 12 poses ours is"), "{out}");
    for rival in ["ycd", "ytd"] {
        let line = line(&out, rival).join(" ");
        assert!(line.ends_with("not significantly better"), "{line}");
    }
    assert!(!out.contains("Not used"), "{out}");
    let lines: Vec<&str> = out.lines().collect();
    assert!(lines.len() <= 24 && lines.iter().all(|l| l.chars().count() <= 100), "{out}");
}

#[test]
fn columns_that_are_not_used_are_named() {
    let out = lin(&[]);
    assert!(out.contains("Not used  columns ycd_dy[in], ytd_dy[in]"), "{out}");
    assert!(!out.contains("Compared"), "{out}");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let folder = Folder::new();
    let json = |name: &str, seed: &str| {
        let file = text(&folder.path(name));
        let screen = lin(&[&RIVALS[..], &["--json", &file, "--seed", seed]].concat());
        assert!(screen.contains("7.41"), "{screen}");
        std::fs::read_to_string(file).expect("written")
    };
    let (first, again, other) = (json("a", "3"), json("b", "3"), json("c", "4"));
    assert_eq!(first, again);
    assert_ne!(first, other);
    assert!(first.ends_with("}\n"));
    assert_eq!(folder.names(), ["a", "b", "c"]);
    let printed = lin(&[&RIVALS[..], &["--json", "-", "--seed", "3"]].concat());
    assert_eq!(printed, first);
    assert_eq!(lin(&["--json", &text(&folder.path("d")), "--quiet"]), "");
}

#[test]
fn the_json_is_the_formats() {
    let out = lin(&["--json", "-"]);
    let found: Value = serde_json::from_str(&out).expect("JSON");
    let keys: Vec<&String> = found.as_object().expect("an object").keys().collect();
    let expected = [
        "stiffarm",
        "robot",
        "measurements",
        "held_out",
        "gap",
        "where",
        "findings",
        "cannot_see",
        "unexplained",
    ];
    assert_eq!(keys, expected);
    assert_eq!(found["stiffarm"], env!("CARGO_PKG_VERSION"));
    let finding = &found["findings"][0];
    assert_eq!(finding["effect"], "joint_compliance");
    assert_eq!(finding["place"], "joint 1");
    let mil = |v: &Value| v.as_f64().expect("a number") / 2.54e-5;
    assert!((mil(&found["gap"]["before"]["position_rms"]) - 7.41).abs() < 5e-3);
    assert!((mil(&found["gap"]["after"]["position_rms"]) - 0.89).abs() < 5e-3);
    let rivals: Value =
        serde_json::from_str(&lin(&[&RIVALS[..], &["--json", "-"]].concat())).expect("JSON");
    assert_eq!(rivals["rivals"][0]["significant"], false);
}

/// An elbow of two joints with one soft spring that its file does not have, measured in mm.
fn data(folder: &Folder, extra: &str, cell: &str) -> (String, String) {
    let robot = "name = \"elbow\"\nconvention = \"standard\"\ngravity = [0, 0, 0]\n\
                 [[joint]]\ntype = \"revolute\"\na = 0.5\nstiffness = 1e5\n\
                 [[joint]]\ntype = \"revolute\"\na = 0.4\nstiffness = 1e5\n";
    let mut rows = format!("q1[deg],q2[deg],fy[N],dx[mm],dy[mm]{extra}\n");
    for k in 0..16 {
        let (q1, q2) = (f64::from(k * 23 % 90), f64::from(k * 37 % 120));
        let (c1, c12) = (q1.to_radians().cos(), (q1 + q2).to_radians().cos());
        let (s1, s12) = (q1.to_radians().sin(), (q1 + q2).to_radians().sin());
        let (x, y) = (0.5 * c1 + 0.4 * c12, 0.5 * s1 + 0.4 * s12);
        let force = -200.0;
        // Joint 2 is four times softer than its file says.
        let (turn1, turn2) = (force * x / 1e5, force * 0.4 * c12 / 2.5e4);
        let jitter = 2e-6 * (f64::from(k) * 12.9898).sin();
        let dx = 1e3 * (-y * turn1 - 0.4 * s12 * turn2 + jitter);
        let dy = 1e3 * (x * turn1 + 0.4 * c12 * turn2 - jitter);
        rows.push_str(&format!("{q1},{q2},{force},{dx},{dy}{cell}\n"));
    }
    (folder.file("elbow.toml", robot), folder.file("run.csv", rows))
}

#[test]
fn what_is_found_adds_to_what_the_file_has() {
    let folder = Folder::new();
    let (robot, run) = data(&folder, ",temprature", ",21.5");
    let out =
        stiffarm(&["diagnose", &robot, &run, "--noise-position", "2um", "--folds", "4"]).good();
    assert!(out.contains("joint compliance at joint 2"), "{out}");
    assert!(out.contains("held out in 4 folds of poses"), "{out}");
    assert!(out.contains("rms µm") || out.contains("rms mm"), "{out}");
    let added = line(&out, "compliance, added").join(" ");
    assert!(
        added.contains("3.0") && added.contains("rad/(N·m)") && !added.contains("lbf"),
        "{added}"
    );
    let stiffness = line(&out, "stiffness").join(" ");
    assert!(stiffness.starts_with("stiffness 2.5"), "{stiffness}");
    assert!(out.contains("noise, as given"), "{out}");
    assert!(out.contains("temprature (did you mean temperature?)"), "{out}");
}

#[test]
fn no_finding_is_said_too() {
    let folder = Folder::new();
    let robot = folder.file(
        "arm.toml",
        "name = \"arm\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\na = 1.0\n",
    );
    // Without a load no spring shows.
    let run = folder.file("run.csv", "q1,dx,dy\n0.1,1e-4,0\n0.2,-1e-4,1e-5\n0.3,0,-2e-5\n");
    let out = stiffarm(&["diagnose", &robot, &run]).good();
    assert!(out.contains("No finding"), "{out}");
    assert!(out.contains("Cannot see  joint compliance at joint 1: no load"), "{out}");
}
