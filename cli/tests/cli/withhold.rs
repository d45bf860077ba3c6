//! `stiffarm withhold`.

use crate::support::{Folder, has, json, stiffarm};

/// One known effect, few cases: quick in any build.
const SMALL: &str = "withhold bicchi_3r --effects joint_offset,joint_compliance --cases 4 --poses 6 --payload 10N \
                     --quiet";

#[test]
fn the_json_has_every_case_and_the_seed_decides() {
    let folder = Folder::new();
    let run = |small: &str, name: &str, seed: &str| {
        let file = folder.name(name);
        let out = crate::support::run(&format!("{small} --json {file} --seed {seed}")).good();
        assert_eq!(out, "");
        std::fs::read_to_string(file).expect("written")
    };
    let single = SMALL.replace("--cases 4", "--cases 1");
    let (one, again) = (run(&single, "a", "1"), run(&single, "b", "1"));
    assert_eq!(one, again);
    assert_ne!(one, run(&single, "c", "2"));
    let report = json(&run(SMALL, "d", "1"));
    assert_eq!(report["cases"].as_array().map(Vec::len), Some(4));
    assert_eq!(report["stiffarm"], env!("CARGO_PKG_VERSION"));
    for key in ["false_alarms", "single", "pairs", "removed", "after", "confusion"] {
        assert!(!report[key].is_null(), "{key}");
    }
    let first = &report["cases"][0];
    assert_eq!(first["kind"], "single");
    let truth = first["truths"][0].as_str().expect("a text");
    assert!(truth.starts_with("joint_"), "{truth}");
    // It is the text that `simulate` takes.
    stiffarm(&["simulate", "bicchi_3r", "--effect", truth, "--poses", "1", "--csv", "-"]).good();
}

#[test]
fn one_screen_says_what_is_found() {
    let out = crate::support::run(SMALL).good();
    has(&out, &["no effect: something is found", "the payload design: 18 measurements at 6 poses"]);
    let lines: Vec<&str> = out.lines().collect();
    assert!(lines.len() <= 24 && lines.iter().all(|l| l.chars().count() <= 120), "{out}");
}
