//! Kernels refuse the loads that the textbook refuses, and no other: forces, moments, and both, scaled
//! through the boundary.

use stiffarm::kernels::generic::Arm;
use stiffarm::kernels::{Error, Kernels, Output, Scalar};

use crate::boundary::{KINDS, around};
use crate::compare::{Draws, ForArm, known};
use crate::fixtures;

fn refuses<S: Scalar>(
    kernels: &dyn Kernels<S>,
    output: Output,
    q: &[f64],
    wrench: &[f64; 6],
) -> bool {
    let q: Vec<S> = q.iter().map(|x| S::lit(*x)).collect();
    match kernels.evaluate(output, &q, &wrench.map(S::lit), &mut [S::lit(0.0); 6]) {
        Ok(()) => false,
        Err(error) => {
            assert_eq!(error, Error::Unstable);
            true
        }
    }
}

/// Loads of every kind through their boundaries; how many there are of each kind, in double and in single
/// precision.
fn check<R: Kernels<f64> + Kernels<f32>>(name: &str, arm: &Arm, kernels: &R) -> [[usize; 2]; 3] {
    let mut draws = Draws::new(11);
    KINDS.map(|kind| {
        let mut found = [0; 2];
        for _ in 0..stiffarm_draws::few_or_many(30, 100) {
            // Numbers of single precision, so that both are asked the same.
            let q: Vec<f64> = draws.posture(arm).iter().map(|x| f64::from(*x as f32)).collect();
            let direction = kind.direction(&mut draws);
            for output in [Output::Deflection, Output::DeflectionWithGravity] {
                let place = || format!("{name} {} {kind:?} at {q:?}", output.name());
                let around = |epsilon| around(arm, output, &q, &direction, epsilon);
                if let Some(loads) = around(f64::EPSILON) {
                    let told = loads.map(|w| refuses::<f64>(kernels, output, &q, &w));
                    assert_eq!(told, [false, true], "{} {loads:?}", place());
                    found[0] += 1;
                }
                if let Some(loads) = around(f64::from(f32::EPSILON)) {
                    let told = loads.map(|w| refuses::<f32>(kernels, output, &q, &w));
                    assert_eq!(told, [false, true], "{} {loads:?}", place());
                    found[1] += 1;
                }
            }
        }
        found
    })
}

#[test]
fn refusals_agree_on_both_sides_of_the_boundary() {
    let (_, kuka) = known("kuka_kr240");
    let of =
        |module: &str| stiffarm_gap::robot::arm(&fixtures::table(module)).expect("numbers only");
    let found = [
        check("kuka_kr240", &kuka, &stiffarm_robots::kuka_kr240::Robot),
        check("oblique", &of("oblique"), &fixtures::oblique::Robot),
        check("sliding", &of("sliding"), &fixtures::sliding::Robot),
        check("parallel", &of("parallel"), &fixtures::parallel::Robot),
    ];
    let least = stiffarm_draws::few_or_many([45, 30], [150, 100]);
    let enough = |[double, single]: [usize; 2]| double > least[0] && single > least[1];
    assert!(found[..3].iter().flatten().all(|found| enough(*found)), "{found:?}");
    // All axes but the last are parallel, and that one has no lever: a moment has no antisymmetric part.
    assert!(enough(found[3][0]) && enough(found[3][2]), "{found:?}");
}

/// Perpendicular axes under a moment about the third direction: the joints' springs are 1.5e5 and 6e4,
/// half the moment stands beside the diagonal, so it is borne up to twice the root of their product.
#[test]
fn a_moment_is_borne_up_to_the_springs() {
    let robot = fixtures::perpendicular::Robot;
    let limit = 2.0 * (1.5e5f64 * 6e4).sqrt();
    for (moment, refused) in [(limit * (1.0 - 1e-14), false), (limit * (1.0 + 1e-14), true)] {
        for sign in [-1.0, 1.0] {
            let wrench = [0.0, 0.0, 0.0, sign * moment, 0.0, 0.0];
            assert_eq!(refuses::<f64>(&robot, Output::Deflection, &[0.0; 2], &wrench), refused);
            let textbook = stiffarm_gap::robot::arm(&fixtures::table("perpendicular")).unwrap();
            let outcome = textbook.evaluate(Output::Deflection, &[0.0; 2], &wrench);
            assert_eq!(outcome.is_err(), refused);
        }
    }
}
