//! README's way from a tracker's file to firmware: its three commands, as they are printed there.

use crate::support::{Folder, number, read, stiffarm};
use crate::workbench::same;

/// What the commands write, in the folder in which they are called.
const WRITTEN: [&str; 3] = ["better.toml", "firmware", "commands.csv"];

#[test]
fn three_commands_lead_from_a_tracker_s_file_to_firmware() {
    let readme = read("README.md");
    let section = readme.split("## From a tracker's file to firmware").nth(1).expect("the section");
    let block = section.split("```sh\n").nth(1).and_then(|b| b.split("```").next());
    let commands: Vec<&str> = block.expect("its commands").lines().collect();
    assert_eq!(commands.len(), 3, "{commands:?}");
    let folder = Folder::new();
    for command in commands {
        let words = command.split_whitespace().skip(1).map(|word| match WRITTEN.contains(&word) {
            true => folder.name(word),
            false => word.to_owned(),
        });
        let run = stiffarm(&words.collect::<Vec<String>>());
        assert_eq!(run.status, 0, "{command}: {}", run.err);
    }
    let made = |name: &str| read(&folder.name(name));
    // The example compiles what the first command writes.
    same("examples/compensation/better.toml", &made("better.toml"));
    // The second one's functions take the side from which joint 1 came: it has play.
    let header = made("firmware/better.h");
    assert!(header.contains("void better_joints(const float q[BETTER_JOINTS], const float sides["));
    // Every point of the path is reached, but for a micrometre.
    let commands = made("commands.csv");
    assert_eq!(commands.lines().filter(|line| line.ends_with("reached")).count(), 5, "{commands}");
}

/// With what a posture does not decide said, the same table tells pose and deflection.
#[test]
fn eval_takes_the_sides_of_a_corrected_arm() {
    let q = "0.2,1.2,-0.9,0.3,0.8,-0.4";
    let at = ["eval", "examples/compensation/better.toml", "--q", q, "--json", "-"];
    let position = |sides: &str| -> [f64; 2] {
        let out = stiffarm(&[&at[..], &["--sides", sides]].concat()).json();
        [0, 1].map(|k| number(&out["position"][k]))
    };
    let ([x, y], [behind_x, behind_y]) = (position("-1,0,0,0,0,0"), position("1,0,0,0,0,0"));
    // The dead band of joint 1, which turns about the base's z.
    let turned = y.atan2(x) - behind_y.atan2(behind_x);
    assert!((turned - 0.00039642662174615946).abs() < 1e-14, "{turned}");
}
