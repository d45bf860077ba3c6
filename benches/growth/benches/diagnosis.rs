//! How a diagnosis grows with the number of poses: six joints, the whole catalogue, three effects,
//! three loads at each pose; each size in a process of its own.
//!
//! ```text
//! cargo bench -p stiffarm-growth --bench diagnosis                    # to 10⁴ poses
//! cargo bench -p stiffarm-growth --bench diagnosis -- --most 100000 --svg docs
//! ```

use std::error::Error;
use std::time::Instant;

use stiffarm_codegen::robot::Robot;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::{Options, diagnose};
use stiffarm_growth::chart::Chart;
use stiffarm_growth::{ROBOT, alone};
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, Plant, Truth};

/// Standard deviation of every coordinate, m and rad.
const NOISE: f64 = 30e-6;

const TRUTHS: [&str; 3] = [
    "joint_compliance@joint 2=1.5e-7",
    "backlash@joint 1=0.2 mrad",
    "transmission_error@joint 3:cos 2=0.1 mrad,sin 2=0.15 mrad",
];

/// Poses; three rows each.
const SIZES: [usize; 7] = [100, 300, 1000, 3000, 10_000, 30_000, 100_000];

/// Sizes that are tried when no other is asked for.
const MOST: usize = 10_000;

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(poses) = alone::wanted() {
        return one(poses);
    }
    let most = alone::option("--most").unwrap_or(MOST);
    println!("  poses    rows  seconds  processor s  ms/row  data MB  peak MB  kB/row  findings");
    let (mut seconds, mut memory) = (Vec::new(), Vec::new());
    for poses in SIZES.into_iter().filter(|poses| *poses <= most) {
        let told = alone::run(poses)?;
        let [rows, time, processor, before, peak, findings] = told[..] else {
            return Err("found another number of numbers, expected 6".into());
        };
        let (each, kilobytes) = (1e3 * processor / rows, 1e-3 * (peak - before) / rows);
        println!(
            "{poses:>7} {rows:>7} {time:>8.2} {processor:>12.2} {each:>7.3} {:>8.0} {:>8.0} {kilobytes:>7.1} \
             {findings:>9}",
            1e-6 * before,
            1e-6 * peak
        );
        seconds.push([poses as f64, processor]);
        memory.push([poses as f64, 1e-9 * peak]);
    }
    let chart = Chart {
        title: "A diagnosis grows as its rows",
        subtitle: "KR 240-2, three effects, three loads at each pose, whole catalogue",
        description: "Seconds and gigabytes of a diagnosis by the number of poses.",
        x: "poses",
        y: "seconds of the processor, gigabytes",
        lines: vec![("time", seconds), ("memory", memory)],
    };
    Ok(chart.write("growth_diagnosis.svg")?)
}

/// Rows, seconds, those of the processor, memory with the data alone and at the most, findings.
fn one(poses: usize) -> Result<(), Box<dyn Error>> {
    let (robot, _) = Robot::from_toml(ROBOT, "kuka_kr240.toml")?;
    let arm = stiffarm_gap::robot::arm(&robot)?;
    let truths: Vec<Truth> =
        TRUTHS.iter().map(|text| Truth::parse(text, &arm)).collect::<Result<_, _>>()?;
    let plant = Plant::new(&arm, &truths)?;
    let noise = Noise { position: NOISE, rotation: NOISE };
    let options =
        Options { noise_position: Some(NOISE), noise_rotation: Some(NOISE), ..Options::default() };
    let (kind, shape) = (Kind::Pose { orientation: true }, Shape::Payload);
    let design = Design { shape, poses, repeats: 1, payload: 240.0, kind, seed: 1 };
    let data = plant.measure(&design.rows(&arm), noise, 2)?;
    let before = alone::peak();
    let (begin, worked) = (Instant::now(), alone::processor());
    let findings = diagnose(&arm, &data, &options)?.findings.len();
    let (seconds, processor) = (begin.elapsed().as_secs_f64(), alone::processor() - worked);
    let rows = data.rows.len() as f64;
    alone::tell(&[rows, seconds, processor, before, alone::peak(), findings as f64]);
    Ok(())
}
