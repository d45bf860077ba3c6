//! First guess of unknown frames, good enough for the exact fit to converge from: a tracker may
//! stand anywhere.

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::model::Model;
use crate::diagnose::data::Problem;
use crate::diagnose::options::{DiagnoseError, Nuisance};
use crate::measurement::Kind;
use crate::simulate::Reading;

/// The nominal model with unknown frames where the measurements put them to a first guess.
///
/// The base by the rigid motion that brings the simulated points closest to the measured ones
/// (Kabsch), the tool's orientation by the mean of what is then left of the rotations.
pub(crate) fn aligned(problem: &Problem<'_>) -> Result<Model, DiagnoseError> {
    let mut model = Model::nominal(problem);
    let Kind::Pose { orientation } = problem.data.kind else { return Ok(model) };
    let (base, tool) =
        (problem.is_unknown(Nuisance::BaseFrame), problem.is_unknown(Nuisance::ToolFrame));
    if !base && !tool {
        return Ok(model);
    }
    let readings: Vec<Reading> =
        model.predict(problem, None)?.sims.iter().map(|sim| sim.reading()).collect();
    let measured: Vec<Reading> =
        problem.data.rows.iter().map(|r| Reading::from_vector(&r.measured)).collect();
    let mut moved = Isometry3::identity();
    if base {
        let from: Vec<_> = readings.iter().map(|r| r.position).collect();
        let to: Vec<_> = measured.iter().map(|r| r.position).collect();
        moved = rigid(&from, &to);
        model.instrument = moved * model.instrument;
    }
    if tool && orientation {
        let left = readings.iter().zip(&measured).map(|(sim, is)| {
            let left = (moved.rotation * sim.rotation).inverse() * is.rotation;
            *left.to_rotation_matrix().matrix()
        });
        let mean = nearest_rotation(&left.sum());
        model.arm.tool.rotation *= mean;
    }
    Ok(model)
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
