//! A joint whose zero is another than the robot file's: what a simple model of the arm shows.

use std::f64::consts::{PI, TAU};

use stiffarm_kernels::Motion;

use super::Misread;
use super::retold::{Asked, turn};
use crate::constants::{FAIR_TORQUE, LEAST_ZERO, MISTAKE_LEAVES};
use crate::infer::limits::SOME_SAMPLES;
use crate::log::search::case::Case;

/// Angles that are tried: least squares of sines and cosines fall from half a step, 15°, without another minimum.
const ANGLES: usize = 12;

/// Golden sections: of a step of 30° on either side these leave 0.03°, which moves a torque by less than any noise.
const SECTIONS: usize = 16;

/// Fine samples that are enough to find an angle among others.
const FEW: usize = 5_000;

/// The ratio of a golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Asked {
    /// The joint whose zero is off and by how much, if without that less than a part is left of the torques of which
    /// something `is` left, told in their `spread`.
    pub(super) fn zero(&self, case: &Case<'_>, is: &[f64], spread: &[f64]) -> Option<Misread> {
        let bad = self.joints.iter().filter(|j| is[**j] >= FAIR_TORQUE * spread[**j]);
        let bad: Vec<usize> = bad.copied().collect();
        if bad.is_empty() {
            return None;
        }
        // One copy for all angles: a log of a million samples is large.
        let mut signals = case.signals.clone();
        let mut left_of = |joint: usize, by: f64, enough: usize| {
            turn(&mut signals, &Misread::Zero { joint, by });
            let left = self.without(&Case { signals: &signals, ..*case }, enough);
            signals.q[joint].clone_from(&case.signals.q[joint]);
            left
        };
        let turns = |joint: &&usize| case.arm.joints[**joint].motion == Motion::Revolute;
        let angles = || (1..ANGLES).map(|k| TAU * k as f64 / ANGLES as f64);
        let tried = self.joints.iter().filter(turns).flat_map(|j| angles().map(|by| (*j, by)));
        let sums = tried.map(|(j, by)| (self.sum(&left_of(j, by, FEW)), j, by));
        let (_, joint, from) = sums.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut sum = |by: f64| self.sum(&left_of(joint, by, FEW));
        let step = TAU / ANGLES as f64;
        let (mut low, mut high) = (from - step, from + step);
        let inner =
            |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let mut at = inner(low, high);
        let mut sums = at.map(&mut sum);
        for _ in 0..SECTIONS {
            if sums[0] < sums[1] {
                high = at[1];
                at = inner(low, high);
                sums = [sum(at[0]), sums[0]];
            } else {
                low = at[0];
                at = inner(low, high);
                sums = [sums[1], sum(at[1])];
            }
        }
        let by = 0.5 * (low + high);
        let by = by - TAU * ((by - PI) / TAU).ceil();
        let after = left_of(joint, by, SOME_SAMPLES);
        let part = bad.iter().map(|j| (after[*j] / is[*j]).ln()).sum::<f64>() / bad.len() as f64;
        let is_less =
            self.sum(&after) < self.sum(is) && part < MISTAKE_LEAVES.ln() && by.abs() >= LEAST_ZERO;
        is_less.then_some(Misread::Zero { joint, by })
    }
}
