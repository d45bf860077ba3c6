//! How a diagnosis grows with the number of poses: six joints, the whole catalogue, one soft joint,
//! three loads at each pose. Times are of this machine and this moment; read how they grow.

use std::time::Instant;

use stiffarm_codegen::robot::Robot;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::plant::design::{Design, Shape};
use stiffarm_gap::plant::{Noise, Plant, Truth};
use stiffarm_gap::{Options, diagnose};

const ROBOT: &str = include_str!("../../robots/arms/kuka_kr240.toml");

/// Standard deviation of every coordinate, m and rad.
const NOISE: f64 = 30e-6;

/// Runs of each size; the fastest is shown.
const RUNS: usize = 3;

fn main() {
    let (robot, _) = Robot::from_toml(ROBOT, "kuka_kr240.toml").expect("a robot file");
    let arm = stiffarm_gap::robot::arm(&robot).expect("an arm");
    let truth = Truth::parse("joint_compliance@joint 2=1.5e-7", &arm).expect("an effect");
    let plant = Plant::new(&arm, &[truth]).expect("a plant");
    let noise = Noise { position: NOISE, rotation: NOISE };
    let options =
        Options { noise_position: Some(NOISE), noise_rotation: Some(NOISE), ..Options::default() };
    println!("poses    rows  seconds  ms per row  findings");
    for poses in [34, 100, 334, 1000, 3334] {
        let kind = Kind::Pose { orientation: true };
        let shape = Shape::Payload;
        let design = Design { shape, poses, repeats: 1, payload: 240.0, kind, seed: 1 };
        let data = plant.measure(&design.rows(&arm), noise, 2).expect("measurements");
        let runs = (0..RUNS).map(|_| {
            let begin = Instant::now();
            let found = diagnose(&arm, &data, &options).expect("a diagnosis").findings.len();
            (begin.elapsed().as_secs_f64(), found)
        });
        let (seconds, found) = runs.min_by(|a, b| a.0.total_cmp(&b.0)).expect("a run");
        let rows = data.rows.len();
        let each = 1e3 * seconds / rows as f64;
        println!("{poses:>5} {rows:>7} {seconds:>8.2} {each:>11.3} {found:>9}");
    }
}
