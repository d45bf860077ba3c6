//! Generated Rust in a crate of a user's own: `cargo fmt` and the strictest lints leave it alone, and
//! `--check` still holds.

use std::path::Path;
use std::process::Command;

use crate::support::{Folder, REPOSITORY, stiffarm};

/// A crate whose module `arm` is what `generate` wrote.
fn krate(robot: &str, extra: &[&str]) -> Folder {
    let folder = Folder::new();
    let root = Path::new(REPOSITORY).canonicalize().expect("the repository");
    let kernels = root.join("kernels");
    let manifest = "[package]\nname = \"user\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\
                    [workspace]\n[dependencies.stiffarm-kernels]\n";
    folder.file("Cargo.toml", format!("{manifest}path = {kernels:?}\n"));
    std::fs::copy(root.join("Cargo.lock"), folder.path("Cargo.lock")).expect("the versions in use");
    std::fs::create_dir(folder.path("src")).expect("a folder");
    let lints = "clippy::all, clippy::pedantic, clippy::nursery, clippy::arithmetic_side_effects, \
                 clippy::float_arithmetic, clippy::indexing_slicing, missing_docs, unused";
    folder.file(
        "src/lib.rs",
        format!("//! A crate.\n#![warn({lints})]\n/// An arm.\npub mod arm;\n"),
    );
    assert_eq!(generate(&folder, robot, extra, "--out"), "");
    folder
}

fn generate(folder: &Folder, robot: &str, extra: &[&str], to: &str) -> String {
    let file = folder.name("src/arm.rs");
    let form = ["generate", robot, "--emit", "rust", "--kernels", "::stiffarm_kernels", to, &file];
    stiffarm(&[&form, extra].concat()).good()
}

/// Runs cargo in the crate.
fn cargo(folder: &Folder, arguments: &[&str]) -> (bool, String) {
    let mut cargo = Command::new(env!("CARGO"));
    // One folder for all of them: the kernels crate is built once.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("committed");
    cargo.args(arguments).current_dir(folder.path("")).env("CARGO_TARGET_DIR", target);
    let output = cargo.output().expect("cargo runs");
    (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Plain, fused and with symbolic link parameters; and the flexible kinematics.
const FORMS: [(&str, &[&str]); 4] = [
    ("ur10", &[]),
    ("kuka_kr240", &["--fused"]),
    ("jweeg_two_link", &[]),
    ("jweeg_two_link", &["--flexible", "dx1,dphi2"]),
];

#[test]
#[ignore = "needs rustfmt"]
fn needs_rustfmt_formatting_leaves_a_generated_file_alone() {
    for (robot, extra) in FORMS {
        let folder = krate(robot, extra);
        let (done, said) = cargo(&folder, &["fmt"]);
        assert!(done, "{said}");
        let said = generate(&folder, robot, extra, "--check");
        assert!(said.contains(&format!("is what {robot} gives")), "{said}");
    }
    // The control: without the head it is formatted.
    let folder = krate("ur10", &[]);
    let bare = std::fs::read_to_string(folder.path("src/arm.rs")).expect("written");
    let bare = bare.replacen("#![cfg_attr(rustfmt, rustfmt_skip)]\n", "", 1);
    folder.file("src/arm.rs", &bare);
    assert!(cargo(&folder, &["fmt"]).0);
    assert_ne!(std::fs::read_to_string(folder.path("src/arm.rs")).expect("written"), bare);
}

#[test]
#[ignore = "needs clippy"]
fn needs_clippy_no_lint_of_a_user_s_crate_is_tripped() {
    for (robot, extra) in FORMS {
        let folder = krate(robot, extra);
        let (done, said) = cargo(&folder, &["clippy", "--offline", "--", "-D", "warnings"]);
        assert!(done, "{robot}: {said}");
    }
    // The control: without the head there is something to say.
    let folder = krate("ur10", &[]);
    let bare = std::fs::read_to_string(folder.path("src/arm.rs")).expect("written");
    let bare: Vec<&str> = bare.lines().filter(|line| !line.starts_with("#![allow")).collect();
    folder.file("src/arm.rs", bare.join("\n"));
    assert!(!cargo(&folder, &["clippy", "--offline", "--", "-D", "warnings"]).0);
}
