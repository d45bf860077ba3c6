//! `stiffarm robots`, `completions`, `man`, help, colour.

use stiffarm_robots::{ARMS, SYMBOLIC};

use crate::support::{Folder, command, stiffarm, text};

#[test]
fn every_built_in_robot_is_listed() {
    let out = stiffarm(&["robots"]).good();
    let found = stiffarm(&["robots", "--json"]).json();
    let ids = ARMS.iter().map(|arm| arm.id).chain(SYMBOLIC.iter().map(|arm| arm.id));
    for (k, id) in ids.enumerate() {
        assert_eq!(found[k]["id"], id);
        let flops = found[k]["jacobian_flops"].as_u64().expect("a count").to_string();
        let row = out.lines().find(|l| l.starts_with(&format!("{id} "))).expect("a row");
        assert!(row.ends_with(&format!(" {flops}")), "{row}");
    }
    let of = |id: &str| {
        found.as_array().expect("a list").iter().find(|r| r["id"] == id).expect("there").clone()
    };
    assert_eq!(of("ur5")["joints"], "6R");
    assert_eq!(of("stanford")["joints"], "2R1P3R");
    assert_eq!(of("panda")["convention"], "modified");
    assert_eq!(of("lin_planar")["beams"], true);
    assert_eq!(of("jweeg_two_link")["parameters"], serde_json::json!(["a1", "a2"]));
    assert!(of("ur5")["jacobian_flops"].as_u64().expect("a count") <= 119);
    let folder = Folder::new();
    let file = folder.path("robots.json");
    assert_eq!(stiffarm(&["robots", "--json", &text(&file)]).good(), "");
    assert!(std::fs::read_to_string(file).expect("written").ends_with("]\n"));
}

#[test]
fn completions_know_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let out = stiffarm(&["completions", shell]).good();
        assert!(out.contains("diagnose") && out.contains("noise-position"), "{shell}");
    }
}

/// In the order of the alphabet.
const COMMANDS: &str = "check compensate completions controller diagnose effects eval generate identify import man map \
                        measurements papers poses predict robots simulate withhold";

#[test]
fn manual_pages_are_written() {
    let page = stiffarm(&["man"]).good();
    assert!(page.contains(".TH stiffarm 1") && page.contains("diagnose"), "{page}");
    let folder = Folder::new();
    let to = folder.name("man1");
    assert_eq!(stiffarm(&["man", "--out", &to]).good(), "");
    let mut names: Vec<String> = std::fs::read_dir(&to)
        .expect("made")
        .map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let pages = COMMANDS.split(' ').map(|c| format!("stiffarm-{c}.1"));
    let mut expected: Vec<String> = pages.collect();
    expected.push("stiffarm.1".to_owned());
    assert_eq!(names, expected);
    let eval = std::fs::read_to_string(folder.path("man1/stiffarm-eval.1")).expect("written");
    assert!(eval.contains("wrench") && eval.contains("Examples"), "{eval}");
}

#[test]
fn help_has_examples() {
    for name in COMMANDS.split(' ') {
        let out = stiffarm(&[name, "--help"]).good();
        assert!(out.contains("Example") && out.contains(&format!("  stiffarm {name}")), "{out}");
    }
    let version = stiffarm(&["--version"]).good();
    assert_eq!(version, format!("stiffarm {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn colour_is_for_terminals() {
    let run = |variables: &[(&str, &str)]| {
        let mut command = command(&["robots"]);
        command.envs(variables.iter().copied());
        String::from_utf8(command.output().expect("runs").stdout).expect("text")
    };
    let plain = run(&[]);
    assert!(!plain.contains('\u{1b}'));
    assert!(run(&[("CLICOLOR_FORCE", "1")]).contains('\u{1b}'));
    assert_eq!(run(&[("NO_COLOR", "1")]), plain);
}
