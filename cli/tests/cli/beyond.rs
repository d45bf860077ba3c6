//! What a robot file says beyond its table: every command that reads one honours it.

use crate::support::{Folder, Table, has, list, number, numbers, read, run, stiffarm};

const ARM: &str = "docs/workbench/arm.toml";

/// An effect that shows at every posture.
const RATIO: &str = "\n[[effect]]\nid = \"joint_ratio\"\nplace = \"joint 2\"\nratio = \"0.5 %\"\n";
/// One that a posture does not decide.
const SLACK: &str = "\n[[effect]]\nid = \"backlash\"\nplace = \"joint 2\"\nwidth = \"3 mrad\"\n";

/// Each command with the robot file as ROBOT, whose result is another with an effect; the others have no robot file.
const COMMANDS: &str = "\
eval ROBOT --q 0,0.5,0,0,0,0 --json -
check ROBOT --count 10
generate ROBOT --emit rust
map ROBOT --over q2,q3 --of condition --steps 3 --csv -
poses ROBOT --count 2 --csv -
identify ROBOT docs/workbench/run.csv --json -
diagnose ROBOT docs/workbench/check.csv --effects joint_offset --json -
predict ROBOT docs/workbench/check.csv --json -
simulate ROBOT --poses 2 --csv -
withhold ROBOT --cases 2 --poses 6 --json - --quiet
compensate ROBOT --targets docs/workbench/path.csv --out - --quiet
controller ROBOT --format kuka-mastering --nominal kuka_kr240 --into tests/data/machine.dat
robots
import
papers
effects
measurements
completions
man";

/// The robot file with something behind it.
fn with(folder: &Folder, name: &str, more: &str) -> String {
    folder.file(name, read(ARM) + more)
}

#[test]
fn no_command_leaves_an_effect_out_in_silence() {
    let help = stiffarm(&["--help"]).good();
    let listed = help.split("Commands:").nth(1).and_then(|l| l.split("Options:").next());
    let listed = listed.expect("a list of commands").lines();
    let listed: Vec<&str> = listed.filter_map(|line| line.split_whitespace().next()).collect();
    let name = |line: &'static str| line.split(' ').next().unwrap_or_default();
    let mut known: Vec<&str> = COMMANDS.lines().map(name).chain(["help"]).collect();
    known.sort_unstable();
    let mut sorted = listed.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, known, "say what a new command does with an effect");
    let folder = Folder::new();
    let plain = with(&folder, "plain.toml", "");
    let beyond = with(&folder, "beyond.toml", RATIO);
    for line in COMMANDS.lines().filter(|line| line.contains("ROBOT")) {
        let [without, with] = [&plain, &beyond].map(|robot| run(&line.replace("ROBOT", robot)));
        assert!(with.status < 2 && without.status < 2, "{line}: {}", with.err);
        assert_ne!(with.out, without.out, "{line}");
    }
}

/// The same as another robot's table: what an entry holds is in it, wherever the file says so.
#[test]
fn what_the_table_holds_is_taken_into_it() {
    let folder = Folder::new();
    let offset = "\n[[effect]]\nid = \"joint_offset\"\nplace = \"joint 1\"\noffset = \"2 mrad\"\n";
    let robot = with(&folder, "offset.toml", offset);
    let emit = |robot: &str| run(&format!("generate {robot} --emit rust")).good();
    let text = emit(&robot);
    assert!(text.contains("q + 0.002"), "{text}");
    assert_ne!(text, emit(ARM));
    let at = |robot: &str, q: &str| -> Vec<f64> {
        numbers(&stiffarm(&["eval", robot, "--q", q, "--json", "-"]).json()["position"])
    };
    let moved = at(ARM, "0.102,0.2,0.3,0.4,0.5,0.6");
    for (a, b) in at(&robot, "0.1,0.2,0.3,0.4,0.5,0.6").iter().zip(moved) {
        assert!((a - b).abs() < 1e-14, "{a} {b}");
    }
}

#[test]
fn what_a_posture_does_not_decide_is_refused_until_it_is_said() {
    let folder = Folder::new();
    let robot = with(&folder, "slack.toml", SLACK);
    let at = "0.2,1.2,-0.9,0.3,0.8,-0.4";
    let pose = stiffarm(&["eval", ARM, "--q", at, "--json", "-"]).json();
    let turn = nalgebra::Matrix3::from_fn(|r, c| number(&pose["rotation"][r][c]));
    let turn = nalgebra::Rotation3::from_matrix(&turn).scaled_axis();
    let place = numbers(&pose["position"]);
    let goal: Vec<String> = place.iter().chain(&turn).map(f64::to_string).collect();
    let compensate = |columns: &str, cells: &str| {
        let goal = goal.join(",");
        let targets = format!("q1,q2,q3,q4,q5,q6,{columns}x,y,z,rx,ry,rz\n{at},{cells}{goal}\n");
        let targets = folder.file("targets.csv", targets);
        stiffarm(&["compensate", &robot, "--targets", &targets, "--out", "-", "--quiet"])
    };
    let err = compensate("", "").refused();
    has(&err, &["the backlash at joint 2: neither columns s1 … sn nor --sides say"]);
    // From where joint 2 comes to rest: half the play to either side.
    let [below, above] = ["1,", "-1,"].map(|side| {
        let out = compensate("s2,", side).good();
        assert!(out.ends_with("reached\n"), "{out}");
        Table::of(&out).numbers("q2[deg]")[0]
    });
    assert!(((below - above).to_radians() - 3e-3).abs() < 2e-6, "{below} {above}");
}

