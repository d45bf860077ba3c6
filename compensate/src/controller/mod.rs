//! What was found, in the files that controllers take: each holds what its format can, and what it cannot is named.

mod kuka;
mod ros;
mod ur;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention, Joint};

pub use kuka::mastering;
pub use ros::{joint_limits, origins};
pub use ur::{calibration, kinematics, model};

/// What is wrong with a controller's file, or with what should go into it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControllerError {
    /// Another number of joints than the format has.
    #[error("found {found} joints, expected {expected}")]
    Joints {
        /// Of the robot.
        found: usize,
        /// Of the format.
        expected: usize,
    },
    /// Rows of another form than those of the format.
    #[error("found {0}, expected rows of the standard convention with joints that turn")]
    Rows(String),
    /// An entry that the file lacks.
    #[error("found no `{0}`, expected {1}")]
    Missing(String, &'static str),
    /// An entry that is no number.
    #[error("line {line}: found `{found}`, expected {expected}")]
    Entry {
        /// From 1.
        line: usize,
        /// As it stands.
        found: String,
        /// What should.
        expected: &'static str,
    },
}

/// What the formats can hold of the difference of two tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Zeros of joints.
    Zeros,
    /// Rows of the table, up to the last axis.
    Rows,
}

/// What a format does not hold of an arm that its controller computes as `nominal`, a phrase each.
pub fn lost(nominal: &Arm, real: &Arm, holds: Holds) -> Vec<String> {
    let mut lost = Vec::new();
    let mut of = |what: &str, has: &dyn Fn(usize, &Joint) -> bool| {
        let joints = real.joints.iter().enumerate().filter(|(k, joint)| has(*k, joint));
        let names: Vec<String> = joints.map(|(k, _)| (k + 1).to_string()).collect();
        if !names.is_empty() {
            let word = if names.len() == 1 { "joint" } else { "joints" };
            lost.push(format!("the {what} of {word} {}", names.join(", ")));
        }
    };
    of("spring", &|_, joint| joint.compliance != 0.0);
    of("bending link", &|_, joint| joint.beam.is_some());
    let last = real.joints.len();
    // Of the last row a turn about y is behind the last axis.
    let beyond = |k: usize| holds == Holds::Zeros || k + 1 == last;
    of("beta", &|k, joint| beyond(k) && joint.beta != nominal.joints[k].beta);
    if holds == Holds::Zeros {
        for (name, entry) in [
            ("d", (|joint| joint.d) as fn(&Joint) -> f64),
            ("a", |joint| joint.a),
            ("alpha", |joint| joint.alpha),
        ] {
            of(name, &|k, joint| {
                let is_zero = name == "d" && joint.motion == Motion::Prismatic;
                !is_zero && entry(joint) != entry(&nominal.joints[k])
            });
        }
    }
    if nominal.tool != real.tool {
        lost.push("the tool".to_owned());
    }
    if real.base != nominal.base {
        lost.push("the base in the measuring frame".to_owned());
    }
    lost
}

/// The place of each axis (z) in the body before it at q = 0, and of the last frame in the last body.
fn axes(arm: &Arm) -> (Vec<Isometry3<f64>>, Isometry3<f64>) {
    let mut end = Isometry3::identity();
    let places = arm.joints.iter().map(|joint| {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), joint.theta);
        let axis = turn * Translation3::new(0.0, 0.0, joint.d);
        let link = Translation3::new(joint.a, 0.0, 0.0);
        match arm.convention {
            Convention::Standard => std::mem::replace(&mut end, link * tilt(joint)) * axis,
            Convention::Modified => tilt(joint) * link * axis,
        }
    });
    let places = places.collect();
    (places, end)
}

/// By what a row turns the next axis from its own: `Rx(alpha) Ry(beta)`.
fn tilt(joint: &Joint) -> UnitQuaternion<f64> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    turn(Vector3::x_axis(), joint.alpha) * turn(Vector3::y_axis(), joint.beta)
}

/// `x y z`, m, and `roll pitch yaw`, rad, as ROS tells a place; what is rounding of products of rotations is zero.
fn told(place: &Isometry3<f64>) -> [f64; 6] {
    const ROUNDING: f64 = 1e-15;
    let (roll, pitch, yaw) = place.rotation.euler_angles();
    let origin = place.translation.vector;
    let values = [origin.x, origin.y, origin.z, roll, pitch, yaw];
    values.map(|x| if x.abs() < ROUNDING { 0.0 } else { x })
}
