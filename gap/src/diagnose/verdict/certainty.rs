//! How well the numbers of a fit are known: their covariance, and how they scatter when visits are
//! left out.

use nalgebra::{DMatrix, DVector, Vector6};

use crate::diagnose::data::Problem;
use crate::diagnose::fit::{Fit, Model, block, squares};
use crate::diagnose::search::{Explained, Search};
use crate::infer::limits::RIDGE;
use crate::infer::{Basis, Observations, students_t};
use crate::parallel;

/// Visits that are left out one after the other; of more, visits that follow each other go together.
const MOST_CLUSTERS: usize = 400;

/// Rows times parameters up to which columns are differences of the exact model. Beyond, the data are so
/// many that what is of second order matters less than the choice of the model.
const MOST_EXACT: usize = 100_000;

/// Part of a number's standard deviation by which it is moved for a difference: far above rounding, and
/// within what is linear.
const STEP: f64 = 0.1;

/// How well the numbers of a fit are known.
pub(crate) struct Certainty {
    /// Half of the 95 % interval of each parameter, frames first.
    pub(crate) half: Vec<f64>,
    /// Of all parameters, by the variance of the remainder.
    pub(crate) covariance: DMatrix<f64>,
    /// Products of the columns, weighted, without what the parameters are held to.
    pub(crate) seen: DMatrix<f64>,
}

impl Certainty {
    /// Of two parameters, −1 to 1; 0 of one that the data leave undecided.
    pub(super) fn correlation(&self, a: usize, b: usize) -> f64 {
        let size = (self.covariance[(a, a)] * self.covariance[(b, b)]).sqrt();
        if size > 0.0 { (self.covariance[(a, b)] / size).clamp(-1.0, 1.0) } else { 0.0 }
    }
}

impl Search<'_, '_> {
    /// Of the numbers of a fit. The interval of a number is the wider of two: by least squares with the
    /// remainder's variance and what the number is held to, and by how it scatters when one visit
    /// after the other is left out (the jackknife; MacKinnon & White 1985, of clusters), which
    /// knows of errors that are shared within a visit, larger at some postures, or of heavy tails.
    pub(crate) fn certainty(&self, now: &Explained) -> Certainty {
        let problem = self.problem;
        let basis = Basis::new(&self.normal(now));
        let parameters = basis.t.nrows();
        let scale = self.scale(now);
        let left = squares(problem, &now.fit.predicted.gaps, &now.weights);
        let variance = scale.variance(left, parameters);
        let sizes = basis.variances().map(|v| (v * variance).sqrt());
        let exact = exact(problem, &now.fit, &sizes);
        let weighted = |row: usize| {
            let weights = problem.weights(row, &now.weights);
            let mut block = block(problem, &now.fit, row, &weights);
            for (k, column) in &exact {
                block.set_column(*k, &column[row].component_mul(&weights));
            }
            (block, now.fit.predicted.gaps[row].component_mul(&weights))
        };
        let clusters = clusters(problem);
        let sums: Vec<(DMatrix<f64>, DVector<f64>)> = parallel::each(&clusters, &|rows| {
            let (mut own, mut score) =
                (DMatrix::zeros(parameters, parameters), DVector::zeros(parameters));
            for (block, gap) in rows.iter().map(|row| weighted(*row)) {
                own.gemm_tr(1.0, &block, &block, 1.0);
                score.gemv_tr(1.0, &block, &gap, 1.0);
            }
            (own, score)
        });
        let mut seen = DMatrix::zeros(parameters, parameters);
        sums.iter().for_each(|(own, _)| seen += own);
        let (mut normal, mut right) = (seen.clone(), DVector::zeros(parameters));
        now.fit.model.hold(problem, &mut normal, &mut right);
        let basis = Basis::new(&normal);
        let covariance = &basis.t * basis.t.transpose() * variance;
        let jackknife = jackknife(&basis, &sums);
        let t = [scale.freedom(parameters), clusters.len().saturating_sub(1) as f64]
            .map(|freedom| students_t(freedom, 0.975));
        let half = (0..parameters).map(|k| {
            let both = [covariance[(k, k)], jackknife[k]].map(|v| v.max(0.0).sqrt());
            (t[0] * both[0]).max(t[1] * both[1])
        });
        Certainty { half: half.collect(), covariance, seen }
    }
}