/// A commanded and compensated tool stands where it should, on the arm that has the effect.
#[test]
fn a_compensated_arm_with_an_effect_reaches_its_targets() {
    let folder = Folder::new();
    let base = "\n[base]\ntranslation = [0.5, -0.25, 0.1]\nrotation = [0.0, 0.0, \"pi/2\"]\n";
    let robot = with(&folder, "beyond.toml", &format!("{base}{RATIO}"));
    let start = "q1,q2,q3,q4,q5,q6,x,y,z,rx,ry,rz\n0.2,1.2,-0.9,0.3,0.8,-0.4,0,0,0,0,0,0\n";
    let start = folder.file("q.csv", start);
    let exact = ["--noise-position", "0mm", "--noise-rotation", "0deg", "--csv", "-"];
    let shown = |robot: &str, poses: &str| {
        let out = stiffarm(&[&["simulate", robot, poses][..], &exact].concat()).good();
        let last = out.lines().last().expect("a row").to_owned();
        let header = out.lines().find(|line| line.starts_with("q1")).expect("a header").to_owned();
        (header, last)
    };
    // Where the arm with the effect stands at some set-points is a target that they reach.
    let (header, row) = shown(&robot, &start);
    let there = folder.file("there.csv", format!("{header}\n{row}\n"));
    let out =
        stiffarm(&["compensate", &robot, "--targets", &there, "--out", "-", "--quiet"]).good();
    let reached = out.lines().last().expect("a row");
    assert!(reached.ends_with("reached"), "{out}");
    let cells: Vec<f64> =
        reached.split(',').take(6).map(|c| c.parse().expect("a number")).collect();
    for (found, commanded) in cells.iter().zip([0.2_f64, 1.2, -0.9, 0.3, 0.8, -0.4]) {
        assert!((found - commanded.to_degrees()).abs() < 1e-5, "{out}");
    }
}

#[test]
fn a_base_stands_somewhere() {
    let folder = Folder::new();
    let base = "\n[base]\ntranslation = [0.5, -0.25, 0.1]\nrotation = [0.0, 0.0, \"pi/2\"]\n";
    let robot = with(&folder, "base.toml", base);
    let eval = |robot: &str| -> serde_json::Value {
        let wrench = "--wrench=30,0,-100,0,5,0";
        let q = "0.1,-0.8,0.9,0.4,0.5,0.6";
        stiffarm(&["eval", robot, "--q", q, wrench, "--gravity", "--json", "-"]).json()
    };
    let (own, world) = (eval(ARM), eval(&robot));
    let at = |value: &serde_json::Value, key: &str, k: usize| number(&value[key][k]);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{a} {b}");
    // A quarter turn about z takes x to y and y to −x.
    near(at(&world, "position", 0), 0.5 - at(&own, "position", 1));
    near(at(&world, "position", 1), -0.25 + at(&own, "position", 0));
    near(at(&world, "position", 2), 0.1 + at(&own, "position", 2));
    for k in [0, 3] {
        near(at(&world, "deflection", k), -at(&own, "deflection", k + 1));
        near(at(&world, "deflection", k + 1), at(&own, "deflection", k));
    }
    // The wrench is told in the base's axes by every command: it loads the joints alike.
    for k in 0..6 {
        near(at(&world, "joint_torque", k), at(&own, "joint_torque", k));
    }
    stiffarm(&["check", &robot, "--count", "50"]).good();
}

/// The same springs of the same arm, wherever it stands.
#[test]
fn springs_are_identified_wherever_the_arm_stands() {
    let folder = Folder::new();
    let base = "\n[base]\ntranslation = [0.5, -0.25, 0.1]\nrotation = [0.3, -0.2, 1.1]\n";
    let springs = |robot: &str| -> Vec<f64> {
        let data = folder.name("run.csv");
        let exact = "--poses 12 --noise-position 0mm --noise-rotation 0deg --design force";
        let soft = "--effect 'joint_compliance@joint 2=1e-7'";
        run(&format!("simulate {robot} {exact} {soft} --csv {data}")).good();
        let found = stiffarm(&["identify", robot, &data, "--json", "-"]).json();
        list(&found["parameters"]).iter().map(|p| number(&p["value"])).collect()
    };
    let (here, there) = (springs(ARM), springs(&with(&folder, "base.toml", base)));
    assert!((here[1] * 6.6e6 - 1.66).abs() < 0.01, "{here:?}");
    for (a, b) in here.iter().zip(&there) {
        assert!((a / b - 1.0).abs() < 1e-6, "{here:?} {there:?}");
    }
}
