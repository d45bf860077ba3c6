//! `stiffarm simulate`.

use crate::support::{Folder, Table, has, number, stiffarm};

const SPRING: &str = "joint_compliance@joint 2=3e-6 rad/(N·m)";

fn simulated(extra: &[&str]) -> String {
    stiffarm(&[&["simulate", "ur5", "--csv", "-"], extra].concat()).good()
}

fn header(csv: &str) -> &str {
    csv.lines().find(|line| !line.starts_with('#')).expect("a header")
}

#[test]
fn a_file_says_what_it_is() {
    let csv = simulated(&["--effect", SPRING, "--poses", "3"]);
    let table = Table::of(&csv);
    assert_eq!(
        table.remarks,
        [
            "# UR5, simulated: the payload design, 9 rows at 3 poses",
            "# noise 30.0 um in each coordinate, 0.0873 mrad in each rotation; seed 0",
            "# effect joint_compliance@joint 2:compliance=3e-6 (SI)",
        ]
    );
    assert_eq!(csv.lines().count(), 3 + 1 + 9);
    for column in ["time[s]", "temperature[degC]", "q6[rad]", "s1", "fz[N]", "mx[Nm]", "rz[rad]"] {
        table.column(column);
    }
    let blind = simulated(&["--effect", SPRING, "--poses", "3", "--withhold"]);
    assert!(blind.contains("# effects withheld") && !blind.contains("compliance"), "{blind}");
    let rows = |csv: &str| csv.lines().skip(3).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(rows(&blind), rows(&csv));
}

#[test]
fn the_seed_decides() {
    let of = |seed: &str| simulated(&["--seed", seed, "--poses", "2", "--design", "force"]);
    assert_eq!(of("5"), of("5"));
    assert_ne!(of("5"), of("6"));
}

#[test]
fn what_is_measured_can_be_chosen() {
    let position = simulated(&["--measure", "position", "--poses", "2"]);
    assert!(header(&position).ends_with("x[m],y[m],z[m]"), "{position}");
    let moved = simulated(&["--measure", "displacement", "--poses", "2", "--first-order-sim"]);
    assert!(header(&moved).contains("drz[rad],sim_dx[m]"), "{moved}");
    let repeated = simulated(&["--repeats", "4", "--poses", "2", "--design", "force"]);
    assert_eq!(repeated.lines().count(), 3 + 1 + 4 * 2 * 4);
    let narrow = simulated(&["--design", "narrow", "--frames", "unknown", "--poses", "2"]);
    assert!(narrow.contains("base_frame and tool_frame are nuisances"), "{narrow}");
}

/// The rows of a file are measured again; another arm's answer differs only by the effect.
#[test]
fn a_files_rows_are_measured_again() {
    let run = "robots/data/lin1991_table3.csv";
    let of = |effects: &[&str]| {
        let noiseless = ["--noise-position", "0m", "--csv", "-"];
        stiffarm(&[&["simulate", "lin_planar", run], effects, &noiseless].concat()).good()
    };
    let nominal = of(&[]);
    assert!(nominal.contains("12 rows at 12 poses"), "{nominal}");
    let soft = of(&["--effect", "joint_compliance@joint 1=4.14e-5"]);
    let last = |csv: &str| *Table::of(csv).all()[0].last().expect("a cell");
    // Stretched out by 48 in under 1.02 lbf, the spring adds F·L²·C.
    let (force, reach) = (1.02 * 4.4482216152605, 48.0 * 0.0254);
    let added = -force * reach * reach * 4.14e-5;
    assert!((last(&soft) - last(&nominal) - added).abs() < 1e-3 * added.abs());
}

/// A plan as `poses` writes it, nothing measured yet, is a design; a campaign it is not.
#[test]
fn a_plan_is_simulated_and_withheld_before_it_is_measured() {
    let (arm, plan) = ("docs/workbench/arm.toml", "docs/workbench/plan.csv");
    let run = stiffarm(&["simulate", arm, plan, "--csv", "-"]).good();
    assert!(run.contains("15 rows at 15 poses"), "{run}");
    assert!(Table::of(&run).all()[0].iter().all(|cell| !cell.is_nan()), "{run}");
    let few = ["withhold", arm, plan, "--cases", "2", "--effects", "joint_compliance", "--quiet"];
    let found = stiffarm(&few).good();
    assert!(found.contains("15 measurements at 15 poses"), "{found}");
}

#[test]
fn the_diagnosis_finds_what_was_put_in() {
    let folder = Folder::new();
    let run = folder.name("run.csv");
    let made = ["simulate", "ur5", "--effect", SPRING, "--poses", "12", "--csv", &run];
    assert_eq!(stiffarm(&made).good(), "");
    let found =
        crate::support::run(&format!("diagnose ur5 {run} --effects joint_compliance --json -"))
            .json();
    let first = &found["findings"][0];
    assert_eq!(
        (&first["effect"], &first["place"]),
        (&"joint_compliance".into(), &"joint 2".into())
    );
    let [low, high] = [0, 1].map(|end| number(&first["parameters"][0]["ci95"][end]));
    assert!(high - low < 1e-6 && low < 3.3e-6 && high > 2.7e-6, "{first}");
}

/// A file of balls in sockets has joint values alone, and what was put in is found with a bench and without.
#[test]
fn sockets_are_simulated_and_diagnosed() {
    let folder = Folder::new();
    let csv = simulated(&["--measure", "point", "--poses", "36", "--effect", SPRING]);
    assert!(header(&csv).contains("point") && !header(&csv).contains("x[m]"), "{csv}");
    let file = folder.file("sockets.csv", &csv);
    let out = stiffarm(&["diagnose", "ur5", &file]).good();
    assert!(out.contains("108 measurements of points at "), "{out}");
    has(&out, &["joint compliance at joint 2", "distance from the point"]);
    let pair = "[[pair]]\npoints = [\"socket 0.1\", \"socket 0.2\"]\ndistance = \"1 m\"\nsigma = \"1 m\"\n";
    let bench = folder.file("bench.toml", pair);
    let out = stiffarm(&["diagnose", "ur5", &file, "--bench", &bench]).good();
    has(&out, &["socket 0.1 and socket 0.2", "known: 1000.00 ± 1000.00 mm"]);
    let plates = simulated(&["--measure", "plane", "--poses", "36", "--effect", SPRING]);
    let out = stiffarm(&["diagnose", "ur5", &folder.file("plates.csv", &plates)]).good();
    has(&out, &["joint compliance at joint 2", "error of the reading"]);
    let again = stiffarm(&["simulate", "ur5", &file, "--csv", "-", "--effect", SPRING]).good();
    assert_eq!(header(&again), header(&csv));
}

/// A tracker's file and a file of sockets are one campaign; a spring is told by both.
#[test]
fn files_of_several_instruments_are_one_campaign() {
    let folder = Folder::new();
    let tracker = simulated(&["--measure", "position", "--poses", "12", "--effect", SPRING]);
    let sockets =
        simulated(&["--measure", "point", "--poses", "36", "--seed", "4", "--effect", SPRING]);
    let [a, b] =
        [("a.csv", &tracker), ("b.csv", &sockets)].map(|(name, text)| folder.file(name, text));
    let found = stiffarm(&["diagnose", "ur5", &a, &b, "--json", "-", "--quiet"]).json();
    assert_eq!(found["measurements"], 3 * (12 + 36));
    assert_eq!(found["findings"][0]["effect"], "joint_compliance");
    assert_eq!(found["bench"].as_array().map(Vec::len), Some(6));
}
