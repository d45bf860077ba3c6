//! The arms: those of the repository, with the stiffness that a file may lack.

use stiffarm_codegen::robot::Robot;
use stiffarm_kernels::generic::Arm;

/// The file of a built-in robot.
pub fn file(id: &str) -> Robot {
    let file = stiffarm_robots::arm(id).expect("a built-in robot");
    Robot::from_toml(file.toml, id).expect("a right file").0
}

/// The arm of a built-in robot. Joints that its file leaves rigid get the springs of an arm of its
/// size: from `stiffness` at the base, a third of that at the tip, N·m/rad.
pub fn arm(id: &str, stiffness: f64) -> Arm {
    let mut arm = stiffarm_gap::robot::arm(&file(id)).expect("numbers for everything");
    let last = (arm.dof() - 1).max(1) as f64;
    for (j, joint) in arm.joints.iter_mut().enumerate() {
        if joint.compliance == 0.0 {
            joint.compliance = 3_f64.powf(j as f64 / last) / stiffness;
        }
    }
    arm
}
