//! How fast a log's motion is beside its rate and its band.

use core::ops::RangeInclusive;

use crate::infer::ascending;
use crate::signal::Signals;

/// Periods per turn of a ripple that are looked at: what turns once is the weights' and a counterbalance's.
pub const ORDERS: RangeInclusive<usize> = 2..=400;

/// A ripple is looked at where it stays below this part of the band's edge: the filter lets it pass.
pub const PASSES: f64 = 0.7;

/// Of the speeds of a joint, the part that is slower: a ripple is seen there last.
const SLOW: f64 = 0.1;

/// A log's motion, and how often it was recorded.
#[derive(Clone, Copy, Debug)]
pub struct Pace<'a> {
    /// The log at even steps.
    pub signals: &'a Signals,
    /// Of each joint the speed below which it rests, rad/s or m/s.
    pub still: &'a [f64],
    /// The recorder's step, s.
    pub period: f64,
}

impl Pace<'_> {
    /// The speed that a tenth of the samples that move are slower than, rad/s or m/s.
    pub fn slow(&self, joint: usize) -> f64 {
        let still = self.still[joint];
        let moves = self.signals.qd[joint].iter().map(|v| v.abs()).filter(|v| *v > still);
        let speeds = ascending(moves);
        speeds.get((SLOW * speeds.len() as f64) as usize).copied().unwrap_or(still)
    }

    /// A joint's acceleration, root mean square, rad/s² or m/s².
    pub fn acceleration(&self, joint: usize) -> f64 {
        let all = &self.signals.qdd[joint];
        (all.iter().map(|a| a * a).sum::<f64>() / all.len() as f64).sqrt()
    }
}

/// Two digits of a number.
pub fn round(x: f64) -> f64 {
    let size = 10f64.powf(1.0 - x.abs().log10().floor());
    (x * size).round() / size
}
