//! What is left, row by row: whether it is as least squares takes noise to be, and where it is largest.

use nalgebra::Vector6;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::constants::FEWEST_TO_JUDGE;
use crate::diagnose::data::Problem;
use crate::diagnose::report::{Autocorrelation, Normality, Residual, Worst};
use crate::diagnose::search::{Explained, Search};
use crate::infer::limits::MOST_NAMED;

/// Quantiles that are told: what a plot shows.
const MOST_QUANTILES: usize = 99;

impl Search<'_, '_> {
    /// Of the model with all findings; `before` and `after` are held-out gaps.
    pub(crate) fn residual(
        &self,
        now: &Explained,
        before: &[Vector6<f64>],
        after: &[Vector6<f64>],
    ) -> Residual {
        let problem = self.problem;
        let gaps = problem.standard(&now.fit.predicted.gaps);
        let gaps: Vec<Vector6<f64>> = gaps.map(|gap| gap.component_mul(&now.weights)).collect();
        Residual {
            normality: normality(problem, &gaps),
            autocorrelation: autocorrelation(problem, &gaps),
            worst: self.worst(before, after),
        }
    }

    /// The rows that are left with the largest gaps.
    fn worst(&self, before: &[Vector6<f64>], after: &[Vector6<f64>]) -> Vec<Worst> {
        let size = |gap: &Vector6<f64>| self.problem.size(gap);
        let rows = &self.problem.data.rows;
        let mut all: Vec<usize> = (0..rows.len()).filter(|row| self.problem.fits[*row]).collect();
        all.sort_by(|a, b| size(&after[*b]).total_cmp(&size(&after[*a])));
        let named = all.into_iter().take(MOST_NAMED);
        let worst = named.map(|row| Worst {
            line: rows[row].line,
            pose: rows[row].pose.clone(),
            before: size(&before[row]),
            after: size(&after[row]),
        });
        worst.collect()
    }
}

/// Of the numbers that are measured and counted, by the test of Anderson and Darling with mean and
/// variance estimated (Stephens 1974; its chance by D'Agostino & Stephens 1986, table 4.9).
fn normality(problem: &Problem<'_>, gaps: &[Vector6<f64>]) -> Option<Normality> {
    let kept = problem.kept_rows().zip(problem.kept(gaps));
    let read = |k: usize| kept.clone().filter(move |(row, _)| row.components(problem.data.kind)[k]);
    let mut values = Vec::new();
    // Positions and rotations each by their own size.
    for kind in [0..3, 3..6] {
        let mut own: Vec<f64> = (problem.measured.iter().filter(|k| kind.contains(*k)))
            .flat_map(|k| read(*k).map(|(_, gap)| gap[*k]))
            .collect();
        let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
        let variance = own.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / own.len() as f64;
        if variance > 0.0 {
            own.iter_mut().for_each(|x| *x = (*x - mean) / variance.sqrt());
            values.append(&mut own);
        }
    }
    if values.len() < FEWEST_TO_JUDGE {
        return None;
    }
    let count = values.len() as f64;
    let excess_kurtosis = values.iter().map(|x| x.powi(4)).sum::<f64>() / count - 3.0;
    values.sort_by(f64::total_cmp);
    let normal = Normal::standard();
    // Beyond some eight deviations a logarithm would be infinite.
    let log = |x: f64| normal.cdf(x).max(f64::MIN_POSITIVE).ln();
    let both = values.iter().zip(values.iter().rev()).enumerate();
    let sum: f64 = both.map(|(k, (x, y))| (2 * k + 1) as f64 * (log(*x) + log(-y))).sum();
    let a = (-count - sum / count) * (1.0 + 0.75 / count + 2.25 / (count * count));
    let p_value = match a {
        a if a >= 0.6 => (1.2937 - 5.709 * a + 0.0186 * a * a).exp(),
        a if a >= 0.34 => (0.9177 - 4.279 * a - 1.38 * a * a).exp(),
        a if a >= 0.2 => 1.0 - (-8.318 + 42.796 * a - 59.938 * a * a).exp(),
        a => 1.0 - (-13.436 + 101.14 * a - 223.73 * a * a).exp(),
    };
    // The fit of the table turns up again far out, where no chance is left.
    let p_value = if a > 10.0 { 0.0 } else { p_value.clamp(0.0, 1.0) };
    let quantiles = quantiles(&values, &normal);
    Some(Normality { excess_kurtosis, anderson_darling: a, p_value, quantiles })
}

/// Of ascending numbers the least, the largest, and some in between, each behind where it would lie.
fn quantiles(values: &[f64], normal: &Normal) -> Vec<[f64; 2]> {
    let (last, count) = (values.len() - 1, values.len().min(MOST_QUANTILES));
    let rank = |k: usize| k * last / (count - 1);
    let expected = |rank: usize| normal.inverse_cdf((rank as f64 + 0.5) / values.len() as f64);
    (0..count).map(rank).map(|rank| [expected(rank), values[rank]]).collect()
}

