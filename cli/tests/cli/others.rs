//! `stiffarm robots`, `completions`, `man`, help, colour.

use stiffarm_robots::{ARMS, SYMBOLIC};

use crate::support::{Folder, command, list, names, read, stiffarm};

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
    let of = |id: &str| list(&found).iter().find(|r| r["id"] == id).expect("there");
    assert_eq!(of("ur5")["joints"], "6R");
    assert_eq!(of("stanford")["joints"], "2R1P3R");
    assert_eq!(of("panda")["convention"], "modified");
    assert_eq!(of("lin_planar")["beams"], true);
    assert_eq!(of("jweeg_two_link")["parameters"], serde_json::json!(["a1", "a2"]));
    assert!(of("ur5")["jacobian_flops"].as_u64().expect("a count") <= 119);
    let folder = Folder::new();
    let file = folder.name("robots.json");
    assert_eq!(stiffarm(&["robots", "--json", &file]).good(), "");
    assert!(read(&file).ends_with("]\n"));
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
    let pages = COMMANDS.split(' ').map(|c| format!("stiffarm-{c}.1"));
    let expected: Vec<String> = pages.chain(["stiffarm.1".to_owned()]).collect();
    assert_eq!(names(&folder.path("man1")), expected);
    let eval = read(&folder.name("man1/stiffarm-eval.1"));
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
