//! Frames that cannot be, and what cannot be told of them.

stiffarm::robot! {
    pub mod arm;
    convention: standard_dh;
    frame: Elbow on 1;
    frame: wrist on 4;
    frame: hand on a3;
    frame: camera translation [0, 0, 0.1];
    frame: upper on a1 translation [0, 0, x];
    marker: smr1;
    outputs: pose, pose at forearm, frames at upper, deflection_with_gravity at upper, jacobian at smr1, pose on upper;
    joint | theta | a
    a1    | q     | 1
    a2    | q     | 1
}

fn main() {
    let _ = arm::at::upper::pose(&[0.0, 0.0]);
}
