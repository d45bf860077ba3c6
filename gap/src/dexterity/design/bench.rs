//! Postures at a bench: with the tool's point in a socket or on a plate, and the arm above the plates.

use nalgebra::{DMatrix, DVector, Isometry3};
use stiffarm_kernels::generic::Arm;

use crate::observe::{Aim, View};

/// Steps that bring a posture there at most, and a step in joints, rad or m, as far as first order holds.
const STEPS: usize = 60;
const LONGEST: f64 = 0.5;

/// A posture is there at this distance, m: an operator moves the rest by hand.
const THERE: f64 = 1e-6;

/// Moves a posture until the tool's point is there; whether it goes within the joints' ranges, and no joint of the arm
/// is below a plate.
pub(super) fn reaches(
    arm: &Arm,
    bench: &[Aim],
    thing: &Aim,
    q: &mut [f64],
    ranges: &[[f64; 2]],
) -> bool {
    for _ in 0..STEPS {
        let at = arm.pose(q);
        let off = read(thing, &at);
        if off.norm() < THERE {
            break;
        }
        let slope = rows(thing, &at) * arm.jacobian(q);
        let Ok(step) = slope.svd(true, true).solve(&-off, 1e-3) else { return false };
        let part = (LONGEST / step.amax()).min(1.0);
        q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q += part * step);
    }
    let within = ranges.iter().zip(q.iter()).all(|([low, high], q)| (low..=high).contains(&q));
    let is_there = read(thing, &arm.pose(q)).norm() < THERE;
    within && is_there && is_above(arm, bench, q)
}

/// Whether every joint after the first is on the side of each plate to which its normal points.
fn is_above(arm: &Arm, bench: &[Aim], q: &[f64]) -> bool {
    let frames = arm.frames(q);
    let joints = || frames.iter().skip(1).take(arm.dof() - 1);
    bench.iter().all(|aim| match &aim.view {
        View::Plane(plane) => joints().all(|at| plane.height(&at.translation.vector) > 0.0),
        _ => true,
    })
}

fn read(aim: &Aim, at: &Isometry3<f64>) -> DVector<f64> {
    DVector::from_column_slice(&aim.view.read(at).as_slice()[..aim.seen.numbers()])
}

/// What is read per shift and turn of the tool, a row for each number.
pub(super) fn rows(aim: &Aim, at: &Isometry3<f64>) -> DMatrix<f64> {
    let by_frame = aim.view.by_frame(at);
    DMatrix::from_fn(aim.seen.numbers(), 6, |r, c| by_frame[(r, c)])
}

/// The same per constant of the thing, which nobody knows as well as the arm reads it.
pub(super) fn constants(aim: &Aim, at: &Isometry3<f64>) -> DMatrix<f64> {
    rows(aim, at) * aim.view.as_twists(at)
}
