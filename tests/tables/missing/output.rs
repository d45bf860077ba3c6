//! An output that the arm was generated without, and an arm of other joints.

use stiffarm::kernels::has;

stiffarm::robot! {
    pub mod arm;
    outputs: pose, jacobian;
    convention: standard_dh;
    joint | theta | a
    a1    | q     | 1
}

fn soft<const N: usize>(_: &impl has::Compliance<N>) {}
fn moves<const N: usize>(_: &impl has::Jacobian<N>) {}

fn main() {
    moves::<1>(&arm::Robot);
    soft::<1>(&arm::Robot);
    moves::<2>(&arm::Robot);
}
