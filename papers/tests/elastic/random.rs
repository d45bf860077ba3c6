//! Random arms of both conventions, with springs and beams at most rows.

use nalgebra::{Isometry3, Vector3, Vector6};
use proptest::prelude::*;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Beam, Convention, Joint};
use stiffarm_papers::chain::elastic::{Axes, Elasticity};

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

fn length() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 3 => -0.8..0.8f64]
}

fn beam() -> impl Strategy<Value = Beam> {
    let section = prop::array::uniform3(1e-6..5e-6f64);
    (section, 1e-3..3e-3f64, prop::option::of(Just(0.5))).prop_map(|([iy, iz, j], area, shear)| {
        Beam {
            youngs_modulus: 70e9,
            shear_modulus: 26e9,
            area,
            iy,
            iz,
            j,
            density: 0.0,
            shear_coefficient: shear,
        }
    })
}

fn joint() -> impl Strategy<Value = Joint> {
    let motion = prop_oneof![3 => Just(Motion::Revolute), 1 => Just(Motion::Prismatic)];
    let alpha = prop_oneof![
        (-1..3i32).prop_map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2),
        -3.0..3.0f64
    ];
    let compliance = prop_oneof![1 => Just(0.0), 3 => 1e-6..1e-5f64];
    (motion, -3.0..3.0f64, length(), length(), alpha, compliance, prop::option::of(beam()))
        .prop_map(|(motion, theta, d, a, alpha, compliance, beam)| Joint {
            motion,
            theta,
            d,
            a,
            alpha,
            beta: 0.0,
            compliance,
            mass: 0.0,
            com: Vector3::zeros(),
            limits: None,
            beam,
        })
}

fn arm() -> impl Strategy<Value = Arm> {
    let convention = prop_oneof![Just(Convention::Standard), Just(Convention::Modified)];
    (convention, prop::collection::vec(joint(), 1..6), vector(0.3), vector(1.5)).prop_map(
        |(convention, joints, translation, rotation)| Arm {
            name: "random".to_owned(),
            convention,
            joints,
            base: Isometry3::identity(),
            tool: Isometry3::new(translation, rotation),
            tool_rotation_vector: rotation,
            gravity: Vector3::zeros(),
        },
    )
}

/// An arm, joint values, and a wrench of up to 500 N and 200 N·m along each axis.
pub fn case() -> impl Strategy<Value = (Arm, Vec<f64>, Vector6<f64>)> {
    arm().prop_flat_map(|arm| {
        let n = arm.dof();
        let q = prop::collection::vec(-3.0..3.0f64, n);
        let w = (vector(500.0), vector(200.0))
            .prop_map(|(f, m)| Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z));
        (Just(arm), q, w)
    })
}

pub fn elasticity() -> impl Strategy<Value = Elasticity> {
    (any::<bool>(), any::<bool>()).prop_map(|(deformed, foreshortening)| Elasticity {
        axes: if deformed { Axes::Deformed } else { Axes::Undeformed },
        foreshortening,
    })
}

/// No point is farther from any axis, m; at least 1.
pub fn reach(arm: &Arm, q: &[f64]) -> f64 {
    let rows = arm.joints.iter().zip(q);
    let sum: f64 = rows.map(|(joint, q)| joint.a.abs() + joint.d.abs() + q.abs()).sum();
    1.0 + sum + arm.tool.translation.vector.norm()
}
