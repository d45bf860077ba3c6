//! An effect of one's own beside those that stiffarm knows: a hose that holds a joint back once it is
//! taut.
//!
//! Such a joint is where its reading says up to some angle either way, and falls behind in proportion
//! beyond. That is one file: this one. It is put into an arm by its exact model, measured with noise,
//! and found by a diagnosis that tries it beside everything else.
//!
//! ```text
//! cargo run -p stiffarm-gap --example own_effect
//! ```

use stiffarm_gap::effects::{
    At, AtRest, Catalogue, Curve, Facts, Forms, Group, Law, Moves, Over, Parameter,
    ParameterReport, Place, Quantity, Spot, Told,
};
use stiffarm_gap::measurement::{Kind, Measurements, Row};
use stiffarm_gap::simulate::Moment;
use stiffarm_gap::{Diagnosis, Options, diagnose};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, Truth, blurred};
use stiffarm_study::withhold::exact;

/// How far the joint stays behind per angle beyond the one at which the hose is taut; the form is that
/// angle, degrees.
struct TautHose;

/// The angles that are tried, degrees.
const TAUT: [usize; 5] = [15, 30, 45, 60, 80];

/// How far a reading is beyond an angle, with its sign, rad.
fn beyond(degrees: f64, q: f64) -> f64 {
    let taut = degrees.to_radians();
    q - q.clamp(-taut, taut)
}

impl Law for TautHose {
    fn facts(&self) -> &'static Facts {
        const FACTS: &Facts = &Facts {
            identifier: "taut_hose",
            at: At::Joints,
            moves: Moves::Joint,
            idle: "the joint never turns so far that the hose is taut",
            group: Some(Group::Constant),
            ..Facts::NONE
        };
        FACTS
    }
}

impl AtRest for TautHose {
    fn forms_are(&self) -> Forms {
        Forms::Numbers("taut")
    }

    fn named_forms(&self, _: &Arm, _: Place) -> Vec<usize> {
        TAUT.to_vec()
    }

    fn parameters(&self, _: &Arm, spot: Spot) -> Vec<Parameter> {
        let name = format!("lag beyond {}°", spot.form);
        vec![Parameter::at_least("lag", Quantity::Ratio, 0.0).named(name)]
    }

    fn moves_by(&self, row: &Row, _: &Moment, spot: Spot, each: &mut dyn FnMut(f64)) {
        each(-beyond(spot.form as f64, row.q[spot.row()]));
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let name = told.numbers.first().map_or("lag", |number| &number.name);
        format!("the hose at {} makes it {name} by {}", told.place, told.size())
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let first = numbers.first()?;
        let digits: String = first.name.chars().filter(char::is_ascii_digit).collect();
        let degrees: f64 = digits.parse().ok()?;
        let value = Box::new(move |q: f64| -first.value * beyond(degrees, q));
        Some(Curve { over: Over::Reading, proportional: false, value })
    }
}

/// What stiffarm knows, and the hose.
pub fn catalogue() -> Catalogue {
    Catalogue::default().with(&TautHose)
}

/// An arm whose second joint has such a hose, measured.
pub fn measured(arm: &Arm) -> Measurements {
    let truth = Truth {
        effect: &TautHose,
        place: Place::Joint(2),
        values: vec![("lag beyond 80°".to_owned(), 4e-4)],
    };
    let kind = Kind::Pose { orientation: true };
    let design =
        Design { shape: Shape::Force, poses: 30, repeats: 1, payload: 12.0, kind, seed: 7 };
    let shown = exact(arm, &[truth], None, &design.rows(arm)).expect("an arm that bears its load");
    blurred(&shown, Noise { position: 20e-6, rotation: 40e-6 }, 7)
}

/// The diagnosis with the hose in the catalogue.
pub fn diagnosed(arm: &Arm, data: &Measurements) -> Diagnosis {
    let options = Options {
        catalogue: catalogue(),
        noise_position: Some(20e-6),
        noise_rotation: Some(40e-6),
        ..Options::default()
    };
    diagnose(arm, data, &options).expect("data of this arm")
}

/// The arm: an elbow with weights and no springs.
pub fn arm() -> Arm {
    let (robot, _) = stiffarm_table::robot::Robot::from_toml(ELBOW, "elbow.toml")
        .expect("a robot file without mistakes");
    stiffarm_gap::robot::arm(&robot).expect("a robot file with numbers")
}

const ELBOW: &str = r#"
name = "elbow"
convention = "standard"
[[joint]]
type = "revolute"
d = 0.4
alpha = "pi/2"
[[joint]]
type = "revolute"
a = 0.7
mass = 12.0
com = [-0.35, 0.0, 0.0]
[[joint]]
type = "revolute"
a = 0.6
mass = 5.0
com = [-0.3, 0.0, 0.0]
[tool]
translation = [0.1, 0.0, 0.05]
"#;

fn main() {
    let arm = arm();
    let found = diagnosed(&arm, &measured(&arm));
    for finding in &found.findings {
        let effect = catalogue().named(&finding.effect).expect("one of the catalogue");
        let (before, after) = (found.gap.before.position_rms, found.gap.after.position_rms);
        println!("{}", effect.sentence(&Told::plain(&finding.place, &finding.parameters)));
        println!("gap {:.0} → {:.0} µm", 1e6 * before, 1e6 * after);
    }
}
