//! The joint values at which the tool misses a pose by least, where none reach it.

use super::SixAxes;
use super::moved::{V3, cross, dot};
use crate::Pose;
use crate::inverse::missed;
use crate::inverse::steps::{error, solved};

/// Newton's steps from each start at most; nearly all starts take fewer than twenty.
const NEWTON: usize = 40;

/// A step of less than this leaves the square of it, which is rounding, rad.
const LAST: f64 = 1e-8;

impl SixAxes {
    /// Half of distance² + tilt², m and rad.
    fn off(&self, pose: &Pose<f64>) -> f64 {
        let [distance, tilt] = missed(pose, &self.target);
        let distance = self.size * distance;
        0.5 * (distance * distance + tilt * tilt)
    }

    /// Its second derivatives, lower triangle, and what it falls by with each joint.
    fn slopes(&self, pose: &Pose<f64>, jacobian: &[[f64; 6]; 6]) -> ([[f64; 6]; 6], [f64; 6]) {
        let weight = self.size * self.size;
        let error = error(pose, &self.target);
        let parts = |six: &[f64; 6]| [[six[0], six[1], six[2]], [six[3], six[4], six[5]]];
        let [to, turn] = parts(&error);
        let axes = || pose.rotation.iter().zip(&self.target.rotation);
        let aligned: f64 = axes().map(|(own, other)| 0.5 * dot(*own, *other)).sum();
        let along = |first: V3, last: V3| -> f64 {
            axes().map(|(own, other)| 0.5 * dot(first, *own) * dot(last, *other)).sum()
        };
        let mut second = [[0.0; 6]; 6];
        for (row, last) in jacobian.iter().map(parts).enumerate() {
            for (column, first) in jacobian.iter().map(parts).take(row + 1).enumerate() {
                let moved = dot(first[0], last[0]) - dot(to, cross(first[1], last[0]));
                let turned = dot(first[1], last[1]) * aligned - along(first[1], last[1]);
                second[row][column] = weight * moved + turned;
            }
        }
        (second, jacobian.each_ref().map(parts).map(|[p, z]| weight * dot(p, to) + dot(z, turn)))
    }

    /// From joint values to those nearest by, where distance² + tilt², m and rad, is least, by Newton's method; half of that.
    /// It is damped as much as it takes for each step to lead nearer (Levenberg 1944).
    pub(super) fn nearest(&self, mut q: [f64; 6]) -> (f64, [f64; 6]) {
        let (mut pose, mut jacobian) = self.at(&q);
        let mut off = self.off(&pose);
        let mut damping = 1e-2;
        for _ in 0..NEWTON {
            let (second, first) = self.slopes(&pose, &jacobian);
            let scale: f64 = (0..6).map(|k| second[k][k].abs()).sum();
            let Ok(by) = solved(second, damping * scale, first) else {
                damping *= 8.0;
                continue;
            };
            let most = by.iter().fold(0.0_f64, |most, by| most.max(by.abs()));
            let next = core::array::from_fn(|k| q[k] + by[k] / most.max(1.0));
            let (there, moves) = self.at(&next);
            let then = self.off(&there);
            if then < off {
                (q, pose, jacobian, off) = (next, there, moves, then);
                damping *= 0.05;
            } else {
                damping *= 8.0;
            }
            if most < LAST {
                break;
            }
        }
        (off, q)
    }
}
