//! Mistakes of a file as a user meets them: named first, mended in the robot file, or given up.

use crate::support::{Folder, Table, flat, has, read, run};

/// A UR5 with a tool, measured where nobody knows, by the command itself; its measurements as header and rows.
fn campaign(folder: &Folder) -> (String, Vec<Vec<String>>) {
    let path = folder.name("given.csv");
    let zeros = "--effect 'joint_offset@joint 2=3 mrad' --effect 'joint_offset@joint 4=-2 mrad'";
    let given = "--poses 40 --payload 0kg --measure position --noise-position 30um";
    run(&format!("simulate ur5 {given} {zeros} --csv {path}")).good();
    let all = read(&path);
    let Table { names, rows, .. } = Table::of(&all);
    let owned = |row: Vec<&str>| row.into_iter().map(str::to_owned).collect();
    (names.join(","), rows.into_iter().map(owned).collect())
}

fn column(header: &str, name: &str) -> usize {
    let is = |cell: &str| cell.split('[').next() == Some(name);
    header.split(',').position(is).unwrap_or_else(|| panic!("no {name} in {header}"))
}

fn file(folder: &Folder, name: &str, header: &str, rows: &[Vec<String>]) -> String {
    let rows: Vec<String> = rows.iter().map(|row| row.join(",")).collect();
    folder.file(name, format!("{header}\n{}\n", rows.join("\n")))
}

/// What a run prints that may have doubts beside it.
fn good(line: &str) -> String {
    let ended = run(line).ended(0);
    // Lines are broken where the screen ends.
    flat(&ended.out)
}

const FRAMES: &str = "--nuisance base_frame,tool_frame";

#[test]
fn a_coupling_is_named_and_written() {
    let folder = Folder::new();
    let (header, mut rows) = campaign(&folder);
    let [two, three] = ["q2", "q3"].map(|name| column(&header, name));
    for row in &mut rows {
        let number = |at: usize| row[at].parse::<f64>().expect("a number");
        row[three] = (number(three) + number(two)).to_string();
    }
    let data = file(&folder, "coupled.csv", &header, &rows);
    let [json, robot] = ["found.json", "better.toml"].map(|name| folder.name(name));
    let outputs = format!("--json {json} --write-robot {robot}");
    let shown = good(&format!("diagnose ur5 {data} {FRAMES} {outputs}"));
    has(&shown, &["Joint 3's reading counts joint 2's angle", "instead of"]);
    let told = crate::support::json(&read(&json));
    let wrong = &told["mistaken"]["mistakes"][0];
    assert_eq!(
        (&wrong["kind"], &wrong["in_robot_file"]),
        (&"reading_coupling".into(), &true.into())
    );
    // The written arm has nothing wrong with it.
    let again = good(&format!("diagnose {robot} {data} {FRAMES}"));
    assert!(!again.contains("Joint 3's reading"), "{again}");
}

/// A zero and the scale of a reading, each by no round number: named with its amount, and written.
#[test]
fn amounts_are_measured_and_written() {
    let folder = Folder::new();
    let (header, rows) = campaign(&folder);
    let spoilt = |name: &str, column: usize, told: &dyn Fn(f64) -> f64| {
        let mut rows = rows.clone();
        for row in &mut rows {
            row[column] = told(row[column].parse().expect("a number")).to_string();
        }
        file(&folder, name, &header, &rows)
    };
    let three = column(&header, "q3");
    let turned = spoilt("turned.csv", three, &|q| q - 37_f64.to_radians());
    let scaled = spoilt("scaled.csv", three, &|q| q / 0.7);
    for (data, said) in [(&turned, "J3 := J3 + 37.0"), (&scaled, "J3 := 0.700")] {
        let robot = folder.name("better.toml");
        let shown = good(&format!("diagnose ur5 {data} {FRAMES} --write-robot {robot}"));
        assert!(shown.contains(said), "{shown}");
        let again = good(&format!("diagnose {robot} {data} {FRAMES}"));
        assert!(!again.contains("Mistaken"), "{again}");
    }
}

#[test]
fn exchanged_coordinates_are_to_be_mended_in_the_measurements() {
    let folder = Folder::new();
    let (header, mut rows) = campaign(&folder);
    let [x, y] = ["x", "y"].map(|name| column(&header, name));
    rows.iter_mut().for_each(|row| row.swap(x, y));
    let data = file(&folder, "exchanged.csv", &header, &rows);
    let shown = good(&format!("diagnose ur5 {data} {FRAMES}"));
    assert!(shown.contains("exchange the names x and y"), "{shown}");
    // Another file with the same mistake is read without it, and one that has it not as it is.
    let right = folder.name("given.csv");
    for (other, is_mended) in [(&data, true), (&right, false)] {
        let json = folder.name("found.json");
        let shown = good(&format!("diagnose ur5 {data} {FRAMES} --check {other} --json {json}"));
        let check = &crate::support::json(&read(&json))["check"];
        assert_eq!(check.get("mended").is_some(), is_mended, "{check}");
        assert!(check["after"]["position_rms"].as_f64().is_some_and(|left| left < 1e-4), "{check}");
        assert_eq!(shown.contains("mended as these readings are"), is_mended, "{shown}");
    }
}

#[test]
fn rows_of_other_poses_are_no_arm() {
    let folder = Folder::new();
    let (header, mut rows) = campaign(&folder);
    let measured = ["x", "y", "z"].map(|name| column(&header, name));
    // Every position is that of the row seven on.
    let was = rows.clone();
    for (number, row) in rows.iter_mut().enumerate() {
        measured.iter().for_each(|k| row[*k].clone_from(&was[(number + 7) % was.len()][*k]));
    }
    let data = file(&folder, "other.csv", &header, &rows);
    let ended = run(&format!("diagnose ur5 {data} {FRAMES}")).ended(3);
    let out = flat(&ended.out);
    assert!(out.contains("Nothing explains the position error"), "{out}");
}

/// Links that bend by 4 cm, as the file has it: nothing is wrong with the measured coordinates.
#[test]
fn links_that_bend_are_no_mistake() {
    let folder = Folder::new();
    let data = folder.name("bent.csv");
    let run = |command: &str| run(&format!("{command} --quiet")).good();
    run(&format!("simulate bicchi_3r --poses 6 --payload 10N --noise-position 30um --csv {data}"));
    let found = run(&format!("diagnose bicchi_3r {data}"));
    assert!(found.contains("Nothing is found") && !found.contains("Mistaken"), "{found}");
}
