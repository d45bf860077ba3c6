//! `stiffarm measurements`.

use crate::support::{Folder, read, stiffarm, text};

const RAW: &str = "Export 7\n\nA1;A2;Höhe\n10,5;-20;0,8\n11;-21;0,9\n";

#[test]
fn a_foreign_table_becomes_a_measurement_file() {
    let folder = Folder::new();
    let raw = folder.file("raw.txt", RAW);
    let map = folder.file("map.toml", "[columns]\ndy = { column = \"Höhe\", unit = \"mm\" }\n");
    let out = folder.name("run.csv");
    let arguments = ["measurements", &raw, "--map", &map, "--robot", "lin_planar", "--csv", &out];
    let run = stiffarm(&arguments);
    assert_eq!((run.status, run.out.as_str()), (0, ""), "{}", run.err);
    assert_eq!(read(&out), "q1[deg],q2[deg],dy[mm]\n10.5,-20,0.8\n11,-21,0.9\n");
    for said in ["a comma begins the decimals", "`A1` is q1[deg]", "`Höhe` is dy[mm]", "2 rows"] {
        assert!(run.err.contains(&format!("note: {said}")), "{}", run.err);
    }
}

#[test]
fn a_second_table_stands_beside() {
    let folder = Folder::new();
    let tracker = folder.file("tracker.csv", "Time [s];X [mm];Y [mm]\n0,5;1;2\n1,5;3;4\n");
    let log = folder.file("log.csv", "Time [ms],J1,J2\n0,0.1,0.2\n1000,0.3,0.4\n2000,0.3,0.6\n");
    let run = stiffarm(&["measurements", &tracker, "--join", &log, "--by", "time"]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(
        run.out,
        "q1[rad],q2[rad],time[s],x[mm],y[mm]\n0.2,0.30000000000000004,0.5,1,2\n0.3,0.5,1.5,3,4\n"
    );
}
