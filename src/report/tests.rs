//! Pages of diagnoses of plants.

use std::path::Path;

use stiffarm_codegen::robot::Robot;
use stiffarm_gap::diagnose::{Diagnosed, Nuisance};
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::plant::design::{Design, Shape};
use stiffarm_gap::plant::{Frames, Noise, Plant, Truth};
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::Arm;

use super::{Report, Told, Unit, Words};

const ROBOT: &str = r#"
name = "shoulder <& elbow>"
convention = "standard"
[[joint]]
type = "revolute"
d = 0.4
alpha = "pi/2"
mass = 30.0
com = [0.0, -0.2, 0.0]
[[joint]]
type = "revolute"
a = 0.7
mass = 20.0
com = [-0.35, 0.0, 0.0]
[[joint]]
type = "revolute"
a = 0.6
d = 0.1
alpha = "-pi/2"
mass = 8.0
com = [-0.3, 0.0, 0.0]
[tool]
translation = [0.05, 0.0, 0.15]
"#;

/// Everything that a report borrows.
struct Bench {
    arm: Arm,
    data: Measurements,
    options: Options,
    diagnosed: Diagnosed,
    words: Words,
}

impl Bench {
    fn new(kind: Kind, poses: usize, truths: &[&str], effects: &[&str], free: bool) -> Bench {
        let (robot, _) = Robot::from_toml(ROBOT, "arm").expect("a robot file");
        let arm = stiffarm_gap::robot::arm(&robot).expect("with numbers");
        let truth = |t: &&str| Truth::parse(t, &arm).expect("an effect of this arm");
        let truths: Vec<Truth> = truths.iter().map(truth).collect();
        let mut plant = Plant::new(&arm, &truths).expect("a plant");
        let mut options = Options { version: "9.9.9".to_owned(), seed: 7, ..Options::default() };
        options.effects = Some(effects.iter().map(|e| (*e).to_owned()).collect());
        if free {
            plant = plant.with_frames(Frames::unknown(1));
            options.nuisances = vec![Nuisance::BaseFrame, Nuisance::ToolFrame];
        }
        let design =
            Design { shape: Shape::Payload, poses, repeats: 1, payload: 15.0, kind, seed: 1 };
        let noise = Noise { position: 2e-5, rotation: 4e-5 };
        let data = plant.measure(&design.rows(&arm), noise, 1).expect("it stands");
        let diagnosed = diagnose_with(&arm, &data, &options, &|_| {}).expect("a diagnosis");
        let told = |_: &_| Told { said: "it gives".to_owned(), numbers: vec!["5 < 6".to_owned()] };
        let words = Words {
            sentence: "Joint 2 twists </script> more; modelling it helps.".to_owned(),
            findings: diagnosed.diagnosis.findings.iter().map(told).collect(),
            hidden: vec!["backlash at joint 1: one side & no other".to_owned()],
            length: Unit { name: "mm", si: 1e-3, decimals: 3 },
            angle: Unit { name: "mrad", si: 1e-3, decimals: 3 },
        };
        Bench { arm, data, options, diagnosed, words }
    }

    fn html(&self) -> String {
        let explanation = &self.diagnosed.explanation;
        let gaps = explanation.predict(&self.data).expect("the same data");
        let report = Report {
            found: &self.diagnosed.diagnosis,
            data: &self.data,
            arm: &self.arm,
            placed: explanation.arm(),
            gaps: &gaps,
            options: &self.options,
            words: &self.words,
        };
        report.html().expect("a page")
    }
}

const POSE: Kind = Kind::Pose { orientation: true };
const SPRING: &str = "joint_compliance@joint 2=6e-6 rad/(N·m)";
const WAVE: &str = "transmission_error@joint 3: cos 2 = 0.4 mrad";

#[test]
fn dev() {
    let bench = Bench::new(POSE, 60, &[SPRING, WAVE], &["joint_compliance", "transmission_error", "backlash", "joint_offset"], true);
    let html = bench.html();
    std::fs::write("/tmp/report.html", &html).unwrap();
    println!("{}", html.len());
}
