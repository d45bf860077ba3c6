//! All branches of inverse kinematics by ik-geo (Elias & Wen 2024) and rs-opw-kinematics (Brandstötter, Angerer & Hofbaur
//! 2014) beside stiffarm's: each one's solutions by forward kinematics, then timed by turns. What the peers in Python take is
//! written into the directory, for `inverse_peers.py`.
//!
//! Found is a solution that misses its pose by less than 1e-6 m and rad; those that exist are what stiffarm finds.

mod arms;
mod screws;

use std::fmt::Write as _;

use stiffarm::kernels::Pose;

use super::{ROUNDS, processor_time, spread};
use arms::{built, nominal};

pub const POSES: usize = 2048;

/// What a solution may miss its pose by, m and rad.
const FOUND: f64 = 1e-6;

/// By how much joint values miss a pose, by its number.
type Miss<'a> = Box<dyn Fn(usize, &[f64]) -> f64 + 'a>;

/// One way to the solutions at poses that it knows by their numbers.
pub struct Way<'a> {
    pub name: &'static str,
    /// All that it tells as solutions.
    pub solve: Box<dyn Fn(usize) -> Vec<Vec<f64>> + 'a>,
    /// The same for the clock.
    pub run: Box<dyn Fn(usize) + 'a>,
    /// What joint values miss a pose by, m and rad.
    pub miss: Miss<'a>,
    /// How many poses are timed: some take long.
    pub poses: usize,
}

/// The largest difference of two poses.
pub fn apart(a: &Pose<f64>, b: &Pose<f64>) -> f64 {
    let (a, b) = (a.columns(), b.columns());
    let each = a.as_flattened().iter().zip(b.as_flattened());
    each.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Random postures, or with joints 3 and 5 (of six; 4 and 6 of seven) within 1e-9 to 1e-4 rad of a stretched elbow or an
/// aligned wrist, one of them or both.
pub fn postures<const N: usize>(singular: bool, elbow: f64) -> Vec<[f64; N]> {
    let mut state = 1_u64;
    let mut unit = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * ((state >> 11) as f64 / (1_u64 << 53) as f64) - 1.0
    };
    let posture = |k: usize| {
        let mut q: [f64; N] = core::array::from_fn(|_| 3.0 * unit());
        if singular {
            let by = 10_f64.powi(-9 + (k / 3 % 6) as i32);
            if !k.is_multiple_of(3) {
                q[N - 2] = by * unit();
            }
            if k % 3 != 1 {
                q[N - 4] = elbow + by * unit();
            }
        }
        q
    };
    (0..POSES).map(posture).collect()
}

/// Prints what each way finds and takes, the first one's time as the measure.
pub fn compete(title: &str, ways: &[Way<'_>]) {
    let mut line = format!("{title}:");
    let mut times = vec![Vec::new(); ways.len()];
    for round in 0..=ROUNDS {
        for (way, times) in ways.iter().zip(&mut times) {
            // What takes milliseconds is timed in three rounds.
            if way.poses < POSES && round > 3 {
                continue;
            }
            let start = processor_time();
            (0..way.poses).for_each(&way.run);
            // The first round warms up.
            if round > 0 {
                times.push((processor_time() - start) / way.poses as f64);
            }
        }
    }
    for (way, own) in ways.iter().zip(&times) {
        let (mut found, mut worst, mut poses, mut nearest) = (0, 0.0_f64, 0, Vec::new());
        for k in 0..way.poses {
            let misses: Vec<f64> = (way.solve)(k).iter().map(|q| (way.miss)(k, q)).collect();
            let met = misses.iter().filter(|miss| **miss < FOUND);
            found += met.clone().count();
            worst = met.fold(worst, |worst, miss| worst.max(*miss));
            poses += usize::from(misses.iter().any(|miss| *miss < FOUND));
            nearest.push(misses.iter().copied().fold(f64::INFINITY, f64::min));
        }
        let count = way.poses as f64;
        let by = times[0].iter().zip(own).map(|(first, own)| own / first);
        let (least, middle, most) = spread(&by.collect::<Vec<f64>>());
        let _ = write!(
            line,
            "\n  {} {:.0} ns ({least:.2} {middle:.2} {most:.2}), {:.3} branches, worst {worst:.1e}, \
             {:.2} % of poses",
            way.name,
            spread(own).1,
            found as f64 / count,
            100.0 * poses as f64 / count,
        );
        if found == 0 {
            let _ = write!(line, ", the nearest misses by {:.1e}", spread(&nearest).1);
        }
    }
    println!("{line}");
}

/// Of every arm, at random poses and near singular ones.
pub fn all(directory: Option<&str>) {
    for singular in [false, true] {
        nominal(singular, directory);
    }
    built(directory);
}
