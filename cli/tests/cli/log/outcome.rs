//! What is made of a log's diagnosis: the robot file, simulators' files, the check of another log, the page.

use super::{HEADER, PENDULUM, rows};
use crate::support::{Folder, arm_of, has, json, list, number, read, run, stiffarm};

/// The pendulum's log, the second half of it apart; both say where torques are measured.
fn logs(folder: &Folder) -> [String; 2] {
    let all = rows(HEADER);
    let lines: Vec<&str> = all.lines().collect();
    let half = |part: &[&str]| {
        let text = part.iter().fold(String::new(), |text, line| text + line + "\n");
        format!("# torque_side = motor\n{HEADER}\n{text}")
    };
    [
        folder.file("first.csv", half(&lines[1..4001])),
        folder.file("second.csv", half(&lines[4001..])),
    ]
}

#[test]
fn a_written_robot_does_what_is_announced() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let [log, other] = logs(&folder);
    let [better, first, again] =
        ["better.toml", "first.json", "again.json"].map(|name| folder.name(name));
    let found = ["diagnose", &robot, &log, "--write-robot", &better, "--json", &first, "--quiet"];
    stiffarm(&found).good();
    stiffarm(&["diagnose", &better, &log, "--json", &again, "--quiet"]).good();
    let (first, again) = (json(&read(&first)), json(&read(&again)));
    let ratio = number(&again["gap"][0]["before"]) / number(&first["gap"][0]["after"]);
    assert!((0.95..1.05).contains(&ratio), "{ratio}");
    assert_eq!(again["findings"].as_array().map(Vec::len), Some(0), "{again:#}");
    // The file is what was simulated: 3 kg at 0.8 m, friction of 2 N·m and 0.7 N·m·s/rad.
    let arm = arm_of(&read(&better));
    let is = arm.inverse_dynamics(&[0.3], &[0.5], &[2.0])[0];
    let was = 1.92 * 2.0 + 3.0 * 0.8 * 9.80665 * 0.3_f64.cos() + 2.0 + 0.7 * 0.5;
    assert!((is - was).abs() < 0.05, "{is}, not {was}: {}", read(&better));
    // The other half was not seen by any fit.
    let checked = folder.name("checked.json");
    let check = ["diagnose", &robot, &log, "--check", &other, "--json", &checked];
    let out = stiffarm(&check).good();
    assert!(out.contains("with nothing fitted"), "{out}");
    let check = &json(&read(&checked))["check"]["gap"][0];
    // 0.1 N·m of noise at 100 Hz, of which the band keeps a part.
    assert!(number(&check["after"]) < 0.1 && number(&check["before"]) > 1.0, "{check}");
}

#[test]
fn simulators_get_what_they_hold() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let [log, _] = logs(&folder);
    let [mjcf, urdf] = ["better.xml", "better.urdf"].map(|name| folder.name(name));
    let only = "coulomb_friction,viscous_friction,torque_offset";
    let found = ["diagnose", &robot, &log, "--effects", only, "--write-mjcf", &mjcf];
    stiffarm(&[&found[..], &["--write-urdf", &urdf, "--quiet"]].concat()).ended(0);
    for (file, names) in
        [(&mjcf, ["frictionloss=\"", "damping=\""]), (&urdf, ["friction=\"", "damping=\""])]
    {
        let file = read(file);
        let of = |name: &str| -> f64 {
            let at = file.find(name).unwrap_or_else(|| panic!("{name}: {file}")) + name.len();
            file[at..].split('"').next().and_then(|text| text.parse().ok()).expect("a number")
        };
        assert!((of(names[0]) - 2.0).abs() < 0.05 && (of(names[1]) - 0.7).abs() < 0.05, "{file}");
    }
}

