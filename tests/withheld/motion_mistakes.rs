//! Logs in motion with a wrong file or reading: each kind is put into what a plant logs, and the diagnosis is not told.
//!
//! ```text
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture motion_mistakes::full
//! ```
//!
//! Two arms with friction and rotors, drawn motions of three runs at 250 Hz, torques with 2 % noise. A kind is right if it is
//! named where it is and nothing beside it is read otherwise; findings beside it are counted by themselves, as of clean
//! logs. `MISTAKES_SEEDS=n` tries so many of each.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use stiffarm_gap::log::report::{Finding, LogDiagnosis};
use stiffarm_gap::log::{Log, LogOptions, Run, Signal, diagnose};
use stiffarm_gap::measurement::Body;
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::course::{Fourier, Limits};
use stiffarm_plant::motion::{Logged, MotionTruth, MovingPlant, Recording, Side, Stage};

use crate::logs::arm;

const RUNS: usize = 3;

/// What is wrong. Joints count from 0.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Nothing,
    Sign(Signal, usize),
    Swapped(usize, usize),
    /// A joint's values so many degrees below the robot file's.
    Zero(usize, f64),
    /// Rates so many times those of the joints.
    Rates(f64),
    /// Stamps so many times those of the clock.
    Time(f64),
    Clipped(usize),
    Silent(usize),
    Parked(usize),
    Wrapped,
    /// s.
    Delay(f64),
    /// The same, s, beside two exchanged torques, or a turned one where both joints are one.
    Late(f64, usize, usize),
    /// The file's friction at every joint, times what is true.
    Friction(f64),
    /// The file's viscous friction of a joint, times what is true.
    Viscous(usize, f64),
    /// What every second run carries: named or not, and what the file says that it weighs, kg.
    Held(bool, Option<f64>),
    /// One motion three times, locked to the samples.
    Repeated,
}

use Kind::{
    Clipped, Delay, Friction, Held, Late, Nothing, Parked, Rates, Repeated, Sign, Silent, Swapped,
    Time, Viscous, Wrapped, Zero,
};

/// kg, at a tenth of a metre before the tool.
const LOAD: f64 = 3.7;

fn kinds(joints: usize) -> Vec<Kind> {
    let mut all = vec![Nothing, Nothing, Nothing];
    all.extend((0..joints).flat_map(|j| [Sign(Signal::Q, j), Sign(Signal::Torque, j)]));
    all.extend((1..joints).map(|j| Swapped(j - 1, j)));
    all.extend([Zero(1, 90.0), Zero(1, -60.0), Zero(2, 180.0), Zero(2, -75.0)]);
    all.extend([Rates(180.0 / PI), Rates(-1.0), Time(1e3), Time(1e-3)]);
    all.extend([Clipped(1), Silent(2), Parked(joints - 1), Wrapped]);
    all.extend([0.02, 0.05, 0.1, 0.2, 0.35, 0.5].map(Delay));
    all.extend([Late(0.05, 2, 2), Late(0.2, 1, 2), Late(0.35, 3, 3), Late(0.5, 0, 3)]);
    all.extend([Friction(1.0 / 0.6), Viscous(1, 2.0), Repeated]);
    all.extend([Held(true, None), Held(false, None), Held(true, Some(3.0))]);
    all
}

/// What was diagnosed, and in how far it is right.
struct Tried {
    kind: Kind,
    is_named: bool,
    /// What is said beside it that is not so.
    beside: Vec<String>,
}

fn limits(arm: &Arm) -> Limits {
    Limits::of(arm, &[1.5], &[5.0]).expect("joints with limits")
}

