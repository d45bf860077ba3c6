//! First guess of unknown frames, good enough for the exact fit to converge from: a tracker may
//! stand anywhere.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::model::Model;
use crate::diagnose::data::Problem;
use crate::diagnose::options::{DiagnoseError, Nuisance};
use crate::measurement::Kind;
use crate::simulate::{Reading, Sim};

/// The nominal model with unknown frames where the measurements put them to a first guess.
///
/// The base of each session by the rigid motion that brings the simulated points closest to the
/// measured ones (Kabsch), a distance's point by its distances from the simulated ones, the tool's
/// orientation by the mean of what is then left of the rotations.
pub(crate) fn aligned(problem: &Problem<'_>) -> Result<Model, DiagnoseError> {
    let mut model = Model::nominal(problem);
    let (base, tool) =
        (problem.is_unknown(Nuisance::BaseFrame), problem.is_unknown(Nuisance::ToolFrame));
    if !base && !tool && problem.centres.is_empty() {
        return Ok(model);
    }
    let sims = model.predict(problem, None)?.sims;
    let rows = 0..problem.data.rows.len();
    for (number, centre) in model.centres.iter_mut().enumerate() {
        let of = rows.clone().filter(|row| problem.centre_of[*row] == Some(number));
        let seen = of.map(|row| {
            let sim = &sims[row];
            let point = sim.base * Point3::from(sim.point(&sim.loaded));
            (point.coords, problem.data.rows[row].measured[0])
        });
        *centre = equidistant(&seen.collect::<Vec<_>>());
    }
    let Kind::Pose { orientation } = problem.data.kind else { return Ok(model) };
    let readings: Vec<Reading> = sims.iter().map(Sim::reading).collect();
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

/// The rigid motion that takes `from` closest to `to`.
pub(crate) fn rigid(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Isometry3<f64> {
    let mean = |points: &[Vector3<f64>]| points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let (here, there) = (mean(from), mean(to));
    let moment = from.iter().zip(to).map(|(f, t)| (t - there) * (f - here).transpose());
    let rotation = nearest_rotation(&moment.sum());
    Isometry3::from_parts((there - rotation * here).into(), rotation)
}

/// The point that has given distances from others, by least squares of `|p|² − 2 p·c + |c|² = d²`,
/// which is linear in c and `|c|²`; of points in a plane it is one of the two that are as good.
fn equidistant(seen: &[(Vector3<f64>, f64)]) -> Vector3<f64> {
    let middle = seen.iter().map(|(p, _)| p).sum::<Vector3<f64>>() / seen.len() as f64;
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (point, distance) in seen {
        let arm = point - middle;
        normal += arm * arm.transpose();
        right += arm * (0.5 * (arm.norm_squared() - distance * distance));
    }
    let svd = normal.svd(true, true);
    let least = f64::EPSILON.sqrt() * svd.singular_values.max();
    let foot = middle + svd.solve(&right, least).unwrap_or_default();
    let flat: Vec<usize> = (0..3).filter(|k| svd.singular_values[*k] <= least).collect();
    let (Some(u), [normal]) = (svd.u, &flat[..]) else { return foot };
    let height = seen.iter().map(|(p, d)| d * d - (p - foot).norm_squared()).sum::<f64>();
    foot + u.column(*normal) * (height / seen.len() as f64).max(0.0).sqrt()
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
    fn a_point_is_found_by_its_distances() {
        let centre = Vector3::new(0.7, -0.4, 0.3);
        let at = |k: f64| Vector3::new((1.3 * k).sin(), (2.1 * k).cos(), 0.2 * k);
        let seen = |at: &dyn Fn(f64) -> Vector3<f64>| -> Vec<_> {
            (0..7).map(|k| at(f64::from(k))).map(|p| (p, (p - centre).norm())).collect()
        };
        assert!((equidistant(&seen(&at)) - centre).norm() < 1e-12);
        // Above a plane nothing tells the point from its mirror image.
        let flat = |k: f64| Vector3::new(at(k).x, at(k).y, 0.0);
        let found = equidistant(&seen(&flat));
        let folded = Vector3::new(found.x, found.y, found.z.abs());
        assert!((folded - centre).norm() < 1e-12, "{found}");
    }

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
