//! The same log in the files of other programs, as `tools/joint_logs.py` writes them by libraries of theirs.

use std::path::Path;

use stiffarm_gap::ReadError;
use stiffarm_gap::log::{Log, Names, Opened, Signal};
use stiffarm_kernels::Motion;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/logs");
const ARM: [Motion; 2] = [Motion::Revolute, Motion::Revolute];

fn names() -> Names {
    Names::own(vec!["shoulder".to_owned(), "elbow".to_owned()])
}

fn read(name: &str, names: &Names) -> Result<Log, ReadError> {
    let path = Path::new(FOLDER).join(name);
    let opened = Opened::new(&path).expect("the file");
    Log::from_file(&path, opened, &ARM, names)
}

/// Compares every signal with that of `expected.csv`; stamps differ by the rounding of nanoseconds, of
/// milliradians the last digit.
fn agree(log: &Log, signals: &[Signal]) {
    let expected = read("expected.csv", &names()).expect("the text");
    let all = |log: &Log, of: &dyn Fn(&stiffarm_gap::log::Run) -> Vec<f64>| -> Vec<f64> {
        log.runs.iter().flat_map(of).collect()
    };
    assert_eq!(log.samples, 12);
    for signal in signals {
        for joint in 0..2 {
            let rows = |log: &Log| all(log, &|run| run.signals[signal][joint].clone());
            for (found, expected) in rows(log).iter().zip(rows(&expected)) {
                assert!((found - expected).abs() < 1e-15, "{signal:?}: {found}, not {expected}");
            }
        }
    }
    let stamps = |log: &Log| all(log, &|run| run.t.iter().map(|t| t - run.t[0]).collect());
    let runs = log.runs.len();
    for (k, (found, expected)) in stamps(log).iter().zip(stamps(&expected)).enumerate() {
        let before = if runs > 1 && k >= 6 { 6.0 / 64.0 } else { 0.0 };
        assert!((found - (expected - before)).abs() < 1e-9, "{found}, not {expected}");
    }
}

#[test]
#[cfg(feature = "parquet")]
fn columns_of_ours_stand_in_parquet() {
    let log = read("own.parquet", &names()).unwrap();
    agree(&log, &[Signal::Q, Signal::Torque]);
    assert_eq!(
        (log.side, log.runs[0].name.as_str()),
        (Some(stiffarm_gap::log::TorqueSide::Link), "first")
    );
    assert_eq!(log.unknown, ["note"]);
    let damaged = &log.damaged[0];
    assert_eq!((damaged.row, damaged.line), ("row", 13));
    assert_eq!(damaged.reason, "found `NaN` for q2, expected a number");
}

#[test]
#[cfg(feature = "parquet")]
fn lists_of_lerobot_are_columns() {
    let log = read("lerobot.parquet", &names().of_format("lerobot").unwrap()).unwrap();
    agree(&log, &[Signal::Q, Signal::QCmd]);
    let runs: Vec<&str> = log.runs.iter().map(|run| run.name.as_str()).collect();
    assert_eq!(runs, ["0", "1"]);
}

#[test]
#[cfg(all(feature = "mcap", feature = "rosbag2"))]
fn messages_map_by_the_joints_names() {
    for name in ["ros2.mcap", "ros2.db3"] {
        let states = read(name, &names().of_topic("/joint_states".to_owned())).unwrap();
        agree(&states, &[Signal::Q, Signal::Torque]);
        assert!(!states.has(Signal::Qd) && states.damaged.is_empty(), "{:?}", states.damaged);
        assert_eq!(states.side, None);
        let control = read(name, &names().of_topic("/arm/controller_state".to_owned())).unwrap();
        agree(&control, &[Signal::Q, Signal::QCmd]);
        let error = read(name, &names()).unwrap_err().to_string();
        assert!(
            error.contains("/joint_states") && error.contains("say which with --topic"),
            "{error}"
        );
        let others = Names::own(vec!["wrist".to_owned(), "elbow".to_owned()]);
        let error = read(name, &others.of_topic("/joint_states".to_owned())).unwrap_err();
        assert!(error.to_string().contains("topic /joint_states: found no column"), "{error}");
    }
}

#[test]
#[cfg(feature = "mcap")]
fn messages_of_ros_1_are_read() {
    let log = read("ros1.mcap", &names()).unwrap();
    agree(&log, &[Signal::Q, Signal::Torque]);
    assert!(log.has(Signal::Qd));
}

/// Every beginning of every file, and every byte of it changed: an error or a log, and no panic.
#[test]
#[cfg(all(feature = "mcap", feature = "parquet", feature = "rosbag2"))]
fn broken_files_are_refused() {
    let folder = std::env::temp_dir().join(format!("stiffarm-logs-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for name in ["own.parquet", "lerobot.parquet", "ros2.mcap", "ros1.mcap", "ros2.db3"] {
        let whole = std::fs::read(Path::new(FOLDER).join(name)).expect("the file");
        let path = folder.join(name);
        let tries = |bytes: &[u8]| {
            std::fs::write(&path, bytes).expect("a file");
            let opened = Opened::new(&path).expect("the file");
            let names = names().of_format("lerobot").expect("a format");
            // Whatever it says.
            let _: Result<Log, ReadError> = Log::from_file(&path, opened, &ARM, &names);
        };
        let step = whole.len().div_ceil(60);
        for at in (8..whole.len()).step_by(step) {
            tries(&whole[..at]);
            let mut changed = whole.clone();
            changed[at] ^= 0xff;
            tries(&changed);
        }
    }
    std::fs::remove_dir_all(&folder).expect("the folder goes");
}