/// A log of the arm as it is, with a mistake of its readings.
fn logged(kind: Kind, real: &Arm, seed: u64) -> Log {
    let limits = limits(real);
    let course = |k: usize| {
        let mut rng = Rng::new(100 * seed + k as u64, Stream::Poses);
        let repeats = if matches!(kind, Repeated) { 3 } else { 1 };
        Fourier::draw(&limits, 20.0, 10, &mut rng).repeated(repeats)
    };
    let runs = if matches!(kind, Repeated) { 1 } else { RUNS };
    let courses: Vec<Fourier> = (0..runs).map(course).collect();
    let held = |k: usize| {
        let name = "box".to_owned();
        (matches!(kind, Held(..)) && k == 1).then(|| (name, LOAD, Vector3::new(0.0, 0.0, 0.1)))
    };
    let stages: Vec<Stage<'_>> =
        courses.iter().enumerate().map(|(k, course)| Stage { course, payload: held(k) }).collect();
    let late = match kind {
        Delay(delay) | Late(delay, ..) => {
            vec![MotionTruth::parse(&format!("latency={delay}"), real, runs).expect("a delay")]
        }
        _ => Vec::new(),
    };
    let recording = match kind {
        Repeated => Recording { jitter: 0.0, lost: 0.0, ..Recording::default() },
        _ => Recording::default(),
    };
    let plant = MovingPlant::new(real, &late, Logged::Torque(Side::Motor), recording);
    let text = plant.text(&stages, seed).expect("an arm that moves");
    let mut log = Log::of_arm(real, "withheld", &text).expect("a right log");
    if let Clipped(joint) = kind {
        clip(&mut log, joint);
    }
    log.runs.iter_mut().for_each(|run| misread(kind, run));
    log
}

