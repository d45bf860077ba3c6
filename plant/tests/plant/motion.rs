//! The moving plant against closed forms and other programs.

use nalgebra::{Matrix3, Rotation3, Vector3};
use stiffarm_gap::effects::IN_MOTION;
use stiffarm_gap::log::{Log, LogOptions, Signal, TorqueSide, diagnose};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::course::{Course, Fourier, Limits, Sampled, State};
use stiffarm_plant::motion::{
    LAWS, Law, Logged, MotionTruth, MovingPlant, Recording, Side, Stage, csv, spread,
};

use crate::fixture::geared as arm;

fn course() -> Fourier {
    let limits = Limits::of(&arm(), &[1.5], &[5.0]).unwrap();
    Fourier::draw(&limits, 8.0, 6, &mut Rng::new(2, Stream::Poses))
}

const MOTOR: Logged = Logged::Torque(Side::Motor);

/// Nothing is coarse, late or lost.
const PERFECT: Recording = Recording {
    rate: 1000.0,
    encoder: 0.0,
    reading: 0.0,
    torque: 0.0,
    colour: 0.0,
    torque_step: 0.0,
    jitter: 0.0,
    lost: 0.0,
};

fn truth(text: &str) -> MotionTruth {
    MotionTruth::parse(text, &arm(), 1).unwrap()
}

/// What an effect adds to the drives' torques at every millisecond of the course, and the course there.
fn change(text: &str) -> Vec<(State, Vec<f64>)> {
    let (arm, course) = (arm(), course());
    let stage = Stage { course: &course, payload: None };
    let told = |truths: &[MotionTruth]| {
        MovingPlant::new(&arm, truths, MOTOR, PERFECT).exact(0, &stage).unwrap()
    };
    let (with, without) = (told(&[truth(text)]), told(&[]));
    let row = |k: usize| (0..3).map(|j| with[j][k] - without[j][k]).collect();
    (0..with[0].len()).map(|k| (course.at(k as f64 * 1e-3), row(k))).collect()
}

/// Every effect's change at joint 2, or of the joints that it acts on, by the formula that the
/// catalogue of logs names. Of joints that move: what stands is held by what it takes.
#[test]
fn effects_are_what_their_formulas_say() {
    type Formula = fn(&State) -> [f64; 3];
    let cases: [(&str, Formula); 10] = [
        ("coulomb_friction@joint 2=3", |s| [0.0, 3.0 * s.qd[1].signum(), 0.0]),
        ("viscous_friction@joint 2=3", |s| [0.0, 3.0 * s.qd[1], 0.0]),
        ("friction_curve@joint 2=3", |s| [0.0, 3.0 * s.qd[1].signum() * s.qd[1].abs().sqrt(), 0.0]),
        ("stribeck@joint 2:torque=3,speed=0.2", |s| {
            [0.0, 3.0 * s.qd[1].signum() * (-(s.qd[1] / 0.2).powi(2)).exp(), 0.0]
        }),
        ("torque_offset@joint 2=3", |_| [0.0, 3.0, 0.0]),
        ("asymmetric_friction@joint 2=3", |_| [0.0, 3.0, 0.0]),
        ("rotor_inertia@joint 2=3", |s| [0.0, 3.0 * s.qdd[1], 0.0]),
        ("counterbalance@joint 2:cos=3,sin=2", |s| {
            [0.0, 3.0 * s.q[1].cos() + 2.0 * s.q[1].sin(), 0.0]
        }),
        ("torque_ripple@joint 2:order=40,cos=3,sin=2", |s| {
            [0.0, 3.0 * (40.0 * s.q[1]).cos() + 2.0 * (40.0 * s.q[1]).sin(), 0.0]
        }),
        ("joint_coupling@joints 2 − 3:coulomb=3,viscous=2,inertia=1", |s| {
            let way = 3.0 * (s.qd[1] - s.qd[2]).signum();
            [0.0, way - 2.0 * s.qd[2] - s.qdd[2], -way - 2.0 * s.qd[1] - s.qdd[1]]
        }),
    ];
    for (text, formula) in cases {
        let mut seen = 0;
        for (state, found) in change(text).iter().skip(500) {
            if state.qd[1] == 0.0 || state.qd[1] == state.qd[2] {
                continue;
            }
            seen += 1;
            for (found, expected) in found.iter().zip(formula(state)) {
                // Rounding of some hundred newton metres.
                assert!((found - expected).abs() < 1e-9, "{text}: {found} {expected}");
            }
        }
        assert!(seen > 1000, "{text}: {seen}");
    }
}

