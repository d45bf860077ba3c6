//! Arms that move: `simulate --log`, `withhold --motion`, `poses --for motion`.

use serde_json::Value;

use crate::support::{Folder, stiffarm};

/// An elbow above an upright axis, with rotors and friction.
pub const ELBOW: &str = "\
name = \"elbow\"
convention = \"standard\"

[[joint]]
type = \"revolute\"
d = 0.4
alpha = \"pi/2\"
mass = 8.0
com = [0.0, -0.1, 0.0]
inertia = [0.1, 0.0, 0.0, 0.1, 0.0, 0.1]
gear = 100.0
rotor_inertia = 5e-5
coulomb = 4.0
viscous = 3.0
limits = [-2.5, 2.5]

[[joint]]
type = \"revolute\"
a = 0.5
mass = 6.0
com = [-0.25, 0.0, 0.0]
inertia = [0.02, 0.0, 0.0, 0.15, 0.0, 0.15]
gear = 100.0
rotor_inertia = 5e-5
coulomb = 4.0
viscous = 3.0
limits = [-1.0, 2.0]

[[joint]]
type = \"revolute\"
a = 0.4
mass = 3.0
com = [-0.2, 0.0, 0.0]
inertia = [0.01, 0.0, 0.0, 0.05, 0.0, 0.05]
gear = 100.0
rotor_inertia = 2e-5
coulomb = 2.0
viscous = 1.0
limits = [-2.0, 2.0]
";

fn columns(csv: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    let names = lines.next().expect("a header").split(',').collect();
    let row = |line: &str| line.split(',').map(|cell| cell.parse().expect("a number")).collect();
    (names, lines.map(row).collect())
}

#[test]
fn a_simulated_log_is_diagnosed() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let log = folder.name("log.csv");
    let effect = ["--effect", "coulomb_friction@joint 2=3 N·m"];
    let run = [&["simulate", &robot, "--log", &log], &effect[..]].concat();
    stiffarm(&run).good();
    let written = std::fs::read_to_string(&log).expect("written");
    assert!(written.contains("# effect coulomb_friction@joint 2:coulomb=3e0 (SI)"), "{written}");
    assert!(written.contains("# torque_side = motor"), "{written}");
    let found = stiffarm(&["diagnose", &robot, &log, "--quiet"]).good();
    assert!(found.contains("coulomb friction at joint 2"), "{found}");
    // The same bytes again; without the effect's name where it is withheld.
    let again = |extra: &[&str]| {
        let run = [&["simulate", &robot, "--log", "-"], &effect[..], extra].concat();
        stiffarm(&run).good()
    };
    assert_eq!(again(&[]), written);
    let blind = again(&["--withhold"]);
    assert!(blind.contains("# effects withheld") && !blind.contains("coulomb"), "{blind}");
}

/// What the file says of the arm in motion is part of the arm, and no gap.
#[test]
fn effects_of_a_robot_file_act_in_a_motion() {
    let folder = Folder::new();
    let effect = "\n[[effect]]\nid = \"coulomb_friction\"\nplace = \"joint 2\"\ncoulomb = 3.0\n";
    let plain = folder.file("elbow.toml", ELBOW);
    let robot = folder.file("knows.toml", format!("{ELBOW}{effect}"));
    let log = folder.name("log.csv");
    stiffarm(&["simulate", &robot, "--log", &log, "--lost", "0%"]).good();
    let only = ["--effects", "coulomb_friction", "--json", "-"];
    let found = |robot: &str| -> Value {
        let run = [&["diagnose", robot, &log], &only[..]].concat();
        stiffarm(&run).json()
    };
    let without = found(&plain);
    assert_eq!(without["findings"][0]["place"], "joint 2", "{without:#}");
    let value = without["findings"][0]["parameters"][0]["value"].as_f64().expect("a number");
    assert!((value - 3.0).abs() < 0.3, "{value}");
    let known = found(&robot);
    let again = known["findings"].as_array().expect("a list").iter();
    assert!(again.clone().all(|f| f["place"] != "joint 2"), "{known:#}");
    let run = ["withhold", &robot, "--motion", "--cases", "2", "--period", "15s", "--json", "-"];
    let page = folder.name("check.html");
    let also = ["--effects", "viscous_friction", "--report", &page];
    let json = stiffarm(&[&run[..], &also].concat()).json();
    let page = std::fs::read_to_string(page).expect("written");
    assert!(page.contains("3 runs of ") && page.contains("viscous_friction"), "{page}");
    assert_eq!(json["failed"], 0, "{json}");
}

