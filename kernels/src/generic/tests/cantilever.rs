//! One link against the closed forms of a cantilever, each load by itself.

use core::f64::consts::FRAC_PI_2;
use std::string::ToString;
use std::vec;

use nalgebra::{Vector3, Vector6};

use crate::Motion;
use crate::generic::{Arm, Beam, Convention, Joint};

const L: f64 = 0.8;
const E: f64 = 70e9;
const G: f64 = 26e9;
const A: f64 = 2e-3;
const IY: f64 = 4e-6;
const IZ: f64 = 1e-6;
const J: f64 = 3e-6;
const KAPPA: f64 = 0.5;
const RHO: f64 = 2700.0;

/// One rigid joint with an elastic link of `a` and `d`, without a tool.
fn link(convention: Convention, motion: Motion, a: f64, d: f64) -> Arm {
    let beam = Beam {
        youngs_modulus: E,
        shear_modulus: G,
        area: A,
        iy: IY,
        iz: IZ,
        j: J,
        density: RHO,
        shear_coefficient: Some(KAPPA),
    };
    let joint = Joint { motion, d, a, beam: Some(beam), ..Joint::default() };
    Arm {
        name: "cantilever".to_string(),
        convention,
        joints: vec![joint],
        gravity: Vector3::new(0.0, 0.0, -9.80665),
        ..Arm::default()
    }
}

/// The deflections are equal but for a few roundings of the largest entry.
fn assert_same(calculated: Vector6<f64>, expected: [f64; 6]) {
    let expected = Vector6::from(expected);
    let error = (calculated - expected).amax();
    assert!(error < 1e-14 * expected.amax(), "{calculated} is not {expected}");
}

/// What `force` along one of the six directions does to the tip.
fn under(arm: &Arm, q: f64, direction: usize, force: f64) -> Vector6<f64> {
    arm.deflection(&[q], &Vector6::ith(direction, force)).unwrap()
}

/// Translation of the tip per transverse force, with shear.
fn bend(i: f64) -> f64 {
    L.powi(3) / (3.0 * E * i) + L / (KAPPA * G * A)
}

/// Rotation of the tip per transverse force, and translation per moment.
fn slope(i: f64) -> f64 {
    L.powi(2) / (2.0 * E * i)
}

/// Rotation of the tip per moment.
fn turn(i: f64) -> f64 {
    L / (E * i)
}

/// Along x: z of the beam is the joint's axis, so that a force in the plane of the joint's motion
/// bends about z. Both conventions.
#[test]
fn horizontal_link() {
    for convention in [Convention::Standard, Convention::Modified] {
        let arm = link(convention, Motion::Revolute, L, 0.0);
        let columns = [
            [L / (E * A), 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, bend(IZ), 0.0, 0.0, 0.0, slope(IZ)],
            [0.0, 0.0, bend(IY), 0.0, -slope(IY), 0.0],
            [0.0, 0.0, 0.0, L / (G * J), 0.0, 0.0],
            [0.0, 0.0, -slope(IY), 0.0, turn(IY), 0.0],
            [0.0, slope(IZ), 0.0, 0.0, 0.0, turn(IZ)],
        ];
        for (direction, column) in columns.into_iter().enumerate() {
            assert_same(under(&arm, 0.0, direction, 100.0), column.map(|x| 100.0 * x));
        }
    }
}

/// Along the joint's axis: x of the frame that the beam is fixed in is its y, so that a force
/// along it bends about z. The joint's turn takes the beam along in the standard convention only.
#[test]
fn vertical_link() {
    for (convention, q) in [
        (Convention::Standard, 0.0),
        (Convention::Modified, 0.0),
        (Convention::Modified, FRAC_PI_2),
    ] {
        let arm = link(convention, Motion::Revolute, 0.0, L);
        assert_same(under(&arm, q, 0, 1.0), [bend(IZ), 0.0, 0.0, 0.0, slope(IZ), 0.0]);
        assert_same(under(&arm, q, 1, 1.0), [0.0, bend(IY), 0.0, -slope(IY), 0.0, 0.0]);
        assert_same(under(&arm, q, 5, 1.0), [0.0, 0.0, 0.0, 0.0, 0.0, L / (G * J)]);
    }
    let arm = link(Convention::Standard, Motion::Revolute, 0.0, L);
    assert_same(under(&arm, FRAC_PI_2, 0, 1.0), [bend(IY), 0.0, 0.0, 0.0, slope(IY), 0.0]);
}

/// Its own weight, across it and along it.
#[test]
fn own_weight() {
    let w = -RHO * A * 9.80665;
    let unloaded = Vector6::zeros();
    for convention in [Convention::Standard, Convention::Modified] {
        let sag = w * (L.powi(4) / (8.0 * E * IY) + L * L / (2.0 * KAPPA * G * A));
        let slope = -w * L.powi(3) / (6.0 * E * IY);
        let arm = link(convention, Motion::Revolute, L, 0.0);
        let calculated = arm.deflection_with_gravity(&[0.0], &unloaded).unwrap();
        assert_same(calculated, [0.0, 0.0, sag, 0.0, slope, 0.0]);

        let arm = link(convention, Motion::Revolute, 0.0, L);
        let calculated = arm.deflection_with_gravity(&[0.0], &unloaded).unwrap();
        assert_same(calculated, [0.0, 0.0, w * L * L / (2.0 * E * A), 0.0, 0.0, 0.0]);
    }
}

/// A mass away from the tip loads it with its moment too; the beam's own weight still counts.
#[test]
fn mass_at_the_end() {
    let mut arm = link(Convention::Standard, Motion::Revolute, L, 0.0);
    let own = arm.deflection_with_gravity(&[0.0], &Vector6::zeros()).unwrap();
    arm.joints[0].mass = 10.0;
    arm.joints[0].com = Vector3::new(0.1, 0.0, 0.0);
    let with_mass = arm.deflection_with_gravity(&[0.0], &Vector6::zeros()).unwrap();
    let f = -10.0 * 9.80665;
    let my = 0.1 * -f;
    let dz = f * bend(IY) - my * slope(IY);
    let ry = -f * slope(IY) + my * turn(IY);
    assert_same(with_mass - own, [0.0, 0.0, dz, 0.0, ry, 0.0]);
}

/// Without a shear coefficient only bending is left.
#[test]
fn euler_bernoulli() {
    let mut arm = link(Convention::Standard, Motion::Revolute, L, 0.0);
    arm.joints[0].beam.as_mut().unwrap().shear_coefficient = None;
    let bent = L.powi(3) / (3.0 * E * IZ);
    assert_same(under(&arm, 0.0, 1, 1.0), [0.0, bent, 0.0, 0.0, 0.0, slope(IZ)]);
}

/// A prismatic joint's beam is as long as the joint is extended, weightless, and nothing at zero.
#[test]
fn telescope() {
    let arm = link(Convention::Standard, Motion::Prismatic, 0.0, 0.0);
    assert_same(under(&arm, L, 0, 1.0), [bend(IZ), 0.0, 0.0, 0.0, slope(IZ), 0.0]);
    let compressed = under(&arm, L / 2.0, 2, 1.0);
    assert_same(compressed, [0.0, 0.0, L / (2.0 * E * A), 0.0, 0.0, 0.0]);
    assert_eq!(under(&arm, 0.0, 0, 1.0), Vector6::zeros());
    let weightless = arm.deflection_with_gravity(&[L], &Vector6::zeros()).unwrap();
    assert_eq!(weightless, Vector6::zeros());
}
