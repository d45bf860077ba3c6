// The program that the compiler is timed on: every output of `arm.rs` for f64.

use std::hint::black_box;
use std::time::Instant;

use stiffarm_kernels::Kernels;

#[allow(dead_code)]
#[path = "arm.rs"]
mod arm;

const POSES: usize = 256;
const WRENCH: [f64; 6] = [30.0, -20.0, -240.0, 4.0, -3.0, 2.0];

fn main() {
    black_box(&arm::Robot as &dyn Kernels<f64>);
    let angle = |k: usize| 3.0 * (k as f64 * 0.618_033_988_749_895).fract() - 1.5;
    let pose = |p: usize| std::array::from_fn(|j| angle(p * arm::N + j));
    let q: Vec<[f64; arm::N]> = (0..POSES).map(pose).collect();
    let jacobian = median(&q, arm::jacobian);
    let deflection = median(&q, |q| arm::deflection_first_order(q, &WRENCH));
    println!("{jacobian} {deflection}");
}

fn median<T>(q: &[[f64; arm::N]], f: impl Fn(&[f64; arm::N]) -> T) -> f64 {
    let mut times: Vec<f64> = (0..51)
        .map(|_| {
            let begin = Instant::now();
            q.iter().for_each(|q| drop(black_box(f(q))));
            1e9 * begin.elapsed().as_secs_f64() / q.len() as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
