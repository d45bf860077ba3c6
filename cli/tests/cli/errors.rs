//! What cannot be done is refused: a message with its place, status 2, nothing written.
use crate::support::{Folder, command, stiffarm, text};

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
fn mistakes_of_a_robot_file_are_shown_where_they_stand() {
    let folder = Folder::new();
    let bad = ROBOT.replace("standard", "standart").replace("a = 0.5", "a = \"350 kg\"");
    let file = folder.file("bad.toml", bad);
    let out = folder.name("out.json");
    let expected = [
        "standart",
        "bad.toml:2:14\n",
        "did you mean `standard`?",
        "`350 kg` is a mass; a length is expected here",
        "bad.toml:8:6\n",
    ];
    refused(&["eval", &file, "--q", "0,0", "--json", &out], &expected);
    refused(&["check", &file], &expected);
    refused(&["generate", &file, "--emit", "rust", "--out", &out], &expected);
    refused(&["diagnose", &file, "robots/data/lin1991_table3.csv", "--json", &out], &expected);
    assert_eq!(folder.names(), ["bad.toml"]);
    let broken = folder.file("broken.toml", "[[joint\n");
    refused(&["eval", &broken, "--q", "0"], &["broken.toml:1:", "TOML"]);
    let empty = folder.file("empty.toml", "");
    refused(&["eval", &empty, "--q", "0"], &["empty.toml: line 1, column 1"]);
    let binary = folder.file("binary.toml", b"name = \"a\"\n\xff\xfe");
    refused(&["eval", &binary, "--q", "0"], &["line 2, column 1: found byte 0xff, expected UTF-8"]);
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
fn mistakes_of_a_measurement_file_are_shown_where_they_stand() {
    let folder = Folder::new();
    let robot = folder.file("arm.toml", ROBOT);
    let out = folder.name("out.json");
    let cases = [
        ("q1,q2,dx\n0.1,nan,1\n", "line 2, column 2 `q2`: found `nan`", "run.csv:2:5\n"),
        ("q1,q2,dx\n0.1,0.2,-inf\n", "line 2, column 3 `dx`: found `-inf`, infinity", ":2:9\n"),
        (
            "q1,q2,dx\n0.1,abc,1\n",
            "line 2, column 2 `q2`: found `abc`, expected an angle",
            ":2:5\n",
        ),
        ("q1,q2,dx\n# remark\n0.1,0.2\n", "line 3: found 2 cells, expected 3", "run.csv:3:1\n"),
        ("q1,q2,dx,q1\n0.1,0.2,1,0.1\n", "`q1` stands in column 1 already", "run.csv:1:10\n"),
        (
            "q1,q2[mm],dx\n0.1,0.2,1\n",
            "found `mm`, the unit of a length, expected an angle",
            ":1:4\n",
        ),
        ("q1,q2,q3,dx\n0.1,0.2,0,1\n", "found joint number 3, expected 1 to 2", "run.csv:1:7\n"),
        ("q1,q2,fx\n0.1,0.2,1\n", "found no measured column", "run.csv:1:1\n"),
        ("q1,dx\n0.1,1\n", "found no column q2", "run.csv:1:1\n"),
        ("q1,q2,dx\n", "found no rows", "run.csv:1:1\n"),
        ("q1;q2;dx\n1;2;3\n", "found columns separated by semicolons", "run.csv:1:1\n"),
        ("", "run.csv: line 1: found nothing, expected a header row", "run.csv"),
        ("q1,q2,dx\n0.1,0.2,1\n", "found 1 pose, expected at least 2", "run.csv"),
        ("q1,q2,x,y,z,marker\n0.1,0.2,1,0,0,m\n", "found the unknown marker `m`", ":2:15\n"),
    ];
    for (content, message, place) in cases {
        let run = folder.file("run.csv", content);
        refused(&["diagnose", &robot, &run, "--json", &out], &[message, place]);
    }
    let run = folder.file("run.csv", b"q1,q2,dx\n0.1,\xff,1\n");
    refused(&["diagnose", &robot, &run], &["run.csv: line 2, column 2: found byte 0xff"]);
    let long = format!("q1,q2,dx\n{}", "0.1,x,1\n".repeat(30));
    let run = folder.file("run.csv", long);
    refused(&["diagnose", &robot, &run], &["run.csv:21:5\n", "and 10 more mistakes"]);
    assert_eq!(folder.names(), ["arm.toml", "run.csv"]);
}

#[test]
fn files_that_are_not_there() {
    refused(&["eval", "no.toml", "--q", "0"], &["error: cannot read no.toml: no such file"]);
    refused(&["eval", "robots/", "--q", "0"], &["error: cannot read robots/: it is a folder"]);
    refused(&["eval", "ur55", "--q", "0"], &["found no robot `ur55`", "did you mean `ur5`?"]);
    refused(&["diagnose", "lin_planar", "no.csv"], &["error: cannot read no.csv: no such file"]);
    refused(&["generate", "ur5", "--emit", "rust", "--check", "no.rs"], &["cannot read no.rs"]);
}

#[test]
fn arguments_that_do_not_fit() {
    let q = "0,0,0,0,0,0";
    refused(
        &["eval", "ur5", "--q", "0,0"],
        &["--q: found 2 values, expected 6 values", "UR5 has 6 joints"],
    );
    refused(
        &["eval", "ur5", "--q", "0,0,0,0,x,0"],
        &["--q: value 5: found `x`, expected an angle"],
    );
    refused(&["eval", "ur5", "--q", "0,0,0,0,1mm,0"], &["value 5: found `1mm`", "rad, deg, mrad"]);
    refused(&["eval", "ur5", "--q", "0,0,0,0,nan,0"], &["value 5: found `nan`"]);
    refused(&["eval", "ur5", "--q", q, "--wrench", "1,2,3"], &["--wrench: found 3 values"]);
    refused(&["eval", "ur5", "--q", q, "--wrench", "1,2,3,1N,0,0"], &["expected a moment"]);
    refused(&["eval", "ur5", "--q", q, "--set", "a=1"], &["UR5 has no symbolic parameter `a`"]);
    refused(&["eval", "ur5", "--q", q, "--set", "a"], &["found `a`, expected NAME=VALUE"]);
    refused(
        &["eval", "jweeg_two_link", "--q", "0,0", "--set", "a1=x"],
        &["--set a1: found `x`", "in m"],
    );
    refused(&["eval", "jweeg_two_link", "--q", "0,0", "--set", "A1=1"], &["did you mean `a1`?"]);
    refused(
        &["eval", "kuka_kr240", "--q", q, "--wrench", "-1e9,0,0,0,0,0"],
        &["the arm is not stable under this load"],
    );
    refused(&["eval", "ur5"], &["--q <q1,q2,…>"]);
    refused(&["check"], &["<ROBOT|--all>"]);
    refused(&["check", "ur5", "--all"], &["cannot be used with"]);
    refused(&["check", "ur5", "--count", "0"], &["--count"]);
    refused(&["check", "jweeg_two_link"], &["found no number for a1, a2"]);
    refused(&["generate", "ur5", "--emit", "fortran"], &["rust, c, cuda, python, latex, dot"]);
    let outputs = |list: &str, told: &[&str]| {
        refused(&["generate", "ur5", "--emit", "latex", "--outputs", list], told);
    };
    outputs("poses", &["did you mean `pose`?"]);
    outputs("pose at elbow", &["`elbow` is no frame of this robot", "no [[frame]]"]);
    refused(&["generate", "ur5", "--emit", "dot", "--kernels", "k"], &["--kernels is for rust"]);
    refused(
        &["generate", "ur5", "--emit", "rust", "--out", "a", "--check", "b"],
        &["cannot be used"],
    );
    refused(&["frobnicate"], &["frobnicate"]);
}

#[test]
fn options_of_diagnose_that_do_not_fit() {
    let with = |extra: &[&str], expected: &[&str]| {
        let lin = ["diagnose", "lin_planar", "robots/data/lin1991_table3.csv"];
        refused(&[&lin[..], extra].concat(), expected);
    };
    with(
        &["--nuisance", "base_fram"],
        &["expected base_frame, tool_frame or geometry; did you mean"],
    );
    let both = ["--json", "-", "--report", "-"];
    with(&both, &["--json and --report cannot both go to standard output"]);
    with(&["--rival", "foo"], &["expected `foo_dy`", "the file has predictions of `ycd`, `ytd`"]);
    with(&["--noise-position", "30"], &["--noise-position: found `30`", "m, mm, um, in"]);
    with(&["--noise-position", "-3um"], &["found `-3um`, expected a positive number"]);
    with(&["--noise-rotation", "3um"], &["--noise-rotation: found `3um`", "rad, deg, mrad"]);
    with(&["--effects", "joint_complience"], &["did you mean `joint_compliance`?"]);
    with(&["--folds", "1"], &["found 1 fold, expected 2 to 12"]);
    with(&["--folds", "x"], &["--folds"]);
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