/// One amplifier has one limit in all runs, which a twentieth of the samples would exceed.
fn clip(log: &mut Log, joint: usize) {
    let rows = log.runs.iter().flat_map(|run| &run.signals[&Signal::Torque][joint]);
    let mut sizes: Vec<f64> = rows.map(|x| x.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let most = sizes[sizes.len() * 19 / 20];
    for run in &mut log.runs {
        let rows = &mut run.signals.get_mut(&Signal::Torque).expect("torques")[joint];
        rows.iter_mut().for_each(|x| *x = x.clamp(-most, most));
    }
}

fn misread(kind: Kind, run: &mut Run) {
    let t = run.t.clone();
    let all = |run: &mut Run, signal: Signal| -> Vec<Vec<f64>> {
        run.signals.get(&signal).cloned().unwrap_or_default()
    };
    match kind {
        Sign(signal, joint) => {
            let rows = run.signals.get_mut(&signal).expect("it is logged");
            rows[joint].iter_mut().for_each(|x| *x = -*x);
        }
        Swapped(a, b) => run.signals.get_mut(&Signal::Torque).expect("torques").swap(a, b),
        Zero(joint, by) => {
            let rows = run.signals.get_mut(&Signal::Q).expect("joints");
            rows[joint].iter_mut().for_each(|q| *q -= by.to_radians());
        }
        Late(_, a, b) if a == b => misread(Sign(Signal::Torque, a), run),
        Late(_, a, b) => misread(Swapped(a, b), run),
        Rates(factor) => {
            let q = all(run, Signal::Q);
            let rate = |q: &Vec<f64>| -> Vec<f64> {
                let last = q.len() - 1;
                let at = |k: usize| {
                    let (from, to) = (k.saturating_sub(1), (k + 1).min(last));
                    factor * (q[to] - q[from]) / (t[to] - t[from])
                };
                (0..=last).map(at).collect()
            };
            run.signals.insert(Signal::Qd, q.iter().map(rate).collect());
        }
        Time(factor) => {
            run.t.iter_mut().for_each(|t| *t *= factor);
            run.clock.period *= factor;
            run.clock.jitter *= factor;
        }
        Silent(joint) => run.signals.get_mut(&Signal::Torque).expect("torques")[joint].fill(0.0),
        Parked(joint) => run.signals.get_mut(&Signal::Q).expect("joints")[joint].fill(0.4),
        Wrapped => {
            let rows = run.signals.get_mut(&Signal::Q).expect("joints").iter_mut().flatten();
            rows.for_each(|q| *q = (*q + PI).rem_euclid(TAU) - PI);
        }
        Held(false, _) => run.payload = None,
        _ => {}
    }
}

fn file(kind: Kind, real: &Arm) -> Arm {
    let mut file = real.clone();
    for (j, joint) in file.joints.iter_mut().enumerate() {
        match kind {
            Friction(times) => {
                joint.drive.coulomb *= times;
                joint.drive.viscous *= times;
            }
            Viscous(one, times) if one == j => joint.drive.viscous *= times,
            _ => {}
        }
    }
    file
}

fn tried(kind: Kind, real: &Arm, seed: u64) -> Tried {
    let log = logged(kind, real, seed);
    let payloads = match kind {
        Held(true, Some(mass)) => {
            vec![Body { name: "box".to_owned(), mass, com: Vector3::new(0.0, 0.0, 0.1) }]
        }
        _ => Vec::new(),
    };
    let options = LogOptions { payloads, ..LogOptions::default() };
    let found = diagnose(&file(kind, real), &log, &options).expect("a log that is diagnosed");
    let (is_named, own) = is_named(kind, real, &log, &found);
    let read: Vec<&String> =
        found.remarks.iter().filter(|remark| remark.starts_with("withheld: ")).collect();
    let phrase = match kind {
        Wrapped => Some("jumps by whole turns".to_owned()),
        kind => phrase(kind, &log),
    };
    let is_own = |remark: &String| phrase.as_ref().is_some_and(|phrase| remark.contains(phrase));
    let others = read.into_iter().filter(|remark| !is_own(remark)).cloned();
    let strays = found.findings.iter().filter(|finding| !own(finding));
    let strays = strays.map(|f| format!("{}@{}", f.effect, f.place));
    Tried { kind, is_named, beside: others.chain(strays).collect() }
}

/// What the sentence of a mistake of the readings says.
fn phrase(kind: Kind, log: &Log) -> Option<String> {
    let jumps = |j: usize| {
        let rows = log.runs.iter().map(|run| &run.signals[&Signal::Q][j]);
        rows.flat_map(|q| q.windows(2)).any(|pair| (pair[1] - pair[0]).abs() > PI)
    };
    let wrapped = || (0..log.runs[0].signals[&Signal::Q].len()).find(|j| jumps(*j));
    Some(match kind {
        Sign(Signal::Q, j) => format!("q{n} has the wrong sign for joint {n}", n = j + 1),
        Sign(_, j) => format!("tau{n} has the wrong sign for joint {n}", n = j + 1),
        Swapped(a, b) => format!("tau{} and tau{} stand in each other's columns", a + 1, b + 1),
        Zero(j, _) => format!("q{n} is off by ", n = j + 1),
        Late(_, a, b) if a == b => return phrase(Sign(Signal::Torque, a), log),
        Late(_, a, b) => return phrase(Swapped(a, b), log),
        Rates(factor) if factor < 0.0 => "qd1 … have the sign against".to_owned(),
        Rates(_) => "they are read as deg/s".to_owned(),
        Time(factor) if factor > 1.0 => "it is read as milliseconds".to_owned(),
        Time(_) => "it is read as a thousand times that".to_owned(),
        Clipped(j) => format!("tau{} stands at its limit", j + 1),
        Silent(j) => format!("tau{} is 0 throughout", j + 1),
        Parked(j) => format!("joint {} does not move", j + 1),
        Wrapped => format!("q{} jumps by whole turns", wrapped()? + 1),
        Held(false, _) => "run 2 carries about 3.7 kg more".to_owned(),
        _ => return None,
    })
}

/// Whether a finding is a mistake's own.
type Own = dyn Fn(&Finding) -> bool;

/// Whether a mistake is named, and which findings are its own.
fn is_named(kind: Kind, real: &Arm, log: &Log, found: &LogDiagnosis) -> (bool, Box<Own>) {
    let says = phrase(kind, log)
        .is_none_or(|phrase| found.remarks.iter().any(|remark| remark.contains(&phrase)));
    let value = |effect: &str, place: &str| {
        let is = |f: &&Finding| f.effect == effect && f.place == place;
        Some(found.findings.iter().find(is)?.parameters.first()?.value)
    };
    let near = |x: Option<f64>, to: f64, by: f64| x.is_some_and(|x| (x - to).abs() < by);
    let place = |j: usize| format!("joint {}", j + 1);
    match kind {
        Delay(delay) => (
            // A part of a sample, 4 ms.
            near(value("latency", "the interface"), delay, 5e-4),
            Box::new(|f| f.effect == "latency"),
        ),
        Late(delay, ..) => (
            says && near(value("latency", "the interface"), delay, 5e-4),
            Box::new(|f| f.effect == "latency"),
        ),
        Friction(times) => {
            let right = |j: usize| {
                let drive = &real.joints[j].drive;
                let is = |effect, of: f64| {
                    let by = (1.0 - times) * of;
                    near(value(effect, &place(j)), by, 0.1 * by.abs())
                };
                is("coulomb_friction", drive.coulomb) && is("viscous_friction", drive.viscous)
            };
            let own = ["coulomb_friction", "viscous_friction"];
            ((0..real.dof()).all(right), Box::new(move |f| own.contains(&&*f.effect)))
        }
        Viscous(j, times) => {
            let by = (1.0 - times) * real.joints[j].drive.viscous;
            let here = place(j);
            let is = near(value("viscous_friction", &here), by, 0.1 * by.abs());
            (is, Box::new(move |f| f.effect == "viscous_friction" && f.place == here))
        }
        Held(_, Some(mass)) => {
            let scale = value("torque_scale", "every joint");
            let is = near(scale, LOAD / mass - 1.0, 0.02)
                || near(value("payload", "the tool in run 2"), LOAD - mass, 0.1);
            let both = ["torque_scale", "payload"];
            let told = |f: &Finding| {
                let other = f.alternatives.iter().any(|a| both.contains(&&*a.effect));
                both.contains(&&*f.effect) && other
            };
            (is && found.findings.iter().any(told), Box::new(move |f| both.contains(&&*f.effect)))
        }
        Held(..) => {
            let is = near(value("payload", "the tool in run 2"), LOAD, 0.1);
            (says && is, Box::new(|f| f.effect == "payload"))
        }
        Repeated => {
            let said = found.remarks.iter().any(|remark| remark.contains("repeats 3 times"));
            (said, Box::new(|_| false))
        }
        _ => (says, Box::new(|_| false)),
    }
}

/// Of so many seeds: how many mistakes are named, and in how many cases something else is.
fn all(robots: &[&str], seeds: core::ops::Range<u64>, only: fn(Kind) -> bool) -> [usize; 3] {
    let mut counts = [0; 3];
    for robot in robots {
        let real = arm(robot);
        for seed in seeds.clone() {
            for kind in kinds(real.dof()).into_iter().filter(|kind| only(*kind)) {
                // Of motions and noise that no other case has: what is right one time in twenty is so in one case.
                let own = 1000 * counts[0] as u64 + seed;
                let Tried { kind, is_named, beside } = tried(kind, &real, own);
                counts[0] += 1;
                counts[1] += usize::from(!is_named);
                counts[2] += usize::from(!beside.is_empty());
                if !is_named || !beside.is_empty() {
                    let named = if is_named { "named" } else { "missed" };
                    println!("  {robot} {seed} {kind:?}: {named}; {}", beside.join(", "));
                }
            }
        }
    }
    let [cases, missed, beside] = counts;
    println!("{cases} cases: {missed} are missed, beside {beside} something else is named");
    counts
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn full() {
    let seeds = std::env::var("MISTAKES_SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(4);
    let [cases, missed, beside] = all(&["ur10", "panda"], 501..501 + seeds, |_| true);
    assert!(20 * missed <= cases, "{missed} of {cases} are missed");
    // A search of the whole catalogue is wrong about once in twenty logs, whatever is misread.
    assert!(10 * beside <= cases, "beside {beside} of {cases} something else is named");
}

/// One of a reading, one of the links and one of a pose; `gap/tests/log/mistaken.rs` has one of most others.
#[test]
#[ignore = "needs time: a log for each"]
fn needs_time_mistakes_in_logs_are_named() {
    let few = |kind| matches!(kind, Sign(Signal::Torque, 3) | Held(false, _) | Zero(1, 90.0));
    let [cases, missed, beside] = all(&["ur10"], 401..402, few);
    assert!(missed == 0 && beside < 2, "{missed} of {cases} are missed, {beside} have more");
}
