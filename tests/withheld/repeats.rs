//! Logs without a cause whose motion repeats: the same errors of encoders and rates in every repeat are no evidence.
//!
//! ```text
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture repeats::full
//! ```
//!
//! Two arms with the friction that their files have; 100 to 250 Hz; the clock locked to the motion, jittering, or with lost
//! samples; one run of several repeats, with rest before and behind or not, or one motion in several runs.
//! `REPEATS_SEEDS=n` tries so many of each.

use stiffarm_gap::log::{Log, LogOptions, diagnose};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_plant::course::{Course, Fourier, Limits, State};
use stiffarm_plant::motion::{Logged, MovingPlant, Recording, Side, Stage};

use crate::logs::arm;

/// How a motion repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// So often in one run, at rest so long before and behind, s.
    OneRun(usize, f64),
    /// One motion in so many runs.
    Runs(usize),
}

/// A clock: jitter as a part of a step, and the part of the samples that are lost.
const CLOCKS: [(f64, f64); 4] = [(0.0, 0.0), (0.0125, 1e-3), (0.05, 1e-3), (0.2, 0.0)];
const RATES: [f64; 4] = [100.0, 125.0, 200.0, 250.0];
const WAYS: [Way; 3] = [Way::OneRun(3, 0.0), Way::OneRun(4, 3.3), Way::Runs(3)];

/// A motion with rest before and behind it.
struct Rested {
    course: Fourier,
    rest: f64,
}

impl Course for Rested {
    fn duration(&self) -> f64 {
        self.course.duration() + 2.0 * self.rest
    }

    fn at(&self, time: f64) -> State {
        self.course.at(time - self.rest)
    }
}

/// What is found in a log without a cause, and what is said of its repeats.
fn found(
    robot: &str,
    way: Way,
    (jitter, lost): (f64, f64),
    rate: f64,
    seed: u64,
) -> (Vec<String>, String) {
    let real = arm(robot);
    let limits = Limits::of(&real, &[1.5], &[5.0]).expect("joints with limits");
    let course = Fourier::draw(&limits, 20.0, 10, &mut Rng::new(seed, Stream::Poses));
    let (runs, course) = match way {
        Way::OneRun(times, rest) => (1, Rested { course: course.repeated(times), rest }),
        Way::Runs(runs) => (runs, Rested { course, rest: 0.0 }),
    };
    let stages: Vec<Stage<'_>> =
        (0..runs).map(|_| Stage { course: &course, payload: None }).collect();
    let recording = Recording { rate, jitter: jitter / rate, lost, ..Recording::default() };
    let plant = MovingPlant::new(&real, &[], Logged::Torque(Side::Motor), recording);
    let text = plant.text(&stages, seed).expect("an arm that moves");
    let log = Log::of_arm(&real, "repeated", &text).expect("a right log");
    let told = diagnose(&real, &log, &LogOptions::default());
    let told = told.expect("a log that is diagnosed");
    let named = told.findings.iter().map(|f| format!("{}@{}", f.effect, f.place)).collect();
    let said = told.remarks.iter().find(|remark| remark.contains("repeat"));
    (named, said.cloned().unwrap_or_default())
}

/// Of so many seeds: logs in which the repeats are not seen, and in which something is named.
fn all(seeds: core::ops::Range<u64>) -> [usize; 3] {
    let mut counts = [0; 3];
    for way in WAYS {
        let mut own = [0; 3];
        for seed in seeds.clone() {
            let k = seed as usize;
            let (clock, rate) = (CLOCKS[k / 4 % 4], RATES[k % 4]);
            let robot = ["ur10", "panda"][k / 2 % 2];
            let (named, said) = found(robot, way, clock, rate, seed);
            own[0] += 1;
            own[1] += usize::from(said.is_empty());
            own[2] += usize::from(!named.is_empty());
            if said.is_empty() || !named.is_empty() {
                println!(
                    "  {way:?} {robot} {seed} {rate} Hz {clock:?}: `{said}` {}",
                    named.join(", ")
                );
            }
        }
        println!(
            "{way:?}: {} logs, repeats not seen in {}, something named in {}",
            own[0], own[1], own[2]
        );
        counts.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
    }
    counts
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn full() {
    let seeds = std::env::var("REPEATS_SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(16);
    let [logs, unseen, named] = all(600..600 + seeds);
    assert_eq!(unseen, 0, "of {logs}");
    // What is right one time in twenty.
    assert!(10 * named <= logs, "{named} of {logs}");
}
