//! What is measured: poses under loads, some of them again, each visited when its turn comes.

use stiffarm_gap::measurement::{Kind, Measurements, Row};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;

use super::models::Model;

/// Poses under no, half and full load; twice as many where there is no load to be had.
const POSES: usize = 60;
const LEVELS: [f64; 3] = [0.0, 0.5, 1.0];

/// Poses that are visited again at their last load, and how often.
const AGAIN: usize = 6;
const REPEATS: usize = 2;

/// Seconds from one row to the next.
const PACE: f64 = 20.0;

/// The arm warms up by so many kelvin, with this time constant, s.
const WARMTH: f64 = 8.0;
const WARMING: f64 = 1000.0;

/// Joints go no further to either side, rad.
const FREE: f64 = 150.0 * core::f64::consts::PI / 180.0;

/// The rows in their order, nothing measured in them yet: level by level, within a level in any
/// order. Every joint of every row comes to rest from one side or the other.
pub fn rows(model: &Model, arm: &Arm, orientation: bool, loads: bool, seed: u64) -> Measurements {
    let mut poses = Rng::new(seed, Stream::Poses);
    let mut load = Rng::new(seed, Stream::Loads);
    let mut order = Rng::new(seed, Stream::Approach);
    let (count, levels) = if loads { (POSES, &LEVELS[..]) } else { (2 * POSES, &LEVELS[..1]) };
    let postures: Vec<Vec<f64>> = (0..count)
        .map(|_| {
            let joint = |joint: &stiffarm_kernels::generic::Joint| {
                let [low, high] = joint.limits.unwrap_or([-FREE, FREE]);
                poses.between(low.max(-FREE), high.min(FREE))
            };
            arm.joints.iter().map(joint).collect()
        })
        .collect();
    let mut rows: Vec<Row> = Vec::new();
    for (number, &level) in levels.iter().enumerate() {
        let mut visits: Vec<Row> = Vec::new();
        for (pose, q) in postures.iter().enumerate() {
            let force = level * model.force;
            let across = 0.25 * force;
            let lever = 0.12 * force;
            let scales = [across, across, 0.0, lever, lever, lever];
            let mut wrench = nalgebra::Vector6::from_fn(|k, _| scales[k] * load.normal());
            wrench[2] = -force;
            let row = Row {
                wrench: wrench.map(|f| (f * 1e4).round() / 1e4 + 0.0),
                pose: Some(format!("p{pose}-{level:.1}")),
                ..Row::new(0, q.clone())
            };
            let again = number + 1 == levels.len() && pose < AGAIN;
            visits.extend(vec![row; if again { 1 + REPEATS } else { 1 }]);
        }
        order.shuffle(&mut visits);
        rows.extend(visits);
    }
    for (number, row) in rows.iter_mut().enumerate() {
        let time = PACE * number as f64;
        row.line = number as u64 + 2;
        row.time = Some(time);
        let warm = WARMTH * (1.0 - (-time / WARMING).exp());
        row.temperature = Some(((20.0 + warm) * 1e3).round() / 1e3);
        row.direction = Some(arm.joints.iter().map(|_| order.sign() as i8).collect());
    }
    Measurements::new("the session", Kind::Pose { orientation }, rows)
}
