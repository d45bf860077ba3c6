//! The text itself: read once, and the same ever after.
//!
//! `INSTA_UPDATE=always cargo test -p stiffarm --test c` accepts a change.

use stiffarm_codegen::emit::{CFiles, COptions, Precision, Sines, SymbolicTable, c};
use stiffarm_codegen::robot::{Output, Robot};

use crate::arms::robot;

const PLANAR: &str = r#"
name = "Planar 2R */ ??/"
convention = "standard"

[[joint]]
name = "j1"
type = "revolute"
theta = 0
d = 0
a = 0.5
alpha = 0
stiffness = 2e5

[[joint]]
name = "j2"
type = "revolute"
theta = 0
d = 0
a = 0.4
alpha = 0
stiffness = 1e5
"#;

fn planar() -> Robot {
    Robot::from_toml(PLANAR, "planar.toml").expect("a valid table").0
}

fn files(robot: &Robot, precision: Precision, sines: Sines) -> CFiles {
    c(robot, &COptions { name: "planar".to_owned(), precision, sines }).expect("numbers only")
}

#[test]
fn the_header_reads_like_the_table() {
    insta::assert_snapshot!(files(&planar(), Precision::F64, Sines::Polynomial).header);
}

#[test]
fn the_source_reads_like_a_textbook() {
    insta::assert_snapshot!(files(&planar(), Precision::F32, Sines::Polynomial).source);
}

/// What is not asked for is not written; the posture holds what is needed.
#[test]
fn outputs_are_written_as_they_are_asked_for() {
    let robot = Robot { outputs: vec![Output::Jacobian], ..robot("ur5") };
    let CFiles { header, source } = files(&robot, Precision::F64, Sines::Polynomial);
    let declared = header.lines().filter(|line| line.starts_with("void "));
    let names: Vec<&str> = declared.filter_map(|line| line.split(['(', ' ']).nth(1)).collect();
    assert_eq!(names, ["planar_posture", "planar_jacobian", "planar_given_jacobian"]);
    assert!(!source.contains("solve_") && !header.contains("s6") && header.contains("s234"));
}

/// FNV-1a, written once more.
fn fnv1a(text: &str) -> String {
    let mut hash = 14_695_981_039_346_656_037u64;
    for byte in text.bytes() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(1_099_511_628_211);
    }
    format!("{hash:016x}")
}

#[test]
fn the_header_holds_the_source_s_hash() {
    let robot = robot("ur5");
    let CFiles { header, source } = files(&robot, Precision::F64, Sines::Polynomial);
    assert!(header.contains(&format!("SOURCE_HASH 0x{}ULL", fnv1a(&source))));
    assert!(header.contains(&format!("source hash: {}", fnv1a(&source))));
    assert_eq!(files(&robot, Precision::F64, Sines::Polynomial).header, header);
}

#[test]
fn the_table_s_hash_is_of_what_kernels_depend_on() {
    let table_hash = |robot: &Robot| {
        let header = files(robot, Precision::F64, Sines::Given).header;
        let at = header.find("_TABLE_HASH ").expect("the constant");
        header[at..].lines().next().expect("a line").to_owned()
    };
    let before = planar();
    let mut limited = planar();
    limited.joints[0].limits = Some([-1.0, 1.0]);
    assert_eq!(table_hash(&before), table_hash(&limited));
    let longer = PLANAR.replace("0.4", "0.41");
    let longer = Robot::from_toml(&longer, "planar.toml").expect("a valid table").0;
    assert_ne!(table_hash(&before), table_hash(&longer));
}

#[test]
fn single_precision_has_no_double() {
    let CFiles { header, source } = files(&robot("ur10"), Precision::F32, Sines::Polynomial);
    assert!(!source.contains("double ") && !header.contains("double "));
    assert!(source.contains("float "));
}

#[test]
fn firmware_finds_nothing_that_it_does_not_want() {
    for sines in [Sines::Polynomial, Sines::Given] {
        let source = files(&robot("kuka_kr240"), Precision::F64, sines).source;
        for word in ["malloc", "math.h", "goto", "alloca", "stdio"] {
            assert!(!source.contains(word), "{word}");
        }
    }
    assert!(!files(&planar(), Precision::F64, Sines::Given).source.contains("sin_cos("));
}

#[test]
fn a_symbolic_table_is_refused_by_name() {
    let symbolic = PLANAR.replace("a = 0.4", "a = \"L2\"");
    let robot = Robot::from_toml(&symbolic, "planar.toml").expect("a valid table").0;
    let options = COptions { name: "x".to_owned(), precision: Precision::F64, sines: Sines::Math };
    let error = c(&robot, &options).expect_err("no number for L2");
    assert_eq!(error, SymbolicTable { parameters: vec!["L2".to_owned()] }.into());
    assert!(error.to_string().contains("L2"), "{error}");
}
