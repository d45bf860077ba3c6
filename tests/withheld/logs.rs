//! The withheld check of joint logs: effects are put into a plant that moves, and the diagnosis reads
//! its log as a file.
//!
//! ```text
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture logs::tuning
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture logs::kept_apart
//! ```
//!
//! Both move two arms in many ways, with noise of many sizes and colours, and print a line for each log
//! in which something else was named; `LOGS_CASES=n` tries so many of each setting. The seeds of the
//! second are those that nobody tunes by: it holds the goals, over 600 logs, of which 72 have an effect that the
//! diagnosis does not know and could tell.

use stiffarm_gap::log::LogOptions;
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::course::{Fourier, Limits};
use stiffarm_plant::motion::{LAWS, Law, Logged, Recording, Side, Stage};
use stiffarm_study::withhold::{Experiment, Motion, Report};

use crate::arms::file;
use crate::goals::{Goals, LOGS};
use crate::suite::{strays, tried};

/// One arm, moved and logged in one way.
struct Setting {
    name: &'static str,
    robot: &'static str,
    logged: Logged,
    recording: Recording,
    /// Runs, s each.
    runs: usize,
    period: f64,
    /// Harmonics of the motion.
    harmonics: usize,
}

const MOTOR: Logged = Logged::Torque(Side::Motor);

fn settings() -> Vec<Setting> {
    let usual = Recording::default();
    let servo = Recording { rate: 50.0, encoder: 1.5e-3, reading: 5e-4, lost: 0.0, ..usual };
    let setting = |name, robot, logged, recording| Setting {
        name,
        robot,
        logged,
        recording,
        runs: 1,
        period: 60.0,
        harmonics: 40,
    };
    vec![
        setting("motor", "ur10", MOTOR, usual),
        Setting {
            runs: 3,
            period: 25.0,
            harmonics: 15,
            ..setting(
                "motor, three runs, coloured noise",
                "ur10",
                MOTOR,
                Recording { rate: 125.0, torque: 0.03, colour: 0.02, jitter: 5e-4, ..usual },
            )
        },
        setting(
            "motor, seven joints",
            "panda",
            MOTOR,
            Recording { rate: 500.0, torque: 0.04, encoder: 2e-6, ..usual },
        ),
        Setting {
            runs: 2,
            period: 40.0,
            harmonics: 25,
            ..setting(
                "motor, coarse and slow",
                "ur5",
                MOTOR,
                Recording { rate: 100.0, torque: 0.01, encoder: 5e-5, lost: 0.01, ..usual },
            )
        },
        setting("servo", "ur5", Logged::Position, servo),
        Setting {
            runs: 4,
            period: 25.0,
            harmonics: 15,
            ..setting(
                "servo, four runs",
                "ur10",
                Logged::Position,
                Recording { rate: 100.0, encoder: 1e-4, reading: 2e-4, ..servo },
            )
        },
    ]
}

/// A built-in arm with rotors and friction such as arms of its size have, which its file then knows.
pub fn arm(id: &str) -> Arm {
    let mut arm = stiffarm_gap::robot::arm(&file(id)).expect("numbers for everything");
    let last = (arm.dof() - 1) as f64;
    let weight = arm.joints.iter().map(|joint| joint.mass).sum::<f64>();
    for (j, joint) in arm.joints.iter_mut().enumerate() {
        // A tenth at the tip of what there is at the base.
        let size = weight * 10_f64.powf(-(j as f64) / last);
        joint.drive.gear = 100.0;
        joint.drive.rotor_inertia = 0.05 * size / 1e4;
        (joint.drive.coulomb, joint.drive.viscous) = (0.4 * size, 0.4 * size);
    }
    arm
}

fn run(setting: &Setting, cases: usize, seed: u64) -> Report {
    let arm = arm(setting.robot);
    let limits = Limits::of(&arm, &[1.5], &[5.0]).expect("joints with limits");
    let course = |k: usize| {
        let mut rng = Rng::new(seed + k as u64, Stream::Poses);
        Fourier::draw(&limits, setting.period, setting.harmonics, &mut rng)
    };
    let courses: Vec<Fourier> = (0..setting.runs).map(course).collect();
    let stages: Vec<Stage<'_>> =
        courses.iter().map(|course| Stage { course, payload: None }).collect();
    let only = std::env::var("LOGS_EFFECTS").ok();
    let asked = |law: &&'static Law| only.as_ref().is_none_or(|only| only.contains(law.name));
    let effects: Vec<&'static Law> = LAWS.iter().filter(asked).collect();
    let experiment = Experiment::Log(Motion {
        stages: &stages,
        logged: setting.logged,
        recording: setting.recording,
        effects: &effects,
        options: &LogOptions::default(),
    });
    tried(&arm, experiment, cases, [1.0, 3.0], seed)
}

fn all(seeds: &[u64], cases: usize) -> Goals {
    let cases = std::env::var("LOGS_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(cases);
    let only = std::env::var("LOGS_ONLY").ok();
    let mut reports = Vec::new();
    let settings = settings();
    let each = |seed: &u64| settings.iter().zip((*seed..).step_by(100)).collect::<Vec<_>>();
    for (setting, seed) in seeds.iter().flat_map(each) {
        if only.as_ref().is_some_and(|only| !setting.name.contains(only.as_str())) {
            continue;
        }
        let started = std::time::Instant::now();
        let report = run(setting, cases, seed);
        println!("{} ({}), {:.0} s", setting.name, setting.robot, started.elapsed().as_secs_f64());
        print!("{}{}", Goals::of(core::slice::from_ref(&report), LOGS), strays(&report));
        if !report.cannot_plant.is_empty() {
            println!("  does not show: {}", report.cannot_plant.join(", "));
        }
        reports.push(report);
    }
    let goals = Goals::of(&reports, LOGS);
    println!("all\n{goals}");
    goals
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn tuning() {
    all(&[1], 34);
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn kept_apart() {
    let goals = all(&[70_001, 80_001, 90_001], 34);
    assert!(goals.cases >= 600);
    assert!(goals.missed().is_empty(), "{goals}");
}

/// Three logs of each of two settings: a rate must not be worse than its goal beyond chance.
#[test]
#[ignore = "needs time: six logs"]
fn needs_time_few_logs_miss_no_goal() {
    let few = settings().into_iter().filter(|setting| ["motor", "servo"].contains(&setting.name));
    let reports: Vec<_> =
        few.enumerate().map(|(k, s)| run(&s, 3, 5_001 + 100 * k as u64)).collect();
    let goals = Goals::of(&reports, LOGS);
    let strays: String = reports.iter().map(strays).collect();
    assert!(goals.missed_beyond_chance().is_empty(), "{goals}{strays}");
}
