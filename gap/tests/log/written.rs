//! From a log to the torques of the robot file that is written of it: what the corrected arm's inverse dynamics
//! ask is what the diagnosis predicts, on every row. Kernels are compiled of the same file, and are held against
//! this textbook elsewhere (`tests/parity`).

use stiffarm_gap::log::corrected::{Corrected, corrected};
use stiffarm_gap::log::{Log, LogDiagnosis, LogOptions, Model, Signal, diagnosed};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_gap::signal::Signals;
use stiffarm_table::robot::Robot;

use super::plant::{self, Path, rigid};

/// The arm as its user has it: the lengths are right, the masses are not, and there is no friction.
const PLANAR: &str = "\
name = \"planar\"
convention = \"standard\"
gravity = [0.0, -9.80665, 0.0]
torque_side = \"motor\"

[[joint]]
type = \"revolute\"
a = 0.7
mass = 5.0
inertia = [0.05, 0.0, 0.0, 0.05, 0.0, 0.05]

[[joint]]
type = \"revolute\"
a = 0.5
mass = 2.0
inertia = [0.05, 0.0, 0.0, 0.05, 0.0, 0.05]
";

/// Coulomb and viscous friction of the two joints.
const FRICTION: [[f64; 2]; 2] = [[6.0, 4.0], [1.5, 2.5]];

/// What a rotor adds about joint 2, kg·m².
const ROTOR: f64 = 0.8;

fn log() -> Log {
    let path = Path::new(7, 0.6);
    let mut rng = Rng::new(7, Stream::Noise);
    plant::recorded(0.01, 6000, Signal::Torque, |_, t| {
        let [at, v, a] = path.at(t);
        let driven = drives(at, v, a);
        [0, 1].map(|j| [at[j] + 1e-6 * rng.normal(), driven[j] + 0.1 * rng.normal()])
    })
}

/// What the links, the rotor and friction ask of the drives.
fn drives(q: [f64; 2], v: [f64; 2], a: [f64; 2]) -> [f64; 2] {
    let (links, rotor) = (rigid(q, v, a), [0.0, ROTOR * a[1]]);
    let friction = |j: usize| FRICTION[j][0] * v[j].signum() + FRICTION[j][1] * v[j];
    [0, 1].map(|j| links[j] + rotor[j] + friction(j))
}

fn read(text: &str) -> Robot {
    Robot::from_toml(text, "arm.toml").expect("a robot").0
}

fn found(log: &Log) -> (LogDiagnosis, Model, Corrected) {
    let robot = read(PLANAR);
    let arm = stiffarm_gap::robot::arm(&robot).expect("numbers");
    let only = ["coulomb_friction", "viscous_friction", "rotor_inertia"];
    let options = LogOptions {
        band: Some(8.0),
        effects: Some(only.map(str::to_owned).to_vec()),
        ..LogOptions::default()
    };
    let (found, model) = diagnosed(&arm, log, &options).expect("a diagnosis");
    let corrected = corrected(&robot, &arm, log, &found, &model).expect("torques");
    (found, model, corrected)
}

#[test]
fn the_written_arm_asks_what_the_diagnosis_predicts() {
    let log = log();
    let (found, model, written) = found(&log);
    assert_eq!(found.findings.len(), 5, "{:#?}", found.findings);
    let arm = stiffarm_gap::robot::arm(&read(PLANAR)).expect("numbers");
    let explained = model.explain(&arm, &log).expect("its own log");
    // As it is read again: nine digits are written.
    let better = stiffarm_gap::robot::arm(&read(&written.robot.to_toml())).expect("numbers");
    let mut signals = Signals::of(&log, model.drive, Some(model.band));
    signals.mark_ways(&model.still);
    // The diagnosis filters what it computes at every sample: so are the written arm's torques.
    let mut torques = [Vec::new(), Vec::new()];
    for k in 0..signals.t.len() {
        let at = |of: &[Vec<f64>]| [of[0][k], of[1][k]];
        let asks = better.inverse_dynamics(&at(&signals.q), &at(&signals.qd), &at(&signals.qdd));
        torques.iter_mut().zip(asks.iter()).for_each(|(of, x)| of.push(*x));
    }
    let bodies = written.bodies.expect("torque rows");
    for (joint, (fine, gap)) in torques.iter().zip(&found.gap).enumerate() {
        let (asked, rows) = (signals.filtered(fine), &explained.joints[joint]);
        let off = rows.rms(|k| asked[k] - (rows.target[k] - rows.left(k)));
        // The links are bodies that are near to what was fitted, by so much; friction is there to nine digits.
        assert!(off <= 2.0 * bodies * gap.size + 1e-6 * gap.size, "{off} of {}", gap.size);
        // And bodies leave of the torques what the diagnosis says, not what the file left before.
        let left = rows.rms(|k| rows.target[k] - asked[k]);
        assert!(left < 1.1 * gap.after && left < 0.1 * gap.before, "{left}: {gap:?}");
    }
    // The arm that was logged, by its closed form.
    for (q, v, a) in
        [([0.3, -0.8], [0.7, -0.4], [1.1, 2.0]), ([-0.5, -2.0], [-0.3, 0.9], [0.0, -3.0])]
    {
        let asked = better.inverse_dynamics(&q, &v, &a);
        for (j, was) in drives(q, v, a).into_iter().enumerate() {
            assert!((asked[j] - was).abs() < 0.02 * found.gap[j].size, "{} {was}", asked[j]);
        }
    }
}
