//! The closed forms of arms with seven joints, beside one with six: nanoseconds per pose.
//!
//! ```text
//! cargo bench -p stiffarm-bench --bench closed_forms
//! ```
//!
//! It is a crate of its own: more arms in that of `speed` change which functions are inlined there.

use stiffarm_bench::arms::inverse::{iiwa14, kuka_kr240, panda};
use stiffarm_bench::timing::{Candidate, print};
use stiffarm_draws::Draws;
use stiffarm_kernels::{Inverse, Pose, has};

const POSES: usize = 2048;
const ROUNDS: usize = 41;

/// Every branch at poses of the arm's own, of which one is to be the posture.
fn time<const N: usize, A: Inverse<N, 8> + has::Pose<N>>(name: &str, arm: &A) {
    let stands = |q: &[f64; N]| -> (Pose<f64>, [f64; N]) { (arm.pose(&arm.posture(q)), *q) };
    let poses: Vec<_> = Draws::new(1).postures::<N>(POSES).iter().map(stands).collect();
    for (pose, q) in &poses {
        let found = arm.inverse_kinematics(pose, q);
        assert!(found.nearest(q, &[None; N], (1e-9, 1e-9)).is_some(), "{name}: {q:?}");
    }
    let input = (&poses[..], &vec![(); POSES][..]);
    let all = |(pose, q): &(Pose<f64>, [f64; N]), _: &()| arm.inverse_kinematics(pose, q);
    print(name, &mut [Candidate::new("all branches", 1, input, all)], ROUNDS);
}

fn main() {
    println!("the closed form: ns per pose");
    time("kuka_kr240", &kuka_kr240::Robot);
    time("panda", &panda::Robot);
    time("iiwa14", &iiwa14::Robot);
}