/// Of what is left at one visit with what is left at the next, in the order of measuring.
fn autocorrelation(problem: &Problem<'_>, gaps: &[Vector6<f64>]) -> Option<Autocorrelation> {
    let mut means: Vec<(Vector6<f64>, f64)> = vec![(Vector6::zeros(), 0.0); problem.visits.count()];
    for (row, gap) in gaps.iter().enumerate().filter(|(row, _)| problem.fits[*row]) {
        let (sum, count) = &mut means[problem.visits.of_row[row]];
        *sum += gap;
        *count += 1.0;
    }
    let means: Vec<Vector6<f64>> = means
        .into_iter()
        .filter(|(_, count)| *count > 0.0)
        .map(|(sum, count)| sum / count)
        .collect();
    let squares: f64 = means.iter().map(|mean| mean.norm_squared()).sum();
    let pairs = means.len().saturating_sub(1) * problem.measured.len();
    if pairs < FEWEST_TO_JUDGE || squares <= 0.0 {
        return None;
    }
    let products: f64 = means.windows(2).map(|pair| pair[0].dot(&pair[1])).sum();
    let lag_1 = products / squares;
    // Of numbers without any it is normal, of variance one over their count (Bartlett 1946).
    let p_value = 2.0 * Normal::standard().sf((lag_1 * (pairs as f64).sqrt()).abs());
    Some(Autocorrelation { lag_1, p_value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::Options;
    use crate::fixture::{rigid, row, table};
    use crate::measurement::{Kind, Row};
    use crate::noisy::normal;
    use crate::rng::{Rng, Stream};

    /// 400 rows at poses of their own whose gaps are made of what `each` makes of normal numbers.
    fn residual(mut each: impl FnMut(&mut dyn FnMut() -> f64) -> Vector6<f64>) -> [f64; 4] {
        let rows = (0..400)
            .map(|k| Row { group: k, ..row(&[0.1 * k as f64, 0.2, 0.3], Vector6::zeros()) });
        let data = table(rows.collect(), Kind::Pose { orientation: false });
        let arm = rigid();
        let problem = Problem::new(&arm, &data, &Options::default()).unwrap();
        let mut rng = Rng::new(2, Stream::Signs);
        let gaps: Vec<_> = (0..400).map(|_| each(&mut || normal(&mut rng))).collect();
        let (shape, order) =
            (normality(&problem, &gaps).unwrap(), autocorrelation(&problem, &gaps).unwrap());
        [shape.excess_kurtosis, shape.p_value, order.lag_1, order.p_value]
    }

    fn three(x: [f64; 3]) -> Vector6<f64> {
        Vector6::new(x[0], x[1], x[2], 0.0, 0.0, 0.0)
    }

    /// Where numbers lie as normal ones do, the pairs are on the line; both ends are among them.
    #[test]
    fn quantiles_of_normal_numbers_are_theirs() {
        let normal = Normal::standard();
        for (count, told) in [(8, 8), (99, 99), (1000, 99)] {
            let rank = |k: usize| normal.inverse_cdf((k as f64 + 0.5) / count as f64);
            let values: Vec<f64> = (0..count).map(|k| 2.0 * rank(k)).collect();
            let pairs = quantiles(&values, &normal);
            assert_eq!(pairs.len(), told);
            assert!(pairs.iter().all(|[expected, is]| (is - 2.0 * expected).abs() < 1e-12));
            assert_eq!((pairs[0][1], pairs[told - 1][1]), (values[0], values[count - 1]));
        }
    }

    #[test]
    fn noise_is_normal_and_forgets() {
        // Sums of twelve uniform numbers have an excess of −0.1.
        let [kurtosis, p, lag, order] = residual(|n| three([n(), n(), n()]));
        assert!(kurtosis.abs() < 0.6 && p > 0.01, "{kurtosis} {p}");
        assert!(lag.abs() < 4.0 / 1200_f64.sqrt() && order > 1e-4, "{lag} {order}");
    }

    #[test]
    fn heavy_tails_and_what_lingers_are_noticed() {
        // Student's t of five degrees of freedom has an excess of 6.
        let student = |n: &mut dyn FnMut() -> f64| {
            let (top, chi) = (n(), (0..5).map(|_| n().powi(2)).sum::<f64>() / 5.0);
            top / chi.sqrt()
        };
        let [kurtosis, p, ..] = residual(|n| three([student(n), student(n), student(n)]));
        assert!(kurtosis > 1.0 && p < 1e-4, "{kurtosis} {p}");
        let mut last = [0.0; 3];
        let [.., lag, p] = residual(|n| {
            last = last.map(|x| 0.5 * x + n());
            three(last)
        });
        // A half, within four of its standard errors, √((1 − ¼)/1200).
        assert!((lag - 0.5).abs() < 4.0 * 0.025 && p < 1e-6, "{lag} {p}");
    }
}
