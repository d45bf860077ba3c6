//! What a file may mean otherwise than it says: nothing of it is wrong to the letter, and nobody's
//! arm does this. A campaign in degrees that says radians would be diagnosed like any other.
//!
//! Each threshold is where no arm can be, so that a doubt is worth its sentence: it is told, and
//! changes nothing.

pub(crate) mod frames;
mod orientation;

use core::f64::consts::TAU;

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

use crate::beyond;
use crate::constants::{LARGE_ANGLE, MOST_REACHES, STIFFEST_JOINT};
use crate::diagnose::Nuisance;
use crate::infer::middle;
use crate::io::shown;
use crate::measurement::{Kind, Measurements, Row};
use crate::simulate::{Reading, simulate};

/// Rows by which a motion of a frame is judged, spread over the file.
const ENOUGH_ROWS: usize = 500;

/// What is to be doubted of `data` as measured on `arm`, a sentence each; `along` are the frames that
/// are fitted along.
pub fn doubts(arm: &Arm, data: &Measurements, along: &[Nuisance]) -> Vec<String> {
    let (reach, mut doubts) = (reach(arm), units(arm, data));
    if reach > 0.0 {
        doubts.extend(loads(arm, data, reach));
        if doubts.is_empty() {
            doubts.extend(orientation::orientations(arm, data));
        }
        // In other units no frame fits.
        if doubts.is_empty() {
            doubts.extend(
                frames::displaced(arm, data, &[], along).map(|moved| moved.doubt(data, reach)),
            );
        }
    }
    doubts
}

/// Whose units are to be doubted: of the readings, and of what is measured or aimed at.
pub fn units(arm: &Arm, data: &Measurements) -> Vec<String> {
    let readings = |joint: usize| data.rows.iter().map(move |row| row.q[joint]);
    let reach = reach(arm);
    let lengths = (reach > 0.0).then(|| lengths(data, reach)).flatten();
    [beyond(arm, &data.file, readings), angles(data), lengths].into_iter().flatten().collect()
}

/// All lengths laid end to end, m: no point of the tool is farther from the base.
pub(crate) fn reach(arm: &Arm) -> f64 {
    let slide = |joint: &Joint| match (joint.motion, joint.limits) {
        (Motion::Prismatic, Some([low, high])) => low.abs().max(high.abs()),
        _ => 0.0,
    };
    let link = |joint: &Joint| joint.a.abs() + joint.d.abs() + slide(joint);
    arm.joints.iter().map(link).sum::<f64>() + arm.tool.translation.vector.norm()
}

/// More than half of the rows.
fn most(data: &Measurements, is: impl Fn(&Row) -> bool) -> bool {
    2 * data.rows.iter().filter(|row| is(row)).count() > data.rows.len()
}

/// Positions and displacements that are too large for metres.
fn lengths(data: &Measurements, reach: f64) -> Option<String> {
    let (most_metres, what) = match data.kind {
        Kind::Displacement { .. } => (LARGE_ANGLE * reach, "displaced"),
        _ => (MOST_REACHES * reach, "away"),
    };
    let size = |row: &Row| length(&row.measured, 0);
    let middle = middle(data.rows.iter().map(size)).filter(|size| *size > most_metres)?;
    let name = data.kind.measured().into_iter().next()?;
    Some(format!(
        "{}: the tool is {} m {what} in most rows, and the arm reaches {} m: is it millimetres? \
         write {name}[mm]",
        data.file,
        shown(middle),
        shown(reach)
    ))
}

/// Of three components from `first` on: what is doubted may be so large that its square is infinite.
fn length(six: &Vector6<f64>, first: usize) -> f64 {
    let three: Vector3<f64> = six.fixed_rows::<3>(first).into_owned();
    let largest = three.amax();
    if largest > 0.0 { largest * (three / largest).norm() } else { 0.0 }
}

/// Rotations that are too large for radians.
fn angles(data: &Measurements) -> Option<String> {
    let most_radians = match data.kind {
        Kind::Displacement { .. } => 1.0,
        _ => TAU,
    };
    let size = |row: &Row| row.measured.fixed_rows::<3>(3).norm();
    if !most(data, |row| size(row) > most_radians) {
        return None;
    }
    let largest = data.rows.iter().map(size).fold(0.0, f64::max);
    let name = data.kind.measured().into_iter().find(|name| name.contains('r'))?;
    Some(format!(
        "{}: rotations reach {} rad: are they in degrees? write {name}[deg]",
        data.file,
        shown(largest)
    ))
}

/// Loads under which a joint would turn by more than a radian, or slide by more than the reach.
fn loads(arm: &Arm, data: &Measurements, reach: f64) -> Option<String> {
    let stiffest = |joint: &Joint| match joint.motion {
        Motion::Revolute => STIFFEST_JOINT * reach.powi(3),
        Motion::Prismatic => STIFFEST_JOINT * reach,
    };
    let compliance = |j: &Joint| if j.compliance > 0.0 { j.compliance } else { 1.0 / stiffest(j) };
    let most_given = |j: &Joint| if j.motion == Motion::Revolute { 1.0 } else { reach };
    // Loads are told in the base's axes, wherever it stands.
    let at_base = Arm { base: Isometry3::identity(), ..arm.clone() };
    let given = |row: &Row| {
        let torque = at_base.joint_torque(&row.q, &row.wrench);
        let each = arm.joints.iter().zip(&torque).enumerate();
        let over = each.map(|(j, (joint, t))| (j, compliance(joint) * t.abs() / most_given(joint)));
        over.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, over)| *over > 1.0)
    };
    let unbearable: Vec<(&Row, usize, f64)> = data
        .rows
        .iter()
        .filter(|row| row.wrench.amax() > 0.0)
        .filter_map(|row| given(row).map(|(j, over)| (row, j, over)))
        .collect();
    let (row, j, over) = unbearable.iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
    let joint = &arm.joints[*j];
    let at_least = if joint.compliance > 0.0 { "" } else { ", as stiff as any arm's is," };
    let (does, unit) = match joint.motion {
        Motion::Revolute => ("turn", "rad"),
        Motion::Prismatic => ("slide", "m"),
    };
    Some(format!(
        "{}: line {}: a load of {} N and {} N·m, under which joint {}{at_least} would {does} by {} \
         {unit}{}: no arm bears it; is the unit of the load right?",
        data.file,
        row.line,
        shown(length(&row.wrench, 0)),
        shown(length(&row.wrench, 3)),
        j + 1,
        shown(over * most_given(joint)),
        match unbearable.len() {
            1 => String::new(),
            n => format!(", and {} rows like it", n - 1),
        }
    ))
}

/// Rows spread over the file, with their numbers.
fn spread(data: &Measurements) -> impl Iterator<Item = (usize, &Row)> {
    data.rows.iter().enumerate().step_by(data.rows.len().div_ceil(ENOUGH_ROWS).max(1))
}

/// What is simulated of a row: by the user where all of so many components are.
fn simulated(arm: &Arm, data: &Measurements, components: usize, row: &Row) -> Option<Reading> {
    match &row.sim {
        Some(sim) if !data.sim_given[..components].contains(&false) => {
            Some(Reading::from_vector(sim))
        }
        _ => simulate(arm, row, data.kind).ok().map(|sim| sim.reading()),
    }
}

#[cfg(test)]
mod tests;
