//! A planar arm of two links in a vertical plane, by the closed form of Craig, *Introduction to
//! Robotics*, 3rd ed., eqs. 6.58-6.61 (point masses at the links' ends), and what moves it.

use core::f64::consts::{FRAC_PI_2, TAU};
use std::collections::BTreeMap;

use nalgebra::Vector3;
use stiffarm_gap::log::Clock;
use stiffarm_gap::log::report::{Finding, LogDiagnosis};
use stiffarm_gap::log::{Log, LogOptions, Run, Signal, TorqueSide, diagnose};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::Convention;
use stiffarm_kernels::generic::{Arm, Joint};

pub const LENGTH: [f64; 2] = [0.7, 0.5];
pub const MASS: [f64; 2] = [4.0, 3.0];
const G: f64 = 9.80665;

/// The same as a table: x along link 1 where q is zero, gravity along −y.
pub fn arm() -> Arm {
    let joint = |k: usize| Joint { a: LENGTH[k], mass: MASS[k], ..Joint::default() };
    Arm {
        name: "planar".to_owned(),
        convention: Convention::Standard,
        joints: vec![joint(0), joint(1)],
        gravity: Vector3::new(0.0, -G, 0.0),
        ..Arm::default()
    }
}

/// What the weights ask of the drives.
pub fn gravity(q: [f64; 2]) -> [f64; 2] {
    weights(0.0, q)
}

fn weights(more: f64, q: [f64; 2]) -> [f64; 2] {
    let ([l1, l2], [m1, m2]) = (LENGTH, [MASS[0], MASS[1] + more]);
    let second = m2 * l2 * G * (q[0] + q[1]).cos();
    [second + (m1 + m2) * l1 * G * q[0].cos(), second]
}

/// What the rigid links ask of the drives.
pub fn rigid(q: [f64; 2], v: [f64; 2], a: [f64; 2]) -> [f64; 2] {
    heavier(0.0, q, v, a)
}

/// The same with so much more at the tool.
pub fn heavier(more: f64, q: [f64; 2], v: [f64; 2], a: [f64; 2]) -> [f64; 2] {
    let ([l1, l2], [m1, m2]) = (LENGTH, [MASS[0], MASS[1] + more]);
    let (s2, c2) = q[1].sin_cos();
    let g = weights(more, q);
    let across = m2 * l1 * l2;
    [
        m2 * l2 * l2 * (a[0] + a[1])
            + across * c2 * (2.0 * a[0] + a[1])
            + (m1 + m2) * l1 * l1 * a[0]
            - across * s2 * (v[1] * v[1] + 2.0 * v[0] * v[1])
            + g[0],
        across * c2 * a[0] + across * s2 * v[0] * v[0] + m2 * l2 * l2 * (a[0] + a[1]) + g[1],
    ]
}

/// A sum of sines of each joint, with its rates: position, velocity, acceleration.
pub struct Path([Vec<[f64; 3]>; 2]);

impl Path {
    /// Of frequencies up to `fastest`, Hz.
    pub fn new(seed: u64, fastest: f64) -> Path {
        let mut rng = Rng::new(seed, Stream::Poses);
        let mut waves = || {
            (0..6)
                .map(|_| [rng.between(0.1, 0.35), rng.between(0.05, fastest), rng.unit()])
                .collect()
        };
        Path([waves(), waves()])
    }

    pub fn at(&self, t: f64) -> [[f64; 2]; 3] {
        let mut all = [[0.0, -FRAC_PI_2]; 3];
        (all[1], all[2]) = ([0.0; 2], [0.0; 2]);
        for (joint, waves) in self.0.iter().enumerate() {
            for [size, frequency, phase] in waves {
                let rate = TAU * frequency;
                let (sin, cos) = (rate * t + TAU * phase).sin_cos();
                all[0][joint] += size * sin;
                all[1][joint] += size * rate * cos;
                all[2][joint] -= size * rate * rate * sin;
            }
        }
        all
    }
}

/// Noise of one correlation time and standard deviation, every `step`.
pub fn noise(rng: &mut Rng, count: usize, step: f64, time: f64, size: f64) -> Vec<f64> {
    let keep = (-step / time).exp();
    let mut x = size * rng.normal();
    let mut next = || {
        x = keep * x + size * (1.0 - keep * keep).sqrt() * rng.normal();
        x
    };
    (0..count).map(|_| next()).collect()
}

