//! Whatever the URDF, it is read or refused; what is read makes a robot file that reads back.
//!
//! A million inputs, in minutes:
//! `cargo test --release -p stiffarm-tests --test table_units -- --ignored a_million`

use proptest::prelude::*;
use stiffarm_draws::texts::{answered, mutated};

use super::{Chain, Table, read, robot_file};
use crate::robot::Robot;

const CORPUS: [&str; 4] = [
    include_str!("../../../../tests/data/urdf/kr240.urdf"),
    include_str!("../../../../tests/data/urdf/oblique.urdf"),
    include_str!("../../../../tests/data/urdf/panda.urdf"),
    include_str!("../../../../tests/data/urdf/ur5.urdf"),
];

/// Pieces that a mutation puts in.
fn pieces() -> Vec<&'static str> {
    let short = [
        "<", ">", "/>", "</", "<!--", "-->", "&amp;", "&#0;", "&x;", "&#10;", "3.14159", "0 0",
        "fixed", "floating", "<joint/>", "link_1",
    ];
    let long = [
        "prismatic",
        "name=\"\"",
        "xyz=\"0 0 0\"",
        "<link name=\"link_1\"/>",
        "<mimic joint=\"a\"/>",
        "<axis xyz=\"1 0 0\"/>",
    ];
    [&short[..], &long].concat()
}

fn reads(text: &str) -> Result<(), TestCaseError> {
    for as_written in [false, true] {
        let chain = read(text, as_written).and_then(|urdf| Chain::new(&urdf.robot, None, None));
        match chain {
            Ok(chain) => {
                let robot = robot_file(&chain, &Table::new(&chain)).to_toml();
                let again = Robot::from_toml(&robot, "again.toml");
                prop_assert!(again.is_ok(), "{}\n{robot}", again.unwrap_err());
            }
            Err(refusal) => prop_assert!(!refusal.message.is_empty()),
        }
    }
    Ok(())
}

fn fuzz(cases: u32) {
    answered(cases, &mutated(&CORPUS, usize::MAX, &pieces()), |text| reads(&text));
}

/// Found so: they made robot files that do not read back.
#[test]
fn a_name_is_one_line_that_is_not_empty() {
    for (name, expected) in [
        ("", "joint `` has an empty name"),
        ("&#10;a", "joint `\\na` has a control character in its name"),
    ] {
        let text = CORPUS[0].replace("name=\"joint_a4\"", &format!("name=\"{name}\""));
        let refusal = read(&text, false).map(|_| ()).unwrap_err();
        assert!(refusal.message.contains(expected), "{}", refusal.message);
    }
}

#[test]
fn any_urdf_is_answered() {
    fuzz(500);
}

#[test]
#[ignore = "a million inputs take minutes"]
fn a_million_urdfs_are_answered() {
    fuzz(1_000_000);
}
