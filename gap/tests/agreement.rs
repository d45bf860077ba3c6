//! One number, one model: the gap that a diagnosis announces, what its model leaves on the same
//! rows, and what the robot that it writes leaves there.

use stiffarm_gap::corrected::{corrected, folded};
use stiffarm_gap::diagnose::{Diagnosed, Nuisance};
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Frames, Noise, Plant, Truth};
use stiffarm_table::robot::Robot;

/// Six joints, three of them parallel; springs where a real arm has them.
const FILE: &str = r#"
name = "six"
convention = "modified"
[[joint]]
type = "revolute"
d = 0.4
stiffness = 5e5
mass = 20.0
com = [0.0, 0.0, -0.1]
[[joint]]
type = "revolute"
a = 0.1
alpha = "-pi/2"
stiffness = 4e5
mass = 25.0
com = [0.3, 0.0, 0.1]
[[joint]]
type = "revolute"
a = 0.6
stiffness = 3e5
mass = 12.0
com = [0.2, 0.0, 0.0]
[[joint]]
type = "revolute"
a = 0.5
d = 0.15
stiffness = 1e5
[[joint]]
type = "revolute"
d = 0.1
alpha = "-pi/2"
gear = 101
[[joint]]
type = "revolute"
d = 0.1
alpha = "pi/2"
[tool]
translation = [0.05, 0.0, 0.12]
"#;

const NOISE: Noise = Noise { position: 2e-5, rotation: 2e-5 };

fn robot() -> Robot {
    Robot::from_toml(FILE, "six.toml").expect("a robot").0
}

fn arm(robot: &Robot) -> Arm {
    stiffarm_gap::robot::arm(robot).expect("numbers")
}

fn measured(truths: &[&str], frames: Option<Frames>, seed: u64) -> Measurements {
    let arm = arm(&robot());
    let truths: Vec<Truth> =
        truths.iter().map(|t| Truth::parse(t, &arm).expect("a truth")).collect();
    let plant = Plant::new(&arm, &truths).expect("a plant");
    let plant = plant.with_frames(frames.unwrap_or_default());
    let design = Design {
        shape: Shape::Payload,
        poses: 60,
        repeats: 1,
        payload: 20.0,
        kind: Kind::Pose { orientation: true },
        seed,
    };
    let mut data = plant.measure(&design.rows(&arm), NOISE, seed).expect("measured");
    data.file = "run.csv".to_owned();
    data
}

