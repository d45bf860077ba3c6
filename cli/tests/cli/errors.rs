//! What cannot be done is refused: a message with its place, status 2, nothing written.
use crate::support::{Folder, command, stiffarm};

const ROBOT: &str = "name = \"arm\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\n\
                     a = 1.0\n[[joint]]\ntype = \"revolute\"\na = 0.5\n";

#[track_caller]
fn refused(arguments: &[&str], expected: &[&str]) {
    let err = stiffarm(arguments).refused();
    for text in expected {
        assert!(err.contains(text), "no `{text}` in\n{err}");
    }
}

#[test]
fn doubts_are_warnings() {
    let folder = Folder::new();
    let file = folder.file("arm.toml", ROBOT.replace("a = 0.5", "a = 0.5\nalpha = 1.5708"));
    let run = stiffarm(&["eval", &file, "--q", "0,0"]);
    assert_eq!(run.status, 0);
    assert!(
        run.err.contains("looks like a rounded pi/2") && run.err.contains("arm.toml:9:9\n"),
        "{}",
        run.err
    );
    let quiet = stiffarm(&["--quiet", "eval", &file, "--q", "0,0"]);
    assert_eq!((quiet.status, quiet.err.as_str()), (0, ""));
}

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Folder::new();
    let q = ["eval", "jweeg_two_link", "--set", "a1=1", "--set", "a2=1", "--q", "0,0", "--json"];
    let to = |out: &str, expected: &str| {
        let err = stiffarm(&[&q[..], &[out]].concat()).refused();
        assert_eq!(err.lines().count(), 1, "{err}");
        assert!(err.contains(expected), "{err}");
    };
    to(&folder.name("no/such.json"), "such.json: no such file or folder");
    to(&folder.name(""), "it is a folder");
    if cfg!(target_os = "linux") {
        to("/dev/full", "cannot write /dev/full: no space left");
        let full = std::fs::File::options().write(true).open("/dev/full").expect("there");
        let output = command(&["robots"]).stdout(full).output().expect("runs");
        assert_eq!(output.status.code(), Some(2));
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(err, "error: cannot write to standard output: no space left\n");
        stiffarm(&[&q[..], &["/dev/null"]].concat()).good();
    }
}

#[test]
fn what_was_there_stays_when_the_work_fails() {
    let folder = Folder::new();
    let out = folder.file("out.json", "before");
    refused(&["eval", "ur5", "--q", "0", "--json", &out], &["--q"]);
    refused(&["diagnose", "lin_planar", "no.csv", "--json", &out], &["no.csv"]);
    assert_eq!(std::fs::read_to_string(&out).expect("there"), "before");
    assert_eq!(folder.names(), ["out.json"]);
}
