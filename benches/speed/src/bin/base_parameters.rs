//! For `benches/peers/run.sh`: the fit of base parameters alone, by the regressor's kernel, of the states and torques
//! that `dynamics` wrote. Prints milliseconds of one fit, the median of some; how many numbers were found; and what
//! they leave of the torques, as a part of their size.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use nalgebra::{DMatrix, DVector};
use stiffarm_bench::arms::{self, textbook};

const ROUNDS: usize = 21;

/// States whose columns are multiplied at once.
const CHUNK: usize = 256;

type Failure = Box<dyn std::error::Error>;

/// One arm: its states and torques are read, its kernel called.
macro_rules! fit {
    ($arm:ident, $n:literal, $directory:expr) => {{
        let id = stringify!($arm);
        let states = read($directory, id, "states")?;
        let torques = read($directory, id, "inverse_dynamics")?;
        let (states, _) = states.as_chunks::<{ 3 * $n }>();
        let base: Vec<usize> = textbook(id).base_parameters().iter().map(|b| b.moment).collect();
        let regressor = |state: &[f64; 3 * $n]| {
            let ([q, qd, qdd], _) = state.as_chunks::<$n>() else {
                unreachable!("three of each joint")
            };
            arms::$arm::plain::torque_regressor(q, qd, qdd)
        };
        // The base's columns of some states, one below the other.
        let columns = |states: &[[f64; 3 * $n]]| {
            let mut columns = DMatrix::zeros($n * states.len(), base.len());
            for (k, state) in states.iter().enumerate() {
                let all = regressor(state);
                for (c, moment) in base.iter().enumerate() {
                    let mut here = columns.view_mut(($n * k, c), ($n, 1));
                    here.copy_from_slice(&all[*moment]);
                }
            }
            columns
        };
        let fit = || -> Option<DVector<f64>> {
            let mut products = DMatrix::zeros(base.len(), base.len());
            let mut right = DVector::zeros(base.len());
            for (states, torques) in states.chunks(CHUNK).zip(torques.chunks($n * CHUNK)) {
                let columns = columns(states);
                products.gemm_tr(1.0, &columns, &columns, 1.0);
                right.gemv_tr(1.0, &columns, &DVector::from_column_slice(torques), 1.0);
            }
            Some(products.cholesky()?.solve(&right))
        };
        let mut times = Vec::new();
        for _ in 0..ROUNDS {
            let start = Instant::now();
            black_box(fit());
            times.push(1e3 * start.elapsed().as_secs_f64());
        }
        times.sort_by(f64::total_cmp);
        let values = fit().ok_or("the base's columns stand apart")?;
        let torques = DVector::from_column_slice(&torques);
        let left = (columns(states) * values - &torques).norm() / torques.norm();
        let (time, count) = (times[ROUNDS / 2], base.len());
        println!("{id} base parameters stiffarm: {time:.2} ms, {count} numbers, {left:.1e} left");
    }};
}

fn main() -> Result<(), Failure> {
    let directory = std::env::args().nth(1).ok_or("usage: base_parameters DIRECTORY")?;
    let directory = Path::new(&directory);
    fit!(ur10, 6, directory);
    fit!(panda, 7, directory);
    Ok(())
}

/// Little-endian doubles.
fn read(directory: &Path, id: &str, name: &str) -> Result<Vec<f64>, Failure> {
    let bytes = std::fs::read(directory.join(format!("{id}.{name}")))?;
    Ok(bytes.as_chunks::<8>().0.iter().map(|x| f64::from_le_bytes(*x)).collect())
}
