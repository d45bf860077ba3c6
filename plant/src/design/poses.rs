//! Postures.

use nalgebra::Vector3;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

use super::super::reality::Reality;
use super::super::transform::origin;
use super::{Design, Shape, rounded};
use crate::rng::{Rng, Stream};

/// Where a joint that has no limits may go: 150° to either side, or half a metre out.
pub(super) fn range(joint: &Joint) -> [f64; 2] {
    let free = match joint.motion {
        Motion::Revolute => [-150_f64.to_radians(), 150_f64.to_radians()],
        Motion::Prismatic => [0.0, 0.5],
    };
    joint.limits.unwrap_or(free)
}

/// Part of each range that a narrow design keeps to.
const NARROW: f64 = 0.1;

/// Joint readings, one posture each.
pub(super) fn draw(arm: &Arm, design: &Design) -> Vec<Vec<f64>> {
    // The part of the range is the arm's and not the seed's: another session stays within it.
    let mut part = Rng::new(0, Stream::Poses);
    let mut rng = Rng::new(design.seed, Stream::Poses);
    let ranges: Vec<[f64; 2]> = arm
        .joints
        .iter()
        .map(|joint| {
            let [low, high] = range(joint);
            match design.shape {
                Shape::Narrow => {
                    let width = NARROW * (high - low);
                    let from = part.between(low, high - width);
                    [from, from + width]
                }
                _ => [low, high],
            }
        })
        .collect();
    let mut posture =
        || ranges.iter().map(|[low, high]| rounded(rng.between(*low, *high), 1e6)).collect();
    (0..design.poses).map(|_| posture()).collect()
}

/// The middle of where the rigid arm's tool is at these postures, base frame, m.
pub(super) fn middle(arm: &Arm, poses: &[Vec<f64>]) -> [f64; 3] {
    let nominal = Reality::nominal(arm);
    let places = poses.iter().map(|q| origin(&nominal.tool_at(q)));
    let mean = places.sum::<Vector3<f64>>() / poses.len() as f64;
    [mean.x, mean.y, mean.z].map(|x| rounded(x, 1e6))
}
