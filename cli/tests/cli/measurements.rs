//! `stiffarm measurements`.

use crate::support::{Folder, read, stiffarm, text};

const RAW: &str = "Export 7\n\nA1;A2;Höhe\n10,5;-20;0,8\n11;-21;0,9\n";

#[test]
fn a_foreign_table_becomes_a_measurement_file() {
    let folder = Folder::new();
    let raw = folder.file("raw.txt", RAW);
    let map = folder.file("map.toml", "[columns]\ndy = { column = \"Höhe\", unit = \"mm\" }\n");
    let out = text(&folder.path("run.csv"));
    let arguments = ["measurements", &raw, "--map", &map, "--robot", "lin_planar", "--csv", &out];
    let run = stiffarm(&arguments);
    assert_eq!((run.status, run.out.as_str()), (0, ""), "{}", run.err);
    assert_eq!(read(&out), "q1[deg],q2[deg],dy[mm]\n10.5,-20,0.8\n11,-21,0.9\n");
    for said in ["a comma begins the decimals", "`A1` is q1[deg]", "`Höhe` is dy[mm]", "2 rows"] {
        assert!(run.err.contains(&format!("note: {said}")), "{}", run.err);
    }
}

#[test]
fn what_could_not_be_diagnosed_is_refused_and_nothing_is_written() {
    let folder = Folder::new();
    let raw = folder.file("raw.txt", RAW);
    let out = text(&folder.path("run.csv"));
    let err = stiffarm(&["measurements", &raw, "--robot", "lin_planar", "--csv", &out]).refused();
    assert!(err.contains("found no measured column"), "{err}");
    let err = stiffarm(&["measurements", "no.csv", "--csv", &out]).refused();
    assert!(err.contains("cannot read no.csv"), "{err}");
    assert_eq!(folder.names(), ["raw.txt"]);
}
