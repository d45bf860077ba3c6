//! Instruments of which nobody knows where they are, placed by the arm as its file has it.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use super::align::aligned;
use super::refit::refit;
use crate::diagnose::data::Problem;
use crate::diagnose::options::{DiagnoseError, Options};
use crate::effects::Known;
use crate::measurement::Measurements;
use crate::parallel;

/// Rows whose instruments stand at their least squares.
pub(crate) struct Placed {
    /// With every constant of the bench known.
    pub(crate) data: Measurements,
    /// What the arm reads there, m and rad, one per row.
    pub(crate) read: Vec<Vector6<f64>>,
}

/// Fits every unknown constant of the bench, and where a camera and what it sees on the tool are; the arm stays as it is,
/// with the effects `known`.
///
/// # Errors
/// [`DiagnoseError`] of the rows.
pub(crate) fn placed(
    arm: &Arm,
    mut data: Measurements,
    known: &[Known],
) -> Result<Placed, DiagnoseError> {
    data.sim_given = [false; 6];
    let options = Options { known: known.to_vec(), ..Options::default() };
    let problem = Problem::new(arm, &data, &options)?;
    let model = refit(&problem, aligned(&problem)?, None, &problem.mask)?.model;
    let read = parallel::tried(data.rows.len(), &|row| {
        let reading = model.sim(&problem, row, None)?.reading();
        Ok::<_, DiagnoseError>(reading.vector().component_mul(&problem.mask))
    })?;
    let bench_of = problem.bench_of;
    for (row, number) in data.rows.iter_mut().zip(bench_of) {
        if let (Some(aim), Some(number)) = (&mut row.aim, number) {
            (aim.view, aim.free) = (model.bench[number].pointed(&aim.view), &[]);
        }
    }
    Ok(Placed { data, read })
}
