//! First guess of unknown frames, good enough for the exact fit to converge from: a tracker may
//! stand anywhere.

use nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use rayon::prelude::*;

use super::model::Model;
use crate::diagnose::data::Problem;
use crate::diagnose::options::{DiagnoseError, Nuisance};
use crate::infer::Basis;
use crate::measurement::Kind;
use crate::observe::View;
use crate::simulate::Reading;

/// Most steps of a thing's least squares, which are nearly linear from where they begin.
const MOST_STEPS: usize = 20;

/// A step below this, m and rad, is the last.
const SETTLED: f64 = 1e-12;

/// The nominal model with unknown frames where the measurements put them to a first guess.
///
/// The base of each session by the rigid motion that brings the simulated points closest to the
/// measured ones (Kabsch), a thing of the bench by what was read of the simulated points, the tool's
/// orientation by the mean of what is then left of the rotations.
pub(crate) fn aligned(problem: &Problem<'_>) -> Result<Model, DiagnoseError> {
    let mut model = Model::nominal(problem);
    let (base, tool) =
        (problem.is_unknown(Nuisance::BaseFrame), problem.is_unknown(Nuisance::ToolFrame));
    if !base && !tool && problem.bench.is_empty() {
        return Ok(model);
    }
    let rows = 0..problem.data.rows.len();
    // Of very many rows the states are more than memory holds.
    let seen = rows.clone().into_par_iter().map(|row| {
        let sim = model.sim(problem, row, None)?;
        Ok((sim.reading(), sim.seen_point()))
    });
    let seen: Vec<(Reading, Vector3<f64>)> = seen.collect::<Result<_, DiagnoseError>>()?;
    for (number, (view, thing)) in model.bench.iter_mut().zip(&problem.bench).enumerate() {
        let of = rows.clone().filter(|row| problem.bench_of[*row] == Some(number));
        let read = of.map(|row| (seen[row].1, problem.data.rows[row].measured[0]));
        *view = thing.aim.guess(&read.collect::<Vec<_>>());
    }
    let Kind::Pose { orientation } = problem.data.kind else { return Ok(model) };
    let readings: Vec<Reading> = seen.into_iter().map(|(reading, _)| reading).collect();
    let measured: Vec<Reading> =
        problem.data.rows.iter().map(|r| Reading::from_vector(&r.measured)).collect();
    let mut moved = vec![Isometry3::identity(); problem.sessions.len()];
    if base {
        for (session, moved) in moved.iter_mut().enumerate() {
            let of: Vec<_> =
                rows.clone().filter(|row| problem.session_of[*row] == session).collect();
            let places = |of_rows: &[Reading]| -> Vec<_> {
                of.iter().map(|row| of_rows[*row].position).collect()
            };
            *moved = rigid(&places(&readings), &places(&measured));
            model.bases[session] = *moved * model.bases[session];
        }
    }
    if tool && orientation {
        let left = rows.map(|row| {
            let turn = moved[problem.session_of[row]].rotation;
            let left = (turn * readings[row].rotation).inverse() * measured[row].rotation;
            *left.to_rotation_matrix().matrix()
        });
        let mean = nearest_rotation(&left.sum());
        model.arm.tool.rotation *= mean;
    }
    Ok(model)
}

/// A thing of the bench by what was read of it, the rest of the model as it is: least squares, from a first
/// guess.
///
/// # Errors
/// [`DiagnoseError::Unstable`] of a row.
pub(crate) fn fitted_thing(
    problem: &Problem<'_>,
    model: &Model,
    thing: usize,
) -> Result<View, DiagnoseError> {
    let rows = (0..problem.data.rows.len()).filter(|row| problem.bench_of[*row] == Some(thing));
    let rows: Vec<usize> = rows.filter(|row| problem.fits[*row]).collect();
    let read: Vec<_> = (rows.into_par_iter())
        .map(|row| {
            let point = model.sim(problem, row, None)?.seen_point();
            Ok((point, problem.data.rows[row].measured.fixed_rows::<3>(0).into_owned()))
        })
        .collect::<Result<_, DiagnoseError>>()?;
    let aim = &problem.bench[thing].aim;
    if read.is_empty() {
        return Ok(aim.view);
    }
    let mut view = aim.guess(&read.iter().map(|(p, value)| (*p, value[0])).collect::<Vec<_>>());
    let count = aim.free.len();
    for _ in 0..MOST_STEPS {
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        for (point, value) in &read {
            let shifts = view.as_shifts(point).select_columns(aim.free);
            let block = view.by_point(point) * shifts;
            normal += block.tr_mul(&block);
            right += block.tr_mul(&(value - view.read(point)));
        }
        let step = Basis::new(&normal).solve(&right);
        view = aim.moved(view, step.as_slice());
        if step.amax() < SETTLED {
            break;
        }
    }
    Ok(view)
}

/// The rigid motion that takes `from` closest to `to`.
pub(crate) fn rigid(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Isometry3<f64> {
    let mean = |points: &[Vector3<f64>]| points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let (here, there) = (mean(from), mean(to));
    let moment = from.iter().zip(to).map(|(f, t)| (t - there) * (f - here).transpose());
    let rotation = nearest_rotation(&moment.sum());
    Isometry3::from_parts((there - rotation * here).into(), rotation)
}

/// The rotation with the largest trace product with a matrix.
fn nearest_rotation(matrix: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let svd = matrix.svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else { return UnitQuaternion::identity() };
    let mut sign = Matrix3::identity();
    // The least singular value pays for a reflection.
    let least = (0..3).min_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]));
    let least = least.unwrap_or(2);
    sign[(least, least)] = (u * v).determinant().signum();
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(u * sign * v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rigid_motion_is_found_back() {
        let points: Vec<Vector3<f64>> = (0..7)
            .map(|k| {
                let k = f64::from(k);
                Vector3::new((1.3 * k).sin(), (2.1 * k).cos(), 0.2 * k)
            })
            .collect();
        for turn in [Vector3::new(0.3, -2.0, 1.0), Vector3::new(0.0, 0.0, 3.1), Vector3::zeros()] {
            let motion = Isometry3::new(Vector3::new(2.0, -3.0, 0.5), turn);
            let moved: Vec<_> =
                points.iter().map(|p| (motion * nalgebra::Point3::from(*p)).coords).collect();
            let found = rigid(&points, &moved);
            let left = (found.inverse() * motion).to_homogeneous() - nalgebra::Matrix4::identity();
            assert!(left.amax() < 1e-12, "{left}");
        }
    }
}
