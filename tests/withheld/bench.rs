//! Sockets, plates, wires, gauges, a level and a camera in place of a tracker: every effect, blind, in unknown places of the
//! bench.

use stiffarm_gap::Options;
use stiffarm_gap::instrument::{Bench, Seen};
use stiffarm_gap::measurement::Kind;
use stiffarm_plant::design::{Design, Shape, beside};
use stiffarm_plant::{Frames, Noise, effects};
use stiffarm_study::withhold::{Campaign, Experiment, Report, with_findings};

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
    instrument: Instrument,
}

#[derive(Clone, Copy, Debug)]
enum Instrument {
    /// Balls in sockets, a probe on plates, three draw wires, gauges of unknown zero, or a level.
    Reads(Seen),
    /// A camera beside the arm shows a board of six corners on the tool.
    Camera,
    /// A detector tells the pose of a board on the tool.
    Board,
}

/// The lens of a machine's camera, and a printed board of a hand's breadth.
const BENCH_FILE: &str = "
[[camera]]
name = \"left\"
matrix = [[2400, 0, 640], [0, 2400, 512], [0, 0, 1]]
distortion = [-0.1, 0.05, 0.001, -0.001]
[[board]]
name = \"charuco\"
[board.corners]
c0 = [0.00, 0.00, 0]
c1 = [0.12, 0.00, 0]
c2 = [0.24, 0.00, 0]
c3 = [0.00, 0.18, 0]
c4 = [0.12, 0.18, 0]
c5 = [0.24, 0.18, 0]
";

fn settings() -> Vec<Setting> {
    use Instrument::{Board, Camera, Reads};
    let each = [Reads(Seen::Point), Reads(Seen::Plane), Camera];
    let of_robot = |robot, stiffness, payload, more: [Instrument; 2]| {
        each.into_iter().chain(more).map(move |instrument| Setting {
            robot,
            stiffness,
            payload,
            instrument,
        })
    };
    let large = of_robot("kuka_kr240", 1e6, 240.0, [Reads(Seen::Distance), Reads(Seen::Level)]);
    large.chain(of_robot("iiwa14", 1.5e4, 14.0, [Reads(Seen::Direction), Board])).collect()
}

/// Ten postures at each of six sockets, twenty at each of six plates, gauges and wires, which have one number a row, forty
/// before the camera and with the level; no, half and full payload.
fn run(setting: &Setting, cases: usize, seed: u64) -> Report {
    let Setting { payload, instrument, .. } = *setting;
    let mut arm = arm(setting.robot, setting.stiffness);
    let poses = match instrument {
        Instrument::Reads(Seen::Point) => 60,
        Instrument::Reads(Seen::Plane | Seen::Direction | Seen::Distance) => 120,
        _ => 40,
    };
    let by_camera = !matches!(instrument, Instrument::Reads(_));
    if by_camera {
        arm.base = beside(&arm);
    }
    let bench = Bench::read("bench.toml", BENCH_FILE).expect("a bench");
    let design = |seed| {
        let kind = match instrument {
            Instrument::Camera => Kind::Bench { lengths: 0, angles: true },
            _ => Kind::Pose { orientation: true },
        };
        let design = Design { shape: Shape::Payload, poses, repeats: 1, payload, kind, seed };
        match instrument {
            Instrument::Reads(seen) => design.read_by(&arm, seen),
            Instrument::Camera => design.shown(&arm, &bench).expect("a camera and a board"),
            Instrument::Board => design.detected(&arm),
        }
    };
    let effects = effects();
    let fresh = [1000, 2000, 3000, 4000].map(|more| design(seed + more));
    let options = Options { version: "test".to_owned(), ..Options::default() };
    let experiment = Experiment::Campaign(Campaign {
        design: &design(seed),
        fresh: &fresh,
        predict: Some(&with_findings(&arm, &options.catalogue)),
        // What a printed socket or a plate and a dial gauge are good for; a tenth of a pixel, and twice as much of a level
        // and of a board.
        noise: Noise {
            position: 50e-6,
            rotation: match instrument {
                Instrument::Camera => 0.1 / 2400.0,
                _ => 0.2 / 2400.0,
            },
        },
        frames: by_camera.then(Frames::default),
        effects: &effects,
        options: &options,
    });
    tried(&arm, experiment, cases, [8.0, 20.0], seed)
}

/// So many cases of each setting.
fn judged(cases: usize, seed: u64) -> Goals {
    let settings = settings();
    let reports: Vec<Report> = settings.iter().map(|s| run(s, cases, seed)).collect();
    for (setting, report) in settings.iter().zip(&reports) {
        let goals = Goals::of(core::slice::from_ref(report), BENCH);
        println!("{}, {:?}\n{goals}{}", setting.robot, setting.instrument, strays(report));
    }
    Goals::of(&reports, BENCH)
}

/// Two cases of each arm with each instrument.
#[test]
#[ignore = "needs time: each arm with each instrument"]
fn needs_time_few_benches_miss_no_goal() {
    let goals = judged(2, 1);
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
