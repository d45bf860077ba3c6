//! Whatever the input, the readers answer; they never panic.

use proptest::prelude::*;
use proptest::sample::select;

use super::{Robot, parse_tokens};

const FILE: &str = r#"name = "arm"
convention = "modified"
gravity = [0.0, 0.0, -9.80665]
[[joint]]
type = "revolute"
theta = "t1 "
d = "350 mm"
a = 1e-3
alpha = "-pi/2"
stiffness = "3.8e6 N·m/rad"
mass = 12
com = [0.3, "c", 0.1]
limits = ["-90°", 2.6]
[joint.beam]
youngs_modulus = "10e6 psi"
shear_modulus = 26e9
section = { shape = "box", outer = [0.2, 0.1], inner = ["190 mm", 0.09] }
density = 2700.0
[[joint]]
type = "prismatic"
d = "q0"
alpha = 1.5708
beam = { youngs_modulus = 1, shear_modulus = 1, section = { shape = "tube", outer_diameter = 1 } }
[tool]
translation = [0.0, 0.0, 0.1]
rotation = [0.0, 0.0, "pi/2"]
[[marker]]
name = "smr1"
"#;

const TABLE: &str = r#"/// An arm.
pub mod arm;
name: "arm"; convention: modified_dh; gravity: [0, 0, -9.81]; marker: m [0, 1 mm, 0];
tool: translation [0, 0, 100 mm] rotation [0, 0, pi/2]; products: fused; crate: ::kernels;
joint | theta    | d       | a    | alpha   | stiffness     | mass | com       | limits  | beam
a1    | q + pi/2 | 350 mm  | 0    | -90 deg | 3.8e6 N*m/rad | 12   | [c, 0, 0] | [-1, 1] | -
a2    | 0        | q - 1 m | a2   | -       | k2            | -    | -         | -       | {
    youngs_modulus: 69 GPa, shear_modulus: G, section: box([0.2, 0.1], [0.1, 0.05]) }
a3    | q        | 0       | 1 in | 1/2*pi  | -             | -    | -         | - |
    { youngs_modulus: E, shear_modulus: G, section: { area: A, iy: I, iz: I, j: 2 mm^4 } }
"#;

/// Pieces that a mutation puts in.
const PIECES: &[&str] = &[
    "",
    " ",
    "\n",
    "\"",
    "|",
    "-",
    "+",
    "*",
    "/",
    "^",
    ",",
    ";",
    ":",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "q",
    "pi",
    "deg",
    "mm",
    "kg",
    "1e999",
    "1e-999",
    "1e-310",
    "0",
    "-1",
    "9.5",
    "1.5708",
    "nan",
    "inf",
    "°",
    "²",
    "·",
    "é",
    "lb",
    "fn",
    "joint",
    "a1",
    "'",
    "#",
    "=",
    "[[joint]]",
    "[joint]",
    "1/0",
    "::",
    "170141183460469231731687303715884105728",
    "^99",
    "^-6",
    "pi*pi",
    "\u{feff}",
    "\0",
];

/// Replaces stretches of a text by pieces, at any places.
fn mutated(text: &'static str) -> impl Strategy<Value = String> {
    let edit = (0..text.len(), 0..12_usize, select(PIECES));
    prop::collection::vec(edit, 1..6).prop_map(move |edits| {
        let mut text: Vec<char> = text.chars().collect();
        for (at, length, piece) in edits {
            let at = at.min(text.len());
            let end = (at + length).min(text.len());
            text.splice(at..end, piece.chars());
        }
        text.into_iter().collect()
    })
}

fn read_file(text: &str) {
    match Robot::from_toml(text, "arm.toml") {
        Ok((robot, warnings)) => {
            warnings.iter().for_each(|warning| drop(warning.to_string()));
            let (again, _) = Robot::from_toml(&robot.to_toml(), "again.toml")
                .unwrap_or_else(|error| panic!("{error}\n{}", robot.to_toml()));
            assert_eq!(again.to_toml(), robot.to_toml());
            assert_eq!(again.symbols(), robot.symbols());
            let _ = robot.with_parameters(|name| Some(name.len() as f64));
        }
        Err(error) => {
            assert!(!error.errors.is_empty());
            assert!(error.errors.iter().all(|e| error.text.get(e.span.clone()).is_some()));
            drop(error.to_string());
        }
    }
}

fn read_tokens(text: &str) {
    let Ok(tokens) = text.parse::<proc_macro2::TokenStream>() else { return };
    if let Err(rejected) = parse_tokens(tokens) {
        assert!(!rejected.errors.is_empty());
        drop(rejected.to_compile_errors());
    }
}

#[test]
fn the_seeds_are_sound() {
    assert!(Robot::from_toml(FILE, "arm.toml").is_ok());
    if let Err(rejected) = parse_tokens(TABLE.parse().unwrap()) {
        panic!("{:?}", rejected.errors);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_mutated_file_is_answered(text in mutated(FILE)) {
        read_file(&text);
    }

    #[test]
    fn any_bytes_are_answered(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        read_file(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_cell_is_answered(
        cell in prop::collection::vec(select(PIECES), 0..8),
        key in select(&["a", "alpha", "stiffness", "mass", "limits", "com"][..]),
    ) {
        let cell = cell.concat();
        let joint = "[[joint]]\ntype = \"revolute\"\n";
        read_file(&format!("name = \"x\"\nconvention = \"standard\"\n{joint}{key} = '{cell}'\n"));
    }

    #[test]
    fn a_mutated_table_is_answered(text in mutated(TABLE)) {
        read_tokens(&text);
    }

    #[test]
    fn a_table_of_pieces_is_answered(pieces in prop::collection::vec(select(PIECES), 0..30)) {
        let table = pieces.join(" ");
        read_tokens(&format!("mod x; convention: standard_dh; joint | theta | d | a\n{table}"));
        read_tokens(&table);
    }
}
