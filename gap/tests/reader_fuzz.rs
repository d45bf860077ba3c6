//! Random and mutated measurement files: the reader answers, and never panics.

use proptest::prelude::*;
use stiffarm_gap::measurement::{Layout, MOST_MISTAKES, Marker};
use stiffarm_gap::{Measurements, ReadError};
use stiffarm_kernels::Motion;

const VALID: &str = "# a file\r\n\
    q1[deg],q2[mm],fx[N],mz[Nmm],s1,temperature[K],time,pose,marker,\
    x[mm],y,z,rx,ry,rz,sim_x,note[?]\n\
    10,20,-5,1e3,-1,293,0,p1,smr,100,2,3,0.1,0.2,0.3,0.1,a b\n\
    # between\n\n\
    -1.5e1,+.5,0,0,1,294,1,p1,smr,200,3,4,0,0,0,0.2,\"c,\"\"d\"\n\
    30,0,7,0,0,295,2,p2,smr,1,2,3,0,0,0,0.3,\n";

/// What a mutation may put in.
const PIECES: &[&str] = &[
    ",",
    "\n",
    "\r",
    "\"",
    "#",
    "nan",
    "inf",
    "-",
    "1e999",
    "[",
    "]",
    "[mm]",
    "[furlong]",
    "q",
    "q3",
    "q0",
    "s",
    "sim_",
    "sim_dx",
    "dx",
    "x",
    "\u{feff}",
    ";",
    "\t",
    " ",
    "é",
    "0",
    "1,5",
    "drz",
    "marker",
    "q99999999999999999999",
    "smr2",
];

fn layout() -> Layout {
    Layout {
        readings: true,
        motions: vec![Motion::Revolute, Motion::Prismatic],
        markers: vec![Marker { name: "smr".to_owned(), translation: None }],
        payloads: None,
    }
}

/// Reads the bytes; what is read is finite, what is refused says why at a place of the file.
fn reads(bytes: &[u8]) -> Result<(), TestCaseError> {
    match Measurements::from_bytes("f.csv", bytes, &layout()) {
        Ok(data) => {
            prop_assert!(!data.rows.is_empty() && data.components() > 0);
            for row in &data.rows {
                let numbers = row.q.iter().chain(row.wrench.iter()).chain(row.measured.iter());
                prop_assert!(numbers.copied().all(f64::is_finite));
                prop_assert!(row.group < data.poses);
            }
            for column in &data.extra {
                prop_assert_eq!(column.cells.len(), data.rows.len());
            }
        }
        Err(ReadError::Mistakes { mistakes, more, .. }) => {
            prop_assert!(!mistakes.is_empty() && mistakes.len() <= MOST_MISTAKES);
            prop_assert!(more == 0 || mistakes.len() == MOST_MISTAKES);
            let lines = bytes.split(|b| *b == b'\n' || *b == b'\r').count() as u64;
            for mistake in mistakes {
                prop_assert!((1..=lines).contains(&mistake.line), "{}", mistake);
                prop_assert!(mistake.to_string().len() > 20);
            }
        }
        Err(ReadError::Open { .. }) => prop_assert!(false, "bytes need no opening"),
    }
    Ok(())
}

fn mutation() -> impl Strategy<Value = (f64, usize, String)> {
    let piece = prop_oneof![
        prop::sample::select(PIECES).prop_map(str::to_owned),
        ".{0,3}",
        "[0-9eE.+-]{1,8}"
    ];
    (0.0..1.0, 0_usize..6, piece)
}

#[test]
fn the_valid_file_is_valid() {
    let data = Measurements::from_bytes("f.csv", VALID.as_bytes(), &layout()).unwrap();
    assert_eq!((data.rows.len(), data.poses, data.rows[2].line), (3, 2, 7));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        reads(&bytes)?;
    }

    #[test]
    fn random_text(text in "[q-z0-9,\\[\\]#\"\r\n.a-f -]{0,200}") {
        reads(text.as_bytes())?;
    }

    #[test]
    fn a_valid_file_with_random_replacements(
        mutations in prop::collection::vec(mutation(), 1..6)
    ) {
        let mut bytes = VALID.as_bytes().to_vec();
        for (place, removed, piece) in mutations {
            let from = (place * bytes.len() as f64) as usize;
            let to = (from + removed).min(bytes.len());
            bytes.splice(from..to, piece.bytes());
        }
        reads(&bytes)?;
    }

    #[test]
    fn a_valid_file_with_random_bits(flips in prop::collection::vec((0.0..1.0, 0_u8..8), 1..8)) {
        let mut bytes = VALID.as_bytes().to_vec();
        for (place, bit) in flips {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] ^= 1 << bit;
        }
        reads(&bytes)?;
    }

    #[test]
    fn a_valid_file_cut_short(length in 0.0..1.0) {
        reads(&VALID.as_bytes()[..(length * VALID.len() as f64) as usize])?;
    }
}
