//! Outputs that there are not.

stiffarm::robot! {
    pub mod arm;
    outputs: pose, jacobain, stiffness of all, ;
    convention: standard_dh;
    joint | theta | a
    a1    | q     | 1
}

fn main() {
    let _ = arm::jacobian(&[0.0]);
}
