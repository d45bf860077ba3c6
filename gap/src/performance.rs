//! Pose accuracy and repeatability of an arm after ISO 9283:1998, from poses that were visited more
//! than once.
//!
//! A visit is a run of rows at one pose with no other between them: what is read twice without a move
//! shows the instrument. Visits compare where pose, load, marker and direction of approach are the
//! same. With `x̄` the mean of the attained positions (the barycentre) and `l_j` the distance of
//! the j-th from it,
//!
//! - pose accuracy `AP = |x̄ − x_c|`, `x_c` what was commanded: here what a model says (7.2.1);
//! - pose repeatability `RP = l̄ + 3 S_l`, `S_l` the standard deviation of the `l_j` (7.2.2).
//!
//! The standard asks for five poses in a plane of a cube, thirty visits each, at the rated load and
//! speed; [`Performance::is_standard`] says whether the numbers of poses and visits are reached, and
//! nobody but the user knows the rest.

use std::collections::BTreeMap;

use nalgebra::{Vector3, Vector6};

use crate::measurement::{Measurements, Row};

/// Poses that the standard asks for.
pub const POSES: usize = 5;

/// Visits of each that the standard asks for.
pub const VISITS: usize = 30;

/// Mean and largest over poses, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Over {
    /// Over poses.
    pub mean: f64,
    /// Of the worst pose.
    pub most: f64,
}

/// What the visits show.
#[derive(Clone, Debug, PartialEq)]
pub struct Performance {
    /// Poses (with one load, marker and direction) that were visited more than once.
    pub poses: usize,
    /// Fewest and most visits of one of them.
    pub visits: [usize; 2],
    /// AP against the model before, and with what was found.
    pub accuracy: [Over; 2],
    /// RP.
    pub repeatability: Over,
}

/// The visits of one pose.
#[derive(Default)]
struct Visited {
    /// Number of the last visit, from 1, and its rows.
    last: usize,
    rows: f64,
    /// Of each visit the mean of the measured position, and of the gaps before and after, m.
    means: Vec<[Vector3<f64>; 3]>,
}

impl Performance {
    /// Of measured positions and their gaps to a model before and after; `None` where no pose was
    /// visited twice, or no positions are measured.
    pub fn of(data: &Measurements, gaps: [&[Vector6<f64>]; 2]) -> Option<Performance> {
        if !data.kind.is_pose() {
            return None;
        }
        let mut poses: BTreeMap<_, Visited> = BTreeMap::new();
        let (mut visit, mut before) = (0, None);
        for (k, row) in data.rows.iter().enumerate() {
            visit += usize::from(before.replace(row.group) != Some(row.group));
            let load: Vec<u64> = row.wrench.iter().map(|f| (f + 0.0).to_bits()).collect();
            let key = (row.group, load, row.marker.as_deref(), row.direction.as_deref());
            let [before, after] = gaps.map(|gaps| position(&gaps[k]));
            poses.entry(key).or_default().add(visit, [attained(row), before, after]);
        }
        let poses: Vec<Visited> = poses.into_values().filter(|v| v.means.len() > 1).collect();
        if poses.is_empty() {
            return None;
        }
        let counts = || poses.iter().map(|visited| visited.means.len());
        let over = |of: &dyn Fn(&Visited) -> f64| {
            let each: Vec<f64> = poses.iter().map(of).collect();
            Over {
                mean: each.iter().sum::<f64>() / each.len() as f64,
                most: each.iter().copied().fold(0.0, f64::max),
            }
        };
        Some(Performance {
            poses: poses.len(),
            visits: [counts().min().unwrap_or(0), counts().max().unwrap_or(0)],
            accuracy: [1, 2].map(|which| over(&|visited| visited.mean(which).norm())),
            repeatability: over(&Visited::repeatability),
        })
    }

