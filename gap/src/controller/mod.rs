//! What was found, in the files that controllers take: each holds what its format can, and what it cannot is named.

mod kuka;
mod ros;
mod ur;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

pub use kuka::mastering;
pub use ros::joint_limits;
pub use ur::{calibration, kinematics};

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
