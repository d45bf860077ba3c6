//! Ripples that stand out of what a simple model leaves.
//!
//! Of hundreds of orders some always look large: one stands out if, under the signs of whole blocks, the
//! largest of all orders is seldom as large, and the more seldom the more joints are asked (Bonferroni). What stood out
//! by accident would be asked as if nobody had sought it.

use core::f64::consts::PI;

use nalgebra::DMatrix;
use rayon::prelude::*;
use stiffarm_kernels::Motion;

use super::CHANCE;
use super::blocks::Blocks;
use super::stock::Stock;
use crate::dice::{Dice, Stream};
use crate::log::pace::{ORDERS, PASSES};

/// Ripples of a joint that are asked for.
const MOST: usize = 2;

/// Random signs.
const FLIPS: usize = 199;

/// Of each joint the orders that stand out of what is left at the rows of the sample.
pub fn found(stock: &Stock<'_>, left: &[Vec<Option<f64>>], seed: u64) -> Vec<Vec<f64>> {
    let joint = |(joint, left): (usize, &Vec<Option<f64>>)| {
        let turns = stock.case.arm.joints[joint].motion == Motion::Revolute;
        if turns { of_joint(stock, joint, left, seed) } else { Vec::new() }
    };
    left.par_iter().enumerate().map(joint).collect()
}

fn of_joint(stock: &Stock<'_>, joint: usize, left: &[Option<f64>], seed: u64) -> Vec<f64> {
    let signals = stock.case.signals;
    let (q, speeds) = (signals.kept(&signals.q[joint]), signals.kept(&signals.qd[joint]));
    let blocks = Blocks::of(&stock.grains, signals, stock.correlation(left));
    let count = blocks.all.len();
    // Cosine and sine of each order, of each block.
    let mut sums = [(); 2].map(|()| DMatrix::<f64>::zeros(ORDERS.count(), count));
    for (row, left) in stock.rows.iter().zip(left) {
        let Some(left) = left else { continue };
        let Some(block) = stock.block_of(&blocks, *row) else { continue };
        let fastest = 2.0 * PI * PASSES * signals.band / speeds[*row].abs();
        let (sin, cos) = q[*row].sin_cos();
        let (mut re, mut im) = (cos, sin);
        for (k, order) in ORDERS.enumerate() {
            (re, im) = (re * cos - im * sin, re * sin + im * cos);
            if order as f64 > fastest {
                break;
            }
            sums[0][(k, block)] += left * re;
            sums[1][(k, block)] += left * im;
        }
    }
    let squares = sums.iter().map(|s| s.map(|x| x * x).column_sum()).reduce(|a, b| a + b);
    let Some(squares) = squares.filter(|s| s.max() > 0.0) else { return Vec::new() };
    let pulls = |signs: &DMatrix<f64>| {
        let of = |sums: &DMatrix<f64>| (sums * signs).map(|x| x * x);
        let mut pulls = of(&sums[0]) + of(&sums[1]);
        for (mut row, square) in pulls.row_iter_mut().zip(squares.iter()) {
            row /= if *square > 0.0 { *square } else { 1.0 };
        }
        pulls
    };
    let mut dice = Dice::new(seed, Stream::Visits);
    let signs = DMatrix::from_fn(count, FLIPS, |_, _| dice.sign());
    let mut largest: Vec<f64> = pulls(&signs).column_iter().map(|c| c.max()).collect();
    largest.sort_by(f64::total_cmp);
    let chance = CHANCE / signals.joints() as f64;
    let limit = largest[((1.0 - chance) * FLIPS as f64) as usize];
    let sizes = pulls(&DMatrix::repeat(count, 1, 1.0));
    // Of those that stand out the strongest.
    let strength = |k: usize| sums.iter().map(|s| s.row(k).sum().powi(2)).sum::<f64>();
    let mut out: Vec<usize> = (0..sizes.nrows()).filter(|k| sizes[(*k, 0)] > limit).collect();
    out.sort_by(|a, b| strength(*b).total_cmp(&strength(*a)));
    out.into_iter().take(MOST).map(|k| (ORDERS.start() + k) as f64).collect()
}
