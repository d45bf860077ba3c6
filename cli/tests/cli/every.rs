//! What holds for every command that reads or writes a file: one clear sentence where that cannot
//! be, the status as documented, and nothing half-written.

use std::process::{Command, Stdio};

use crate::support::{Folder, REPOSITORY, command, read, run, stiffarm, text};

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
        &["papers"],
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

/// Where in a command a file is read.
const READS: [(&[&str], usize); 7] = [
    (&URDF, 1),
    (&SPRINGS, 1),
    (&SPRINGS, 2),
    (&LIN, 2),
    (&COMPENSATE, 1),
    (&COMPENSATE, 3),
    (&PAPER, 1),
];

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = Folder::new();
    let garbage = folder.file("garbage", b"\xff\xfe\x00\x9fnot,a\ntext");
    let empty = folder.file("empty", "");
    for (arguments, at) in READS {
        let mut arguments = arguments.to_vec();
        if arguments[0] == "compensate" {
            arguments.extend(["--out", "-"]);
        }
        if arguments[0] == "import" {
            arguments.extend(["--toml", "-"]);
        }
        for (file, named) in [
            ("no/such.file", "no/such.file"),
            ("docs", "docs"),
            (&garbage, "garbage"),
            (&empty, "empty"),
        ] {
            arguments[at] = file;
            let err = stiffarm(&arguments).refused();
            assert!(err.contains(named), "{arguments:?}: {err}");
            assert!(err.contains("error"), "{arguments:?}: {err}");
        }
    }
}

#[test]
fn a_missing_column_is_named() {
    let folder = Folder::new();
    let without = |file: &str, column: &str| {
        let whole = read(file);
        let mut lines = whole.lines().filter(|line| !line.starts_with('#'));
        let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
        let gone = header.iter().position(|name| name.starts_with(column)).expect("a column");
        let kept = |line: &str| {
            let cells = line.split(',').enumerate().filter(|(k, _)| *k != gone);
            cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",")
        };
        let rest: Vec<String> =
            std::iter::once(header.join(",").as_str()).chain(lines).map(kept).collect();
        folder.file("less.csv", rest.join("\n"))
    };
    for (arguments, at, file, column) in [
        (&SPRINGS[..], 2, "docs/workbench/run.csv", "q3"),
        (&["diagnose", SPRINGS[1], ""], 2, "docs/workbench/run.csv", "q3"),
        (&["diagnose", SPRINGS[1], ""], 2, "docs/workbench/check.csv", "y"),
        (&COMPENSATE[..], 3, "docs/workbench/path.csv", "z"),
    ] {
        let less = text(std::path::Path::new(&without(file, column)));
        let mut arguments = arguments.to_vec();
        arguments[at] = &less;
        if arguments[0] == "compensate" {
            arguments.extend(["--out", "-"]);
        }
        let err = stiffarm(&arguments).refused();
        let named = err.contains(&format!("`{column}`")) || err.contains(&format!(" {column}"));
        assert!(named && err.contains("less.csv"), "{arguments:?}: {err}");
    }
}

#[test]
fn results_are_not_written_over_each_other_or_over_what_is_read() {
    let folder = Folder::new();
    let robot = folder.file("arm.toml", read(SPRINGS[1]));
    let data = folder.file("run.csv", read("docs/workbench/check.csv"));
    let link = folder.name("link.csv");
    #[cfg(unix)]
    std::os::unix::fs::symlink(&data, &link).expect("a link");
    #[cfg(windows)]
    std::os::windows::fs::symlink_file(&data, &link).expect("a link");
    let (there, same) = (read("docs/workbench/check.csv"), read(SPRINGS[1]));
    for (line, over) in [
        (format!("diagnose {robot} {data} --report {data}"), "--report would write over DATA"),
        (format!("diagnose {robot} {data} --json {link}"), "--json would write over DATA"),
        (
            format!("diagnose {robot} {data} --write-robot {robot}"),
            "--write-robot would write over ROBOT",
        ),
        (
            format!("diagnose {robot} {data} --check {link} --json {link}"),
            "--json would write over",
        ),
        (format!("identify {robot} docs/workbench/run.csv --write-robot {robot}"), "over ROBOT"),
        (format!("simulate {robot} {data} --csv {data}"), "--csv would write over DATA"),
        (
            format!("compensate {robot} --targets {data} --out {data}"),
            "--out would write over --targets",
        ),
        (format!("generate {robot} --emit rust --out {robot}"), "--out would write over ROBOT"),
        (format!("eval {robot} --q 0,0,0,0,0,0 --json {robot}"), "--json would write over ROBOT"),
    ] {
        let err = run(&line).refused();
        assert!(err.contains(over), "{line}: {err}");
    }
    let out = folder.name("out");
    let err = stiffarm(&["diagnose", &robot, &data, "--json", &out, "--report", &out]).refused();
    assert!(err.contains("--report would write over --json"), "{err}");
    assert_eq!(std::fs::read_to_string(&data).expect("there"), there);
    assert_eq!(std::fs::read_to_string(&robot).expect("there"), same);
    assert_eq!(folder.names(), ["arm.toml", "link.csv", "run.csv"]);
    // What is no file takes whatever comes.
    run(&format!("diagnose {robot} {data} --json /dev/null --report /dev/null --quiet")).good();
}