    /// Whether there are as many poses and visits as the standard asks for.
    pub fn is_standard(&self) -> bool {
        self.poses >= POSES && self.visits[0] >= VISITS
    }
}

impl Visited {
    /// Rows of one visit follow each other.
    fn add(&mut self, visit: usize, row: [Vector3<f64>; 3]) {
        if visit != self.last {
            (self.last, self.rows) = (visit, 0.0);
            self.means.push([Vector3::zeros(); 3]);
        }
        self.rows += 1.0;
        for (mean, value) in self.means.iter_mut().rev().take(1).flatten().zip(row) {
            *mean += (value - *mean) / self.rows;
        }
    }

    fn mean(&self, which: usize) -> Vector3<f64> {
        self.means.iter().map(|mean| mean[which]).sum::<Vector3<f64>>() / self.means.len() as f64
    }

    fn repeatability(&self) -> f64 {
        let centre = self.mean(0);
        let far: Vec<f64> = self.means.iter().map(|mean| (mean[0] - centre).norm()).collect();
        let count = far.len() as f64;
        let mean = far.iter().sum::<f64>() / count;
        let squares: f64 = far.iter().map(|l| (l - mean).powi(2)).sum();
        mean + 3.0 * (squares / (count - 1.0)).sqrt()
    }
}

fn attained(row: &Row) -> Vector3<f64> {
    position(&row.measured)
}

fn position(of: &Vector6<f64>) -> Vector3<f64> {
    of.fixed_rows::<3>(0).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{row, table};
    use crate::measurement::Kind;

    /// Pose 0 is visited thrice, one visit read twice; pose 1 once, read thrice.
    #[test]
    fn figures_by_hand() {
        let at = |group: usize, x: f64, y: f64| {
            let measured = Vector6::new(1.0 + x, y, 0.0, 0.0, 0.0, 0.0);
            Row { group, measured, ..row(&[group as f64], Vector6::zeros()) }
        };
        let rows = vec![
            at(0, 2e-3, 0.0),
            at(0, 4e-3, 0.0),
            at(1, 7e-3, 0.0),
            at(1, 8e-3, 0.0),
            at(0, 0.0, 0.0),
            at(1, 9e-3, 0.0),
            at(0, 0.0, 3e-3),
        ];
        let mut data = table(rows, Kind::Pose { orientation: false });
        data.poses = 2;
        // Commanded to (1, 0, 0); the model with the findings is 1 mm farther along x.
        let gap = |x: f64| -> Vec<Vector6<f64>> {
            let to = Vector6::new(1.0 + x, 0.0, 0.0, 0.0, 0.0, 0.0);
            data.rows.iter().map(|row| row.measured - to).collect()
        };
        let found = Performance::of(&data, [&gap(0.0), &gap(1e-3)]).unwrap();
        assert_eq!((found.poses, found.visits), (2, [2, 3]));
        // Visits of pose 0 at (3, 0), (0, 0), (0, 3) mm: barycentre (1, 1), distances √5, √2, √5.
        // Of pose 1 at 7.5 and 9 mm: barycentre 8.25, both 0.75 from it.
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
        close(found.accuracy[0].most, 8.25e-3);
        close(found.accuracy[0].mean, 0.5 * (8.25 + 2f64.sqrt()) * 1e-3);
        close(found.accuracy[1].mean, 0.5 * (7.25 + 1.0) * 1e-3);
        let mean = (2.0 * 5f64.sqrt() + 2f64.sqrt()) / 3.0;
        let squares = 2.0 * (5f64.sqrt() - mean).powi(2) + (2f64.sqrt() - mean).powi(2);
        close(found.repeatability.most, 1e-3 * (mean + 3.0 * (squares / 2.0).sqrt()));
        assert!(!found.is_standard());
        let seen_once = table(data.rows[..4].to_vec(), data.kind);
        assert_eq!(Performance::of(&seen_once, [&gap(0.0)[..4], &gap(0.0)[..4]]), None);
    }
}
