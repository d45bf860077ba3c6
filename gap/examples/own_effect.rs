//! An effect of one's own beside those that stiffarm knows: a belt that is soft until its slack is
//! taken up.
//!
//! Such a joint twists in proportion to its torque up to some torque, its knee, and hardly more
//! beyond. That is one file: this one. It is put into an arm by its exact model, measured with noise,
//! and found by a diagnosis that tries it beside everything else.
//!
//! ```text
//! cargo run -p stiffarm-gap --example own_effect
//! ```

use stiffarm_gap::effects::{
    Carrier, Catalogue, Curve, Effect, Forms, Group, Over, Parameter, ParameterReport, Place,
    Quantity, Scene, Spot, Told,
};
use stiffarm_gap::measurement::{Kind, Measurements, Row};
use stiffarm_gap::plant::design::{Design, Shape};
use stiffarm_gap::plant::{Noise, Truth, blurred};
use stiffarm_gap::simulate::{Actual, Moment, Site};
use stiffarm_gap::withhold::exact;
use stiffarm_gap::{Diagnosis, Options, diagnose};
use stiffarm_kernels::generic::Arm;

use nalgebra::Vector6;

/// Twist per torque up to the knee; the form is the knee, N·m.
struct SlackBelt;

/// The knees that are tried, N·m.
const KNEES: [usize; 6] = [20, 40, 60, 80, 120, 160];

/// Component of a revolute joint's own load and motion: about z.
const OWN: usize = 5;

impl Effect for SlackBelt {
    fn identifier(&self) -> &'static str {
        "slack_belt"
    }

    fn places(&self, arm: &Arm) -> Vec<Place> {
        (1..=arm.dof()).map(Place::Joint).collect()
    }

    fn forms_are(&self) -> Forms {
        Forms::Numbers("knee")
    }

    fn named_forms(&self, _: &Arm, _: Place) -> Vec<usize> {
        KNEES.to_vec()
    }

    fn parameters(&self, _: &Arm, spot: Spot) -> Vec<Parameter> {
        let name = format!("stretch up to {} N·m", spot.form);
        vec![Parameter::at_least("stretch", Quantity::AnglePerMoment, 0.0).named(name)]
    }

    fn alter(&self, actual: &mut Actual<'_>, _: &Row, _: &Moment, spot: Spot, values: &[f64]) {
        let (stretch, knee) = (values[0], spot.form as f64);
        let law =
            move |load: &Vector6<f64>| Vector6::ith(OWN, stretch * load[OWN].clamp(-knee, knee));
        actual.laws.push((Site::Joint(spot.row()), Box::new(law)));
    }

    fn carrier(&self, spot: Spot) -> Option<Carrier> {
        Some(Carrier::Joint(spot.row()))
    }

    fn motions(&self, scene: &Scene<'_>, spot: Spot, motions: &mut Vec<f64>) {
        let knee = spot.form as f64;
        motions.push(scene.state.torque[spot.row()].clamp(-knee, knee));
    }

    fn idle(&self) -> &'static str {
        "no load of this data reaches the belt"
    }

    fn group(&self) -> Option<Group> {
        Some(Group::Nonlinear)
    }

    fn sentence(&self, told: &Told<'_>) -> String {
        let name = told.numbers.first().map_or("stretch", |number| &number.name);
        format!("the belt of {} has a {name} of {}", told.place, told.size())
    }

    fn curve<'a>(&self, numbers: &'a [ParameterReport]) -> Option<Curve<'a>> {
        let first = numbers.first()?;
        let knee: f64 = first.name.split(' ').find_map(|word| word.parse().ok())?;
        let value = Box::new(move |torque: f64| first.value * torque.clamp(-knee, knee));
        Some(Curve { over: Over::Torque, proportional: false, value })
    }
}

/// What stiffarm knows, and the belt.
pub fn catalogue() -> Catalogue {
    Catalogue::default().with(&SlackBelt)
}

/// An arm whose second joint has such a belt, measured.
pub fn measured(arm: &Arm) -> Measurements {
    let truth = Truth {
        effect: &SlackBelt,
        place: Place::Joint(2),
        values: vec![("stretch up to 80 N·m".to_owned(), 6e-6)],
    };
    let kind = Kind::Pose { orientation: true };
    let design =
        Design { shape: Shape::Force, poses: 30, repeats: 1, payload: 12.0, kind, seed: 7 };
    let shown = exact(arm, &[truth], None, &design.rows(arm)).expect("an arm that bears its load");
    blurred(&shown, Noise { position: 20e-6, rotation: 40e-6 }, 7)
}

/// The diagnosis with the belt in the catalogue.
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
    let (robot, _) = stiffarm_codegen::robot::Robot::from_toml(ELBOW, "elbow.toml")
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
        let effect = catalogue().named(finding.effect).expect("one of the catalogue");
        let (before, after) = (found.gap.before.position_rms, found.gap.after.position_rms);
        println!("{}", effect.sentence(&Told::plain(&finding.place, &finding.parameters)));
        println!("gap {:.0} → {:.0} µm", 1e6 * before, 1e6 * after);
    }
}
