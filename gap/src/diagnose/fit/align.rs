//! First guess of unknown frames, good enough for the exact fit to converge from: a tracker may
//! stand anywhere.

use nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Vector2, Vector3, Vector6};

use super::model::Model;
use super::refit::refit;
use crate::diagnose::data::{Problem, Thing};
use crate::diagnose::options::{DiagnoseError, Nuisance};
use crate::infer::Basis;
use crate::infer::limits::LAST_DIGITS;
use crate::instrument::{View, nearest_rotation, pose};
use crate::measurement::{Kind, Row};
use crate::parallel;
use crate::simulate::Reading;

/// Most steps of a thing's least squares, which are nearly linear from where they begin.
const MOST_STEPS: usize = 20;

/// The nominal model with unknown frames where the measurements put them to a first guess.
///
/// Each base by the rigid motion that brings the simulated points closest to the
/// measured ones (Kabsch), or to the lines of sight of a camera; a thing of the bench by what was read of the simulated
/// points, the tool's orientation by the mean of what is then left of the rotations.
pub(crate) fn aligned(problem: &Problem<'_>) -> Result<Model, DiagnoseError> {
    let mut model = Model::nominal(problem);
    let (base, tool) =
        (problem.is_unknown(Nuisance::BaseFrame), problem.is_unknown(Nuisance::ToolFrame));
    if !base && !tool && problem.bench.is_empty() {
        return Ok(model);
    }
    let rows = 0..problem.data.rows.len();
    // Of very many rows the states are more than memory holds.
    let seen = parallel::tried(rows.len(), &|row| -> Result<_, DiagnoseError> {
        let sim = model.sim(problem, row, None)?;
        Ok([sim.base * sim.loaded.tool, sim.seen_frame()])
    })?;
    for (number, (view, thing)) in model.bench.iter_mut().zip(&problem.bench).enumerate() {
        let of = rows.clone().filter(|row| problem.bench_of[*row] == Some(number));
        let read =
            of.map(|row| (seen[row][1].translation.vector, problem.data.rows[row].measured[0]));
        *view = thing.aim.guess(&read.collect::<Vec<_>>());
    }
    let (readings, measured): (Vec<Isometry3<f64>>, Vec<_>) = match problem.data.kind {
        Kind::Pose { .. } => {
            let frames = |row: usize| Some(frame_of(&problem.data.rows[row].measured));
            (seen.iter().map(|[_, frame]| *frame).collect(), rows.clone().map(frames).collect())
        }
        Kind::Bench { angles: true, .. } => {
            (seen.iter().map(|[tool, _]| *tool).collect(), boards(problem))
        }
        _ => return Ok(model),
    };
    let orientation = !matches!(problem.data.kind, Kind::Pose { orientation: false });
    let mut moved = vec![Isometry3::identity(); model.bases.len()];
    if base {
        for (number, moved) in moved.iter_mut().enumerate() {
            let of = rows.clone().filter(|row| problem.stands.base_of[*row] == number);
            let both = of.filter_map(|row| Some((readings[row], measured[row]?)));
            let (from, to): (Vec<_>, Vec<_>) =
                both.map(|(a, b)| (a.translation.vector, b.translation.vector)).unzip();
            let found = if from.is_empty() {
                resected(problem, number, &seen)
            } else {
                Some(rigid(&from, &to))
            };
            *moved = found.unwrap_or_default();
            model.bases[number] = *moved * model.bases[number];
        }
    }
    if tool && orientation {
        let mut left = vec![Matrix3::zeros(); model.mounts.len().max(1)];
        for row in rows {
            // What has no place of its own on the tool says nothing of where the others are.
            let number = problem.stands.mount_of[row];
            let number = if model.mounts.is_empty() { Some(0) } else { number };
            let (Some(measured), Some(number)) = (measured[row], number) else { continue };
            let turn = moved[problem.stands.base_of[row]].rotation * readings[row].rotation;
            let off = turn.inverse() * measured.rotation;
            left[number] += off.to_rotation_matrix().matrix();
        }
        let tools = match model.mounts.is_empty() {
            true => core::slice::from_mut(&mut model.arm.tool),
            false => &mut model.mounts[..],
        };
        let each = tools.iter_mut().zip(&left);
        each.for_each(|(tool, left)| tool.rotation *= nearest_rotation(left));
    }
    with_lenses_held(problem, model)
}

