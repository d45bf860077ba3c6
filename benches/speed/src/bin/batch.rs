//! A million Jacobians of the KR 240-2 by Rust's batch, once for each line of the input: the milliseconds that it took.
//! What `python/tools/speed.py` compares with.

use std::error::Error;
use std::io::stdin;
use std::time::Instant;

use stiffarm_kernels::Output;
use stiffarm_kernels::batch::{Layout, Wrenches};

const POSES: usize = 1_000_000;

fn main() -> Result<(), Box<dyn Error>> {
    let arm = stiffarm_robots::arm("kuka_kr240").ok_or("found no kuka_kr240")?;
    // Fractions of the golden ratio, spread evenly from -1 to 1.
    let states: Vec<f64> =
        (0..6 * POSES).map(|k| 2.0 * (0.618_033_988_75 * k as f64).fract() - 1.0).collect();
    let mut out = vec![0.0; 36 * POSES];
    for line in stdin().lines() {
        line?;
        let begun = Instant::now();
        let wrenches = Wrenches::One(&[0.0; 6]);
        arm.batched.evaluate_batch(Output::Jacobian, Layout::Poses, &states, wrenches, &mut out)?;
        println!("{}", 1e3 * begun.elapsed().as_secs_f64());
    }
    Ok(())
}