/// What the table has no entry for stands in the file, and is known to the next diagnosis of a log.
#[test]
fn an_effect_of_motion_is_part_of_the_model() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let half = format!(
        "{PENDULUM}\n[[effect]]\nid = \"coulomb_friction\"\nplace = \"joint 1\"\ncoulomb = 2.0\n"
    );
    let knows = folder.file("knows.toml", half);
    let [log, _] = logs(&folder);
    let [plain, known] = ["plain.json", "known.json"].map(|name| folder.name(name));
    let only = ["--effects", "coulomb_friction,viscous_friction", "--quiet", "--json"];
    stiffarm(&[&["diagnose", &robot, &log], &only[..], &[&plain]].concat()).good();
    stiffarm(&[&["diagnose", &knows, &log], &only[..], &[&known]].concat()).good();
    let effects = |path: &str| -> Vec<String> {
        let found = json(&read(path));
        let effect = |f: &serde_json::Value| f["effect"].as_str().expect("a name").to_owned();
        list(&found["findings"]).iter().map(effect).collect()
    };
    assert!(effects(&plain).contains(&"coulomb_friction".to_owned()));
    assert_eq!(effects(&known), ["viscous_friction"]);
    // At rest it does nothing; a kernel that moves has no place for it.
    stiffarm(&["eval", &knows, "--q", "0.3"]).good();
    stiffarm(&["generate", &knows, "--emit", "rust", "--outputs", "pose"]).good();
    let err = stiffarm(&["generate", &knows, "--emit", "rust", "--outputs", "inverse_dynamics"])
        .refused();
    assert!(err.contains("inverse_dynamics has no Coulomb friction"), "{err}");
}

#[test]
fn the_robot_file_may_say_the_side() {
    let folder = Folder::new();
    let robot = folder.file(
        "pendulum.toml",
        PENDULUM.replace("\n\n[[joint]]", "\ntorque_side = \"motor\"\n\n[[joint]]"),
    );
    let log = folder.file("log.csv", rows(HEADER));
    let out = stiffarm(&["diagnose", &robot, &log, "--effects", "coulomb_friction"]).good();
    assert!(out.contains("torques, motor"), "{out}");
}

#[test]
fn currents_tell_no_newton_metres() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let log = folder.file("log.csv", rows("t,q1,i1"));
    let better = folder.name("better.toml");
    let run =
        run(&format!("diagnose {robot} {log} --write-robot {better} --effects coulomb_friction"));
    assert!(run.refused().contains("found currents alone, expected torques"));
    assert!(!folder.names().contains(&"better.toml".to_owned()));
}

#[test]
fn a_page_holds_everything() {
    let folder = Folder::new();
    let robot = folder.file("pendulum.toml", PENDULUM);
    let [log, other] = logs(&folder);
    let page = folder.name("log.html");
    stiffarm(&["diagnose", &robot, &log, "--check", &other, "--report", &page, "--quiet"]).good();
    let page = read(&page);
    has(
        &page,
        &[
            "What each finding contributes",
            "Torque against time",
            "Friction against speed",
            "with nothing fitted",
        ],
    );
    // Nothing of it stands elsewhere.
    for away in ["http://", "https://", "src=", "@import"] {
        assert!(!page.contains(away), "{away}");
    }
    let data = page
        .split("type=\"application/json\">")
        .nth(1)
        .and_then(|rest| rest.split("</script>").next());
    let data = json(data.expect("data"));
    let joint = &data["joints"][0];
    let [points, line] = [0, 1].map(|k| list(&joint["friction"][k]));
    assert!(points.len() <= 1200 && line.len() > 20, "{} {}", points.len(), line.len());
    // 2 N·m and 0.7 N·m·s/rad, at the fastest speeds both ways.
    for end in [line.first(), line.last()] {
        let [speed, torque] = [0, 1].map(|k| number(&end.expect("a point")[k]));
        let expected = 2.0 * speed.signum() + 0.7 * speed;
        assert!((torque - expected).abs() < 0.15, "{torque} at {speed}, not {expected}");
    }
}
