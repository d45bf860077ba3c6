//! Small arms and rows that the tests of this crate share.

use core::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Matrix3, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Beam, Convention, Joint};
use stiffarm_table::robot::Robot;

use crate::effects::{Catalogue, Known, Spot};
use crate::measurement::{Kind, Layout, Measurements, Row};

fn joint(a: f64, alpha: f64, d: f64) -> Joint {
    Joint { d, a, alpha, mass: 12.0, com: Vector3::new(-a / 2.0, 0.0, 0.02), ..Joint::default() }
}

/// An elbow of three rigid joints with weights.
pub(crate) fn rigid() -> Arm {
    Arm {
        name: "elbow".to_owned(),
        convention: Convention::Standard,
        joints: vec![joint(0.1, FRAC_PI_2, 0.4), joint(0.7, 0.0, 0.0), joint(0.6, 0.0, 0.05)],
        tool: Isometry3::translation(0.1, 0.0, 0.05),
        gravity: Vector3::new(0.0, 0.0, -9.80665),
        ..Arm::default()
    }
}

/// The same with inertias, rotors and friction.
pub(crate) fn geared() -> Arm {
    let mut arm = rigid();
    for joint in &mut arm.joints {
        joint.inertia = Matrix3::identity() * 0.3;
        joint.limits = Some([-FRAC_PI_2, FRAC_PI_2]);
        joint.drive.gear = 100.0;
        joint.drive.rotor_inertia = 1e-4;
        (joint.drive.coulomb, joint.drive.viscous) = (4.0, 2.0);
    }
    arm
}

/// The rigid elbow with a spring at every joint.
pub(crate) fn springy() -> Arm {
    let mut arm = rigid();
    for (joint, compliance) in arm.joints.iter_mut().zip([2e-6, 3e-6, 5e-6]) {
        joint.compliance = compliance;
    }
    arm
}

/// The same with bending links too.
pub(crate) fn bent() -> Arm {
    let mut arm = springy();
    for joint in &mut arm.joints[1..] {
        joint.beam = Some(Beam {
            youngs_modulus: 70e9,
            shear_modulus: 26e9,
            area: 2e-3,
            iy: 3e-6,
            iz: 3e-6,
            j: 6e-6,
            density: 2700.0,
            shear_coefficient: None,
        });
    }
    arm
}

/// The arm of a robot file.
pub(crate) fn arm(text: &str) -> Arm {
    crate::robot::arm(&Robot::from_toml(text, "arm.toml").unwrap().0).unwrap()
}

/// A KUKA KR 240-2, its tool where it is told.
pub(crate) fn kr240(tool: [f64; 3]) -> Arm {
    let text = include_str!("../../robots/arms/kuka_kr240.toml");
    Arm { tool: Isometry3::translation(tool[0], tool[1], tool[2]), ..arm(text) }
}

/// A row with readings and wrench.
pub(crate) fn row(q: &[f64], wrench: Vector6<f64>) -> Row {
    Row { wrench, ..Row::new(2, q.to_vec()) }
}

/// Measurements of these rows, each row's group as it stands.
pub(crate) fn table(rows: Vec<Row>, kind: Kind) -> Measurements {
    Measurements::new("test.csv", kind, rows)
}

/// A robot of revolute joints without markers.
pub(crate) fn layout(joints: usize) -> Layout {
    Layout::new(vec![Motion::Revolute; joints])
}

/// An effect of a robot file.
pub(crate) fn known(id: &str, place: &str, form: usize, values: &[f64]) -> Known {
    let effect = Catalogue::default().named(id).unwrap();
    let spot = Spot { place: place.parse().unwrap(), form };
    Known { effect, spot, values: values.to_vec(), session: None, at: Default::default() }
}
