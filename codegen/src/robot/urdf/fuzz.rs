//! Whatever the URDF, it is read or refused; what is read makes a robot file that reads back.
//!
//! A million inputs, in minutes:
//! `cargo test --release -p stiffarm-codegen --features urdf -- --ignored a_million`

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, TestRunner};

use super::{Chain, Table, read, robot_file};
use crate::robot::Robot;

const CORPUS: [&str; 4] = [
    include_str!("../../../../tests/data/urdf/kr240.urdf"),
    include_str!("../../../../tests/data/urdf/oblique.urdf"),
    include_str!("../../../../tests/data/urdf/panda.urdf"),
    include_str!("../../../../tests/data/urdf/ur5.urdf"),
];

/// Pieces that a mutation puts in.
const PIECES: [&str; 36] = [
    "",
    " ",
    "\n",
    "\"",
    "'",
    "<",
    ">",
    "/>",
    "</",
    "<!--",
    "-->",
    "&amp;",
    "&#0;",
    "&x;",
    "\0",
    "é",
    "0",
    "-1",
    "1e999",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "1.5708",
    "3.14159",
    "0 0",
    "fixed",
    "prismatic",
    "floating",
    "<joint/>",
    "<link name=\"link_1\"/>",
    "xyz=\"0 0 0\"",
    "<mimic joint=\"a\"/>",
    "<axis xyz=\"1 0 0\"/>",
    "link_1",
];

/// A file with stretches replaced by pieces, or by stretches of itself.
fn mutated() -> impl Strategy<Value = String> {
    let edit = (any::<Index>(), 0..9_usize, select(&PIECES[..]), any::<Option<(Index, u8)>>());
    (select(&CORPUS[..]), prop::collection::vec(edit, 0..6)).prop_map(|(file, edits)| {
        let mut text: Vec<char> = file.chars().collect();
        for (at, length, piece, copied) in edits {
            let at = at.index(text.len() + 1);
            let end = (at + length).min(text.len());
            let copied = copied.map(|(from, length)| {
                let from = from.index(text.len() + 1);
                text[from..(from + usize::from(length)).min(text.len())].to_vec()
            });
            text.splice(at..end, copied.unwrap_or_else(|| piece.chars().collect()));
        }
        text.into_iter().collect()
    })
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
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let answered = TestRunner::new(config).run(&mutated(), |text| reads(&text));
    answered.unwrap_or_else(|e| panic!("{e}"));
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
