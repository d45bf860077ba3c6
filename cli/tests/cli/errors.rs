//! Doubts, and outputs that cannot be written.
use crate::support::{Folder, command, has, stiffarm};

const ROBOT: &str = "name = \"arm\"\nconvention = \"standard\"\n[[joint]]\ntype = \"revolute\"\n\
                     a = 1.0\n[[joint]]\ntype = \"revolute\"\na = 0.5\n";

#[test]
fn doubts_are_warnings() {
    let folder = Folder::new();
    let file = folder.file("arm.toml", ROBOT.replace("a = 0.5", "a = 0.5\nalpha = 1.5708"));
    let run = stiffarm(&["eval", &file, "--q", "0,0"]).ended(0);
    has(&run.err, &["looks like a rounded pi/2", "arm.toml:9:9\n"]);
    let quiet = stiffarm(&["--quiet", "eval", &file, "--q", "0,0"]);
    assert_eq!((quiet.status, quiet.err.as_str()), (0, ""));
}

#[test]
fn outputs_that_cannot_be_written() {
    let q = ["eval", "jweeg_two_link", "--set", "a1=1", "--set", "a2=1", "--q", "0,0", "--json"];
    let to = |out: &str, expected: &str| {
        let err = stiffarm(&[&q[..], &[out]].concat()).refused();
        assert_eq!(err.lines().count(), 1, "{err}");
        assert!(err.contains(expected), "{err}");
    };
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