/// The frames fitted with every lens as its pictures have it, if one is to be co-estimated: from as far as the first guess
/// is, a lens would take part of what the frames are off.
fn with_lenses_held(problem: &Problem<'_>, model: Model) -> Result<Model, DiagnoseError> {
    let is_lens =
        |thing: &Thing| matches!(thing.aim.view, View::Camera { .. }) && !thing.aim.free.is_empty();
    if !problem.bench.iter().any(is_lens) {
        return Ok(model);
    }
    let mut held = problem.clone();
    held.bench.iter_mut().filter(|thing| is_lens(thing)).for_each(|thing| thing.aim.free = &[]);
    Ok(refit(&held, model, None, &problem.mask)?.model)
}

fn frame_of(vector: &Vector6<f64>) -> Isometry3<f64> {
    let Reading { position, rotation } = Reading::from_vector(vector);
    Isometry3::from_parts(position.into(), rotation)
}

/// The tool's pose by each picture of a board, at its first row: the board in the camera's axes, or the camera in the
/// board's.
fn boards(problem: &Problem<'_>) -> Vec<Option<Isometry3<f64>>> {
    let mut poses = vec![None; problem.data.rows.len()];
    if !problem.data.by_board {
        return poses;
    }
    for rows in problem.data.pictures() {
        let shown = rows.iter().filter(|row| problem.fits[**row]).filter_map(|row| {
            let row = &problem.data.rows[*row];
            let (target, direction) = direction(row)?;
            Some((target.or_else(|| row.offset.map(Vector3::from))?, direction, target.is_some()))
        });
        let shown: Vec<_> = shown.collect();
        let is_on_tool = shown.first().is_some_and(|(.., is_target)| *is_target);
        let points: Vec<_> =
            shown.into_iter().map(|(point, direction, _)| (point, direction)).collect();
        let board = pose(&points);
        poses[rows[0]] = if is_on_tool { board.map(|board| board.inverse()) } else { board };
    }
    poses
}

/// Where a camera's axes have the measuring frame, by all points that it shows where the arm is thought to have them.
fn resected(
    problem: &Problem<'_>,
    base: usize,
    seen: &[[Isometry3<f64>; 2]],
) -> Option<Isometry3<f64>> {
    let of =
        (0..seen.len()).filter(|row| problem.stands.base_of[*row] == base && problem.fits[*row]);
    let points = of.filter_map(|row| {
        let (target, direction) = direction(&problem.data.rows[row])?;
        target.is_none().then_some((seen[row][1].translation.vector, direction))
    });
    pose(&points.collect::<Vec<_>>())
}

/// What a camera is pointed at in a row, and the direction in which it shows it.
fn direction(row: &Row) -> Option<(Option<Vector3<f64>>, Vector2<f64>)> {
    let View::Camera { lens, target } = row.aim.as_ref()?.view else { return None };
    Some((target, lens.direction(&row.measured.fixed_rows::<2>(3).into_owned())))
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
    let read = parallel::tried(rows.len(), &|k| -> Result<_, DiagnoseError> {
        let (sim, row) = (model.sim(problem, rows[k], None)?, &problem.data.rows[rows[k]]);
        let first = if problem.bench[thing].aim.view.is_angle() { 3 } else { 0 };
        let value = row.measured.fixed_rows::<3>(first).into_owned();
        Ok((sim.seen_frame(), value, row.view(problem.data.kind)))
    })?;
    let aim = &problem.bench[thing].aim;
    if read.is_empty() {
        return Ok(aim.view);
    }
    let points = read.iter().map(|(at, value, _)| (at.translation.vector, value[0]));
    let mut view = aim.guess(&points.collect::<Vec<_>>());
    let count = aim.free.len();
    for _ in 0..MOST_STEPS {
        let (mut normal, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        for (at, value, of_row) in &read {
            let here = of_row.map_or(view, |of_row| view.pointed(&of_row));
            let block = here.by_frame(at) * here.as_twists(at).select_columns(aim.free);
            normal += block.tr_mul(&block);
            right += block.tr_mul(&(value - here.read(at)));
        }
        let step = Basis::new(&normal).solve(&right);
        view = aim.moved(view, step.as_slice());
        if step.amax() < LAST_DIGITS {
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
