//! Measurement files, and the tables of others from which they are made.

use proptest::prelude::*;
use proptest::sample::{Index, select};
use stiffarm_draws::texts::{PIECES_OF_TABLES, answered, mutated};
use stiffarm_gap::Measurements;
use stiffarm_gap::io::{MOST_MISTAKES, Map, Mistake, ReadError};
use stiffarm_gap::measurement::{Layout, Marker};
use stiffarm_gap::readings::{By, Sheet, import};
use stiffarm_table::robot::Motion;

/// Every kind of column, comment, line end and quotes.
const VALID: &str = "# a file\r\n\
    q1[deg],q2[mm],fx[N],mz[Nmm],s1,temperature[K],time,pose,marker,\
    x[mm],y,z,rx,ry,rz,sim_x,note[?]\n\
    10,20,-5,1e3,-1,293,0,p1,smr1,100,2,3,0.1,0.2,0.3,0.1,a b\n\
    # between\n\n\
    -1.5e1,+.5,0,0,1,294,1,p1,smr1,200,3,4,0,0,0,0.2,\"c,\"\"d\"\n\
    30,0,7,0,0,295,2,p2,smr1,1,2,3,0,0,0,0.3,\n";

/// Files of the repository, and tables that once were trouble.
const CORPUS: [&str; 9] = [
    VALID,
    include_str!("../../../docs/workbench/run.csv"),
    include_str!("../../../docs/workbench/plan.csv"),
    include_str!("../../../docs/workbench/check.csv"),
    include_str!("../../../docs/workbench/raw.txt"),
    include_str!("../../../robots/data/lin1991_table3.csv"),
    "q1,q2,x,y,z,rx,ry,rz,marker,pose,s1,time,temperature\n1,2,3,4,5,6,7,8,smr1,a,-1,0,20\n",
    "Actual_q0 | Actual_q1 | qw | qx | qy | qz | X | Y | Z | kg\n1|2|1|0|0|0|1|2|3|4\n",
    "\u{feff}A1;X;Y;Z;W;P;R\n1,5;2;3;4;5;6;7\n",
];

const MAPS: [&str; 6] = [
    "",
    include_str!("../../../docs/workbench/map.toml"),
    "decimal = \",\"\nseparator = \";\"\norientation = \"zyz\"\n",
    "header = 3\n[columns]\nq1 = { column = \"A1\", unit = \"deg\", factor = -1, offset = 90 }\n",
    "orientation = \"quaternion\"\ngravity = [0, 0, 1e300]\n",
    "orientation = \"fixed_zxz\"\ndecimal = \",\"\nignore = [\"A1\"]\n",
];

/// Lines of a file: a few are as good as many.
const LINES: usize = 14;

fn layout(joints: usize) -> Layout {
    let mut motions = vec![Motion::Revolute; joints];
    motions[joints / 2] = Motion::Prismatic;
    let marker = |name: &str, translation| Marker { name: name.to_owned(), translation };
    let markers = vec![marker("smr1", None), marker("smr2", Some([0.1, 0.2, 0.3]))];
    Layout { markers, ..Layout::new(motions) }
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
                        prop_assert!(
                            row.sim.iter().flat_map(|sim| sim.iter()).all(|x| x.is_finite())
                        );
                        let both = row.time.into_iter().chain(row.temperature);
                        prop_assert!(both.into_iter().all(f64::is_finite));
                        prop_assert!(row.group < data.poses);
                    }
                    for column in &data.extra {
                        let values = column.values.as_ref();
                        prop_assert!(values.map_or(true, |v| v.len() == data.rows.len()));
                    }
                }
                Err(ReadError { mistakes, more, .. }) => {
                    prop_assert!(!mistakes.is_empty() && mistakes.len() <= MOST_MISTAKES);
                    prop_assert!(more == 0 || mistakes.len() == MOST_MISTAKES);
                    let lines = bytes.split(|b| *b == b'\n' || *b == b'\r').count() as u64;
                    let is_told = |m: &Mistake| m.to_string().len() > 20;
                    let is_line = |line| (1..=lines).contains(&line);
                    let is_there = |m: &Mistake| m.line.is_some_and(is_line) && is_told(m);
                    prop_assert!(mistakes.iter().all(is_there), "{mistakes:?}");
                }
            }
        }
    }
    Ok(())
}

/// What is imported is a table that the reader answers, in it no number that is not finite.
fn imports(text: &str, map: &str) -> Result<(), TestCaseError> {
    let Ok(map) = Map::read("map.toml", map) else { return Ok(()) };
    let sheet = Sheet::new("raw.txt", text.as_bytes().to_vec());
    let log = Sheet::new("log.csv", b"Zeit;J1;X\n0,5;0,1;7\n2;0,3;8\n".to_vec());
    let by = ["row", "time", "Zeit"].map(|by| By::from(by.to_owned()));
    let others = [None].into_iter().chain(by.iter().map(|by| Some((&log, by))));
    for other in others {
        match import(&sheet, other, &map) {
            Ok(imported) => {
                prop_assert!(!imported.said.is_empty());
                reads(imported.csv.as_bytes())?;
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
    Ok(())
}

fn fuzz(cases: u32) {
    let texts = || mutated(&CORPUS, LINES, &PIECES_OF_TABLES);
    answered(cases, &texts(), |text| reads(text.as_bytes()));
    answered(cases / 10, &prop::collection::vec(any::<u8>(), 0..300), |bytes| reads(&bytes));
    let flips = prop::collection::vec((any::<Index>(), 0_u8..8), 1..8);
    answered(cases / 10, &flips, |flips| {
        let mut bytes = VALID.as_bytes().to_vec();
        for (at, bit) in flips {
            let at = at.index(bytes.len());
            bytes[at] ^= 1 << bit;
        }
        reads(&bytes)
    });
    let map = (select(&MAPS[..]), any::<Option<Index>>(), select(&PIECES_OF_TABLES[..]));
    answered(cases, &(texts(), map), |(text, (map, edit, piece))| {
        let mut map = map.to_owned();
        if let Some(at) = edit {
            let places: Vec<usize> =
                map.char_indices().map(|(k, _)| k).chain([map.len()]).collect();
            map.insert_str(places[at.index(places.len())], piece);
        }
        imports(&text, &map)
    });
}

#[test]
fn the_valid_file_is_valid() {
    let data = Measurements::from_bytes("f", VALID.as_bytes(), &layout(2)).unwrap();
    assert_eq!((data.rows.len(), data.poses, data.rows[2].line), (3, 2, 7));
}

#[test]
fn any_table_is_answered() {
    fuzz(stiffarm_draws::few_or_many(200, 1000));
}

#[test]
#[ignore = "a million inputs to each reader take minutes"]
fn a_million_tables_are_answered() {
    fuzz(1_000_000);
}
