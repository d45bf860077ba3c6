//! Every arm of the collection.

use stiffarm::kernels::parity::{self, Subject};
use stiffarm::kernels::{Output, has};
use stiffarm_draws::few_or_many;

use crate::compare::{Draws, agrees, collection};

/// States of each arm; the claim "10,000 random joint vectors and wrenches per robot" is the ignored test's.
const COUNT: usize = 500;

fn every_arm(states: usize) {
    collection().for_each(|(entry, _, arm)| agrees(entry.id, &arm, entry.kernels, (states, 1)));
}

#[test]
fn double_precision_agrees_to_1e_12() {
    every_arm(few_or_many(100, COUNT));
}

#[test]
#[ignore = "ten thousand states of every arm take minutes"]
fn double_precision_agrees_to_1e_12_at_ten_thousand_states() {
    every_arm(10_000);
}

/// In both precisions, by the textbook, its differences and dual numbers: what `stiffarm check` does
/// with a derived graph, with the compiled kernels.
#[test]
fn compiled_kernels_agree_in_every_way() {
    for (entry, _, arm) in collection() {
        let double = parity::compiled(entry.kernels, |x: f64| x);
        let single = parity::compiled(entry.kernels_f32, |x: f32| f64::from(x));
        let outputs = entry.kernels.outputs();
        let subject =
            Subject { outputs, arm: &arm, beyond: None, generated: &double, single: Some(&single) };
        for line in parity::agreement(&subject, few_or_many(100, COUNT), 2, &|_| {}).lines {
            assert_eq!(line.exceeded().next(), None, "{} {line:?}", entry.id);
            assert!(line.worst[0].is_some() && line.worst[1].is_some(), "{} {line:?}", entry.id);
        }
    }
}

#[test]
fn slices_of_the_wrong_length_are_refused() {
    use stiffarm::kernels::Error;
    let arm = stiffarm_robots::arm("ur5").expect("the collection has a UR5");
    let mut out = [0.0; 12];
    let short = arm.kernels.evaluate(Output::Pose, &[0.0; 5], &[0.0; 6], &mut out);
    assert_eq!(short, Err(Error::Length));
    let small = arm.kernels.evaluate(Output::Jacobian, &[0.0; 6], &[0.0; 6], &mut out);
    assert_eq!(small, Err(Error::Length));
    assert_eq!(out, [0.0; 12], "nothing is written on an error");
}

/// The accelerations that torques are told to have need these torques: `M (q̈ − M⁻¹ (τ − b)) = 0`, relative to what is
/// summed there, for the solve is as exact as its matrix.
#[test]
fn forward_dynamics_gives_the_motion_back() {
    fn left<const N: usize, A>(arm: &A) -> f64
    where
        A: has::InverseDynamics<N> + has::ForwardDynamics<N> + has::MassMatrix<N>,
    {
        let mut draws = Draws::new(41);
        let mut worst = 0.0_f64;
        for _ in 0..few_or_many(100, COUNT) {
            let [q, rates, accelerations]: [[f64; N]; 3] =
                core::array::from_fn(|_| core::array::from_fn(|_| 3.0 * draws.unit()));
            let posture = arm.posture(&q);
            let torques = arm.inverse_dynamics(&posture, &rates, &accelerations);
            let back = arm.forward_dynamics(&posture, &rates, &torques).expect("masses move");
            let mass = arm.mass_matrix(&posture);
            for column in &mass {
                let row = |of: &dyn Fn(usize) -> f64| -> f64 { (0..N).map(of).sum() };
                let off = row(&|i| column[i] * (back[i] - accelerations[i])).abs();
                let size = row(&|i| (column[i] * accelerations[i]).abs());
                let most = torques.iter().fold(size, |most, torque| most.max(torque.abs()));
                worst = worst.max(off / most);
            }
        }
        worst
    }
    let worst = [left(&stiffarm_robots::ur10::Robot), left(&stiffarm_robots::panda::Robot)];
    println!("{:.1e} {:.1e}", worst[0], worst[1]);
    assert!(worst.iter().all(|left| *left <= 1e-12), "{worst:?}");
}
