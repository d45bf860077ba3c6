//! Sockets and plates in place of a tracker: every effect, blind, in unknown places of the bench.

use stiffarm_gap::Options;
use stiffarm_gap::effects::Effect;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::plant::design::{Design, Shape};
use stiffarm_gap::plant::{Noise, effects};
use stiffarm_gap::study::withhold::{Campaign, Experiment, Report, with_findings};

use crate::arms::arm;
use crate::goals::{BENCH, Goals};
use crate::suite::{strays, tried};

/// One arm with one instrument.
struct Setting {
    robot: &'static str,
    /// Of joints that the file leaves rigid, N·m/rad.
    stiffness: f64,
    /// kg.
    payload: f64,
    /// Whether balls sit in sockets; else plates are probed.
    points: bool,
}

fn settings() -> Vec<Setting> {
    let robots = [("kuka_kr240", 1e6, 240.0), ("iiwa14", 1.5e4, 14.0)];
    let of_robot = |(robot, stiffness, payload)| {
        [true, false].map(|points| Setting { robot, stiffness, payload, points })
    };
    robots.into_iter().flat_map(of_robot).collect()
}

/// What no socket sees whose place is unknown: an arm that is larger by a factor fits larger places.
const UNSEEN: [&str; 1] = ["instrument_scale"];

/// Ten postures at each of six sockets, twenty at each of six plates, which have one number a row; no, half and full
/// payload.
fn run(setting: &Setting, cases: usize, seed: u64) -> Report {
    let Setting { payload, points, .. } = *setting;
    let arm = arm(setting.robot, setting.stiffness);
    let (kind, shape) = (Kind::Bench { points }, Shape::Payload);
    let poses = if points { 60 } else { 120 };
    let design = |seed| Design { shape, poses, repeats: 1, payload, kind, seed }.rows(&arm);
    let seen = |effect: &&dyn Effect| !UNSEEN.contains(&effect.identifier());
    let effects: Vec<_> = effects().into_iter().filter(seen).collect();
    let fresh = [1000, 2000, 3000, 4000].map(|more| design(seed + more));
    let options = Options { version: "test".to_owned(), ..Options::default() };
    let experiment = Experiment::Campaign(Campaign {
        design: &design(seed),
        fresh: &fresh,
        predict: Some(&with_findings(&arm, &options.catalogue)),
        // What a printed socket or a plate and a dial gauge are good for.
        noise: Noise { position: 50e-6, rotation: 0.0 },
        frames: None,
        effects: &effects,
        options: &options,
    });
    tried(&arm, experiment, cases, [8.0, 20.0], seed)
}

fn judged(cases: usize, seed: u64) -> Goals {
    let reports: Vec<Report> = settings().iter().map(|s| run(s, cases, seed)).collect();
    for (setting, report) in settings().iter().zip(&reports) {
        let goals = Goals::of(core::slice::from_ref(report), BENCH);
        let what = if setting.points { "sockets" } else { "plates" };
        println!("{}, {what}\n{goals}{}", setting.robot, strays(report));
    }
    Goals::of(&reports, BENCH)
}

#[test]
fn quick() {
    let goals = judged(8, 1);
    assert!(goals.missed_beyond_chance().is_empty(), "{goals}");
}

/// Forty cases of each arm with each instrument.
#[test]
#[ignore = "takes minutes: cargo test -p stiffarm --release --test withheld -- --ignored --nocapture bench"]
fn full() {
    let goals = judged(40, 51);
    println!("all\n{goals}");
    assert!(goals.missed().is_empty(), "{goals}");
}
