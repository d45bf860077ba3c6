//! Joint logs as text: units, runs, damage, other programs' columns.

use stiffarm_io::{Map, ReadError};
use stiffarm_kernels::Motion;
use stiffarm_observe::log::*;

const MOTIONS: [Motion; 2] = [Motion::Revolute, Motion::Prismatic];

fn read(text: &str) -> Result<Log, ReadError> {
    Log::from_bytes("log.csv", text.as_bytes(), &MOTIONS, &Names::default())
}

const HEADER: &str = "t[ms],q1[deg],q2[mm],tau1[N*m],tau2[N],run,note\n";

#[test]
fn units_runs_and_sides_are_read() {
    let rows = "0,180,5,1.5,2,a,x\n2,90,6,2.5,3,a,y\n0,0,7,3.5,4,b,z\n";
    let log = read(&format!("# torque_side = motor. Of the joints.\n{HEADER}{rows}")).unwrap();
    assert_eq!((log.side, log.samples, log.runs.len()), (Some(TorqueSide::Motor), 3, 2));
    let run = &log.runs[0];
    assert_eq!((run.name.as_str(), run.t.as_slice()), ("a", [0.0, 0.002].as_slice()));
    let quarter = core::f64::consts::FRAC_PI_2;
    assert_eq!(run.signals[&Signal::Q], [vec![2.0 * quarter, quarter], vec![5e-3, 6e-3]]);
    assert_eq!(run.signals[&Signal::Torque], [vec![1.5, 2.5], vec![2.0, 3.0]]);
    assert_eq!(log.unknown, ["note"]);
    assert_eq!(log.remarks(), ["nothing reads note"]);
}

/// Stamps that go back begin another run; one that stands twice is one sample.
#[test]
fn stamps_are_looked_at() {
    let rows = "0,0,0,0,0,,\n2,0,0,0,0,,\n2,1,0,0,0,,\n4,0,0,0,0,,\n1,0,0,0,0,,\n";
    let log = read(&format!("{HEADER}{rows}")).unwrap();
    assert_eq!(log.runs.iter().map(|r| r.t.len()).collect::<Vec<_>>(), [3, 1]);
    assert_eq!(log.runs[0].clock.repeated, 1);
    assert!(log.remarks().concat().contains("1 samples bear the stamp"), "{:?}", log.remarks());
}

#[test]
fn damaged_rows_are_left_out_and_named() {
    let rows = "0,1,1,1,1,,\n2,1,1e306,1,1,,\n4,1,1\n6,1,1,nan,x,,\n8,1,1,1,1,,\n";
    let log = read(&format!("{HEADER}{rows}")).unwrap();
    let damaged: Vec<(u64, &str)> =
        log.damaged.iter().map(|d| (d.line, d.reason.as_str())).collect();
    assert_eq!(
        damaged,
        [
            (3, "found `1e306` for q2, expected a number"),
            (4, "found 3 cells, expected 7"),
            (5, "found `x` for tau2, expected a number"),
        ]
    );
    assert_eq!(log.samples, 2);
    assert!(log.remarks()[0].contains("3 of 5 rows are damaged and left out: line 3, 4, 5"));
}

/// A torque that one joint lacks costs no other joint a row; short gaps are interpolated.
#[test]
fn a_cell_that_other_joints_do_without_costs_them_nothing() {
    let row = |k: usize| {
        let lacks = k == 3 || (10..20).contains(&k);
        let tau2 = if lacks { "n/a".to_owned() } else { k.to_string() };
        format!("{},1,1,5,{tau2},{}\n", 2 * k, if k.is_multiple_of(4) { "20" } else { "" })
    };
    let header = "t[ms],q1[deg],q2[mm],tau1[N*m],tau2[N],temp1[degC],temp2[degC]\n";
    let rows: String = (0..30).map(row).collect::<String>().replace(",20\n", ",20,20\n");
    let log = read(&format!("{header}{}", rows.replace(",\n", ",,\n"))).unwrap();
    assert_eq!((log.samples, log.damaged.len()), (30, 0), "{:?}", log.damaged);
    let run = &log.runs[0];
    let near = |(k, x): (usize, &f64)| (x - k as f64).abs() < 1e-12;
    assert!(run.signals[&Signal::Torque][1].iter().enumerate().all(near), "{run:?}");
    let hole = Hole { signal: Signal::Torque, joint: 1, samples: 10..20 };
    assert_eq!(run.holes, [hole]);
    let said = log.remarks()[0].clone();
    assert!(said.contains("no number for tau2 in 11 rows, temp1 in 22 rows"), "{said}");
    assert!(said.contains("first in line 5 (found `n/a`)"), "{said}");
}

#[test]
fn a_wrong_header_says_what_to_mend() {
    stiffarm_draws::golden::says(
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../observe/src/log/wrong.txt"),
        |text, _| read(text).expect_err(text).to_string(),
    );
}