/// The whole torque is what changes, or what changes is in proportion to it.
#[test]
fn effects_of_the_torque_are_what_their_formulas_say() {
    let (arm, course) = (arm(), course());
    let stage = Stage { course: &course, payload: None };
    let told = |texts: &[&str]| {
        let truths: Vec<MotionTruth> = texts.iter().map(|text| truth(text)).collect();
        MovingPlant::new(&arm, &truths, MOTOR, PERFECT).exact(0, &stage).unwrap()
    };
    let plain = told(&[]);
    type Formula = fn(f64) -> f64;
    let cases: [(&str, Formula); 2] = [
        ("torque_scale@joint 2=0.1", |x| 1.1 * x),
        ("torque_saturation@joint 2=0.001", |x| x + 1e-3 * x * x.abs()),
    ];
    for (text, formula) in cases {
        for (found, plain) in told(&[text])[1].iter().zip(&plain[1]) {
            assert!((found - formula(*plain)).abs() < 1e-12 * (1.0 + plain.abs()), "{text}");
        }
    }
    let late = told(&["latency=0.025"]);
    for k in 100..5000 {
        assert!((late[1][k] - plain[1][k - 25]).abs() < 1e-9);
    }
    // Friction of the file, by a part more each minute.
    for (k, (state, found)) in change("warm_up@joint 2=-0.5").iter().enumerate().skip(500) {
        let friction = 4.0 * state.qd[1].signum() + 2.0 * state.qd[1];
        let expected = -0.5 * (k as f64 * 1e-3) / 60.0 * friction;
        assert!((found[1] - expected).abs() < 1e-9);
    }
}

