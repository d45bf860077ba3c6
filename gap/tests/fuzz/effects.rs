//! Robot files with `[[effect]]` tables, as the catalogue understands them.

use proptest::prelude::*;
use stiffarm_draws::texts::{answered, mutated};
use stiffarm_gap::effects::{Catalogue, Known};
use stiffarm_gap::robot::{arm, layout};
use stiffarm_table::robot::Robot;

const FILE: &str = r#"name = "arm"
convention = "standard"
[[joint]]
type = "revolute"
d = 0.3
alpha = "pi/2"
stiffness = 2e4
mass = 5
gear = 100
[[joint]]
type = "prismatic"
a = 0.4
[[effect]]
id = "transmission_error"
place = "joint 1"
order = 2
cos = "0.10 mrad"
sin = -5e-5
[[effect]]
id = "joint_coupling"
place = "joint 2"
joint = 1
ratio = 1e-4
[[effect]]
id = "slip"
place = "tool"
after = 3
session = "run1.csv"
x = "0.1 mm"
[[effect]]
id = "soft_zone"
place = "joint 1"
threshold = "20 N*m"
[[effect]]
id = "motor_error"
place = "joint 1"
order = 101.5
[[payload]]
name = "5kg"
mass = 5
"#;

/// Pieces that a mutation puts in.
const PIECES: [&str; 36] = [
    "",
    "\n",
    "\"",
    "=",
    "[",
    "]",
    "[[effect]]\n",
    "joint 1",
    "joint 2",
    "joint 99",
    "link 1",
    "base",
    "tool",
    "arm",
    "instrument",
    "backlash",
    "bearing_wobble",
    "counterbalance",
    "geometry",
    "link_weight",
    "order = ",
    "0",
    "1",
    "-1",
    "1.5",
    "40",
    "1e300",
    "1e-320",
    "9e999",
    "nan",
    "µm",
    " mrad",
    "rad/(N*m)",
    "session",
    "é",
    "\0",
];

/// What is read is finite, and the same when it is written and read again.
fn reads(text: &str) -> Result<(), TestCaseError> {
    let Ok((robot, _)) = Robot::from_toml(text, "arm.toml") else { return Ok(()) };
    let Ok(arm) = arm(&robot) else { return Ok(()) };
    prop_assert!(layout(&robot).is_ok_and(|layout| layout.motions.len() == arm.dof()));
    match Known::all(&robot, &arm, &Catalogue::default()) {
        Ok(known) => {
            prop_assert!(known.iter().flat_map(|known| &known.values).all(|x| x.is_finite()));
            let effects = known.iter().map(|known| known.table(&arm)).collect();
            let written = Robot { effects, ..robot }.to_toml();
            let (again, _) = Robot::from_toml(&written, "again.toml").expect("what was written");
            let again = Known::all(&again, &arm, &Catalogue::default()).expect("what was written");
            let said = |known: &[Known]| -> Vec<_> {
                known.iter().map(|k| (k.spot, k.values.clone(), k.session.clone())).collect()
            };
            prop_assert_eq!(said(&again), said(&known));
        }
        Err(wrong) => {
            prop_assert!(!wrong.is_empty() && wrong.iter().all(|e| e.message.len() > 10));
        }
    }
    Ok(())
}

fn fuzz(cases: u32) {
    answered(cases, &mutated(&[FILE], usize::MAX, &PIECES), |text| reads(&text));
}

#[test]
fn the_seed_is_sound() {
    let (robot, _) = Robot::from_toml(FILE, "arm.toml").unwrap_or_else(|error| panic!("{error}"));
    let known = Known::all(&robot, &arm(&robot).unwrap(), &Catalogue::default());
    assert_eq!(known.map_err(|wrong| wrong[0].to_string()).map(|known| known.len()), Ok(5));
}

#[test]
fn any_effect_is_answered() {
    fuzz(1000);
}

#[test]
#[ignore = "a million inputs take minutes"]
fn a_million_effects_are_answered() {
    fuzz(1_000_000);
}
