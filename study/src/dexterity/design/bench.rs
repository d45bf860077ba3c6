//! Postures at a bench: with the tool's point in a socket or on a plate, or a board in a camera's view; and the arm above
//! the plates.

use nalgebra::{DMatrix, DVector, Isometry3};
use stiffarm_kernels::generic::Arm;

use super::Station;
use crate::instrument::{Aim, Plane};

/// Steps that bring a posture there at most, and a step in joints, rad or m, as far as first order holds.
const STEPS: usize = 60;
const LONGEST: f64 = 0.5;

/// A posture is there at this distance, m: an operator moves the rest by hand. A picture's middle is there at the same part
/// of the focal length.
const THERE: f64 = 1e-6;

impl Station {
    /// As reports call it.
    pub fn full_name(&self) -> String {
        match self {
            Station::Thing(aim) => aim.full_name(),
            Station::Board(look) => look.full_name(),
        }
    }

    /// How many constants it has.
    pub(super) fn constants(&self) -> usize {
        match self {
            Station::Thing(aim) => aim.view.constants(),
            Station::Board(look) => look.constants(),
        }
    }

    /// What is read per shift and turn of the tool, a row for each number, and per constant, which nobody knows as well
    /// as the arm reads it.
    pub(super) fn rows(&self, at: &Isometry3<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
        match self {
            Station::Thing(aim) => {
                let by_frame = rows(aim, at);
                let constants = &by_frame * aim.view.as_twists(at);
                (by_frame, constants)
            }
            Station::Board(look) => look.rows(at),
        }
    }

    /// How far the tool is from it, and by how much that changes with its shift and turn.
    fn off(&self, at: &Isometry3<f64>) -> (DVector<f64>, DMatrix<f64>) {
        match self {
            Station::Thing(aim) => {
                let off = aim.view.read(at);
                let off = DVector::from_column_slice(&off.as_slice()[..aim.seen.numbers()]);
                (off, rows(aim, at))
            }
            Station::Board(look) => {
                (DVector::from_column_slice(look.off(at).as_slice()), look.off_by_tool(at))
            }
        }
    }

    /// Whether it is read there.
    fn is_read(&self, at: &Isometry3<f64>) -> bool {
        match self {
            Station::Thing(_) => self.off(at).0.norm() < THERE,
            Station::Board(look) => look.shows(at).is_some(),
        }
    }
}

/// Moves a posture until the tool's point is there, or what it sees or shows in the picture; whether it goes within the
/// joints' ranges, and no joint of the arm is below a plate.
pub(super) fn reaches(
    arm: &Arm,
    plates: &[Plane],
    station: &Station,
    q: &mut [f64],
    ranges: &[[f64; 2]],
) -> bool {
    for _ in 0..STEPS {
        let (off, by_tool) = station.off(&arm.pose(q));
        if off.norm() < THERE {
            break;
        }
        let slope = by_tool * arm.jacobian(q);
        let Ok(step) = slope.svd(true, true).solve(&-off, 1e-3) else { return false };
        let part = (LONGEST / step.amax()).min(1.0);
        q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += part * step);
    }
    let within = ranges.iter().zip(q.iter()).all(|([low, high], q)| (low..=high).contains(&q));
    within && station.is_read(&arm.pose(q)) && is_above(arm, plates, q)
}

/// Whether every joint after the first is on the side of each plate to which its normal points.
fn is_above(arm: &Arm, plates: &[Plane], q: &[f64]) -> bool {
    let frames = arm.frames(q);
    let joints = || frames.iter().skip(1).take(arm.dof() - 1);
    plates.iter().all(|plate| joints().all(|at| plate.height(&at.translation.vector) > 0.0))
}

/// What is read of a thing per shift and turn of the tool, a row for each number.
fn rows(aim: &Aim, at: &Isometry3<f64>) -> DMatrix<f64> {
    let by_frame = aim.view.by_frame(at);
    DMatrix::from_fn(aim.seen.numbers(), 6, |r, c| by_frame[(r, c)])
}
