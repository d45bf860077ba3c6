//! Poses in f32 against poses in f64, of every arm of the collection: what a core without double
//! precision loses.

use core::f64::consts::PI;

use stiffarm::kernels::{Kernels, Output, Scalar};
use stiffarm_draws::Draws;
use stiffarm_robots::{ARMS, SYMBOLIC, jweeg_two_link, lin_elbow_symbolic, lin_planar_symbolic};

/// Postures of each arm, within ±π (m for joints that slide).
const POSTURES: usize = 10_000;

/// A symbolic arm in both precisions: its lengths, and 1 for what a pose does not depend on.
macro_rules! symbolic {
    ($arm:ident, { $($length:ident: $value:literal),* }, [$($one:ident),*]) => {{
        fn parameters<S: Scalar>() -> $arm::Parameters<S> {
            $arm::Parameters { $($length: S::lit($value),)* $($one: S::lit(1.0),)* }
        }
        let double = $arm::Robot::new(&parameters::<f64>());
        let single = $arm::Robot::new(&parameters::<f32>());
        check(stringify!($arm), &double, &single);
    }};
}

fn pose<S: Scalar>(arm: &dyn Kernels<S>, q: &[S]) -> [S; 12] {
    let mut out = [S::lit(0.0); 12];
    arm.evaluate(Output::Pose, q, &[S::lit(0.0); 6], &mut out).expect("an arm has a pose");
    out
}

/// The position to 5e-7 of the arm's reach; the axes to that and what the sums of angles round.
fn check(id: &str, double: &dyn Kernels<f64>, single: &dyn Kernels<f32>) {
    let mut draws = Draws::new(1);
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (mut reach, mut off, mut turned) = (0.0f64, 0.0f64, 0.0f64);
    for _ in 0..POSTURES {
        // Angles that both precisions have: what is compared is the arithmetic.
        let q: Vec<f32> = (0..double.dof()).map(|_| (PI * draws.unit()) as f32).collect();
        let exact = pose(double, &q.iter().map(|x| f64::from(*x)).collect::<Vec<_>>());
        let found = pose(single, &q);
        let error: Vec<f64> = exact.iter().zip(found).map(|(a, b)| f64::from(b) - a).collect();
        reach = reach.max(norm(&exact[9..]));
        off = off.max(norm(&error[9..]));
        turned = error[..9].iter().fold(turned, |most, x| most.max(x.abs()));
    }
    assert!(off <= 5e-7 * reach, "{id}: {:e} of the reach", off / reach);
    // A sum of k angles within ±π rounds by half a unit of kπ at most, 2^-24 kπ.
    let n = double.dof() as f64;
    let sums = PI * 2f64.powi(-24) * (n * (n + 1.0) / 2.0 - 1.0);
    assert!(turned <= 5e-7 + sums, "{id}: axes {turned:e} off");
    // Double precision in the place of single would pass as well, and prove nothing.
    assert!(off > 1e-9 * reach, "{id}: {off:e} m is too good for single precision");
}

#[test]
fn poses_in_single_precision_are_off_by_less_than_half_a_millionth_of_the_reach() {
    for arm in ARMS {
        check(arm.id, arm.kernels, arm.kernels_f32);
    }
    symbolic!(lin_planar_symbolic, { L1: 0.6096, L2: 0.6096 },
        [E1, E2, G1, G2, A1, A2, Iy1, Iy2, I1, I2, J1, J2, rho1, rho2]);
    symbolic!(lin_elbow_symbolic, { a2: 0.6096, a3: 0.55, a4: 0.254, d6: 0.0889 },
        [E2, E3, E4, E6, G2, G3, G4, G6, A2, A3, A4, A6, I2, I3, I4, I6, J2, J3, J4, J6,
         rho2, rho3, rho4, rho6]);
    symbolic!(jweeg_two_link, { a1: 0.4, a2: 0.35 }, []);
    assert_eq!(SYMBOLIC.len(), 3, "the arms that are listed here");
}
