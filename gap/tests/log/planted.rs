//! One effect after the other, planted by its law, and what is said of it.

use nalgebra::Vector3;
use stiffarm_gap::log::report::LogDiagnosis;
use stiffarm_gap::log::{Log, LogOptions, Run, Signal, diagnose};
use stiffarm_gap::measurement::Body;
use stiffarm_kernels::generic::Arm;

use super::plant::{self, Now, Path, Recorder, arm, finding, gravity, rigid};

/// Torques of the rigid links and of what is planted beside them.
fn recorded(seed: u64, mut more: impl FnMut(&Now) -> [f64; 2]) -> Log {
    recorded_off(seed, |now| (more(now), [0.0; 2]))
}

/// The same; encoders stand so far off the links.
fn recorded_off(seed: u64, mut more: impl FnMut(&Now) -> ([f64; 2], [f64; 2])) -> Log {
    Recorder::new(seed, 8000, 0.1).torques(|now| {
        let (more, off) = more(now);
        (now.rigid_and(more), off)
    })
}

fn diagnosed(log: &Log) -> LogDiagnosis {
    plant::diagnosed(log, 10.0)
}

/// The numbers of an effect at a place, which is named.
fn numbers(found: &LogDiagnosis, effect: &str, place: &str) -> Vec<f64> {
    finding(found, effect, place).parameters.iter().map(|p| p.value).collect()
}

fn close(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found}, expected {expected}");
}

/// Tolerances are twice the 95 % intervals of 80 s that hold some hundreds of independent numbers, and what
/// the band of 10 Hz takes of a step.
#[test]
fn what_is_planted_beside_friction_is_named_with_its_numbers() {
    let bent = recorded(11, |now| {
        let v = now.v[1];
        [0.0, (2.0 + 4.0 * v.abs().sqrt()) * v.signum()]
    });
    close(numbers(&diagnosed(&bent), "friction_curve", "joint 2")[0], 4.0, 0.15);
    let loaded = recorded(12, |now| {
        let load = rigid(now.q, now.v, now.a)[0].abs();
        [(2.0 + 0.1 * load) * now.v[0].signum(), 0.0]
    });
    close(numbers(&diagnosed(&loaded), "load_friction", "joint 1")[0], 0.1, 0.15);
    let warmer = recorded(13, |now| [6.0 * (1.0 - 0.3 * now.t / 60.0) * now.v[0].signum(), 0.0]);
    let found = diagnosed(&warmer);
    let [coulomb, rate] = ["coulomb_friction", "warm_up"].map(|e| numbers(&found, e, "joint 1")[0]);
    // The rate is of the friction that a model without it has, in the middle of 80 s.
    close(coulomb, 6.0, 0.05);
    close(rate, -0.3 / (1.0 - 0.3 * 40.0 / 60.0), 0.15);
}

#[test]
fn what_is_planted_alone_is_named_with_its_numbers() {
    let rotor = recorded(21, |now| [0.0, 0.4 * now.a[1]]);
    close(numbers(&diagnosed(&rotor), "rotor_inertia", "joint 2")[0], 0.4, 0.1);
    let offset = recorded(22, |_| [0.0, 1.5]);
    close(numbers(&diagnosed(&offset), "torque_offset", "joint 2")[0], 1.5, 0.1);
    let ripple = recorded(23, |now| [0.0, (40.0 * now.q[1] + 0.3).cos()]);
    let found = numbers(&diagnosed(&ripple), "torque_ripple", "joint 2");
    assert_eq!(found[0], 40.0, "{found:?}");
    // What turns fast is above the band: it takes a part.
    close(found[1].hypot(found[2]), 1.0, 0.2);
    let path = Path::new(24, 0.6);
    let late = recorded(24, |now| {
        let [q, v, a] = path.at(now.t - 0.02);
        let (then, is) = (rigid(q, v, a), rigid(now.q, now.v, now.a));
        [then[0] - is[0], then[1] - is[1]]
    });
    close(numbers(&diagnosed(&late), "latency", "the interface")[0], 0.02, 0.1);
}

#[test]
fn friction_that_falls_as_it_begins_and_iron_that_saturates_are_named_with_their_numbers() {
    let fall = recorded(25, |now| {
        let v = now.v[1];
        [0.0, (2.0 + 3.0 * (-(v / 0.15).powi(2)).exp()) * v.signum()]
    });
    let found = numbers(&diagnosed(&fall), "stribeck", "joint 2");
    close(found[0], 3.0, 0.15);
    close(found[1], 0.15, 0.15);
    let iron = recorded(26, |now| {
        let brake = 2.0 * now.v[0].signum();
        // A few hundredths of the torque: it is told by the torque as it is told.
        let torque = rigid(now.q, now.v, now.a)[0] + brake;
        [brake + 5e-4 * torque * torque.abs(), 0.0]
    });
    close(numbers(&diagnosed(&iron), "torque_saturation", "joint 1")[0], 5e-4, 0.15);
}

