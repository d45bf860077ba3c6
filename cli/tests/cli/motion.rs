//! Arms that move: `simulate --log`, `withhold --motion`, `poses --for motion`.

use serde_json::Value;

use crate::support::{Folder, Table, has, list, number, read, run, stiffarm};

/// An elbow above an upright axis, with rotors and friction.
pub const ELBOW: &str = include_str!("../../../tests/data/elbow.toml");

#[test]
fn a_simulated_log_is_diagnosed() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let (log, runs) = (folder.name("log.csv"), stiffarm_draws::few_or_many(1, 3));
    let moved = |to: &str| {
        let effect = "--effect 'coulomb_friction@joint 2=3 N·m'";
        run(&format!("simulate {robot} {effect} --runs {runs} --log {to}")).good()
    };
    moved(&log);
    let written = read(&log);
    has(&written, &["# effect coulomb_friction@joint 2:coulomb=3e0 (SI)", "# torque_side = motor"]);
    let found = stiffarm(&["diagnose", &robot, &log, "--quiet"]).good();
    assert!(found.contains("Coulomb friction at joint 2"), "{found}");
    // The same bytes again; without the effect's name where it is withheld.
    assert_eq!(moved("-"), written);
    let blind = moved("- --withhold");
    assert!(blind.contains("# effects withheld") && !blind.contains("coulomb"), "{blind}");
}

/// What the file says of the arm in motion is part of the arm, and no gap.
#[test]
fn effects_of_a_robot_file_act_in_a_motion() {
    let folder = Folder::new();
    let effect = "\n[[effect]]\nid = \"coulomb_friction\"\nplace = \"joint 2\"\ncoulomb = 3.0\n";
    let plain = folder.file("elbow.toml", ELBOW);
    let robot = folder.file("knows.toml", format!("{ELBOW}{effect}"));
    let (log, runs) = (folder.name("log.csv"), stiffarm_draws::few_or_many(1, 3));
    run(&format!("simulate {robot} --runs {runs} --log {log} --lost 0%")).good();
    let found = |robot: &str| {
        run(&format!("diagnose {robot} {log} --effects coulomb_friction --json -")).json()
    };
    let without = found(&plain);
    assert_eq!(without["findings"][0]["place"], "joint 2", "{without:#}");
    let value = number(&without["findings"][0]["parameters"][0]["value"]);
    assert!((value - 3.0).abs() < 0.3, "{value}");
    let known = found(&robot);
    assert!(list(&known["findings"]).iter().all(|f| f["place"] != "joint 2"), "{known:#}");
    let page = folder.name("check.html");
    let period = stiffarm_draws::few_or_many("8s", "15s");
    let few = format!("--motion --cases 2 --period {period} --effects viscous_friction");
    let json = run(&format!("withhold {robot} {few} --json - --report {page}")).json();
    let page = read(&page);
    assert!(page.contains("3 runs of ") && page.contains("viscous_friction"), "{page}");
    assert_eq!(json["failed"], 0, "{json}");
}

/// The commands hold the limits, and the arm follows them.
#[test]
fn a_chosen_motion_is_what_simulate_takes() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let commands = folder.name("commands.csv");
    let plan = "--for motion --period 8s --harmonics 5 --max-rate 1.2 --max-acceleration 4";
    let screen = run(&format!("poses {robot} {plan} --csv {commands}")).good();
    has(&screen, &["Coulomb friction at joint 3", " ×", "rotor inertia at joint 1"]);
    let written = read(&commands);
    let table = Table::of(&written);
    let rows = table.all();
    assert_eq!(table.names[..4], ["t[s]", "q_cmd1[rad]", "q_cmd2[rad]", "q_cmd3[rad]"]);
    assert_eq!(rows.len(), 801);
    for row in &rows {
        for (q, [low, high]) in row[1..4].iter().zip([[-2.5, 2.5], [-1.0, 2.0], [-2.0, 2.0]]) {
            assert!((low..=high).contains(q), "{row:?}");
        }
        assert!(row[4..].iter().all(|rate| rate.abs() <= 1.2), "{row:?}");
    }
    let still = |row: &[f64]| row[4..].iter().all(|rate| rate.abs() < 1e-6);
    assert!(still(&rows[0]) && still(&rows[800]));
    let exact = "--logged position --rate 100Hz --lost 0% --jitter 0s";
    let log = run(&format!("simulate {robot} {commands} --log - {exact}")).good();
    let table = Table::of(&log);
    assert_eq!(table.names[1..4], ["q1[rad]", "q2[rad]", "q3[rad]"]);
    for (sent, row) in rows.iter().zip(table.all()) {
        // Knots every 20 ms of motions up to 5/8 Hz, readings of 0.0005 rad: six of them.
        assert!((0..3).all(|j| (sent[1 + j] - row[1 + j]).abs() < 3.5e-3), "{sent:?} {row:?}");
    }
}

#[test]
fn two_effects_are_told_from_each_other_by_a_motion() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let pair = "'viscous_friction@joint 2' 'friction_curve@joint 2'";
    let csv = folder.name("commands.csv");
    let plan = format!("poses {robot} --for motion --harmonics 4 --csv {csv} {pair}");
    let screen = run(&plan).good();
    assert!(screen.contains("friction curve at joint 2: root"), "{screen}");
}

#[test]
fn logs_are_withheld() {
    let folder = Folder::new();
    let robot = folder.file("elbow.toml", ELBOW);
    let period = stiffarm_draws::few_or_many("8s", "15s");
    let effects = "coulomb_friction,viscous_friction";
    let few = format!("--motion --cases 6 --period {period} --effects {effects}");
    let json = run(&format!("withhold {robot} {few} --json -")).json();
    assert_eq!(list(&json["cases"]).len(), 6);
    assert_eq!((&json["runs"], &json["failed"]), (&Value::from(3), &Value::from(0)));
    // How often it is right is the suite's to say: `tests/withheld/logs.rs`.
    assert_eq!(json["single"]["first_named"]["of"], 4, "{json}");
    assert_eq!(json["false_alarms"]["of"], 1, "{json}");
}