/// Position rms that is announced, that the model leaves on the same rows, and that the written
/// robot does, m.
fn three(robot: &Robot, data: &Measurements, options: &Options) -> (Diagnosed, [f64; 3]) {
    let found = diagnose_with(&arm(robot), data, options, &|_| {}).expect("a diagnosis");
    let announced = found.diagnosis.gap.after.position_rms;
    let same = found.explanation.predict(data).expect("predicted");
    let text = corrected(robot, &found).robot.to_toml();
    let written = Robot::from_toml(&text, "written.toml").unwrap_or_else(|e| panic!("{e}")).0;
    let (written, known) =
        folded(&written, &Catalogue::default()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    // Nothing is tried: the gap before is the written robot's.
    let none = Options { known, effects: Some(Vec::new()), ..Options::default() };
    let again = diagnose_with(&arm(&written), data, &none, &|_| {}).expect("a diagnosis");
    let again = again.diagnosis.gap.before.position_rms;
    (found, [announced, Statistics::of(&same.after).position_rms, again])
}

/// What is left on rows that were fitted is smaller than on rows that were not: of `n` numbers and `p`
/// parameters by √((1 − p/n) / (1 + p/n)).
fn optimism(found: &Diagnosed, data: &Measurements) -> f64 {
    let fitted: usize = found.explanation.found().iter().map(|k| k.values.len()).sum();
    let frames = 6 * found.diagnosis.nuisances.len();
    let part = (fitted + frames) as f64 / (6 * data.rows.len()) as f64;
    ((1.0 + part) / (1.0 - part)).sqrt()
}

#[track_caller]
fn agree(found: &Diagnosed, data: &Measurements, [announced, same, written]: [f64; 3], what: &str) {
    let held_out = announced / (same * optimism(found, data));
    assert!((held_out - 1.0).abs() < 0.05, "{what}: {announced:e} {same:e}");
    // The file has twelve decimals, and nine digits of a stiffness.
    assert!((written / same - 1.0).abs() < 1e-4, "{what}: {same:e} {written:e}");
}

/// Arms as they are, in frames that nobody knows: every number that is found is in the file.
#[test]
fn announced_checked_and_written_are_one_number() {
    let everything = [
        "joint_offset@joint 3=0.4 mrad",
        "link_geometry@link 2:a=0.3 mm,alpha=0.4 mrad",
        "link_geometry@link 3:a=-0.2 mm,beta=0.5 mrad",
        "link_geometry@link 4:alpha=-0.3 mrad,beta=-0.4 mrad",
        "joint_compliance@joint 2=3e-6",
        "transmission_error@joint 1:cos 2=0.3 mrad,sin 2=-0.2 mrad",
        "backlash@joint 4=0.4 mrad",
        "joint_ratio@joint 5=500 ppm",
    ];
    for (count, seed) in
        [(4, 1), (6, 2), (8, 3)].into_iter().skip(stiffarm_draws::few_or_many(2, 0))
    {
        let data = measured(&everything[..count], Some(Frames::unknown(seed)), seed);
        let options = Options { nuisances: Nuisance::ALL.to_vec(), ..Options::default() };
        let (found, gaps) = three(&robot(), &data, &options);
        // What calibration takes up is one finding.
        assert!(found.diagnosis.findings.len() >= count - 3, "{count}");
        agree(&found, &data, gaps, &format!("{count} truths"));
        for finding in &found.diagnosis.findings {
            let along = finding.parameters.iter().find(|p| p.name == "d");
            assert!(along.is_none_or(|d| d.value.abs() < 2e-3), "{finding:?}");
        }
    }
}

/// Every effect that the plant has, or every fifth, each alone: found, written and read it is the same model.
#[test]
fn every_effect_is_written_as_it_was_fitted() {
    let truths = [
        "joint_hardening@joint 2=2e-11",
        "bearing_compliance@joint 2:tilt_x=3e-6,tilt_y=3e-6",
        "link_compliance@link 3:bending=1e-5,torsion=1e-5",
        "link_weight@link 2=15",
        "base_compliance:rock_x=3e-6,rock_y=3e-6,give=3e-7",
        "base_compliance:rock=3e-6,give=3e-7",
        "wrench_scale=0.3",
        "payload_com:x=0.1,y=0.1,z=0.1",
        "friction_hysteresis@joint 2=2e-6",
        "joint_coupling@joint 3:joint 2=0.001",
        "thermal_growth=2e-4",
        "instrument_scale=3e-4",
        "settling_lag@joint 1=0.001",
        "drift:x=3e-6,y=2e-6,z=-3e-6,rx=1e-6,ry=2e-6,rz=1e-6",
        "slip@base:after=50,x=0.3mm,rz=0.5mrad",
        "base_frame:x=1mm,rz=1mrad",
        "tool_frame:y=1mm,rx=1mrad",
        "loaded_backlash@joint 2=0.4 mrad",
        "soft_zone@joint 2:threshold=150,compliance=4e-6",
        "counterbalance@joint 2:cos=200,sin=120",
        "motor_error@joint 5:order=202.37,cos=0.3 mrad,sin=-0.2 mrad",
    ];
    for (k, truth) in truths.iter().enumerate().step_by(stiffarm_draws::few_or_many(5, 1)) {
        let data = measured(&[truth], None, k as u64 + 10);
        let id = truth.split([':', '@', '=']).next().expect("an effect");
        let options = Options { effects: Some(vec![id.to_owned()]), ..Options::default() };
        let (found, gaps) = three(&robot(), &data, &options);
        let names: Vec<_> =
            found.explanation.found().iter().map(|k| k.effect.identifier()).collect();
        assert!(names.contains(&id), "{truth}: {names:?}");
        agree(&found, &data, gaps, truth);
    }
}

/// Where the arm stands changes nothing of its gap, another simulator's predictions or not.
#[test]
fn an_arm_has_the_same_gap_wherever_it_stands() {
    let base = "[base]\ntranslation = [1.0, -2.0, 0.5]\nrotation = [0.4, -0.3, 2.0]\n";
    let there = Robot::from_toml(&format!("{FILE}{base}"), "there.toml").expect("a robot").0;
    for kind in [
        Kind::Pose { orientation: true },
        Kind::Pose { orientation: false },
        Kind::Displacement { components: [true; 6] },
    ] {
        for own_sim in [false, true] {
            let gap = |robot: &Robot| {
                let arm = arm(robot);
                let truth = Truth::parse("joint_compliance@joint 2=3e-6", &arm).expect("a truth");
                let mut plant = Plant::new(&arm, &[truth]).expect("a plant");
                if own_sim {
                    plant = plant.with_first_order_sim();
                }
                let (shape, payload) = (Shape::Payload, 20.0);
                let design = Design { shape, poses: 8, repeats: 1, payload, kind, seed: 4 };
                let data = plant.exact(&design.rows(&arm)).expect("measured");
                let none = Options { effects: Some(Vec::new()), ..Options::default() };
                let found = diagnose_with(&arm, &data, &none, &|_| {}).expect("a diagnosis");
                found.diagnosis.gap.before
            };
            let (here, there) = (gap(&robot()), gap(&there));
            assert!(here.position_rms > 1e-5, "{kind:?} {own_sim}");
            // Roundings of places of a metre or two, beside a gap of a tenth of a millimetre and more.
            let near =
                |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{kind:?} {own_sim} {a:e} {b:e}");
            near(here.position_rms, there.position_rms);
            near(here.rotation_rms, there.rotation_rms);
        }
    }
}
