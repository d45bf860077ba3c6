//! A lens by least squares of all that its pictures show, each taken from a place of its own: a start from which the fit of
//! arm and lens together goes on, whatever the distortion.

use nalgebra::{
    DMatrix, DVector, Isometry3, Matrix2xX, Matrix6, Matrix6xX, Point3, Vector2, Vector3, Vector6,
};

use super::Picture;
use crate::instrument::Lens;
use crate::instrument::lens::CONSTANTS;
use crate::instrument::resection::{by_pose, moved, pose};

/// Steps of the least squares at most, the gain of the last one, and the damping of the first (Marquardt 1963).
const STEPS: usize = 100;
const LAST: f64 = 1e-12;
const DAMPING: f64 = 1e-3;

/// The lens with its free constants where all pictures fit best, each taken from wherever it fits best; held as loosely to
/// what was told of it as in any fit.
pub(crate) fn refined(lens: Lens, free: &[usize], pictures: &[Picture]) -> Lens {
    let views = pictures.iter().filter_map(|picture| {
        let seen: Picture = picture.iter().map(|(p, at)| (*p, at / lens.focus)).collect();
        let directions: Picture = seen.iter().map(|(p, at)| (*p, lens.direction(at))).collect();
        Some((pose(&directions)?, seen))
    });
    let mut now = Pictures { lens, free, told: lens, views: views.collect() };
    let (mut left, mut damping) = (now.left(), DAMPING);
    for _ in 0..STEPS {
        let Some(next) = now.stepped(damping) else { break };
        let less = next.left();
        if less < left {
            let is_last = left - less < LAST * left;
            (now, left, damping) = (next, less, damping / 10.0);
            if is_last {
                break;
            }
        } else {
            damping *= 10.0;
        }
    }
    now.lens
}

/// A lens, and where its pictures were taken from.
#[derive(Clone)]
struct Pictures<'a> {
    lens: Lens,
    free: &'a [usize],
    /// What was told of it.
    told: Lens,
    /// The board in the camera's axes; and what is seen, in parts of the focal length.
    views: Vec<(Isometry3<f64>, Picture)>,
}

impl Pictures<'_> {
    /// Of the numbers that are seen, and what is left of them.
    fn squares(&self) -> (f64, f64) {
        let each = self.views.iter().flat_map(|(board, picture)| {
            let off = move |(p, at): &(Vector3<f64>, Vector2<f64>)| {
                (at - self.lens.shows(&(board * Point3::from(*p)).coords)).norm_squared()
            };
            picture.iter().map(off)
        });
        each.fold((0.0, 0.0), |(count, sum), square| (count + 2.0, sum + square))
    }

    /// Variance of what is seen, as far as it is known.
    fn variance(&self) -> f64 {
        let (count, left) = self.squares();
        left / count.max(1.0)
    }

    /// What is to be small: the logarithm's argument of a likelihood whose variance is fitted, and what holds the lens.
    fn left(&self) -> f64 {
        let held = self.free.iter().filter_map(|k| self.lens.strayed(&self.told, *k));
        let held: f64 = held.map(|(left, _)| left * left).sum();
        let (count, left) = self.squares();
        left * (held / count.max(1.0)).exp()
    }

    /// One step of damped least squares; poses are eliminated picture by picture. `None` where there is none.
    fn stepped(&self, damping: f64) -> Option<Self> {
        let count = self.free.len();
        let damped = |d: f64| d * (1.0 + damping);
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let variance = self.variance();
        let mut views = Vec::with_capacity(self.views.len());
        for (board, picture) in &self.views {
            let (mut own, mut cross, mut own_right) =
                (Matrix6::zeros(), Matrix6xX::zeros(count), Vector6::zeros());
            for (p, at) in picture {
                let arm = board.rotation * p;
                let place = arm + board.translation.vector;
                let (by_place, by_constants) = self.lens.slopes(&place);
                let left = at - self.lens.shows(&place);
                let by_pose = by_pose(&by_place, &arm);
                let by_lens = Matrix2xX::from_fn(count, |r, c| by_constants[(r, self.free[c])]);
                own += by_pose.tr_mul(&by_pose);
                own_right += by_pose.tr_mul(&left);
                cross += by_pose.tr_mul(&by_lens);
                normal += by_lens.tr_mul(&by_lens);
                right += by_lens.tr_mul(&left);
            }
            own.set_diagonal(&own.diagonal().map(damped));
            views.push((own.cholesky()?, cross, own_right));
        }
        for (k, constant) in self.free.iter().enumerate() {
            if let Some((left, by)) = self.lens.strayed(&self.told, *constant) {
                normal[(k, k)] += variance * by * by;
                right[k] += variance * by * left;
            }
        }
        normal.set_diagonal(&normal.diagonal().map(damped));
        for (own, cross, own_right) in &views {
            normal -= cross.tr_mul(&own.solve(cross));
            right -= cross.tr_mul(&own.solve(own_right));
        }
        let step = normal.cholesky()?.solve(&right);
        let mut all = [0.0; CONSTANTS];
        self.free.iter().zip(step.iter()).for_each(|(k, by)| all[*k] = *by);
        let views = self.views.iter().zip(&views).map(|((board, picture), (own, cross, right))| {
            let by: Vector6<f64> = own.solve(&(right - cross * &step));
            (moved(board, &by), picture.clone())
        });
        Some(Pictures { lens: self.lens.moved(&all), views: views.collect(), ..self.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{MATRIX, board, pictures};
    use super::*;
    use crate::instrument::pictures::matrix;

    /// With a distortion, which the start does not know, to rounding.
    #[test]
    fn a_distorted_lens_is_found_by_least_squares() {
        let distortion = [-0.21, 0.07, 1e-3, -2e-3, 0.01];
        let truth = Lens::new(MATRIX, &distortion);
        let tilts: Vec<[f64; 3]> = (0..12)
            .map(f64::from)
            .map(|k| [0.6 * (1.7 * k).sin(), 0.6 * (2.3 * k).cos(), 0.5 * k])
            .collect();
        let shown: Vec<Picture> = pictures(&board(true), &tilts)
            .into_iter()
            .map(|picture| {
                let [fx, fy, cx, cy] = MATRIX;
                let distorted = |(p, at): (Vector3<f64>, Vector2<f64>)| {
                    let sight = Vector3::new((at.x - cx) / fx, (at.y - cy) / fy, 1.0);
                    (p, truth.shows(&sight) * truth.focus)
                };
                picture.into_iter().map(distorted).collect()
            })
            .collect();
        let start = matrix("left", 9, &shown).expect("a matrix");
        let free = [0, 1, 2, 3, 4, 5, 6, 7, 8];
        let found = refined(Lens::guessed(start, &[]), &free, &shown);
        for k in free {
            let near = if k < MATRIX.len() { 1e-4 } else { 1e-5 };
            let (is, was) = (found.constant(k), truth.constant(k));
            assert!((is - was).abs() < near, "{k}: {is}, not {was}");
        }
    }
}