/// The commands hold the limits, and the arm follows them.
#[test]
fn a_chosen_motion_is_what_simulate_takes() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let commands = folder.name("commands.csv");
    let limits = ["--max-rate", "1.2", "--max-acceleration", "4"];
    let plan = ["poses", &robot, "--for", "motion", "--period", "8s", "--harmonics", "5"];
    let screen = stiffarm(&[&plan[..], &limits, &["--csv", &commands]].concat()).good();
    assert!(screen.contains("coulomb friction at joint 3") && screen.contains(" ×"), "{screen}");
    assert!(screen.contains("rotor inertia at joint 1"), "{screen}");
    let written = std::fs::read_to_string(&commands).expect("written");
    let (names, rows) = columns(&written);
    assert_eq!(names[..4], ["t[s]", "q_cmd1[rad]", "q_cmd2[rad]", "q_cmd3[rad]"]);
    assert_eq!(rows.len(), 801);
    for row in &rows {
        for (q, [low, high]) in row[1..4].iter().zip([[-2.5, 2.5], [-1.0, 2.0], [-2.0, 2.0]]) {
            assert!((low..=high).contains(q), "{row:?}");
        }
        assert!(row[4..].iter().all(|rate| rate.abs() <= 1.2), "{row:?}");
    }
    let still = |row: &[f64]| row[4..].iter().all(|rate| rate.abs() < 1e-6);
    assert!(still(&rows[0]) && still(&rows[800]));
    let run =
        ["simulate", &robot, &commands, "--log", "-", "--logged", "position", "--rate", "100Hz"];
    let log = stiffarm(&[&run[..], &["--lost", "0%", "--jitter", "0s"]].concat()).good();
    let (names, followed) = columns(&log);
    assert_eq!(names[1..4], ["q1[rad]", "q2[rad]", "q3[rad]"]);
    for (sent, row) in rows.iter().zip(&followed) {
        // Knots every 20 ms of motions up to 5/8 Hz, readings of 0.0005 rad: six of them.
        assert!((0..3).all(|j| (sent[1 + j] - row[1 + j]).abs() < 3.5e-3), "{sent:?} {row:?}");
    }
}

#[test]
fn two_effects_are_told_from_each_other_by_a_motion() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let plan = ["poses", &robot, "--for", "motion", "--harmonics", "4", "--csv"];
    let pair = ["viscous_friction@joint 2", "friction_curve@joint 2"];
    let csv = folder.name("commands.csv");
    let screen = stiffarm(&[&plan[..], &[csv.as_str()], &pair].concat()).good();
    assert!(screen.contains("friction curve at joint 2: root"), "{screen}");
}

#[test]
fn logs_are_withheld() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let effects = ["--effects", "coulomb_friction,viscous_friction"];
    let run = ["withhold", &robot, "--motion", "--cases", "6", "--period", "15s", "--json", "-"];
    let json = stiffarm(&[&run[..], &effects].concat()).json();
    assert_eq!(json["cases"].as_array().expect("cases").len(), 6);
    assert_eq!((&json["runs"], &json["failed"]), (&Value::from(3), &Value::from(0)));
    // How often it is right is the suite's to say: `tests/withheld/logs.rs`.
    assert_eq!(json["single"]["first_named"]["of"], 4, "{json}");
    assert_eq!(json["false_alarms"]["of"], 1, "{json}");
}
