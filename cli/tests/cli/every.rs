//! What holds for every command that reads or writes a file: one clear sentence where that cannot
//! be, the status as documented, and nothing half-written.

use std::process::{Command, Stdio};

use crate::support::{Folder, REPOSITORY, command, read, run, stiffarm};

const LIN: [&str; 3] = ["diagnose", "lin_planar", "robots/data/lin1991_table3.csv"];
const SPRINGS: [&str; 3] = ["identify", "docs/workbench/arm.toml", "docs/workbench/run.csv"];
const MAP: [&str; 8] = ["map", "ur5", "--over", "q2,q3", "--of", "condition", "--steps", "3"];
const WITHHOLD: [&str; 6] = ["withhold", "lin_planar", "--cases", "2", "--poses", "6"];
const SIMULATE: [&str; 4] = ["simulate", "ur5", "--poses", "2"];
const PREDICT: [&str; 3] = ["predict", "docs/workbench/arm.toml", "docs/workbench/check.csv"];
const POSES: [&str; 4] = ["poses", "ur10", "--count", "2"];
const RAW: [&str; 2] = ["measurements", "docs/workbench/run.csv"];
const URDF: [&str; 2] = ["import", "tests/data/urdf/panda.urdf"];
const PAPER: [&str; 2] = ["papers", "tests/data/paper.toml"];
const EVAL: [&str; 4] = ["eval", "ur5", "--q", "0,0,0,0,0,0"];
const COMPENSATE: [&str; 6] = [
    "compensate",
    "docs/workbench/arm.toml",
    "--targets",
    "docs/workbench/path.csv",
    "--wrench",
    "0,0,-2kN,0,0,0",
];

/// A command, and an option behind which a file is written.
const WRITES: [(&[&str], &str); 23] = [
    (&EVAL, "--json"),
    (&["robots"], "--json"),
    (&["effects"], "--json"),
    (&["effects"], "--markdown"),
    (&URDF, "--toml"),
    (&RAW, "--csv"),
    (&MAP, "--csv"),
    (&MAP, "--svg"),
    (&POSES, "--csv"),
    (&SPRINGS, "--json"),
    (&SPRINGS, "--write-robot"),
    (&SPRINGS, "--report"),
    (&LIN, "--json"),
    (&LIN, "--write-robot"),
    (&LIN, "--report"),
    (&PREDICT, "--csv"),
    (&PREDICT, "--json"),
    (&SIMULATE, "--csv"),
    (&WITHHOLD, "--json"),
    (&WITHHOLD, "--report"),
    (&COMPENSATE, "--out"),
    (&PAPER, "--report"),
    (&PAPER, "--markdown"),
];

/// Notes on what was read may stand before the one error.
fn one_error(arguments: &[&str], err: &str, expected: &str) {
    let errors: Vec<&str> = err.lines().filter(|line| line.starts_with("error")).collect();
    assert_eq!(errors.len(), 1, "{arguments:?}: {err}");
    assert!(errors[0].contains(expected), "{arguments:?}: no `{expected}` in {err}");
    assert!(!err.contains("panicked"), "{arguments:?}: {err}");
}

/// A disk that is full: a device that says so, and a file that may not grow.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_what_was_there() {
    for (arguments, option) in WRITES {
        let folder = Folder::new();
        let arguments = [arguments, &["--quiet", option]].concat();
        let full = [&arguments[..], &["/dev/full"]].concat();
        let run = stiffarm(&full);
        assert_eq!(run.status, 2, "{full:?}: {}", run.err);
        one_error(&full, &run.err, "cannot write /dev/full: no space left");
        let kept = folder.file("kept", "before");
        let mut shell = Command::new("sh");
        shell.args(["-c", "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\""]);
        shell.arg(env!("CARGO_BIN_EXE_stiffarm")).args(&arguments).arg(&kept);
        shell.current_dir(REPOSITORY).stdin(Stdio::null());
        let output = shell.output().expect("a shell");
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {err}");
        one_error(&arguments, &err, "cannot write ");
        assert_eq!(std::fs::read_to_string(&kept).expect("there"), "before", "{arguments:?}");
        assert_eq!(folder.names(), ["kept"], "{arguments:?}");
    }
}

/// A reader that has seen enough (`| head`) is no mistake.
#[test]
fn a_closed_pipe_is_no_mistake() {
    let generate = ["generate", "iiwa14", "--emit", "rust"];
    let screens: [&[&str]; 8] = [
        &LIN,
        &SPRINGS,
        &WITHHOLD,
        &PAPER,
        &["man"],
        &["robots"],
        &["completions", "bash"],
        &generate,
    ];
    let plain = screens.into_iter().map(<[&str]>::to_vec);
    let written = WRITES.iter().map(|(arguments, option)| [*arguments, &[*option, "-"]].concat());
    for arguments in plain.chain(written) {
        let arguments = [&arguments[..], &["--quiet"]].concat();
        let mut child = command(&arguments);
        let child = child.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = child.spawn().expect("runs");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("ends");
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        // One of the targets of the path cannot be reached, and that is what its status says.
        let status = if arguments[0] == "compensate" { 1 } else { 0 };
        assert_eq!((output.status.code(), err.as_str()), (Some(status), ""), "{arguments:?}");
    }
}

#[test]
fn results_are_not_written_over_a_link_to_what_is_read() {
    let folder = Folder::new();
    let robot = folder.file("arm.toml", read(SPRINGS[1]));
    let data = folder.file("run.csv", read("docs/workbench/check.csv"));
    let link = folder.name("link.csv");
    #[cfg(unix)]
    std::os::unix::fs::symlink(&data, &link).expect("a link");
    #[cfg(windows)]
    std::os::windows::fs::symlink_file(&data, &link).expect("a link");
    let there = read("docs/workbench/check.csv");
    for outputs in ["--json", "--check docs/workbench/check.csv --json"] {
        let err = run(&format!("diagnose {robot} {data} {outputs} {link}")).refused();
        assert!(err.contains("--json would write over DATA"), "{err}");
    }
    assert_eq!(read(&data), there);
    // What is no file takes whatever comes.
    run(&format!("diagnose {robot} {data} --json /dev/null --report /dev/null --quiet")).good();
}