/// Bodies and gravity against the kernels' textbook.
#[test]
fn masses_and_gravity_are_those_of_another_arm() {
    let tilted = |arm: &mut Arm| {
        arm.gravity = Rotation3::from_scaled_axis(Vector3::new(0.02, -0.01, 0.0)) * arm.gravity;
    };
    let heavier = |arm: &mut Arm| {
        // Two kilograms at (0.1, 0.2, −0.1) m of the second link's frame.
        let (link, at) = (&mut arm.joints[1], Vector3::new(0.1, 0.2, -0.1));
        let mass = link.mass + 2.0;
        let com = (link.mass * link.com + 2.0 * at) / mass;
        let about = |m: f64, r: Vector3<f64>| {
            m * (Matrix3::identity() * r.norm_squared() - r * r.transpose())
        };
        link.inertia += about(link.mass, link.com - com) + about(2.0, at - com);
        (link.mass, link.com) = (mass, com);
    };
    let body = "m=2,mx=0.2,my=0.4,mz=-0.2,xx=0.1,yy=0.04,zz=0.1,xy=-0.04,xz=0.02,yz=0.04";
    type Change<'a> = &'a dyn Fn(&mut Arm);
    let cases: [(String, Change<'_>); 2] = [
        ("gravity_direction:rx=0.02,ry=-0.01".to_owned(), &tilted),
        (format!("link_inertia@link 2:{body}"), &heavier),
    ];
    for (text, changed) in cases {
        let (plain, mut other) = (arm(), arm());
        changed(&mut other);
        for (state, found) in change(&text).iter().step_by(97) {
            let torque = |arm: &Arm| arm.inverse_dynamics(&state.q, &state.qd, &state.qdd);
            let expected = torque(&other) - torque(&plain);
            for (found, expected) in found.iter().zip(expected.iter()) {
                assert!((found - expected).abs() < 1e-10, "{text}: {found} {expected}");
            }
        }
    }
}

/// Behind a reversal the bristle comes back by `1 − 2 e^(−x / distance)` (Dahl 1968).
#[test]
fn presliding_friction_comes_back_over_its_distance() {
    let change = change("presliding@joint 2:torque=3,distance=0.02");
    let turned = |k: &usize| *k > 1000 && change[k - 1].0.qd[1] * change[*k].0.qd[1] < 0.0;
    let begin = (0..change.len()).find(turned).unwrap();
    let (from, way) = (change[begin].0.q[1], change[begin].0.qd[1].signum());
    let mut seen = 0;
    for (state, found) in &change[begin..] {
        let gone = (state.q[1] - from).abs();
        if state.qd[1] * way < 0.0 || gone > 0.08 {
            break;
        }
        seen += 1;
        let expected = -3.0 * 2.0 * (-gone / 0.02).exp() * way;
        // The reversal lies within a step, and so does what is gone since.
        assert!((found[1] - expected).abs() < 0.02, "{gone}: {found:?} {expected}");
    }
    assert!(seen > 50, "{seen}");
}

/// A log of the controlled arm, differentiated, against the textbook: it is the motion of the arm that
/// the torques drove. Differences of the second order of a motion up to 6/8 Hz at a millisecond, of which every
/// other step is told.
#[test]
fn torques_and_motion_of_a_controlled_arm_obey_newton() {
    let (arm, course) = (arm(), course());
    let plant = MovingPlant::new(&arm, &[truth("viscous_friction@joint 2=5")], MOTOR, PERFECT);
    let log = &plant.record(&[Stage { course: &course, payload: None }], 1).unwrap()[0];
    let mut heavier = arm.clone();
    heavier.joints[1].drive.viscous += 5.0;
    let mut off = 0.0_f64;
    let at = |k: usize| -> Vec<f64> { log.q.iter().map(|q| q[k]).collect() };
    for k in (600..7400).step_by(7) {
        let [before, here, after] = [k - 1, k, k + 1].map(at);
        let of = |f: fn(f64, f64, f64) -> f64| -> Vec<f64> {
            (0..3).map(|j| f(before[j], here[j], after[j])).collect()
        };
        let qd = of(|a, _, c| (c - a) / 2e-3);
        let qdd = of(|a, b, c| (a - 2.0 * b + c) / 1e-6);
        if qd.iter().any(|rate| rate.abs() < 0.1) {
            continue;
        }
        let expected = heavier.inverse_dynamics(&here, &qd, &qdd);
        for j in 0..3 {
            off = off.max((log.tau[j][k] - expected[j]).abs());
        }
        // The controller does not know of the friction, and holds the arm nonetheless.
        let wanted = course.at(k as f64 * 1e-3);
        assert!((0..3).all(|j| (wanted.q[j] - here[j]).abs() < 0.02));
    }
    assert!(off < 0.05, "{off}");
}

/// At rest friction holds what hangs on it: without the file's weights known to the controller the arm
/// still stays where its bristles stand.
#[test]
fn servos_follow_their_laws() {
    let arm = arm();
    let rate = 3.0;
    // A sine at joint 2 alone.
    let times: Vec<f64> = (0..400).map(|k| 0.02 * f64::from(k)).collect();
    let sine: Vec<f64> = times.iter().map(|t| 0.5 * (rate * t).sin()).collect();
    let joints = [vec![0.1; 400], sine, vec![-0.3; 400]];
    let course = Sampled::of(&times, &joints).unwrap();
    let stage = Stage { course: &course, payload: None };
    let served = |texts: &[&str]| {
        let truths: Vec<MotionTruth> = texts.iter().map(|text| truth(text)).collect();
        MovingPlant::new(&arm, &truths, Logged::Position, PERFECT).exact(0, &stage).unwrap()
    };
    let plain = served(&[]);
    for (k, q) in plain[1].iter().enumerate() {
        assert!((q - course.at(k as f64 * 1e-3).q[1]).abs() < 1e-12);
    }
    let late = served(&["latency=0.1"]);
    assert!((200..7000).all(|k| (late[1][k] - plain[1][k - 100]).abs() < 1e-9));
    // 1/(1 + i ω L − ω² J): second differences of (ω h)² of it.
    let (lag, inertia) = (0.05, 1e-3);
    let lagging = served(&["tracking_lag@joint 2:lag=0.05,inertia=1e-3"]);
    let (re, im) = (1.0 - rate * rate * inertia, rate * lag);
    for (k, lagging) in lagging[1].iter().enumerate().take(7000).skip(3000) {
        let t = k as f64 * 1e-3;
        let expected = 0.5 * (re * (rate * t).sin() - im * (rate * t).cos()) / (re * re + im * im);
        assert!((lagging - expected).abs() < 2e-5, "{t}: {lagging} {expected}");
    }
    let drooping = served(&["servo_droop@joint 2=1e-4"]);
    for k in (1000..7000).step_by(50) {
        let q: Vec<f64> = drooping.iter().map(|q| q[k]).collect();
        let expected = plain[1][k] + 1e-4 * arm.weight_torque(&q)[1];
        // Weights of a step before: a joint that turns by 1.5 mrad.
        assert!((drooping[1][k] - expected).abs() < 1e-4 * 200.0 * 2e-3, "{k}");
    }
    let loose = served(&["backlash@joint 2=0.02"]);
    for k in 1000..7000 {
        let wanted = 0.5 * (rate * (k as f64 * 1e-3)).cos() * rate;
        // A hundredth of a radian behind the sine, once it has gone through its play.
        if wanted.abs() > 0.5 {
            assert!((loose[1][k] - plain[1][k] + 0.01 * wanted.signum()).abs() < 1e-9, "{k}");
        }
    }
}

#[test]
fn a_log_is_as_coarse_as_it_was_recorded() {
    let (arm, course) = (arm(), course());
    let recording = Recording {
        rate: 500.0,
        encoder: 1e-4,
        torque: 0.05,
        jitter: 2e-4,
        lost: 0.02,
        torque_step: 1e-3,
        ..PERFECT
    };
    let plant = MovingPlant::new(&arm, &[], MOTOR, recording);
    let log = &plant.record(&[Stage { course: &course, payload: None }], 7).unwrap()[0];
    // 4001 samples of which one in fifty is lost, to four standard deviations.
    assert!((log.t.len() as f64 - 4001.0 * 0.98).abs() < 4.0 * (80.0_f64 * 0.98).sqrt());
    let late: Vec<f64> = log.t.iter().map(|t| t - (t * 500.0).round() / 500.0).collect();
    let jitter = (late.iter().map(|x| x * x).sum::<f64>() / late.len() as f64).sqrt();
    assert!((jitter / 2e-4 - 1.0).abs() < 0.05, "{jitter}");
    assert!(log.q[1].iter().all(|q| (q / 1e-4 - (q / 1e-4).round()).abs() < 1e-6));
    let quiet = MovingPlant::new(
        &arm,
        &[],
        MOTOR,
        Recording { torque: 0.0, torque_step: 0.0, ..recording },
    );
    let quiet = &quiet.record(&[Stage { course: &course, payload: None }], 7).unwrap()[0];
    assert_eq!(quiet.t, log.t);
    let off: Vec<f64> = log.tau[1].iter().zip(&quiet.tau[1]).map(|(a, b)| a - b).collect();
    let part = spread(&off) / spread(&quiet.tau[1]);
    // Four standard errors of a deviation of some four thousand.
    assert!((part / 0.05 - 1.0).abs() < 4.0 / (8000.0_f64).sqrt(), "{part}");
}

/// The file is read by the reader of logs, and says what was recorded.
#[test]
fn logs_are_read_back() {
    let (arm, course) = (arm(), course());
    let stages = [
        Stage { course: &course, payload: None },
        Stage { course: &course, payload: Some(("disc".to_owned(), 2.0, Vector3::z() * 0.1)) },
    ];
    let sides = [Side::Motor, Side::Link, Side::Current, Side::Commanded].map(Logged::Torque);
    for logged in [&sides[..], &[Logged::Position]].concat() {
        let plant = MovingPlant::new(&arm, &[], logged, Recording::default());
        let runs = plant.record(&stages, 3).unwrap();
        let text = csv(&arm, logged, &runs, &["simulated".to_owned()]);
        let log = Log::of_arm(&arm, "log", &text).unwrap();
        assert_eq!((log.runs.len(), log.damaged.len()), (2, 0));
        let (side, signal) = match logged {
            Logged::Torque(Side::Motor) => (Some(TorqueSide::Motor), Signal::Torque),
            Logged::Torque(Side::Link) => (Some(TorqueSide::Link), Signal::Torque),
            Logged::Torque(Side::Commanded) => (Some(TorqueSide::Commanded), Signal::Torque),
            Logged::Torque(Side::Current) => (None, Signal::Current),
            Logged::Position => (None, Signal::QCmd),
        };
        assert_eq!(log.side, side);
        for (read, run) in log.runs.iter().zip(&runs) {
            assert_eq!(read.t.len(), run.t.len());
            let expected = if signal == Signal::QCmd { &run.q_cmd[2] } else { &run.tau[2] };
            let off = read.signals[&signal][2].iter().zip(expected).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-9);
        }
    }
}