/// An instant of a motion.
pub struct Now {
    pub t: f64,
    pub q: [f64; 2],
    pub v: [f64; 2],
    pub a: [f64; 2],
}

impl Now {
    /// What the rigid links ask of the drives, and something beside them.
    pub fn rigid_and(&self, more: [f64; 2]) -> [f64; 2] {
        let links = rigid(self.q, self.v, self.a);
        [links[0] + more[0], links[1] + more[1]]
    }

    /// What a body of that mass at the tool asks of the drives.
    pub fn body(&self, mass: f64) -> [f64; 2] {
        let held = heavier(mass, self.q, self.v, self.a);
        let bare = rigid(self.q, self.v, self.a);
        [held[0] - bare[0], held[1] - bare[1]]
    }
}

/// How torques are recorded.
pub struct Recorder {
    /// Of the noise.
    pub seed: u64,
    pub path: Path,
    /// Where the path begins, s.
    pub from: f64,
    pub step: f64,
    pub count: usize,
    /// Correlation time, s, and standard deviation, N·m, of what is added to the torques.
    pub noise: [f64; 2],
}

impl Recorder {
    /// A hundred samples a second, with noise of such a standard deviation.
    pub fn new(seed: u64, count: usize, noise: f64) -> Recorder {
        let path = Path::new(seed, 0.6);
        Recorder { seed, path, from: 0.0, step: 0.01, count, noise: [0.05, noise] }
    }

    /// A log of the torques that `drives` gives, and of encoders that stand so far off the links as it says.
    pub fn torques(&self, mut drives: impl FnMut(&Now) -> ([f64; 2], [f64; 2])) -> Log {
        let mut rng = Rng::new(self.seed, Stream::Noise);
        let [time, size] = self.noise;
        let noises = [(); 2].map(|()| noise(&mut rng, self.count, self.step, time, size));
        recorded(self.step, self.count, Signal::Torque, |k, t| {
            let t = self.from + t;
            let [q, v, a] = self.path.at(t);
            let (torque, off) = drives(&Now { t, q, v, a });
            [0, 1].map(|j| [q[j] + off[j] + 1e-6 * rng.normal(), torque[j] + noises[j][k]])
        })
    }
}

/// A log of samples: of each joint its value and what stands `beside` it.
pub fn recorded(
    step: f64,
    count: usize,
    beside: Signal,
    mut sample: impl FnMut(usize, f64) -> [[f64; 2]; 2],
) -> Log {
    let [mut q, mut other] = [(); 2].map(|()| vec![Vec::new(); 2]);
    for k in 0..count {
        for (j, [value, beside]) in sample(k, step * k as f64).into_iter().enumerate() {
            q[j].push(value);
            other[j].push(beside);
        }
    }
    log(step, BTreeMap::from([(Signal::Q, q), (beside, other)]))
}

/// What is said of a log of this arm below so many hertz.
pub fn diagnosed(log: &Log, band: f64) -> LogDiagnosis {
    let options = LogOptions { band: Some(band), ..LogOptions::default() };
    diagnose(&arm(), log, &options).expect("a diagnosis")
}

/// An effect at a place, which is named.
pub fn finding<'d>(found: &'d LogDiagnosis, effect: &str, place: &str) -> &'d Finding {
    let named = found.findings.iter().find(|f| f.is(effect, place));
    named.unwrap_or_else(|| panic!("{effect} at {place}: {found:#?}"))
}

/// A log of one run at even steps.
pub fn log(step: f64, signals: BTreeMap<Signal, Vec<Vec<f64>>>) -> Log {
    let count = signals[&Signal::Q][0].len();
    let run = Run {
        name: "plant".to_owned(),
        t: (0..count).map(|k| step * k as f64).collect(),
        signals,
        payload: None,
        contact: vec![false; count],
        holes: Vec::new(),
        clock: Clock { period: step, jitter: 0.0, dropped: 0, repeated: 0 },
    };
    Log {
        files: vec!["plant.csv".to_owned()],
        samples: count,
        runs: vec![run],
        side: Some(TorqueSide::Motor),
        damaged: Vec::new(),
        lacking: Vec::new(),
        unknown: Vec::new(),
    }
}
