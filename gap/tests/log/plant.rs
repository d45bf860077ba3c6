//! A planar arm of two links in a vertical plane, by the closed form of Craig, *Introduction to
//! Robotics*, 3rd ed., eqs. 6.58-6.61 (point masses at the links' ends), and what moves it.

use core::f64::consts::{FRAC_PI_2, TAU};
use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix3, Vector3};
use stiffarm_gap::log::read::Clock;
use stiffarm_gap::log::{Log, Run, Signal, TorqueSide};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::{Arm, Drive, Joint};
use stiffarm_kernels::{Convention, Motion};

pub const LENGTH: [f64; 2] = [0.7, 0.5];
pub const MASS: [f64; 2] = [4.0, 3.0];
const G: f64 = 9.80665;

/// The same as a table: x along link 1 where q is zero, gravity along −y.
pub fn arm() -> Arm {
    let joint = |k: usize| Joint {
        motion: Motion::Revolute,
        theta: 0.0,
        d: 0.0,
        a: LENGTH[k],
        alpha: 0.0,
        beta: 0.0,
        compliance: 0.0,
        mass: MASS[k],
        com: Vector3::zeros(),
        inertia: Matrix3::zeros(),
        drive: Drive::default(),
        limits: None,
        beam: None,
    };
    Arm {
        name: "planar".to_owned(),
        convention: Convention::Standard,
        joints: vec![joint(0), joint(1)],
        base: Isometry3::identity(),
        tool: Isometry3::identity(),
        tool_rotation_vector: Vector3::zeros(),
        gravity: Vector3::new(0.0, -G, 0.0),
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
