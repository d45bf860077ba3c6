//! Every command of the guide, in a folder that has its files.

use std::process::Command;

use super::{HEADER, PENDULUM, rows};
use crate::support::{Folder, Table, read, stiffarm, words};

/// A servo that comes 50 ms late.
fn servo(rows: &str) -> String {
    let all = Table::of(rows).all();
    let late =
        all.iter().zip(&all[5..]).map(|(was, now)| format!("{},{},{}\n", now[0], was[1], now[1]));
    format!("t,q1,q_cmd1\n{}", late.collect::<String>())
}

#[test]
fn every_command_of_the_guide_runs() {
    let folder = Folder::new();
    let all = rows(HEADER);
    let lines: Vec<&str> = all.lines().skip(1).collect();
    let part = |of: &[&str]| format!("{HEADER}\n{}\n", of.join("\n"));
    folder.file("arm.toml", PENDULUM);
    folder.file("log.csv", part(&lines[..4000]));
    folder.file("other.csv", part(&lines[4000..]));
    for (k, name) in ["run1.csv", "run2.csv", "run3.csv"].into_iter().enumerate() {
        folder.file(name, part(&lines[2000 * k..2000 * (k + 1)]));
    }
    folder.file("servo.csv", servo(&all));
    let [arm, campaign] = ["arm.toml", "campaign.csv"].map(|name| folder.name(name));
    let spring = "joint_compliance@joint 1=1e-5";
    stiffarm(&["simulate", &arm, "--csv", &campaign, "--payload", "5kg", "--effect", spring])
        .good();
    folder.file("recorded.csv", rows("timestamp,actual_q_0,actual_current_0"));
    let guide = read("docs/logs.md");
    let blocks = guide.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let commands: Vec<&str> = blocks.flat_map(str::lines).collect();
    assert!(commands.len() > 8, "{commands:?}");
    for command in commands {
        let run = Command::new(env!("CARGO_BIN_EXE_stiffarm"))
            .args(&words(command)[1..])
            .current_dir(folder.path(""))
            .output()
            .expect("the binary runs");
        let err = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{command}: {err}");
    }
    for made in [
        "log.html",
        "better.toml",
        "better.xml",
        "better.urdf",
        "servo.json",
        "both.toml",
        "both.html",
    ] {
        assert!(folder.names().contains(&made.to_owned()), "{made}");
    }
}
