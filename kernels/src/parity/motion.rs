//! The equations of motion by d'Alembert's principle on points: `τ_j = Σ m (p̈ − g) · ∂p/∂q_j`.
//!
//! A rigid body moves like six points with its mass, its centre and its second moments, a rod like two. Where
//! the points are is the forward kinematics alone; how they accelerate, and how each joint moves them, are its
//! derivatives by dual numbers. There is neither an angular velocity nor a tensor of inertia in it.

use std::vec::Vec;

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual2_64, Dual64};

use super::dual::{Frame, Number, frames, origin, table};
use crate::generic::{Arm, Joint};
use crate::{Motion, Output};

/// What an output of the equations of motion must be at a state; `None` where it is none of them, or where the
/// mass of some link is that of no body.
pub fn of(arm: &Arm, output: Output, state: &[f64]) -> Option<Vec<f64>> {
    let n = arm.dof();
    let (q, behind) = state.split_at(n);
    let rotor = |k: usize| arm.joints[k].drive.gear.powi(2) * arm.joints[k].drive.rotor_inertia;
    let (rates, accelerations) = behind.split_at(behind.len().min(n));
    match output {
        Output::InverseDynamics | Output::Bias => {
            let none = vec![0.0; n];
            let accelerations = if accelerations.is_empty() { &none } else { accelerations };
            let forces = inertial(arm, q, rates, accelerations)?;
            let torque = |(j, moved): (usize, Vec<Vector3<f64>>)| {
                let drive = &arm.joints[j].drive;
                let dry = if rates[j] == 0.0 { 0.0 } else { drive.coulomb * rates[j].signum() };
                let work: f64 = forces.iter().zip(&moved).map(|(f, p)| f.dot(p)).sum();
                work + rotor(j) * accelerations[j] + dry + drive.viscous * rates[j]
            };
            Some((0..n).map(|j| (j, slopes(arm, q, j))).map(torque).collect())
        }
        Output::MassMatrix => {
            let masses: Vec<f64> = points(arm)?.into_iter().flatten().map(|p| p.mass).collect();
            let moved: Vec<Vec<Vector3<f64>>> = (0..n).map(|j| slopes(arm, q, j)).collect();
            let entry = |i: usize, j: usize| {
                let pairs = masses.iter().zip(moved[i].iter().zip(&moved[j]));
                let own = if i == j { rotor(i) } else { 0.0 };
                pairs.map(|(m, (a, b))| m * a.dot(b)).sum::<f64>() + own
            };
            Some((0..n * n).map(|at| entry(at / n, at % n)).collect())
        }
        _ => None,
    }
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
fn inertial(
    arm: &Arm,
    q: &[f64],
    rates: &[f64],
    accelerations: &[f64],
) -> Option<Vec<Vector3<f64>>> {
    let points = points(arm)?;
    let mut table = table(arm, q, Dual2_64::from);
    for (k, joint) in arm.joints.iter().enumerate() {
        let cell = &mut table.rows[k][moving(joint)];
        (cell.v1, cell.v2) = (rates[k], accelerations[k]);
    }
    let places = places(arm, &points, &frames(arm.convention, &table));
    let gravity = arm.base.rotation * arm.gravity;
    let force = |(p, point): ([Dual2_64; 3], &Point)| {
        (Vector3::from(p.map(|x| x.v2)) - gravity) * point.mass
    };
    Some(places.into_iter().zip(points.iter().flatten()).map(force).collect())
}

/// `∂p/∂q_j` of every point.
fn slopes(arm: &Arm, q: &[f64], j: usize) -> Vec<Vector3<f64>> {
    let mut table = table(arm, q, Dual64::from);
    table.rows[j][moving(&arm.joints[j])].eps = 1.0;
    let points = points(arm).unwrap_or_default();
    let places = places(arm, &points, &frames(arm.convention, &table));
    places.into_iter().map(|p| Vector3::from(p.map(|x| x.eps))).collect()
}

/// The cell of a row that its joint moves.
fn moving(joint: &Joint) -> usize {
    match joint.motion {
        Motion::Revolute => 0,
        Motion::Prismatic => 1,
    }
}
