//! An arm as ik-geo and EAIK take it: directions of its axes and offsets between points on them, at joint values of zero.

use std::fmt::Write as _;

use stiffarm::kernels::{Pose, has};

type Vector = [f64; 3];

/// Directions, offsets from base to tool, and the tool's axes.
#[derive(Clone)]
pub struct Screws<const N: usize> {
    pub directions: [Vector; N],
    pub offsets: Vec<Vector>,
    pub home: [Vector; 3],
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn plus(a: Vector, by: f64, b: Vector) -> Vector {
    core::array::from_fn(|k| a[k] + by * b[k])
}

/// From the axes of an arm; those of each group meet in a point.
pub fn screws<const N: usize, A>(arm: &A, groups: &[&[usize]]) -> Screws<N>
where
    A: has::Pose<N> + has::Jacobian<N>,
{
    let posture = arm.posture(&[0.0; N]);
    let (Pose { rotation, position }, jacobian) = (arm.pose(&posture), arm.jacobian(&posture));
    let directions = jacobian.map(|[.., x, y, z]| [x, y, z]);
    // The Jacobian's first half is z × (p − o): the point beside the tool is p + z × that.
    let mut points: [Vector; N] = core::array::from_fn(|k| {
        let ([a, b, c], [x, y, z, ..]) = (directions[k], jacobian[k]);
        plus(position, 1.0, [b * z - c * y, c * x - a * z, a * y - b * x])
    });
    for group in groups {
        let [i, j, ..] = **group else { continue };
        let (z, w) = (directions[i], directions[j]);
        let across = plus(z, -dot(z, w), w);
        let along = dot(plus(points[j], -1.0, points[i]), across) / dot(across, across);
        let meet = plus(points[i], along, z);
        group.iter().for_each(|k| points[*k] = meet);
    }
    let mut offsets = vec![points[0]];
    offsets.extend(points.windows(2).map(|pair| plus(pair[1], -1.0, pair[0])));
    offsets.push(plus(position, -1.0, points[N - 1]));
    Screws { directions, offsets, home: rotation }
}

impl<const N: usize> Screws<N> {
    /// Rotation without the tool's own at zero, its columns.
    pub fn turned(&self, pose: &Pose<f64>) -> [Vector; 3] {
        // R H⁻¹: column c is the sum over the tool's axes of R's axis times its component c.
        core::array::from_fn(|c| {
            (0..3).fold([0.0; 3], |sum, k| plus(sum, self.home[k][c], pose.rotation[k]))
        })
    }

    /// What `inverse_peers.py` reads: directions, offsets, the tool's axes, and a line for each pose.
    pub fn written(&self, poses: &[Pose<f64>]) -> String {
        let mut text = String::new();
        let mut line = |numbers: &[f64]| {
            let words: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
            let _ = writeln!(text, "{}", words.join(" "));
        };
        line(self.directions.as_flattened());
        line(self.offsets.as_flattened());
        line(self.home.as_flattened());
        for pose in poses {
            let columns = self.turned(pose);
            line(&[columns.as_flattened(), &pose.position].concat());
        }
        text
    }
}
