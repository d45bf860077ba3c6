//! The links of random chains in space by the unit-load method: virtual work of the section forces
//! integrated along every beam, with no flexibility matrix and no transport to the tool.

use std::vec::Vec;

use nalgebra::{Rotation3, Vector3, Vector6};

use super::support::cases;
use crate::Motion;
use crate::generic::{Arm, Convention};

/// Points and weights of Gauss and Legendre on (0, 1): exact to the fifth degree, and the
/// product of a weight's moment (second degree) and a unit force's (first) is of the third.
fn gauss() -> [(f64, f64); 3] {
    let off = (3.0_f64 / 5.0).sqrt() / 2.0;
    [(0.5 - off, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + off, 5.0 / 18.0)]
}

/// A force and the point on which it acts.
type Force = (Vector3<f64>, Vector3<f64>);

/// Force and moment of forces and a free moment about the section at `point`.
fn section(point: &Vector3<f64>, forces: &[Force], moment: Vector3<f64>) -> [Vector3<f64>; 2] {
    let force = forces.iter().map(|(force, _)| force).sum();
    let arms = forces.iter().map(|(force, at)| (at - point).cross(force));
    [force, arms.sum::<Vector3<f64>>() + moment]
}

/// Twist of the tool by the bending of the links under the wrench and all weights.
fn unit_load(arm: &Arm, q: &[f64], w: &Vector6<f64>) -> Vector6<f64> {
    let frames = arm.frames(q);
    let origin = |i: usize| frames[i].translation.vector;
    let tool = arm.pose(q).translation.vector;
    // The file's gravity is told in the base's axes.
    let gravity = arm.base.rotation * arm.gravity;
    let mut twist = Vector6::zeros();
    for (i, joint) in arm.joints.iter().enumerate() {
        let Some(beam) = &joint.beam else { continue };
        let chord = origin(i + 1) - origin(i);
        let length = chord.norm();
        if length == 0.0 {
            continue;
        }
        let x = chord / length;
        let across = (frames[i] * Vector3::z()).cross(&x);
        let y = if across.norm() > 1e-6 {
            across.normalize()
        } else {
            match arm.convention {
                Convention::Standard => {
                    frames[i + 1] * (Rotation3::new(-joint.beta * Vector3::y()) * Vector3::x())
                }
                Convention::Modified => frames[i] * Vector3::x(),
            }
        };
        let z = x.cross(&y);

        // Masses of links i, ..., n and beams i+1, ..., n.
        let mut beyond: Vec<Force> = Vec::new();
        for (k, joint) in arm.joints.iter().enumerate().skip(i) {
            let centre = frames[k + 1].transform_point(&joint.com.into()).coords;
            beyond.push((joint.mass * gravity, centre));
            if let (Some(beam), true) = (&joint.beam, k > i) {
                let mass = beam.density * beam.area * (origin(k + 1) - origin(k)).norm();
                beyond.push((mass * gravity, (origin(k) + origin(k + 1)) / 2.0));
            }
        }
        let (f, m) = (Vector3::new(w[0], w[1], w[2]), Vector3::new(w[3], w[4], w[5]));
        beyond.push((f, tool));

        for (part, share) in gauss() {
            let point = origin(i) + chord * part;
            let rest = length * (1.0 - part);
            let mut forces = beyond.clone();
            forces.push((beam.density * beam.area * rest * gravity, (point + origin(i + 1)) / 2.0));
            let [force, moment] = section(&point, &forces, m);
            let (e, g) = (beam.youngs_modulus, beam.shear_modulus);
            let stretch = force.dot(&x) / (e * beam.area);
            let slip = beam.shear_coefficient.map_or(0.0, |kappa| 1.0 / (kappa * g * beam.area));
            let twisting = moment.dot(&x) / (g * beam.j);
            let (about_y, about_z) =
                (moment.dot(&y) / (e * beam.iy), moment.dot(&z) / (e * beam.iz));
            for k in 0..6 {
                let unit = Vector3::ith(k % 3, 1.0);
                let [force_1, moment_1] = match k {
                    0..3 => section(&point, &[(unit, tool)], Vector3::zeros()),
                    _ => section(&point, &[], unit),
                };
                let shear = force.dot(&y) * force_1.dot(&y) + force.dot(&z) * force_1.dot(&z);
                let work = stretch * force_1.dot(&x)
                    + slip * shear
                    + twisting * moment_1.dot(&x)
                    + about_y * moment_1.dot(&y)
                    + about_z * moment_1.dot(&z);
                twist[k] += length * share * work;
            }
        }
    }
    twist
}

#[test]
fn links_bend_as_virtual_work_says() {
    let mut bent = 0;
    for (mut arm, q, w) in cases() {
        for joint in &mut arm.joints {
            joint.compliance = 0.0;
        }
        let expected = unit_load(&arm, &q, &w);
        let calculated = arm.deflection_with_gravity(&q, &w).unwrap();
        // Some hundred products and sums of like size.
        assert!((calculated - expected).norm() <= 1e-13 * expected.norm());
        bent += usize::from(expected.norm() > 0.0);

        for joint in &mut arm.joints {
            joint.mass = 0.0;
            if let Some(beam) = &mut joint.beam {
                beam.density = 0.0;
            }
        }
        let expected = unit_load(&arm, &q, &w);
        let calculated = arm.deflection(&q, &w).unwrap();
        assert!((calculated - expected).norm() <= 1e-13 * expected.norm());
        let calculated = arm.compliance(&q) * w;
        assert!((calculated - expected).norm() <= 1e-13 * expected.norm());
    }
    assert!(bent > 100);
}

/// The cases hold what makes the beams' axes hard: chords along the axis, prismatic beams.
#[test]
fn cases_cover_every_kind_of_beam() {
    let rows = || cases().flat_map(|(arm, ..)| arm.joints).filter(|joint| joint.beam.is_some());
    assert!(rows().any(|joint| joint.a == 0.0 && joint.d == 0.0));
    assert!(rows().any(|joint| joint.a == 0.0 && joint.d != 0.0));
    assert!(rows().any(|joint| joint.a != 0.0 && joint.d != 0.0));
    assert!(rows().any(|joint| joint.motion == Motion::Prismatic));
}
