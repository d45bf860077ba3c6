//! Ripples that stand out of what a simple model leaves.
//!
//! Of hundreds of orders some always look large: one stands out if, under the signs of whole blocks, the
//! largest of all orders is seldom as large, and the more seldom the more joints are asked (Bonferroni). What stood out
//! by accident would be asked as if nobody had sought it.

use core::f64::consts::PI;

use nalgebra::DMatrix;
use stiffarm_kernels::Motion;

use super::dictionary::Dictionary;
use crate::constants::ACCIDENT;
use crate::infer::{Signs, unit};
use crate::log::pace::{ORDERS, PASSES};
use crate::parallel;

/// Ripples of a joint that are asked for.
const MOST: usize = 2;

/// Of each joint the orders that stand out of what is left at the rows of the sample.
pub fn found(dict: &Dictionary<'_>, left: &[Vec<Option<f64>>], seed: u64) -> Vec<Vec<f64>> {
    parallel::map(left.len(), &|joint| {
        let turns = dict.case.arm.joints[joint].motion == Motion::Revolute;
        if turns { of_joint(dict, joint, &left[joint], seed) } else { Vec::new() }
    })
}

fn of_joint(dict: &Dictionary<'_>, joint: usize, left: &[Option<f64>], seed: u64) -> Vec<f64> {
    let signals = dict.case.signals;
    let (q, speeds) = (signals.kept(&signals.q[joint]), signals.kept(&signals.qd[joint]));
    let blocks = dict.blocks(dict.correlation(left));
    let count = blocks.all.len();
    // Cosine and sine of each order, of each block.
    let mut sums = vec![DMatrix::<f64>::zeros(2, count); ORDERS.count()];
    for (row, left) in dict.rows.iter().zip(left) {
        let Some(left) = left else { continue };
        let Some(block) = dict.block_of(&blocks, *row) else { continue };
        let fastest = 2.0 * PI * PASSES * signals.band / speeds[*row].abs();
        let (sin, cos) = q[*row].sin_cos();
        let (mut re, mut im) = (cos, sin);
        for (sums, order) in sums.iter_mut().zip(ORDERS) {
            (re, im) = (re * cos - im * sin, re * sin + im * cos);
            if order as f64 > fastest {
                break;
            }
            sums[(0, block)] += left * re;
            sums[(1, block)] += left * im;
        }
    }
    let shares: Vec<DMatrix<f64>> = sums.iter().map(unit).collect();
    let signs = Signs::new(count, seed);
    let highest = signs.largest(&shares.iter().collect::<Vec<_>>());
    let strength = |sums: &DMatrix<f64>| sums.column_sum().norm_squared();
    let most = ACCIDENT / signals.joints() as f64;
    let stands_out = |k: &usize| signs.p_value(&highest, strength(&shares[*k])) <= most;
    // Of those that stand out the strongest.
    let mut out: Vec<usize> = (0..shares.len()).filter(stands_out).collect();
    out.sort_by(|a, b| strength(&sums[*b]).total_cmp(&strength(&sums[*a])));
    out.into_iter().take(MOST).map(|k| (ORDERS.start() + k) as f64).collect()
}
