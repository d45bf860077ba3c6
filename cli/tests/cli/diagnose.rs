//! `stiffarm diagnose`.

mod campaign;
pub mod plant;
mod sockets;

use crate::support::{Folder, command, flat, json, number, read, stiffarm};

const LIN: [&str; 3] =
    ["diagnose", "robots/arms/lin_planar.toml", "robots/data/lin1991_table3.csv"];
const RIVALS: [&str; 4] = ["--rival", "ycd", "--rival", "ytd"];

fn lin(extra: &[&str]) -> String {
    stiffarm(&[&LIN[..], extra].concat()).good()
}

fn line<'a>(out: &'a str, begins: &str) -> Vec<&'a str> {
    let found = out.lines().find(|line| line.trim_start().starts_with(begins));
    found.unwrap_or_else(|| panic!("no line `{begins}` in\n{out}")).split_whitespace().collect()
}

#[test]
fn the_readme_shows_what_is_printed() {
    let readme = read("README.md");
    let out = lin(&RIVALS);
    assert!(out.lines().count() <= 40 && out.lines().all(|l| l.chars().count() <= 100), "{out}");
    assert!(readme.contains(&format!("```text\n{out}```\n")), "put this into README.md:\n{out}");
}

#[test]
fn columns_that_are_not_used_are_named() {
    let out = lin(&[]);
    assert!(flat(&out).ends_with("Not used columns ycd_dy[in], ytd_dy[in]"), "{out}");
    assert!(!out.contains("Other models"), "{out}");
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let folder = Folder::new();
    let json = |name: &str, seed: &str| {
        let file = folder.name(name);
        let screen = lin(&[&RIVALS[..], &["--json", &file, "--seed", seed]].concat());
        assert!(screen.contains("7.41"), "{screen}");
        read(&file)
    };
    let (first, again, other) = (json("a", "3"), json("b", "3"), json("c", "4"));
    assert_eq!(first, again);
    assert_ne!(first, other);
    assert!(first.ends_with("}\n"));
    assert_eq!(folder.names(), ["a", "b", "c"]);
    let printed = lin(&[&RIVALS[..], &["--json", "-", "--seed", "3"]].concat());
    assert_eq!(printed, first);
    assert_eq!(lin(&["--json", &folder.name("d"), "--quiet"]), "");
}

#[test]
fn the_json_is_the_formats() {
    let out = lin(&["--json", "-"]);
    let found = json(&out);
    let keys: Vec<&String> = found.as_object().expect("an object").keys().collect();
    let expected = "stiffarm robot measurements held_out gap where findings cannot_see unexplained";
    assert_eq!(keys[..9], expected.split(' ').collect::<Vec<_>>());
    let more = "residual observability parts by covers data_sha256 robot_sha256 trust corrected";
    assert!(keys[9..].iter().all(|key| more.split(' ').any(|name| *key == name)), "{keys:?}");
    assert_eq!(found["stiffarm"], env!("CARGO_PKG_VERSION"));
    let finding = &found["findings"][0];
    assert_eq!(finding["effect"], "joint_compliance");
    assert_eq!(finding["place"], "joint 1");
    for (when, mil) in [("before", 7.41), ("after", 0.89)] {
        assert!((number(&found["gap"][when]["position_rms"]) / 2.54e-5 - mil).abs() < 5e-3);
    }
    let rivals = json(&lin(&[&RIVALS[..], &["--json", "-"]].concat()));
    assert_eq!(rivals["rivals"][0]["significant"], false);
}

/// Ctrl-C ends a long search: a shell sees the status of a program that was interrupted.
#[cfg(unix)]
#[test]
fn an_interrupt_has_its_own_exit_status() {
    use std::os::unix::process::ExitStatusExt as _;
    use std::process::{Command, Stdio};

    let folder = Folder::new();
    let data = folder.name("run.csv");
    let effects = "--effect 'joint_compliance@joint 2=8e-7' \
                   --effect 'transmission_error@joint 3:cos 2=0.3 mrad'";
    crate::support::run(&format!("simulate kuka_kr240 --poses 300 --csv {data} {effects}")).good();
    let mut search = command(&["diagnose", "kuka_kr240", &data, "--nested", "--quiet"]);
    let mut search = search.stdout(Stdio::null()).spawn().expect("the binary runs");
    std::thread::sleep(std::time::Duration::from_secs(1));
    let id = search.id().to_string();
    // The first asks for the end, the second does not wait for it.
    for _ in 0..2 {
        let sent = Command::new("kill").args(["-INT", &id]).status().expect("kill runs");
        assert!(sent.success());
        std::thread::sleep(std::time::Duration::from_millis(200));
    }
    let ended = search.wait().expect("it ends");
    // Before there is a handler the signal itself ends it, which a shell tells as 130, too.
    assert!(ended.code() == Some(130) || ended.signal() == Some(2), "{ended:?}");
}
