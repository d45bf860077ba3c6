//! Random postures and wrenches under which the arm stays clearly stable.

use std::vec::Vec;

use crate::Motion;
use crate::generic::{Arm, Joint};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use super::scale::reach;

/// A posture and a load; every number is one of single precision too, so that both
/// precisions are asked the same question.
pub struct Sample {
    /// Joint values, rad (m if prismatic); behind them as many numbers within ±2 and as many within ±5: rates,
    /// and accelerations or torques.
    pub state: Vec<f64>,
    /// Wrench, N and N·m.
    pub w: [f64; 6],
}

/// ‖K_C‖ is at most this part of the softest joint's stiffness.
const LOADED: f64 = 0.1;

/// Force on an arm whose joints are rigid, N.
const FORCE: f64 = 100.0;

/// So many of them; a seed always gives the same.
pub fn samples(arm: &Arm, count: usize, seed: u64) -> Vec<Sample> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    // What moves is drawn apart: postures and loads are the same with it and without.
    let mut moving = ChaCha8Rng::seed_from_u64(!seed);
    let unit_of = |from: &mut ChaCha8Rng| (from.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut unit = || unit_of(&mut generator);
    let ranges: Vec<[f64; 2]> = arm.joints.iter().map(range).collect();
    let single = |x: f64| f64::from(x as f32);
    let sample = |_| {
        let mut q: Vec<f64> = ranges.iter().map(|[a, b]| single(a + (b - a) * unit())).collect();
        let lever = reach(arm, &q).max(1e-3);
        let force = force(arm, lever);
        let w = std::array::from_fn(|k| {
            single((2.0 * unit() - 1.0) * if k < 3 { force } else { force * lever })
        });
        for most in [2.0, 5.0] {
            q.extend(ranges.iter().map(|_| single(most * (2.0 * unit_of(&mut moving) - 1.0))));
        }
        Sample { state: q, w }
    };
    (0..count).map(sample).collect()
}

/// Within the joint's limits, and within ±π (beyond, postures come again) or ±1 m if it has none.
fn range(joint: &Joint) -> [f64; 2] {
    let turn = core::f64::consts::PI;
    match (joint.motion, joint.limits) {
        (Motion::Revolute, None) => [-turn, turn],
        (Motion::Prismatic, None) => [-1.0, 1.0],
        (Motion::Revolute, Some([low, high])) if low < turn && high > -turn => {
            [low.max(-turn), high.min(turn)]
        }
        (_, Some(limits)) => limits,
    }
}

/// The largest force at which K_C stays small: an entry of it is at most force times lever, or a
/// moment, and a row has as many as the arm has joints.
fn force(arm: &Arm, lever: f64) -> f64 {
    let stiffness = arm.joints.iter().filter(|j| j.compliance > 0.0).map(|j| match j.motion {
        Motion::Revolute => 1.0 / j.compliance,
        Motion::Prismatic => lever * lever / j.compliance,
    });
    let softest = stiffness.fold(f64::INFINITY, f64::min);
    // Three components of force and three of moment, each up to the largest.
    (LOADED * softest / (6.0 * lever * arm.dof() as f64)).min(FORCE)
}
