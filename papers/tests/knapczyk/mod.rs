//! Knapczyk & Ryska, "Stiffness matrix analysis of six-revolute serial manipulator": the FANUC
//! S-420F, what does and does not follow from the printed example. The
//! elements of its compliance are judged in the ledger.

mod example;

use stiffarm_kernels::generic::Arm;

/// PUMA 560 as quoted from Kim & Streit (1995), N·m/rad.
const PUMA: [f64; 6] = [66.23e3, 66.5e3, 11.61e3, 0.202e3, 0.101e3, 0.144e3];

/// The joint coordinates of section 2.1, degrees.
const PRINTED: [f64; 6] = [-84.91, 65.0, -12.31, 0.0, 9.64, 0.0];

/// Tab. 1 with springs on the first joints.
fn fanuc(stiffness: &[f64]) -> Arm {
    let mut arm = stiffarm_papers::methods::arm("fanuc_s420f").unwrap();
    for (joint, k) in arm.joints.iter_mut().zip(stiffness) {
        joint.compliance = 1.0 / k;
    }
    arm
}

fn printed() -> [f64; 6] {
    PRINTED.map(f64::to_radians)
}
