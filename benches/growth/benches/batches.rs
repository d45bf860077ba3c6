//! How a batch grows with the number of poses: first-order deflections of a KR 240-2, one after
//! the other, in batches pose after pose and quantity after quantity, and on all cores; each size
//! in a process of its own.
//!
//! ```text
//! cargo bench -p stiffarm-growth --bench batches -- --svg docs
//! ```

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use stiffarm_growth::chart::Chart;
use stiffarm_growth::{alone, kuka_kr240};
use stiffarm_kernels::Output;
use stiffarm_kernels::batch::{self, Layout, Wrenches};

/// Poses of a size are worked through until so many are done, at least [`LEAST`] times each.
const WORK: usize = 20_000_000;

/// Rounds of each size.
const LEAST: usize = 5;

/// The load, N and N·m.
const WRENCH: [f64; 6] = [300.0, -200.0, -2400.0, 40.0, -30.0, 20.0];

/// Numbers of a pose: joint values and a deflection.
const EACH: (usize, usize) = (6, 6);

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(poses) = alone::wanted() {
        return one(poses);
    }
    const NAMES: [&str; 4] = ["one by one", "poses", "quantities", "all cores"];
    println!(
        "nanoseconds per pose                                   memory\n\
         \x20  poses  one by one    poses  quantities  all cores  peak MB  B/pose"
    );
    let mut lines = NAMES.map(|name| (name, Vec::new()));
    for poses in (2..=7).map(|power| 10_usize.pow(power)) {
        let told = alone::run(poses)?;
        let [one, by_pose, by_quantity, parallel, before, peak] = told[..] else {
            return Err("found another number of numbers, expected 6".into());
        };
        let bytes = (peak - before) / poses as f64;
        println!(
            "{poses:>8} {one:>11.1} {by_pose:>8.1} {by_quantity:>11.1} {parallel:>10.1} {:>8.0} \
             {bytes:>7.0}",
            1e-6 * peak
        );
        for ((_, line), time) in lines.iter_mut().zip([one, by_pose, by_quantity, parallel]) {
            line.push([poses as f64, time]);
        }
    }
    let chart = Chart {
        title: "Nanoseconds per pose by the size of the batch",
        subtitle: "KR 240-2, first-order deflection",
        description: "Time per pose of four ways to work through many poses, by their number.",
        x: "poses",
        y: "nanoseconds per pose",
        lines: lines.into(),
    };
    Ok(chart.write("growth_batches.svg")?)
}

/// Nanoseconds per pose of each way, and the memory before and at the most.
fn one(poses: usize) -> Result<(), Box<dyn Error>> {
    let before = alone::peak();
    // The same angles in either order of the numbers: all are as random.
    let angle = |k: usize| 3.0 * (k as f64 * 0.618_033_988_749_895).fract() - 1.5;
    let q: Vec<f64> = (0..EACH.0 * poses).map(angle).collect();
    let mut out = vec![0.0; EACH.1 * poses];
    let wrenches = Wrenches::One(&WRENCH);
    let (robot, output) = (&kuka_kr240::Robot, Output::DeflectionFirstOrder);
    let rounds = LEAST.max(WORK / poses);
    let mut ways = [0.0; 4];
    for (way, time) in ways.iter_mut().enumerate() {
        let mut work = || -> Result<f64, batch::Error> {
            let begin = Instant::now();
            match way {
                0 => {
                    let (q, _) = q.as_chunks::<{ EACH.0 }>();
                    let (out, _) = out.as_chunks_mut::<{ EACH.1 }>();
                    for (q, out) in q.iter().zip(out) {
                        *out = kuka_kr240::deflection_first_order(q, &WRENCH);
                    }
                }
                1 => batch::evaluate(robot, output, Layout::Poses, &q, wrenches, &mut out)?,
                2 => batch::evaluate(robot, output, Layout::Quantities, &q, wrenches, &mut out)?,
                _ => {
                    let layout = Layout::Quantities;
                    batch::evaluate_parallel(robot, output, layout, &q, wrenches, &mut out)?;
                }
            }
            black_box(&mut out);
            Ok(begin.elapsed().as_secs_f64())
        };
        // The first round warms up.
        work()?;
        let begin = alone::processor();
        let mut shortest = f64::INFINITY;
        for _ in 0..rounds {
            shortest = shortest.min(work()?);
        }
        // What one core did, by its own clock; of all cores the clock on the wall tells.
        let own = (alone::processor() - begin) / rounds as f64;
        *time = 1e9 / poses as f64 * if way < 3 { own } else { shortest };
    }
    let [a, b, c, d] = ways;
    alone::tell(&[a, b, c, d, before, alone::peak()]);
    Ok(())
}
