//! One effect at one place, fitted to all rows and, for judging it, to all rows but each fold.

use nalgebra::{DVector, Vector6};

use super::folds::Folds;
use super::normal::Normal;
use super::problem::{Point, Problem};
use crate::effects::{Effect, Parameter, Place};

/// Steps of the exact refit.
const MOST_STEPS: usize = 30;

/// Halvings of one step.
const MOST_HALVINGS: usize = 12;

/// A step below this part of the parameters' standard error changes nothing more.
const CONVERGED: f64 = 1e-6;

/// Nor does one that changes the explained part of the gap by less than this part of it.
const ROUNDING: f64 = 1e-10;

/// Part by which a step may let the sum of squares grow: the block is a close, not an exact,
/// derivative, so the last steps need not go down.
const SLACK: f64 = 1e-6;

/// An effect at a place that this data can show.
pub(crate) struct Candidate {
    pub(crate) effect: &'static dyn Effect,
    pub(crate) place: Place,
    pub(crate) parameters: Vec<Parameter>,
    /// The model as it is.
    pub(crate) nominal: Point,
}

/// A candidate fitted.
pub(crate) struct Fit {
    /// Of the exact model; at their bounds if the data asks for what is not physical.
    pub(crate) values: DVector<f64>,
    /// At those values.
    pub(crate) point: Point,
    /// Over all rows at those values.
    pub(crate) normal: Normal,
    /// What is left of the gap of each row by fits that have not seen the row's fold.
    pub(crate) held_out: Vec<Vector6<f64>>,
}

/// Normal equations of a point, pose by pose.
pub(crate) fn by_pose(problem: &Problem<'_>, point: &Point, w: &Vector6<f64>) -> Vec<Normal> {
    let parameters = point.blocks.first().map_or(0, |b| b.ncols());
    let mut poses = vec![Normal::zero(parameters); problem.data.poses];
    let rows = problem.data.rows.iter().zip(&point.blocks).zip(&point.gaps);
    for ((row, block), gap) in rows {
        poses[row.group].add_row(block, gap, w);
    }
    poses
}

/// Adds up the poses that `take` takes.
pub(crate) fn sum(poses: &[Normal], take: impl Fn(usize) -> bool) -> Normal {
    let mut total = Normal::zero(poses.first().map_or(0, |n| n.xr.len()));
    poses.iter().enumerate().filter(|(pose, _)| take(*pose)).for_each(|(_, n)| total.add(n));
    total
}

impl Candidate {
    /// Least physical values.
    pub(crate) fn least(&self) -> DVector<f64> {
        DVector::from_iterator(self.parameters.len(), self.parameters.iter().map(|p| p.least))
    }

    /// Fits the exact model by Gauss and Newton: the values are those of the arm with the
    /// effect in it, not of its linearisation. The folds are then fitted linearly about them, which
    /// leaves an error of second order in the difference between fold and whole.
    ///
    /// `w` weights the components of a row.
    pub(crate) fn fit(&self, problem: &Problem<'_>, folds: &Folds, w: &Vector6<f64>) -> Fit {
        let least = self.least();
        let mut values = DVector::zeros(self.parameters.len());
        let mut point = self.nominal.clone();
        let mut normal = sum(&by_pose(problem, &point, w), |_| true);
        for _ in 0..MOST_STEPS {
            let mut step = normal.solve(&(&least - &values));
            let Some((next, next_normal)) = self.descend(problem, w, &values, &mut step, normal.rr)
            else {
                break;
            };
            let change = step.dot(&(&next_normal.xx * &step));
            values += &step;
            let whole = values.dot(&(&next_normal.xx * &values));
            let variance = next_normal.rr / problem.data.rows.len() as f64;
            (point, normal) = (next, next_normal);
            if change <= CONVERGED.powi(2) * variance + ROUNDING.powi(2) * whole {
                break;
            }
        }
        let held_out = self.hold_out(problem, folds, w, &values, &point);
        Fit { values, point, normal, held_out }
    }

    /// Halves the step until the exact model is stable and no worse than before.
    fn descend(
        &self,
        problem: &Problem<'_>,
        w: &Vector6<f64>,
        values: &DVector<f64>,
        step: &mut DVector<f64>,
        before: f64,
    ) -> Option<(Point, Normal)> {
        if step.iter().all(|s| *s == 0.0) {
            return None;
        }
        for _ in 0..MOST_HALVINGS {
            let tried = values + &*step;
            if let Ok(point) = problem.exact(self.effect, self.place, tried.as_slice()) {
                let normal = sum(&by_pose(problem, &point, w), |_| true);
                if normal.rr <= before * (1.0 + SLACK) {
                    return Some((point, normal));
                }
            }
            *step /= 2.0;
        }
        None
    }

    fn hold_out(
        &self,
        problem: &Problem<'_>,
        folds: &Folds,
        w: &Vector6<f64>,
        values: &DVector<f64>,
        point: &Point,
    ) -> Vec<Vector6<f64>> {
        let poses = by_pose(problem, point, w);
        let bound = self.least() - values;
        let steps: Vec<DVector<f64>> = (0..folds.count)
            .map(|fold| sum(&poses, |pose| folds.of_pose[pose] != fold).solve(&bound))
            .collect();
        let rows = problem.data.rows.iter().zip(&point.gaps).zip(&point.blocks);
        rows.map(|((row, gap), block)| gap - block * &steps[folds.of_pose[row.group]]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::options::Options;
    use crate::effects::JointCompliance;
    use crate::fixture::{bent, row, table};
    use crate::measurement::{Kind, Row};
    use crate::simulate::simulate;

    #[test]
    fn the_exact_model_is_found_where_the_linear_one_is_not() {
        let arm = bent();
        let mut soft = arm.clone();
        soft.joints[1].compliance += 2e-5;
        let kind = Kind::Pose { orientation: true };
        let rows = (0..8)
            .map(|k| {
                let t = f64::from(k);
                let w = Vector6::new(500.0 * t.sin(), 200.0, -900.0, 20.0, 40.0 * t.cos(), 10.0);
                let q = [0.4 * t, -0.9 + 0.2 * t, 0.3 + t.cos()];
                let mut row = Row { group: k as usize, ..row(&q, w) };
                row.measured = simulate(&soft, &row, kind).unwrap().reading().vector();
                row
            })
            .collect();
        let data = table(rows, kind);
        let problem = Problem::new(&arm, &data).unwrap();
        let folds = Folds::deal(&data, &Options::default()).unwrap();
        let place = Place::Joint(2);
        let candidate = Candidate {
            effect: &JointCompliance,
            place,
            parameters: JointCompliance.parameters(&arm, place, problem.reach),
            nominal: problem.nominal(&JointCompliance, place),
        };
        let w = Vector6::repeat(1.0);
        let nominal = sum(&by_pose(&problem, &candidate.nominal, &w), |_| true);
        let linear = nominal.solve(&candidate.least())[0];
        assert!((linear / 2e-5 - 1.0).abs() > 1e-3, "{linear}");
        let fit = candidate.fit(&problem, &folds, &w);
        assert!((fit.values[0] / 2e-5 - 1.0).abs() < 1e-9, "{}", fit.values[0]);
        assert!(fit.held_out.iter().all(|g| g.amax() < 1e-11));
    }
}