#[test]
fn files_of_one_log_are_alike() {
    let one = read(&format!("{HEADER}0,1,1,1,1,,\n")).unwrap();
    let both = one.clone().and(one.clone()).unwrap();
    assert_eq!((both.samples, both.runs.len(), both.files.len()), (2, 2, 2));
    let other = read("t,q1,q2,i1,i2\n0,1,1,1,1\n").unwrap();
    let error = one.and(other).unwrap_err().to_string();
    assert!(error.contains("found columns of q, i, expected what log.csv has"), "{error}");
}

/// RTDE's recorder separates by spaces.
#[test]
fn the_separator_is_found() {
    let text = "timestamp actual_q_0 actual_q_1 actual_current_0 actual_current_1\n0 1 2 3 4\n";
    let names = Names::default().of_format("rtde").unwrap();
    let log = Log::from_bytes("log.csv", text.as_bytes(), &MOTIONS, &names).unwrap();
    assert_eq!(log.runs[0].signals[&Signal::Current], [vec![3.0], vec![4.0]]);
}

/// SAGE writes all joints into one cell.
#[test]
fn a_cell_may_hold_all_joints() {
    let text =
        "timestamp,positions,torques\n0,\"[1, 2]\",\"[3.5,4]\"\n1,\"[1, 2, 3]\",\"[3.5,4]\"\n";
    let names = Names::default().of_format("sage").unwrap();
    let log = Log::from_bytes("log.csv", text.as_bytes(), &MOTIONS, &names).unwrap();
    assert_eq!(log.runs[0].signals[&Signal::Torque], [vec![3.5], vec![4.0]]);
    assert_eq!(
        (log.damaged[0].line, log.damaged[0].reason.as_str()),
        (3, "found 6 cells, expected 5")
    );
}

#[test]
fn a_map_comes_first() {
    let read = |map: &str, text: &str| {
        let names = Names::default().mapped(Map::read("m.toml", map).unwrap());
        Log::from_bytes("log.csv", text.as_bytes(), &MOTIONS[..1], &names)
    };
    let map = "separator = \" \"\n[columns]\nq1 = \"A\"\ntau1 = { column = \"q1\", unit = \"Nmm\", offset = 1 }\n";
    let log = read(map, "t A[deg] q1\n0 180 2000\n").unwrap();
    assert_eq!(log.runs[0].signals[&Signal::Q], [[core::f64::consts::PI]]);
    assert_eq!(log.runs[0].signals[&Signal::Torque], [[2.001]]);
    let error = read("[columns]\nspeed = \"v\"\n", "t,v\n").unwrap_err().to_string();
    assert!(
        error.contains("found `speed` among the columns of m.toml, expected a name of ours: t")
    );
    let error = read("[columns]\nq1 = \"w\"\n", "t,v\n").unwrap_err().to_string();
    assert!(
        error.contains("found no column `w`, expected the one that is q1 by m.toml"),
        "{error}"
    );
}

/// A German controller's: title, semicolons, decimal commas, Windows-1252; a point behind a comma is of thousands.
#[test]
fn a_log_has_the_dialects_of_a_table() {
    let text = b"Pr\xfcfstand 7\nt[s];q1[\xb0];tau1;note\n0,5;180;1,5;a\n0,6;90;1.234,5;b\n0,7;90;1.234;c\n";
    let read = |map: &str| {
        let names = Names::default().mapped(Map::read("m.toml", map).unwrap());
        Log::from_bytes("log.csv", text, &MOTIONS[..1], &names).map_err(|error| error.to_string())
    };
    let log = read("header = 2\n").unwrap();
    assert_eq!((log.runs[0].t.as_slice(), log.samples), ([0.5, 0.6].as_slice(), 2));
    assert_eq!(log.runs[0].signals[&Signal::Torque], [[1.5, 1234.5]]);
    assert_eq!(log.damaged[0].reason, "found `1.234` for tau1, expected a number");
    let log = read("header = 2\ndecimal = \",\"\n").unwrap();
    assert_eq!(log.runs[0].signals[&Signal::Torque], [[1.5, 1234.5, 1234.0]]);
    let error = read("header = 9\n").unwrap_err();
    assert!(
        error.starts_with("log.csv: line 9: found no header, expected a row of names there"),
        "{error}"
    );
    assert!(read("").unwrap_err().contains("found no column `t`"));
    let wide: Vec<u8> =
        "\u{feff}t;q1;tau1\n0;1;2\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert!(Opened::from(wide.clone()).is_log());
    let log = Log::from_bytes("log.csv", &wide, &MOTIONS[..1], &Names::default()).unwrap();
    assert_eq!(log.runs[0].signals[&Signal::Torque], [[2.0]]);
}
