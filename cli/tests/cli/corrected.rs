//! The corrected arm from its diagnosis on: what was found is in every command that comes after.

use serde_json::Value;

use crate::motion::ELBOW;
use crate::support::{Folder, Table, list, number, read, run, stiffarm};

const ARM: &str = "docs/workbench/arm.toml";

/// A spring goes into the table; the foundation and the gear's error have no place there.
const TRUTHS: &str = "--effect 'joint_compliance@joint 2=1.2e-7' \
                      --effect base_compliance@base:rock_x=6e-8,rock_y=4e-8 \
                      --effect 'transmission_error@joint 3:cos 2=0.3 mrad'";

const LOADS: &str = "--load 0,0,-2kN,0,0,0 --load 1500,0,-1000,0,0,0 --load 0,1500,-1000,0,0,0";

/// What a diagnosis of that arm writes, as a robot file and as JSON.
fn corrected(folder: &Folder) -> [String; 2] {
    let [data, better, json] =
        ["run.csv", "better.toml", "found.json"].map(|name| folder.name(name));
    run(&format!("simulate {ARM} --payload 2kN --poses 30 --csv {data} {TRUTHS}")).good();
    let tried = "--effects joint_compliance,base_compliance,transmission_error";
    let written = format!("--write-robot {better} --json {json} --quiet");
    run(&format!("diagnose {ARM} {data} {tried} {written}")).good();
    let effects = read(&better).matches("\n[[effect]]\n").count();
    assert_eq!(effects, 2, "{}", read(&better));
    [better, json]
}

fn springs(robot: &str, data: &str) -> Vec<[f64; 3]> {
    let found = stiffarm(&["identify", robot, data, "--json", "-"]).json();
    let parameters = list(&found["parameters"]).iter();
    parameters.map(|p| [&p["value"], &p["ci95"][0], &p["ci95"][1]].map(number)).collect()
}

/// The arm as it is, at the plan that is made for it: its springs are those that were put in, unless what was
/// found beside them is left out.
#[test]
fn springs_are_identified_where_the_corrected_arm_was_planned() {
    let folder = Folder::new();
    let [better, json] = corrected(&folder);
    let [plan, again, filled] =
        ["plan.csv", "again.csv", "filled.csv"].map(|name| folder.name(name));
    for (robot, csv) in [(&better, &plan), (&json, &again)] {
        run(&format!("poses {robot} --count 15 --csv {csv} --quiet {LOADS}")).good();
    }
    assert_eq!(read(&plan), read(&again));
    let noise = "--noise-position 5um";
    run(&format!("simulate {ARM} {plan} {noise} --csv {filled} {TRUTHS}")).good();
    // As ARM has them, joint 2 softer by what was put in.
    let truths = [3.8e6, 1.0 / (1.0 / 6.6e6 + 1.2e-7), 3.9e6, 5.6e5, 6.6e5, 4.7e5];
    let missed = |robot: &str| {
        let springs = springs(robot, &filled);
        let outside = |(is, truth): &(&[f64; 3], &f64)| {
            let [_, low, high] = **is;
            !(low..=high).contains(&(1.0 / **truth))
        };
        springs.iter().zip(&truths).filter(outside).count()
    };
    // One in twenty intervals misses by right.
    assert!(missed(&better) <= 1 && missed(&json) <= 1);
    let dropped = read(&better).split("\n[[effect]]").next().expect("a table").to_owned();
    let dropped = folder.file("dropped.toml", dropped);
    // The foundation's rocking passes for joint 2, which bears much the same moment.
    let off = |robot: &str| springs(robot, &filled)[1][0] * truths[1] - 1.0;
    assert!(
        off(&better).abs() < 0.02 && off(&dropped) > 0.15,
        "{} {}",
        off(&better),
        off(&dropped)
    );
    // What is identified goes into the file, and the effects stay.
    let written = stiffarm(&["identify", &better, &filled, "--write-robot", "-"]).good();
    assert_eq!(written.matches("\n[[effect]]\n").count(), 2, "{written}");
}

/// With nothing put in there is nothing to find.
#[test]
fn a_corrected_arm_raises_no_alarm() {
    let folder = Folder::new();
    let [better, json] = corrected(&folder);
    for robot in [&better, &json] {
        let tried = "--effects joint_offset,joint_compliance --payload 2kN";
        let few = "--cases 8 --poses 12 --json - --quiet";
        let report = run(&format!("withhold {robot} {few} {tried}")).json();
        let none = &report["false_alarms"];
        assert_eq!((&none["hits"], &none["of"]), (&0.into(), &2.into()), "{report:#}");
    }
}