/// What the numbers of effects do to each row's reading, by differences of the exact model, so that what
/// is of second order counts (a link's compliance and its length); of data that are too many, nothing.
/// `sizes` are the parameters' standard deviations.
fn exact(
    problem: &Problem<'_>,
    fit: &Fit,
    sizes: &DVector<f64>,
) -> Vec<(usize, Vec<Vector6<f64>>)> {
    let first = Model::nuisances(problem);
    let too_many = fit.predicted.gaps.len() * (sizes.len() - first) > MOST_EXACT;
    if too_many || problem.stop.is_asked() {
        return Vec::new();
    }
    let columns = (first..sizes.len()).filter(|k| sizes[*k] > 0.0).filter_map(|k| {
        let step = STEP * sizes[k];
        let mut steps = vec![0.0; sizes.len()];
        steps[k] = step;
        // Where the arm finds no rest with a number that is known so badly, its first order stays.
        let moved = fit.model.moved(problem, &steps);
        let moved = moved.predict(problem, Some(&fit.predicted.sims)).ok()?;
        let gaps = fit.predicted.gaps.iter().zip(&moved.gaps);
        let column = gaps.map(|(gap, moved)| (gap - moved).component_mul(&problem.mask) / step);
        Some((k, column.collect()))
    });
    columns.collect()
}

/// The rows that are left out together.
fn clusters(problem: &Problem<'_>) -> Vec<Vec<usize>> {
    let visits = &problem.visits;
    let count = visits.count().min(MOST_CLUSTERS);
    let mut clusters = vec![Vec::new(); count];
    for row in (0..problem.fits.len()).filter(|row| problem.fits[*row]) {
        clusters[visits.of_row[row] * count / visits.count()].push(row);
    }
    clusters.retain(|rows| !rows.is_empty());
    clusters
}

/// Variance of each parameter by the jackknife: the fit without one cluster after the other.
fn jackknife(basis: &Basis, sums: &[(DMatrix<f64>, DVector<f64>)]) -> DVector<f64> {
    let rank = basis.rank();
    let moved: Vec<DVector<f64>> = parallel::each(sums, &|(own, score)| {
        let others = DMatrix::identity(rank, rank) * (1.0 + RIDGE) - basis.t.tr_mul(own) * &basis.t;
        let score = basis.t.tr_mul(score);
        let moved = others.cholesky().map_or(DVector::zeros(rank), |root| root.solve(&score));
        &basis.t * moved
    });
    let count = moved.len() as f64;
    let mut sum = DVector::zeros(basis.t.nrows());
    moved.iter().for_each(|moved| sum += moved.component_mul(moved));
    sum * ((count - 1.0) / count).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mean's variance by the jackknife is that of the textbook, Σ (x − x̄)²/(n (n − 1)), of the means
    /// of clusters where these are alike.
    #[test]
    fn of_a_mean_it_is_the_textbooks() {
        let values = [1.0, 1.0, 4.0, 4.5, -2.0, -1.5, 0.5, 0.0];
        let mean = values.iter().sum::<f64>() / 8.0;
        let basis = Basis::new(&DMatrix::from_element(1, 1, 8.0));
        for size in [1, 2] {
            let clusters: Vec<&[f64]> = values.chunks(size).collect();
            let sums: Vec<_> = (clusters.iter())
                .map(|c| {
                    let score = c.iter().map(|x| x - mean).sum();
                    (DMatrix::from_element(1, 1, size as f64), DVector::from_element(1, score))
                })
                .collect();
            let own = |c: &&[f64]| c.iter().sum::<f64>() / size as f64 - mean;
            let count = clusters.len() as f64;
            let squares: f64 = clusters.iter().map(|c| own(c).powi(2)).sum();
            let wanted = squares / (count * (count - 1.0));
            // The ridge.
            assert!((jackknife(&basis, &sums)[0] / wanted - 1.0).abs() < 1e-8);
        }
    }
}
