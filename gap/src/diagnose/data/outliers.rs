//! Rows that do not fit: a beam that was broken, a reflector that was touched, a number mistyped.
//! They are told and left out, for a few of them are most of a sum of squares. A load that is mistyped
//! leaves no large gap where it decides alone what gives under it: such rows are left out before
//! anything is fitted, and come back where what is found without them predicts them.

use nalgebra::Vector6;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::noise::{Level, Noise, Source};
use super::problem::Problem;
use crate::constants::FAR_LOAD;
use crate::infer::constants::BEYOND_NOISE;
use crate::infer::{ascending, percentile};
use crate::measurement::{Measurements, ONE_IN, Row};

/// The rows whose loads are no more than those of the others, but for a factor: all where more than one in
/// ten are.
pub(crate) fn ordinary(data: &Measurements) -> Vec<bool> {
    let mut ordinary = vec![true; data.rows.len()];
    for from in [0, 3] {
        let size = |row: &Row| row.wrench.fixed_rows::<3>(from).norm();
        let loads = ascending(data.rows.iter().map(size).filter(|load| *load > 0.0));
        // Of nine in ten the largest; none that is far beyond has a part in it.
        let Some(usual) = (9 * loads.len()).div_ceil(10).checked_sub(1).map(|k| loads[k]) else {
            continue;
        };
        let far = |row: &Row| size(row) > FAR_LOAD * usual;
        if ONE_IN * data.rows.iter().filter(|row| far(row)).count() <= loads.len() {
            ordinary.iter_mut().zip(&data.rows).for_each(|(is, row)| *is &= !far(row));
        }
    }
    ordinary
}

/// The rows that fit, of the gaps of all rows to a model. The scale is that of the middle row (of
/// normal errors the median of the squared norm is that of a chi-squared number), or the noise if
/// that is given and larger.
pub(crate) fn fitting(problem: &Problem<'_>, noise: &Noise, gaps: &[Vector6<f64>]) -> Vec<bool> {
    let mut fits = vec![true; gaps.len()];
    for level in noise.kinds() {
        let sizes: Vec<f64> = problem.standard(gaps).map(|gap| level.square(&gap)).collect();
        let limit = limit(level, &sizes, problem.data.rows.len()).max(problem.rounding().powi(2));
        fits.iter_mut().zip(&sizes).for_each(|(fits, size)| *fits &= *size <= limit);
    }
    let out = fits.iter().filter(|fits| !**fits).count();
    // More is no mishap: something that acts on few rows is not understood.
    if ONE_IN * out > gaps.len() { vec![true; gaps.len()] } else { fits }
}

/// The largest squared norm of one kind that fits among those of all rows.
fn limit(level: &Level, sizes: &[f64], rows: usize) -> f64 {
    let Ok(chi) = ChiSquared::new(level.components as f64) else { return f64::INFINITY };
    let middle = percentile(&ascending(sizes.iter().copied()), 0.5) / chi.inverse_cdf(0.5);
    // Repeats that do not fit would count as noise.
    let given = if level.source == Source::Option { level.sd.powi(2) } else { 0.0 };
    middle.max(given) * chi.inverse_cdf(1.0 - BEYOND_NOISE / rows as f64)
}