/// While a joint moves a wrong zero does the same: it is named, or told not to be apart from what is.
#[test]
fn friction_that_is_more_one_way_is_not_told_from_a_wrong_zero() {
    let log = recorded(27, |now| [0.0, 2.0 * now.v[1].signum() + 0.8]);
    let found = diagnosed(&log);
    let is = |effect: &str, place: &str| effect == "asymmetric_friction" && place == "joint 2";
    let told = found.findings.iter().find(|f| {
        is(&f.effect, &f.place)
            || f.alternatives.iter().any(|other| is(&other.effect, &other.place))
    });
    let told = told.unwrap_or_else(|| panic!("{found:#?}"));
    assert!(["asymmetric_friction", "torque_offset"].contains(&&*told.effect), "{told:#?}");
    close(told.parameters[0].value, 0.8, 0.1);
}

/// A spring goes with the joint's own angle, weights with the sum of both.
#[test]
fn a_spring_between_links_is_named_with_its_numbers() {
    let log = recorded(28, |now| [0.0, 3.0 * now.q[1].cos() + 1.5 * now.q[1].sin()]);
    let found = numbers(&diagnosed(&log), "counterbalance", "joint 2");
    close(found[0], 3.0, 0.15);
    close(found[1], 1.5, 0.3);
}

/// A base that leans by 0.02 rad: the file's weights pull from there.
#[test]
fn a_base_that_leans_is_named_with_its_angle() {
    let log = recorded(29, |now| {
        // Turned with its base the arm is seen from, gravity turns the other way.
        let (leans, stands) = (gravity([now.q[0] + 0.02, now.q[1]]), gravity(now.q));
        [leans[0] - stands[0], leans[1] - stands[1]]
    });
    let options = LogOptions { band: Some(10.0), known_links: true, ..LogOptions::default() };
    let found = diagnose(&arm(), &log, &options).unwrap();
    close(numbers(&found, "gravity_direction", "the base")[2], 0.02, 0.1);
}

/// In a level plane: the encoder of joint 1 stands before its link by 1 mrad for each newton metre.
#[test]
fn a_gear_that_gives_is_named_with_its_compliance() {
    let log = recorded_off(30, |now| {
        let weights = gravity(now.q);
        let torque = rigid(now.q, now.v, now.a)[0] - weights[0];
        ([-weights[0], -weights[1]], [1e-3 * torque, 0.0])
    });
    let level = Arm { gravity: Vector3::zeros(), ..arm() };
    let options = LogOptions { band: Some(10.0), ..LogOptions::default() };
    let found = diagnose(&level, &log, &options).unwrap();
    close(numbers(&found, "joint_elasticity", "joint 1")[0], 1e-3, 0.15);
}

/// Two runs, in the second of which the tool holds a body that nobody told.
#[test]
fn what_a_run_carries_is_named_with_its_mass() {
    let mut both = recorded(32, |_| [0.0; 2]);
    let mut second = recorded(33, |now| now.body(0.8));
    second.runs[0].payload = Some("disc".to_owned());
    both.runs.extend(second.runs);
    close(numbers(&diagnosed(&both), "payload", "the tool in run 2")[0], 0.8, 0.1);
}

/// Dahl's model, integrated in steps of the log.
#[test]
fn friction_that_builds_up_is_named_with_its_distance() {
    let (mut bent, mut before) = (0.0_f64, None::<f64>);
    let log = recorded(31, |now| {
        let moved = now.q[1] - before.unwrap_or(now.q[1]);
        before = Some(now.q[1]);
        let steps = 50;
        for _ in 0..steps {
            let by = moved / f64::from(steps);
            bent += by / 0.03 * (1.0 - bent * moved.signum());
        }
        [0.0, 5.0 * bent]
    });
    let found = numbers(&diagnosed(&log), "presliding", "joint 2");
    close(found[0], 5.0, 0.15);
    close(found[1], 0.03, 0.3);
}

#[test]
fn a_link_that_is_heavier_than_the_file_says_is_named() {
    let log = recorded(41, |now| now.body(0.5));
    let options = LogOptions { band: Some(10.0), known_links: true, ..LogOptions::default() };
    let found = diagnose(&arm(), &log, &options).unwrap();
    assert_eq!((&*found.findings[0].effect, &*found.findings[0].place), ("link_inertia", "link 2"));
    close(numbers(&found, "link_inertia", "link 2")[0], 0.5, 0.1);
}

/// Two runs, the second with two kilograms at the tool, torques all told 1.25 times: with free masses only
/// the known load tells it.
#[test]
fn a_known_load_tells_the_scale_of_all_torques() {
    let friction = |now: &Now| [6.0 * now.v[0].signum(), 1.5 * now.v[1].signum()];
    let scaled = |mut log: Log| {
        let run: &mut Run = &mut log.runs[0];
        let torques = run.signals.get_mut(&Signal::Torque).expect("torques");
        torques.iter_mut().flatten().for_each(|x| *x *= 1.25);
        log
    };
    let mut both = scaled(recorded(51, friction));
    let mut second = scaled(recorded(52, |now| {
        let (body, brakes) = (now.body(2.0), friction(now));
        [body[0] + brakes[0], body[1] + brakes[1]]
    }));
    second.runs[0].payload = Some("two".to_owned());
    both.runs.extend(second.runs);
    let payloads = vec![Body { name: "two".to_owned(), mass: 2.0, com: Vector3::zeros() }];
    let options = LogOptions { band: Some(8.0), payloads, ..LogOptions::default() };
    let found = diagnose(&arm(), &both, &options).unwrap();
    close(1.0 + numbers(&found, "torque_scale", "every joint")[0], 1.25, 0.03);
}