#[test]
fn what_moves_no_mass_is_refused() {
    let mut arm = arm();
    for joint in &mut arm.joints {
        (joint.mass, joint.inertia, joint.drive) = (0.0, Matrix3::zeros(), Default::default());
    }
    let course = course();
    let plant = MovingPlant::new(&arm, &[], MOTOR, PERFECT);
    let error = plant.record(&[Stage { course: &course, payload: None }], 1).unwrap_err();
    assert!(error.to_string().contains("move no mass"), "{error}");
}

/// The plant has a law for every effect, and no name but of one.
#[test]
fn laws_are_those_of_the_catalogue() {
    assert!(IN_MOTION.iter().all(|effect| Law::named(effect.identifier()).is_some()));
    assert_eq!(LAWS.len(), 24);
}

/// The same motion, told by its motors' currents: in the newton-metres of an ampere the same torques.
#[test]
fn currents_are_the_motors_torques_in_amperes() {
    let (arm, course) = (arm(), course());
    let stages = [Stage { course: &course, payload: None }];
    let recorded = |side| {
        let plant = MovingPlant::new(&arm, &[], Logged::Torque(side), Recording::default());
        plant.record(&stages, 4).unwrap().remove(0)
    };
    let (torques, currents) = (recorded(Side::Motor), recorded(Side::Current));
    assert_eq!(torques.t, currents.t);
    for (joint, per_ampere) in currents.per_ampere.iter().enumerate() {
        for (torque, current) in torques.tau[joint].iter().zip(&currents.tau[joint]) {
            assert!((torque - per_ampere * current).abs() < 1e-9 * torque.abs().max(1.0));
        }
    }
    let text = csv(&arm, Logged::Torque(Side::Current), &[currents], &[]);
    let log = Log::of_arm(&arm, "log.csv", &text).unwrap();
    assert!(log.has(Signal::Current) && !log.has(Signal::Torque) && log.side.is_none());
}