/// A diagnosis that was saved says of its own rows what it said when it was made, and of a plan what to
/// expect there.
#[test]
fn a_saved_diagnosis_predicts() {
    let folder = Folder::new();
    let [better, json] = corrected(&folder);
    let data = folder.name("run.csv");
    let said = crate::support::json(&read(&json));
    let fitted = &said["gap"]["fitted"];
    for robot in [&better, &json] {
        let found = stiffarm(&["predict", robot, &data, "--json", "-"]).json();
        assert_eq!((&found["rows"], &found["inside"]), (&90.into(), &90.into()));
        for key in ["position_rms", "position_max", "rotation_rms"] {
            let ratio = number(&found["gap"][key]) / number(&fitted[key]);
            // What is written has seven digits.
            assert!((ratio - 1.0).abs() < 1e-3, "{key}: {found:#} {fitted:#}");
        }
    }
    let plan = folder.name("plan.csv");
    run(&format!("poses {json} --count 5 --csv {plan} --quiet {LOADS}")).good();
    let err = stiffarm(&["predict", &json, &plan]).refused();
    assert!(err.contains("found nothing measured") && err.contains("--csv OUT"), "{err}");
    // Measured as they were predicted there is no gap.
    let expected = folder.name("expected.csv");
    let written = stiffarm(&["predict", &json, &plan, "--csv", &expected]).good();
    assert!(
        written.contains("Nothing is measured") || written.contains("None is judged"),
        "{written}"
    );
    let none = stiffarm(&["predict", &better, &expected, "--json", "-"]).json();
    assert!(number(&none["gap"]["position_max"]) < 1e-12, "{none:#}");
    // Beyond the loads of the diagnosis nothing is judged.
    let heavy = read(&expected).replace("-2000,", "-9000,").replace("1500,", "9000,");
    let heavy = folder.file("heavy.csv", heavy);
    let told = stiffarm(&["predict", &json, &heavy, "--json", "-", "--quiet"]).json();
    assert_eq!((&told["inside"], &told["gap"]), (&0.into(), &Value::Null), "{told}");
}

/// What goes with the load and gives beyond the table is in a map of the corrected arm.
#[test]
fn a_map_is_of_the_corrected_arm() {
    let folder = Folder::new();
    let [better, json] = corrected(&folder);
    let map = |robot: &str| -> Vec<f64> {
        let of = "--over q2,q3 --of deflection --wrench 0,0,-2000,0,0,0";
        let out = run(&format!("map {robot} {of} --steps 3 --csv -")).good();
        Table::of(&out).numbers("deflection[mm]")
    };
    let bare =
        folder.file("bare.toml", read(&better).split("\n[[effect]]").next().expect("a table"));
    let (corrected, bare) = (map(&better), map(&bare));
    assert_eq!(corrected, map(&json));
    // The foundation rocks by 6e-8 rad/(N·m) under some 5000 N·m, three metres away.
    let apart = corrected.iter().zip(&bare).map(|(a, b)| a - b).fold(0.0, f64::max);
    assert!((0.1..2.0).contains(&apart), "{corrected:?} {bare:?}");
}

/// A counterbalance acts at rest as it does in motion: the arm whose file has one stands where the arm stands to which
/// one is given, and is moved as such an arm.
#[test]
fn a_counterbalance_of_a_file_acts_at_rest_and_in_motion() {
    let folder = Folder::new();
    let table =
        "\n[[effect]]\nid = \"counterbalance\"\nplace = \"joint 2\"\ncos = 3e3\nsin = 2000.0\n";
    let plain = read("robots/arms/kuka_kr240.toml");
    let has = folder.file("has.toml", plain + table);
    let quiet =
        ["--poses", "4", "--noise-position", "0m", "--noise-rotation", "0rad", "--csv", "-"];
    let rows = |csv: String| -> Vec<String> {
        csv.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
    };
    let simulated = |rest: &[&str]| rows(stiffarm(&[&["simulate"], rest, &quiet].concat()).good());
    let given = ["kuka_kr240", "--effect", "counterbalance@joint 2:cos=3000 Nm,sin=2000 Nm"];
    assert_eq!(simulated(&[&has]), simulated(&given));
    assert_ne!(simulated(&[&has]), simulated(&["kuka_kr240"]));
    let moved = |rest: &[&str]| {
        let run = ["simulate", rest[0], "--log", "-", "--period", "2s", "--runs", "1"];
        rows(stiffarm(&[&run, &rest[1..]].concat()).good())
    };
    let elbow = folder.file("elbow.toml", ELBOW);
    let table = table.replace("3e3", "30.0").replace("2000.0", "20.0");
    let has = folder.file("has.toml", format!("{ELBOW}{table}"));
    let log = moved(&[&has]);
    assert!(log.len() > 100);
    assert_eq!(log, moved(&[&elbow, "--effect", "counterbalance@joint 2:cos=30,sin=20"]));
    assert_ne!(log, moved(&[&elbow]));
}
