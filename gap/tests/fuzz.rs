//! Whatever the input, the readers of measurements answer: no panic, no number that is not finite, no
//! mistake without a place. The repository's own files are mutated.
//!
//! A million inputs each, in minutes:
//! `cargo test --release -p stiffarm-gap --test fuzz -- --ignored a_million`

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, TestRunner};
use stiffarm_codegen::robot::Motion;
use stiffarm_gap::measurement::{Layout, Marker};
use stiffarm_gap::readings::{Map, Sheet, import};
use stiffarm_gap::{Measurements, ReadError};

/// Files of the repository, and tables that once were trouble.
const CORPUS: [&str; 8] = [
    include_str!("../../docs/workbench/run.csv"),
    include_str!("../../docs/workbench/plan.csv"),
    include_str!("../../docs/workbench/check.csv"),
    include_str!("../../docs/workbench/raw.txt"),
    include_str!("../../robots/data/lin1991_table3.csv"),
    "q1,q2,x,y,z,rx,ry,rz,marker,pose,s1,time,temperature\n1,2,3,4,5,6,7,8,smr1,a,-1,0,20\n",
    "Actual_q0 | Actual_q1 | qw | qx | qy | qz | X | Y | Z | kg\n1|2|1|0|0|0|1|2|3|4\n",
    "\u{feff}A1;X;Y;Z;W;P;R\n1,5;2;3;4;5;6;7\n",
];

const MAPS: [&str; 5] = [
    "",
    include_str!("../../docs/workbench/map.toml"),
    "decimal = \",\"\nseparator = \";\"\norientation = \"zyz\"\n",
    "header = 3\n[columns]\nq1 = { column = \"A1\", unit = \"deg\", factor = -1, offset = 90 }\n",
    "orientation = \"quaternion\"\ngravity = [0, 0, 1e300]\n",
];

/// Pieces that a mutation puts in.
const PIECES: [&str; 48] = [
    "",
    " ",
    "\n",
    "\r",
    "\r\n",
    ",",
    ";",
    "\t",
    "|",
    "\"",
    "\"\"",
    "#",
    "[",
    "]",
    "(mm)",
    "[deg]",
    "[kN]",
    "[in]",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "1e999",
    "1e308",
    "-1e308",
    "1e-320",
    "0",
    "-0",
    "-1",
    "1,5",
    "1.5.2",
    "1e",
    "+",
    "-",
    "é",
    "°",
    "\0",
    "\u{feff}",
    "q1",
    "q99999999999999999999",
    "x",
    "drx",
    "sim_x",
    "marker",
    "smr1",
    "A1",
    "kg",
    "1 000",
];

/// A file with stretches replaced by pieces, or by stretches of itself, and cut off anywhere.
fn mutated() -> impl Strategy<Value = String> {
    let edit = (any::<Index>(), 0..9_usize, select(&PIECES[..]), any::<Option<(Index, u8)>>());
    let edits = prop::collection::vec(edit, 0..7);
    (select(&CORPUS[..]), 1..14_usize, edits, any::<Option<Index>>()).prop_map(
        |(file, lines, edits, cut)| {
            let mut text: Vec<char> =
                file.split_inclusive('\n').take(lines).flat_map(str::chars).collect();
            for (at, length, piece, copied) in edits {
                let at = at.index(text.len() + 1);
                let end = (at + length).min(text.len());
                let copied = copied.map(|(from, length)| {
                    let from = from.index(text.len() + 1);
                    text[from..(from + usize::from(length)).min(text.len())].to_vec()
                });
                text.splice(at..end, copied.unwrap_or_else(|| piece.chars().collect()));
            }
            text.truncate(cut.map_or(text.len(), |cut| cut.index(text.len() + 1)));
            text.into_iter().collect()
        },
    )
}

fn layout(joints: usize) -> Layout {
    let mut motions = vec![Motion::Revolute; joints];
    motions[joints / 2] = Motion::Prismatic;
    let marker = |name: &str, translation| Marker { name: name.to_owned(), translation };
    let markers = vec![marker("smr1", None), marker("smr2", Some([0.1, 0.2, 0.3]))];
    Layout { motions, markers, readings: true, payloads: None }
}

/// What is read is finite, what is refused has a place.
fn reads(bytes: &[u8]) -> Result<(), TestCaseError> {
    for joints in [1, 2, 6] {
        for planned in [false, true] {
            let read = match planned {
                false => Measurements::from_bytes("f", bytes, &layout(joints)),
                true => Measurements::plan_from_bytes("f", bytes, &layout(joints)),
            };
            match read {
                Ok(data) => {
                    prop_assert!(!data.rows.is_empty() || !data.skipped.is_empty());
                    for row in &data.rows {
                        prop_assert!(row.q.iter().all(|q| q.is_finite()));
                        prop_assert!(row.wrench.iter().chain(&row.measured).all(|x| x.is_finite()));
                        prop_assert!(row.sim.iter().flatten().all(|x| x.is_finite()));
                        let both = row.time.into_iter().chain(row.temperature);
                        prop_assert!(both.into_iter().all(f64::is_finite));
                        prop_assert!(row.group < data.poses);
                    }
                }
                Err(ReadError::Mistakes { mistakes, .. }) => {
                    prop_assert!(!mistakes.is_empty());
                    prop_assert!(mistakes.iter().all(|m| m.line > 0 && !m.to_string().is_empty()));
                }
                Err(error) => prop_assert!(false, "{error}"),
            }
        }
    }
    Ok(())
}

/// What is imported is a table that the reader answers, in it no number that is not finite.
fn imports(text: &str, map: &str) -> Result<(), TestCaseError> {
    let Ok(map) = Map::read("map.toml", map) else { return Ok(()) };
    match import(&Sheet::new("raw.txt", text.as_bytes().to_vec()), &map) {
        Ok(imported) => {
            prop_assert!(!imported.said.is_empty());
            reads(imported.csv.as_bytes())
        }
        Err(error) => {
            prop_assert!(!error.to_string().is_empty());
            Ok(())
        }
    }
}

fn fuzz(cases: u32) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let map = || (select(&MAPS[..]), any::<Option<(Index, Index)>>(), select(&PIECES[..]));
    let mut runner = TestRunner::new(config.clone());
    runner.run(&mutated(), |text| reads(text.as_bytes())).unwrap_or_else(|e| panic!("{e}"));
    let mut runner = TestRunner::new(config.clone());
    let bytes = prop::collection::vec(any::<u8>(), 0..200);
    runner.run(&bytes, |bytes| reads(&bytes)).unwrap_or_else(|e| panic!("{e}"));
    let mut runner = TestRunner::new(config);
    let both = (mutated(), map());
    let imported = runner.run(&both, |(text, (map, edit, piece))| {
        let mut map = map.to_owned();
        if let Some((at, _)) = edit {
            let places: Vec<usize> =
                map.char_indices().map(|(k, _)| k).chain([map.len()]).collect();
            map.insert_str(places[at.index(places.len())], piece);
        }
        imports(&text, &map)
    });
    imported.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn any_table_is_answered() {
    fuzz(1000);
}

#[test]
#[ignore = "a million inputs to each reader take minutes"]
fn a_million_tables_are_answered() {
    fuzz(1_000_000);
}
