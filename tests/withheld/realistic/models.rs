//! The kinds of arm: parallel axes, a large one, seven joints, a small one.

use nalgebra::Vector3;
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Robot, Value};
use stiffarm_kernels::generic::Arm;

use crate::arms::{arm, file};

/// A kind of arm and what it carries.
pub struct Model {
    pub robot: &'static str,
    /// Of the first joint where the file leaves them rigid, N·m/rad; a third of it at the tip.
    stiffness: f64,
    /// Largest vertical force on the tool, N.
    pub force: f64,
}

/// Payloads of the makers' data sheets, stiffnesses of arms of that size.
pub const MODELS: [Model; 4] = [
    Model { robot: "ur10", stiffness: 4.5e4, force: 80.0 },
    Model { robot: "kuka_kr240", stiffness: 0.0, force: 2000.0 },
    Model { robot: "iiwa14", stiffness: 3e4, force: 120.0 },
    Model { robot: "irb120", stiffness: 3e4, force: 30.0 },
];

/// Links of an arm of 1150 kg, kg and m: the file of the KR 240 has none.
const HEAVY: [(f64, [f64; 3]); 6] = [
    (300.0, [0.1, 0.0, -0.1]),
    (230.0, [0.6, 0.0, 0.1]),
    (170.0, [0.05, 0.1, 0.0]),
    (60.0, [0.0, -0.02, -0.15]),
    (35.0, [0.0, 0.05, 0.0]),
    (12.0, [0.0, 0.0, -0.05]),
];

impl Model {
    /// As a user's robot file has it: springs and weights, everything as designed.
    pub fn arm(&self) -> Arm {
        let mut arm = arm(self.robot, self.stiffness);
        if arm.joints.iter().all(|joint| joint.mass == 0.0) {
            for (joint, (mass, com)) in arm.joints.iter_mut().zip(HEAVY) {
                (joint.mass, joint.com) = (mass, Vector3::from(com));
            }
        }
        arm
    }

    /// The file of that arm.
    pub fn file(&self, arm: &Arm) -> Robot {
        let value = |x: f64| Value::Number(Number::Rounded(x));
        let mut robot = file(self.robot);
        for (row, joint) in robot.joints.iter_mut().zip(&arm.joints) {
            row.stiffness = Some(value(1.0 / joint.compliance));
            row.mass = Some(value(joint.mass));
            row.com = [0, 1, 2].map(|k| value(joint.com[k]));
        }
        robot
    }
}
