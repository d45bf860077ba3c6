//! The base parameters as they are fitted: which sums of moments, how large, how well they are known.

use nalgebra::DMatrix;
use stiffarm_kernels::generic::{Arm, BaseParameter};

use super::Base;
use crate::infer::students_t;
use crate::report::log::{BaseValue, Moment, RigidLinks};

/// Of an arm's base columns, the first of a fit's values; `covariance` of all values, by so many blocks.
pub fn fitted(
    arm: &Arm,
    base: &Base,
    values: &[f64],
    covariance: &DMatrix<f64>,
    blocks: usize,
) -> RigidLinks {
    let (count, moments) = (base.columns.len(), arm.moments());
    let t = students_t(blocks as f64 - 1.0, 0.975);
    let value = |(k, sum): (usize, &BaseParameter)| {
        let (value, half) = (values[k], t * covariance[(k, k)].sqrt());
        let first = core::iter::once((sum.moment, 1.0));
        let part = |(moment, times): (usize, f64)| Moment {
            moment: BaseParameter { moment, others: Vec::new() }.to_string(),
            times,
        };
        BaseValue {
            name: sum.to_string(),
            sum: first.chain(sum.others.iter().copied()).map(part).collect(),
            value,
            unit: unit(sum.moment).into(),
            ci95: (half > 0.0).then_some([value - half, value + half]),
            in_file: sum.of(&moments),
        }
    };
    let row = |k: usize| (0..count).map(|l| covariance[(k, l)]).collect();
    let is_told = count <= RigidLinks::MOST_COVARIANCES;
    RigidLinks {
        parameters: base.sums.iter().enumerate().map(value).collect(),
        covariance: if is_told { (0..count).map(row).collect() } else { Vec::new() },
    }
}

/// The unit of a moment, by its column of the regressor.
fn unit(moment: usize) -> &'static str {
    match moment % 10 {
        0 => "kg",
        1..4 => "kg·m",
        _ => "kg·m²",
    }
}