/// What is asked of a drive that tells its torque too large, bent and shifted is what it gives, told so.
#[test]
fn a_command_is_what_its_drive_makes_of_it() {
    let truths =
        ["torque_scale@joint 2=0.1", "torque_offset@joint 2=2", "torque_saturation@joint 2=1e-3"]
            .map(truth);
    let (arm, course) = (arm(), course());
    let stages = [Stage { course: &course, payload: None }];
    let recorded = |side, truths: &[MotionTruth]| {
        MovingPlant::new(&arm, truths, Logged::Torque(side), PERFECT)
            .record(&stages, 4)
            .unwrap()
            .remove(0)
    };
    // Without an error of its own a drive gives what is asked for.
    assert_eq!(recorded(Side::Commanded, &[]).tau, recorded(Side::Motor, &[]).tau);
    // A controller that asks too much of a drive which gives less is where the drive's own sensor would be, once its
    // loop has met what the drive does (5 Hz, critically damped: half a second leaves 16 e⁻¹⁶ of it).
    let (asked, measured) = (recorded(Side::Commanded, &truths), recorded(Side::Motor, &truths));
    let size = spread(&asked.tau[1]);
    let off = asked.tau[1].iter().zip(&measured.tau[1]).map(|(a, m)| a - m);
    let off: Vec<f64> = off.skip((0.5 * PERFECT.rate) as usize).collect();
    assert!(spread(&off) < 0.02 * size, "{} of {size}", spread(&off));
    let text = csv(&arm, Logged::Torque(Side::Commanded), &[asked], &[]);
    assert!(text.starts_with("# torque_side = commanded\n"), "{}", &text[..60]);
}

/// The joint is turned by 0.08 rad more than its column says, and with it all that it carries.
#[test]
fn a_zero_is_named_with_its_angle() {
    let arm = arm();
    let limits = Limits::of(&arm, &[1.5], &[5.0]).unwrap();
    let course = Fourier::draw(&limits, 40.0, 6, &mut Rng::new(2, Stream::Poses));
    let stages = [Stage { course: &course, payload: None }];
    let zero = truth("joint_offset@joint 2=0.08");
    let plant = MovingPlant::new(&arm, &[zero], MOTOR, Recording::default());
    let recorded = plant.record(&stages, 4).unwrap();
    let log = Log::of_arm(&arm, "log.csv", &csv(&arm, MOTOR, &recorded, &[])).unwrap();
    let options = LogOptions { known_links: true, ..LogOptions::default() };
    let found = diagnose(&arm, &log, &options).unwrap();
    let first = &found.findings[0];
    assert_eq!((&*first.effect, &*first.place), ("joint_offset", "joint 2"), "{found:#?}");
    let offset = first.parameters[0].value;
    assert!((offset - 0.08).abs() < 2e-3, "{offset}");
}
