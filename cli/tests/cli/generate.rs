//! `stiffarm generate`.

use stiffarm_codegen::emit::{FILE_HEAD, RustOptions, rust};
use stiffarm_codegen::robot::Robot;
use stiffarm_robots::{ARMS, SYMBOLIC};

use crate::support::{Folder, names, read, stiffarm};

/// The robots of the collection by id.
fn collection() -> impl Iterator<Item = (&'static str, Robot)> {
    let numeric = ARMS.iter().map(|arm| (arm.id, arm.toml));
    let symbolic = SYMBOLIC.iter().map(|arm| (arm.id, arm.toml));
    let read = |(id, toml)| (id, Robot::from_toml(toml, id).expect("a valid file").0);
    numeric.chain(symbolic).map(read)
}

#[test]
fn the_same_table_gives_the_same_bytes() {
    for emit in ["rust", "python", "cuda", "latex", "dot"] {
        let arguments = ["generate", "lin_planar", "--emit", emit];
        let out = stiffarm(&arguments).good();
        assert_eq!(stiffarm(&arguments).good(), out);
        let of_file = stiffarm(&["generate", "robots/arms/lin_planar.toml", "--emit", emit]).good();
        assert_eq!(of_file, out);
        assert!(out.ends_with('\n') && out.len() > 500, "{emit}");
    }
}

#[test]
fn what_is_written_can_be_checked() {
    let folder = Folder::new();
    let file = folder.name("ur5.rs");
    let of = |extra: &[&str]| stiffarm(&[&["generate", "ur5", "--emit", "rust"], extra].concat());
    assert_eq!(of(&["--out", &file]).good(), "");
    assert_eq!(std::fs::read_to_string(&file).expect("written"), of(&[]).good());
    assert_eq!(of(&["--out", "-"]).good(), of(&[]).good());
    assert!(of(&["--check", &file]).good().contains("is what ur5 gives"));
    assert_eq!(of(&["--check", &file, "--quiet"]).good(), "");
    assert_eq!(folder.names(), ["ur5.rs"]);
}

#[test]
fn a_missing_folder_is_made() {
    let folder = Folder::new();
    for (emit, out, expected) in [
        ("c", "new/firmware", ["ur5.c", "ur5.h"].as_slice()),
        ("rust", "other/src/ur5.rs", &["ur5.rs"]),
    ] {
        let of = |to: &str| {
            let path = folder.name(out);
            stiffarm(&["generate", "ur5", "--emit", emit, to, &path])
        };
        assert_eq!(of("--out").good(), "");
        assert!(of("--check").good().contains("is what ur5 gives"));
        let inner = folder.path(out);
        let inner = if emit == "c" { &inner } else { inner.parent().expect("a folder") };
        assert_eq!(names(inner), expected);
    }
    let file = folder.file("file", "before");
    let under = folder.name("file/src/ur5.rs");
    let err = stiffarm(&["generate", "ur5", "--emit", "rust", "--out", &under]).refused();
    assert!(err.contains("cannot write "), "{err}");
    assert_eq!(std::fs::read_to_string(&file).expect("there"), "before");
}

#[test]
fn a_difference_is_shown_with_its_line() {
    let folder = Folder::new();
    let text = stiffarm(&["generate", "ur5", "--emit", "rust"]).good();
    let mut lines: Vec<&str> = text.lines().collect();
    let fifth = lines[4];
    lines[4] = "// by hand";
    let edited = folder.file("edited.rs", lines.join("\n") + "\n");
    let run = stiffarm(&["generate", "ur5", "--emit", "rust", "--check", &edited]);
    assert_eq!((run.status, run.err.as_str()), (1, ""));
    assert!(run.out.contains("first in line 5:"), "{}", run.out);
    assert!(run.out.contains(&format!("expected {fifth}\n     found // by hand\n")), "{}", run.out);
    // The check itself writes nothing.
    assert_eq!(std::fs::read_to_string(&edited).expect("still there"), lines.join("\n") + "\n");

    let differs = |content: &str, message: &str| {
        let file = folder.file("other.rs", content);
        let run = stiffarm(&["generate", "ur5", "--emit", "rust", "--check", &file]).ended(1);
        assert!(run.out.contains(message), "{}", run.out);
    };
    differs("", "found (the file has ended)");
    differs(&format!("{text}more\n"), "expected (the file has ended)");
    differs(text.trim_end(), "found \"");
    differs(&text.replacen('\n', "\r\n", 1), "\\r\\n\"");
}

#[test]
fn outputs_are_chosen() {
    let one = stiffarm(&["generate", "ur5", "--emit", "latex", "--outputs", "pose"]).good();
    let two = stiffarm(&["generate", "ur5", "--emit", "latex", "--outputs", "pose,jacobian"]);
    assert!(one.contains("{pose}") && !one.contains("{jacobian}"));
    assert!(two.good().contains("{jacobian}"));
    let dot = stiffarm(&["generate", "ur5", "--emit", "dot", "--outputs", "joint_torque"]).good();
    let rust =
        stiffarm(&["generate", "ur5", "--emit", "rust", "--outputs", "jacobian,pose"]).good();
    assert!(rust.contains("pub fn all<") && !rust.contains("pub fn joint_torque<"));
    assert!(rust.contains("`stiffarm generate ROBOT --outputs pose,jacobian --check FILE`"));
    assert!(dot.starts_with("digraph") && dot.contains("joint_torque 1,1"));
    let kernels =
        stiffarm(&["generate", "ur5", "--emit", "rust", "--kernels", "crate::kernels"]).good();
    assert!(kernels.contains("crate::kernels::") && !kernels.contains("::stiffarm::kernels"));
}

#[test]
fn symbolic_robots_stay_symbolic() {
    let out = stiffarm(&["generate", "jweeg_two_link", "--emit", "rust"]).good();
    assert!(out.contains("pub struct Parameters<S>"));
}

#[test]
fn the_command_writes_what_the_library_returns_after_a_head() {
    for (id, robot) in collection() {
        let written =
            stiffarm(&["generate", &format!("robots/arms/{id}.toml"), "--emit", "rust"]).out;
        let text = rust(&robot, &RustOptions::default());
        assert!(written.strip_prefix(FILE_HEAD) == Some(&text), "{id}");
    }
}

#[test]
fn the_command_fuses_rust_alone() {
    let (_, robot) = collection().find(|(id, _)| *id == "ur10").expect("in the collection");
    let text = rust(&robot, &RustOptions { fused: true, ..RustOptions::default() });
    let fused = ["generate", "robots/arms/ur10.toml", "--emit", "rust", "--fused"];
    let written = stiffarm(&fused).out;
    assert!(written.strip_prefix(FILE_HEAD) == Some(&text));
}

/// The block of docs/dynamics.md is what its command prints, but for the lines that `…` stands for.
#[test]
fn base_parameters_are_those_of_the_page() {
    let page = read("docs/dynamics.md");
    let (_, block) =
        page.split_once("$ stiffarm generate panda --emit base\n").expect("the command");
    let (shown, _) = block.split_once("```").expect("the block's end");
    let (first, last) = shown.split_once("     …\n").expect("lines left out");
    let printed = stiffarm(&["generate", "panda", "--emit", "base"]).good();
    assert!(printed.starts_with(first) && printed.ends_with(last), "{printed}");
}
