//! `stiffarm generate --emit c`: two files, their check, what is refused.

use crate::support::{Folder, stiffarm};

/// The exit status, standard output and standard error of `stiffarm generate`.
fn generate(arguments: &[&str]) -> (i32, String, String) {
    let run = stiffarm(&[&["generate"], arguments].concat());
    (run.status, run.out, run.err)
}

#[test]
fn both_files_are_written_and_checked() {
    let folder = Folder::new();
    let place = folder.name("");
    let place = place.as_str();
    let by_id = ["ur5", "--emit", "c", "--precision", "f32"];
    let by_file = ["robots/arms/ur5.toml", "--emit", "c", "--precision", "f32"];
    let with = |robot: &[&str], extra: [&str; 2]| generate(&[robot, &extra].concat());
    assert_eq!(with(&by_id, ["--out", place]), (0, String::new(), String::new()));
    assert_eq!(folder.names(), ["ur5.c", "ur5.h"]);

    for robot in [&by_id, &by_file] {
        let (status, out, _) = with(robot, ["--check", place]);
        assert_eq!((status, out.matches("is what").count()), (0, 2), "{out}");
    }
    // In another precision neither file is the same.
    let (status, out, _) = generate(&["ur5", "--emit", "c", "--check", place]);
    assert_eq!((status, out.matches("is not what").count()), (1, 2), "{out}");
    // By hand: one file differs, the other is still told to be good.
    let source = std::fs::read_to_string(folder.path("ur5.c")).expect("written");
    folder.file("ur5.c", source.replacen("0.425f", "0.426f", 1));
    let (status, out, _) = with(&by_id, ["--check", place]);
    assert_eq!((status, out.matches("is not what").count()), (1, 1), "{out}");
    assert!(out.contains("0.426f"), "{out}");
}

#[test]
fn names_are_the_caller_s() {
    let folder = Folder::new();
    let place = folder.name("");
    let place = place.as_str();
    let of = |name| generate(&["ur5", "--emit", "c", "--name", name, "--out", place]);
    assert_eq!(of("left_arm").0, 0);
    let header = std::fs::read_to_string(folder.path("left_arm.h")).expect("written");
    assert!(header.contains("void left_arm_pose(const double q[LEFT_ARM_JOINTS]"));
    let (status, _, error) = of("Left-Arm");
    assert_eq!(status, 2);
    assert!(error.contains("`Left-Arm`") && error.contains("`left_arm`"), "{error}");
}
