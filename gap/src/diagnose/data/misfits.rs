//! Rows that do not fit: a beam that was broken, a reflector that was touched, a number mistyped.
//! They are told and left out, for a few of them are most of a sum of squares.

use nalgebra::Vector6;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::noise::{Level, Noise, Source};
use super::problem::Problem;
use crate::gap::percentile;

/// Of a campaign of normal errors so much is left out: less than one row in a hundred of them.
const LEVEL: f64 = 0.01;

/// More than this part of the rows is no mishap: something that acts on few rows is not understood.
const MOST: f64 = 0.1;

/// The rows that fit, of the gaps of all rows to a model. The scale is that of the middle row (of
/// normal errors the median of the squared norm is that of a chi-squared number), or the noise if
/// that is given and larger.
pub(crate) fn fitting(problem: &Problem<'_>, noise: &Noise, gaps: &[Vector6<f64>]) -> Vec<bool> {
    let mut fits = vec![true; gaps.len()];
    for level in noise.kinds() {
        let sizes: Vec<f64> = problem.standard(gaps).map(|gap| level.square(&gap)).collect();
        let limit = limit(level, &sizes, problem.data.rows.len());
        fits.iter_mut().zip(&sizes).for_each(|(fits, size)| *fits &= *size <= limit);
    }
    let out = fits.iter().filter(|fits| !**fits).count();
    if out as f64 > MOST * gaps.len() as f64 { vec![true; gaps.len()] } else { fits }
}

/// The largest squared norm of one kind that fits among those of all rows.
fn limit(level: &Level, sizes: &[f64], rows: usize) -> f64 {
    let Ok(chi) = ChiSquared::new(level.components as f64) else { return f64::INFINITY };
    let mut ascending = sizes.to_vec();
    ascending.sort_by(f64::total_cmp);
    let middle = percentile(&ascending, 0.5) / chi.inverse_cdf(0.5);
    // Repeats that do not fit would count as noise.
    let given = if level.source == Source::Option { level.sd.powi(2) } else { 0.0 };
    middle.max(given) * chi.inverse_cdf(1.0 - LEVEL / rows as f64)
}
