//! From a log to kernels: an arm with friction is moved and logged, the robot file is written of what its diagnosis
//! finds, and what `robot!` compiles of that file asks what the textbook asks of it, at any state, and on every row of
//! the log what the diagnosis predicts.
//!
//! `STIFFARM_WRITE_DATA=1 cargo test -p stiffarm --test parity logged -- --ignored` writes the file anew.

use stiffarm::kernels::generic::Arm;
use stiffarm::kernels::parity::Comparison;
use stiffarm::kernels::{Kernels, Output};
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::log::corrected::{Corrected, corrected};
use stiffarm_gap::log::{Log, LogDiagnosis, LogOptions, Model, Names, diagnosed};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_gap::signal::Signals;
use stiffarm_plant::course::{Fourier, Limits};
use stiffarm_plant::motion::{Logged, MotionTruth, MovingPlant, Recording, Side, Stage, csv};

use crate::compare::{CANCELLED, Draws, ForArm, deviation, known, read};

stiffarm::robot! {
    /// A UR10 as its log has corrected it.
    mod logged from "tests/data/logged.toml";
    outputs: inverse_dynamics;
}

const FILE: &str = "tests/data/logged.toml";
const MOTOR: Logged = Logged::Torque(Side::Motor);
const SEED: u64 = 17;

/// What the table has entries for, at every joint something. With more at its last, which is light, the controller
/// loses the arm.
const TRUTHS: [&str; 8] = [
    "coulomb_friction@joint 1=9",
    "viscous_friction@joint 1=12",
    "coulomb_friction@joint 2=14",
    "viscous_friction@joint 3=8",
    "coulomb_friction@joint 4=3",
    "rotor_inertia@joint 4=0.3",
    "viscous_friction@joint 5=2",
    "viscous_friction@joint 6=0.3",
];

/// A minute of it, read as a file.
fn recorded(arm: &Arm) -> Log {
    let limits = Limits::of(arm, &[1.5], &[5.0]).expect("joints with limits");
    let course = Fourier::draw(&limits, 60.0, 30, &mut Rng::new(SEED, Stream::Poses));
    let truths = TRUTHS.map(|text| MotionTruth::parse(text, arm, 1).expect("a truth"));
    let plant = MovingPlant::new(arm, &truths, MOTOR, Recording::default());
    let runs = plant.record(&[Stage { course: &course, payload: None }], SEED).expect("a log");
    let motions: Vec<_> = arm.joints.iter().map(|joint| joint.motion).collect();
    let text = csv(arm, MOTOR, &runs, &[]);
    Log::from_bytes("log.csv", text.as_bytes(), &motions, &Names::default()).expect("a log")
}

fn found(robot: &Robot, arm: &Arm, log: &Log) -> (LogDiagnosis, Model, Corrected) {
    let only = ["coulomb_friction", "viscous_friction", "rotor_inertia"];
    let effects = Some(only.map(str::to_owned).to_vec());
    let options = LogOptions { effects, ..LogOptions::default() };
    let (found, model) = diagnosed(arm, log, &options).expect("a diagnosis");
    let written = corrected(robot, arm, log, &found, &model).expect("torques");
    (found, model, written)
}

#[test]
fn a_logged_arm_is_compiled_with_its_friction() {
    let (file, textbook) = read(include_str!("../data/logged.toml"), FILE);
    let drives = file.joints.iter().map(|joint| &joint.drive);
    assert!(drives.clone().all(|drive| drive.coulomb.is_some() || drive.viscous.is_some()));
    assert!(drives.clone().any(|drive| drive.rotor_inertia.is_some()));
    let mut draws = Draws::new(7);
    for _ in 0..1000 {
        let (state, wrench) = (draws.state(&textbook), draws.wrench(&textbook));
        let at = (state.as_slice(), &wrench);
        let kernels: &dyn Kernels<f64> = &logged::Robot;
        let worst = deviation(kernels, &textbook, Output::InverseDynamics, at, (CANCELLED, |x| x));
        assert!(worst <= Comparison::Textbook.limit(), "{worst:e} at {state:?}");
    }
}

#[test]
#[ignore = "needs time: one long log"]
fn needs_time_the_compiled_arm_asks_what_the_diagnosis_predicts() {
    let (robot, arm) = known("ur10");
    let log = recorded(&arm);
    let (found, model, written) = found(&robot, &arm, &log);
    if std::env::var_os("STIFFARM_WRITE_DATA").is_some() {
        std::fs::write(FILE, written.robot.to_toml()).expect("the file is written");
        return;
    }
    let explained = model.explain(&arm, &log).expect("its own log");
    let mut signals = Signals::of(&log, model.drive, Some(model.band));
    signals.mark_ways(&model.still);
    let mut torques = vec![Vec::new(); arm.dof()];
    for k in 0..signals.t.len() {
        let motion = [&signals.q, &signals.qd, &signals.qdd];
        let state: Vec<f64> = motion.into_iter().flatten().map(|joint| joint[k]).collect();
        let mut asks = [0.0; logged::N];
        let kernels: &dyn Kernels<f64> = &logged::Robot;
        let done = kernels.evaluate(Output::InverseDynamics, &state, &[0.0; 6], &mut asks);
        assert_eq!(done, Ok(()));
        torques.iter_mut().zip(asks).for_each(|(of, x)| of.push(x));
    }
    let bodies = written.bodies.expect("torque rows");
    for (joint, (fine, gap)) in torques.iter().zip(&found.gap).enumerate() {
        // The diagnosis filters what it computes at every sample: so are the kernel's torques.
        let (asked, rows) = (signals.filtered(fine), &explained.joints[joint]);
        let off = rows.rms(|k| asked[k] - (rows.target[k] - rows.left(k)));
        // The links are bodies that are near to what was fitted, by so much in the mean of the joints: no joint is off
        // by more than all together. Friction and rotors are there to nine digits.
        let all = logged::N as f64 * bodies;
        assert!(off <= (all + 1e-6) * gap.size, "{}: {off} of {gap:?}", joint + 1);
        let left = rows.rms(|k| rows.target[k] - asked[k]);
        assert!(left < 1.1 * gap.after, "{}: {left} of {gap:?}", joint + 1);
    }
}
