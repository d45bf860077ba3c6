//! The equations of motion by d'Alembert's principle on points: `τ_j = Σ m (p̈ − g) · ∂p/∂q_j`.
//!
//! A rigid body moves like six points with its mass, its centre and its second moments, a rod like two. Where
//! the points are is the forward kinematics alone; how they accelerate, and how each joint moves them, are its
//! derivatives by dual numbers. There is neither an angular velocity nor a tensor of inertia in it.

use std::vec::Vec;

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual, Dual2, Dual64};

use super::dual::{Frame, Number, frames, moving, origin, table};
use crate::generic::{Arm, Joint};
use crate::{Motion, Output};

/// What an output of the equations of motion must be at a state; `None` where it is none of them, or where the
/// mass of some link is that of no body.
pub fn of(arm: &Arm, output: Output, state: &[f64]) -> Option<Vec<f64>> {
    let n = arm.dof();
    let points = points(arm)?;
    let torques = |state: &[Dual64]| torques(arm, &points, state);
    let still: Vec<Dual64> = state.iter().map(|x| Dual64::from(*x)).collect();
    // The slope of the torques by one number of the state.
    let slope = |at: usize| {
        let mut moved = still.clone();
        moved[at].eps = 1.0;
        torques(&moved).into_iter().map(|torque| torque.eps)
    };
    match output {
        Output::InverseDynamics | Output::Bias => {
            Some(torques(&still).into_iter().map(|torque| torque.re).collect())
        }
        Output::InverseDynamicsByJoints => Some((0..n).flat_map(slope).collect()),
        Output::InverseDynamicsByRates => Some((n..2 * n).flat_map(slope).collect()),
        Output::MassMatrix => {
            let masses: Vec<f64> = points.iter().flatten().map(|p| p.mass).collect();
            let moved: Vec<Vec<[f64; 3]>> =
                (0..n).map(|j| slopes(arm, &points, state, j)).collect();
            let entry = |i: usize, j: usize| {
                let pairs = masses.iter().zip(moved[i].iter().zip(&moved[j]));
                let own = if i == j { rotor(&arm.joints[i]) } else { 0.0 };
                pairs.map(|(m, (a, b))| *m * dot(a, b)).sum::<f64>() + own
            };
            Some((0..n * n).map(|at| entry(at / n, at % n)).collect())
        }
        _ => None,
    }
}

/// The rotor's inertia as its joint feels it.
fn rotor(joint: &Joint) -> f64 {
    joint.drive.gear.powi(2) * joint.drive.rotor_inertia
}

/// τ at a state of joint values, rates and, where there are any, accelerations.
fn torques<T: Number>(arm: &Arm, points: &[Vec<Point>], state: &[T]) -> Vec<T> {
    let n = arm.dof();
    let (q, motion) = state.split_at(n);
    let (rates, given) = motion.split_at(n);
    let none = vec![T::from(0.0); n];
    let accelerations = if given.is_empty() { &none } else { given };
    let forces = inertial(arm, points, q, rates, accelerations);
    let torque = |j: usize| {
        let drive = &arm.joints[j].drive;
        let forwards = f64::from(u8::from(rates[j] > 0.0)) - f64::from(u8::from(rates[j] < 0.0));
        let dry = T::from(drive.coulomb * forwards);
        let moved = slopes(arm, points, q, j);
        let work = forces.iter().zip(&moved).fold(dry, |sum, (f, p)| sum + dot(f, p));
        work + accelerations[j] * rotor(&arm.joints[j]) + rates[j] * drive.viscous
    };
    (0..n).map(torque).collect()
}

fn dot<T: Number>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A point of a row: in its frame, or along the straight line from the frame before.
struct Point {
    mass: f64,
    at: Place,
}

enum Place {
    Frame(Vector3<f64>),
    Chord(f64),
}

/// The points of every row; `None` where one is of no body.
fn points(arm: &Arm) -> Option<Vec<Vec<Point>>> {
    arm.joints.iter().map(of_row).collect()
}

fn of_row(joint: &Joint) -> Option<Vec<Point>> {
    let mut points = Vec::new();
    if joint.mass > 0.0 {
        let tensor = joint.inertia;
        let moments = Matrix3::from_diagonal_element(tensor.trace() / 2.0) - tensor;
        let eigen = moments.symmetric_eigen();
        for (moment, axis) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            // What rounding leaves below zero of a body that is thin.
            let moment = if moment.abs() < 1e-15 * tensor.norm() { 0.0 } else { *moment };
            let far = (3.0 * moment / joint.mass).sqrt();
            if far.is_nan() {
                return None;
            }
            let place = |side: f64| Place::Frame(joint.com + axis * (side * far));
            points.extend([1.0, -1.0].map(|s| Point { mass: joint.mass / 6.0, at: place(s) }));
        }
    }
    if let Some(beam) = joint.beam.as_ref().filter(|_| joint.motion == Motion::Revolute) {
        let mass = beam.density * beam.area * joint.a.hypot(joint.d);
        let off = 0.5 / 3.0_f64.sqrt();
        points.extend(
            [0.5 - off, 0.5 + off].map(|part| Point { mass: mass / 2.0, at: Place::Chord(part) }),
        );
    }
    Some(points)
}

/// Where all points are.
fn places<T: Number>(arm: &Arm, points: &[Vec<Point>], frames: &[Frame<T>]) -> Vec<[T; 3]> {
    let mut last: [T; 3] = arm.base.translation.vector.map(T::from).into();
    let mut found = Vec::new();
    for (points, frame) in points.iter().zip(frames) {
        let here = origin(frame);
        found.extend(points.iter().map(|point| match point.at {
            Place::Frame(p) => {
                core::array::from_fn(|k| (0..3).fold(here[k], |sum, c| sum + frame[k][c] * p[c]))
            }
            Place::Chord(part) => core::array::from_fn(|k| here[k] * part + last[k] * (1.0 - part)),
        }));
        last = here;
    }
    found
}

/// `m (p̈ − g)` of every point along `q + q̇ t + q̈ t²/2`.
fn inertial<T: Number>(
    arm: &Arm,
    points: &[Vec<Point>],
    q: &[T],
    rates: &[T],
    accelerations: &[T],
) -> Vec<[T; 3]> {
    let mut table = table(arm, q, Dual2::from_re);
    for (k, joint) in arm.joints.iter().enumerate() {
        let cell = &mut table.rows[k][moving(joint)];
        (cell.v1, cell.v2) = (rates[k], accelerations[k]);
    }
    let places = places(arm, points, &frames(arm.convention, &table));
    let gravity: [f64; 3] = (arm.base.rotation * arm.gravity).into();
    let force = |(p, point): ([Dual2<T>; 3], &Point)| {
        core::array::from_fn(|k| (p[k].v2 - gravity[k]) * point.mass)
    };
    places.into_iter().zip(points.iter().flatten()).map(force).collect()
}

/// `∂p/∂q_j` of every point.
fn slopes<T: Number>(arm: &Arm, points: &[Vec<Point>], q: &[T], j: usize) -> Vec<[T; 3]> {
    let mut table = table(arm, q, Dual::from_re);
    table.rows[j][moving(&arm.joints[j])].eps = T::from(1.0);
    let places = places(arm, points, &frames(arm.convention, &table));
    places.into_iter().map(|p| p.map(|x| x.eps)).collect()
}
