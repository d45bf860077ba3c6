//! Whatever the input, the readers of robot files and of the macro's tables answer; they never panic.
//!
//! A million inputs each, in minutes:
//! `cargo test --release -p stiffarm-tests --test table_units -- --ignored a_million`

use proptest::prelude::*;
use proptest::sample::select;
use stiffarm_draws::texts::{PIECES, answered, mutated};

use crate::robot::{Robot, parse_tokens};

const FILE: &str = r#"name = "arm"
convention = "modified"
gravity = [0.0, 0.0, -9.80665]
torque_side = "motor"
outputs = ["jacobian at elbow"]
carries = "5kg"
[[joint]]
type = "revolute"
name = "shoulder"
theta = "t1 "
d = "350 mm"
a = 1e-3
alpha = "-pi/2"
stiffness = "3.8e6 N·m/rad"
mass = 12
com = [0.3, "c", 0.1]
inertia = [0.2, 0, 0.01, 0.3, 0, 0.1]
gear = 120
rotor_inertia = 3e-4
coulomb = "6 N*m"
viscous = "9 N*m*s/rad"
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
beta = "1e-3"
beam = { youngs_modulus = 1, shear_modulus = 1, section = { shape = "tube", outer_diameter = 1 } }
[tool]
translation = [0.0, 0.0, 0.1]
rotation = [0.0, 0.0, "pi/2"]
[base]
translation = [2.4, "-1.1 m", 0.35]
rotation = [0, 0, "120 deg"]
[[marker]]
name = "smr1"
[[frame]]
name = "elbow"
joint = "shoulder"
rotation = ["pi/2", 0, 0]
[[effect]]
id = "transmission_error"
place = "joint 2"
order = 2
cos = "0.10 mrad"
[[payload]]
name = "5kg"
mass = 5
com = [0, 0, "60 mm"]
inertia = [0.02, 0, 0, 0.02, 0, 0.01]
"#;

const TABLE: &str = r#"/// An arm.
pub mod arm;
name: "arm"; convention: modified_dh; gravity: [0, 0, -9.81]; marker: m [0, 1 mm, 0];
base: translation [0, 1 m, 0]; payload: load mass 1.2 kg, com [0, 0, 60 mm]; carries: load;
outputs: pose, jacobian at m;
tool: translation [0, 0, 100 mm] rotation [0, 0, pi/2]; products: fused; crate: ::kernels;
joint | theta    | d       | a    | alpha   | stiffness     | mass | com       | limits  | beam
a1    | q + pi/2 | 350 mm  | 0    | -90 deg | 3.8e6 N*m/rad | 12   | [c, 0, 0] | [-1, 1] | -
a2    | 0        | q - 1 m | a2   | -       | k2            | -    | -         | -       | {
    youngs_modulus: 69 GPa, shear_modulus: G, section: box([0.2, 0.1], [0.1, 0.05]) }
a3    | q        | 0       | 1 in | 1/2*pi  | -             | -    | -         | - |
    { youngs_modulus: E, shear_modulus: G, section: { area: A, iy: I, iz: I, j: 2 mm^4 } }
"#;

/// Pieces that a mutation puts in, among them a number of more than 128 bits.
fn pieces() -> Vec<&'static str> {
    let short = [
        "*", "/", "^", ":", "{", "}", "(", ")", "q", "pi", "deg", "mm", "1e-999", "1e-310", "9.5",
        "²", "·", "lb", "fn", "joint", "a1", "[joint]", "::", "^99", "^-6", "pi*pi",
    ];
    let long = ["[[joint]]", "170141183460469231731687303715884105728"];
    [&PIECES[..], &short, &long].concat()
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
    // The last text would stay in memory for its spans, as would a million.
    proc_macro2::extra::invalidate_current_thread_spans();
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

/// Cells of pieces, for a key of a joint.
fn cells() -> impl Strategy<Value = (&'static str, String)> {
    let keys = ["a", "alpha", "stiffness", "mass", "limits", "com"];
    let pieces = prop::collection::vec(select(pieces()), 0..8);
    (select(keys.to_vec()), pieces.prop_map(|pieces| pieces.concat()))
}

fn fuzz_files(cases: u32) {
    answered(cases, &mutated(&[FILE], usize::MAX, &pieces()), |text| {
        read_file(&text);
        Ok(())
    });
    let bytes = prop::collection::vec(any::<u8>(), 0..200);
    answered(cases / 10, &bytes, |bytes| {
        read_file(&String::from_utf8_lossy(&bytes));
        Ok(())
    });
    answered(cases / 10, &cells(), |(key, cell)| {
        let joint = "[[joint]]\ntype = \"revolute\"\n";
        let head = "name = \"x\"\nconvention = \"standard\"\n";
        read_file(&format!("{head}{joint}{key} = '{cell}'\n"));
        Ok(())
    });
}

fn fuzz_tables(cases: u32) {
    answered(cases, &mutated(&[TABLE], usize::MAX, &pieces()), |text| {
        read_tokens(&text);
        Ok(())
    });
    let pieces = prop::collection::vec(select(pieces()), 0..30);
    answered(cases / 10, &pieces, |pieces| {
        let table = pieces.join(" ");
        read_tokens(&format!("mod x; convention: standard_dh; joint | theta | d | a\n{table}"));
        read_tokens(&table);
        Ok(())
    });
}

#[test]
fn any_robot_file_is_answered() {
    fuzz_files(2000);
}

#[test]
fn any_table_is_answered() {
    fuzz_tables(2000);
}

#[test]
#[ignore = "a million inputs take minutes"]
fn a_million_robot_files_are_answered() {
    fuzz_files(1_000_000);
}

#[test]
#[ignore = "a million inputs take minutes"]
fn a_million_tables_are_answered() {
    fuzz_tables(1_000_000);
}
