//! Random arms and central differences.

use std::string::ToString;
use std::vec::Vec;

use nalgebra::{Isometry3, Matrix3, Vector3, Vector6};
use stiffarm_draws::Draws;

use crate::generic::{Arm, Beam, Convention, Drive, Joint};
use crate::{Motion, Output};

/// Random arms, and what they are asked.
pub struct Random(Draws);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(Draws::new(seed))
    }

    /// Evenly between `low` and `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.between(low, high)
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.0.chance(probability)
    }

    pub fn vector(&mut self, size: f64) -> Vector3<f64> {
        self.0.array(-size, size).into()
    }

    /// 100 N and 30 N·m or less along each axis.
    pub fn wrench(&mut self) -> Vector6<f64> {
        self.0.load().into()
    }

    pub fn posture(&mut self, arm: &Arm) -> Vec<f64> {
        arm.joints.iter().map(|_| self.between(-3.0, 3.0)).collect()
    }

    /// A beam whose two bending stiffnesses, torsion, axial and shear flexibility all differ.
    pub fn beam(&mut self, weightless: bool) -> Beam {
        Beam {
            youngs_modulus: self.between(60e9, 210e9),
            shear_modulus: self.between(25e9, 80e9),
            area: self.between(1e-3, 3e-3),
            iy: self.between(1e-6, 5e-6),
            iz: self.between(1e-6, 5e-6),
            j: self.between(1e-6, 5e-6),
            density: if weightless { 0.0 } else { self.between(2000.0, 8000.0) },
            shear_coefficient: self.chance(0.5).then_some(0.5),
        }
    }

    /// Of a body: second moments of its mass along three axes, turned.
    fn inertia(&mut self) -> Matrix3<f64> {
        let spread = Matrix3::from_fn(|_, _| self.between(-0.3, 0.3));
        let moments = spread * spread.transpose();
        Matrix3::from_diagonal_element(moments.trace()) - moments
    }

    fn drive(&mut self) -> Drive {
        Drive {
            gear: self.between(1.0, 100.0),
            rotor_inertia: self.between(0.0, 1e-3),
            coulomb: self.between(0.0, 5.0),
            viscous: self.between(0.0, 5.0),
        }
    }

    fn joint(&mut self) -> Joint {
        let motion = if self.chance(0.3) { Motion::Prismatic } else { Motion::Revolute };
        let right_angles = self.between(-2.0, 2.0).round();
        Joint {
            motion,
            theta: self.between(-3.0, 3.0),
            d: if self.chance(0.4) { 0.0 } else { self.between(-1.0, 1.0) },
            a: if self.chance(0.4) { 0.0 } else { self.between(-1.0, 1.0) },
            alpha: if self.chance(0.6) {
                right_angles * core::f64::consts::FRAC_PI_2
            } else {
                self.between(-3.0, 3.0)
            },
            beta: if self.chance(0.7) { 0.0 } else { self.between(-1.0, 1.0) },
            compliance: if self.chance(0.2) { 0.0 } else { self.between(1e-7, 1e-6) },
            mass: if self.chance(0.3) { 0.0 } else { self.between(1.0, 50.0) },
            com: self.vector(0.3),
            inertia: self.inertia(),
            drive: self.drive(),
            limits: None,
            beam: self.chance(0.7).then(|| self.beam(motion == Motion::Prismatic)),
        }
    }

    /// One to seven joints of both kinds, with masses, beams and a turned tool.
    pub fn arm(&mut self) -> Arm {
        let count = self.between(1.0, 7.999) as usize;
        let rotation = self.vector(1.5);
        Arm {
            name: "random".to_string(),
            convention: if self.chance(0.5) { Convention::Standard } else { Convention::Modified },
            joints: (0..count).map(|_| self.joint()).collect(),
            base: Isometry3::new(self.vector(1.0), self.vector(2.0)),
            tool: Isometry3::new(self.vector(0.5), rotation),
            tool_rotation_vector: rotation,
            gravity: self.vector(9.0),
        }
    }
}

/// A state for `output` at joint values `q`: what stands behind them is as good as random.
pub fn state(output: Output, q: &[f64]) -> Vec<f64> {
    let behind = |k: usize| [1.0, -0.6, 1.7][k / q.len()] * q[k % q.len()];
    (0..output.state(q.len())).map(behind).collect()
}

/// A random arm, posture and wrench for each of many seeds.
pub fn cases() -> impl Iterator<Item = (Arm, Vec<f64>, Vector6<f64>)> {
    (0..200).map(|seed| {
        let mut random = Random::new(seed);
        let arm = random.arm();
        let q = random.posture(&arm);
        let w = random.wrench();
        (arm, q, w)
    })
}

/// No point of the arm is farther from a joint's axis than this (and at least 1, so that it bounds
/// rotations too).
pub fn reach(arm: &Arm, q: &[f64]) -> f64 {
    let rows = arm.joints.iter().zip(q);
    let lengths = rows.map(|(joint, q)| joint.a.abs() + joint.d.abs() + q.abs() + joint.com.norm());
    1.0 + lengths.sum::<f64>() + arm.tool.translation.vector.norm()
}

/// The step of a central difference that balances its two errors, the cube root of ε.
pub const STEP: f64 = 6e-6;

/// What a central difference may be off, for a function whose values and derivatives do not exceed
/// `scale`: truncation is STEP²/6 = 6e-12 of it and one rounding ε/STEP = 4e-11; some tens of
/// roundings on the way make 1e-9.
pub fn difference_tolerance(scale: f64) -> f64 {
    1e-9 * scale
}

/// The central difference of `f` as entry `i` of `x` changes.
pub fn central<T>(x: &[f64], i: usize, f: impl Fn(&[f64]) -> T) -> T
where
    T: core::ops::Sub<Output = T> + core::ops::Div<f64, Output = T>,
{
    let at = |step: f64| {
        let mut moved = x.to_vec();
        moved[i] += step;
        f(&moved)
    };
    (at(STEP) - at(-STEP)) / (2.0 * STEP)
}

/// Twist per unit between the poses half a step before and after: translation and rotation vector.
pub fn twist_between(before: &Isometry3<f64>, after: &Isometry3<f64>) -> Vector6<f64> {
    let translation = after.translation.vector - before.translation.vector;
    let rotation = (after.rotation * before.rotation.inverse()).scaled_axis();
    let (t, r) = (translation / (2.0 * STEP), rotation / (2.0 * STEP));
    Vector6::new(t.x, t.y, t.z, r.x, r.y, r.z)
}
