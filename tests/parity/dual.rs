//! Derivatives by dual numbers (num-dual) and by central differences.

use num_dual::Dual64 as Dual;
use stiffarm::kernels::{Kernels, Output, Scalar};

use crate::compare::{Draws, block, relative};
use crate::fixtures;

/// ∂output/∂q_i as (dual numbers, central differences).
fn slopes<R: Kernels<Dual> + Kernels<f64>>(
    robot: &R,
    output: Output,
    (q, wrench): (&[f64], &[f64; 6]),
    joint: usize,
) -> (Vec<f64>, Vec<f64>) {
    let mut dual: Vec<Dual> = q.iter().map(|x| Dual::lit(*x)).collect();
    dual[joint].eps = 1.0;
    let by_dual = block::<Dual>(robot, output, &dual, &wrench.map(Dual::lit));
    let step = 1e-5;
    let moved = |by: f64| {
        let mut q = q.to_vec();
        q[joint] += by;
        block::<f64>(robot, output, &q, wrench)
    };
    let differences =
        moved(step).into_iter().zip(moved(-step)).map(|(a, b)| (a - b) / (2.0 * step));
    (by_dual.into_iter().map(|d| d.eps).collect(), differences.collect())
}

/// The twist of a pose from its derivative: ω from `R' Rᵀ`.
fn twist(slope: &[f64], pose: &[f64]) -> Vec<f64> {
    let skew = |r: usize, c: usize| (0..3).map(|k| slope[3 * k + r] * pose[3 * k + c]).sum::<f64>();
    vec![slope[9], slope[10], slope[11], skew(2, 1), skew(0, 2), skew(1, 0)]
}

fn check<R: Kernels<Dual> + Kernels<f64>>(robot: &R, range: f64) {
    let n = Kernels::<f64>::dof(robot);
    let mut draws = Draws::new(4);
    for _ in 0..200 {
        let q: Vec<f64> = (0..n).map(|_| range * draws.unit() + 0.6).collect();
        let wrench = draws.load();
        let pose = block::<f64>(robot, Output::Pose, &q, &wrench);
        let jacobian = block::<f64>(robot, Output::Jacobian, &q, &wrench);
        let pairs = [
            (Output::JointTorque, Output::ComplementaryStiffness),
            (Output::WeightTorque, Output::WeightStiffness),
        ];
        for joint in 0..n {
            let (dual, difference) = slopes(robot, Output::Pose, (&q, &wrench), joint);
            let column = &jacobian[6 * joint..6 * joint + 6];
            // Central differences of step 1e-5 err by about 1e-10 of the scale plus 1e-11 of rounding.
            assert!(relative(&twist(&dual, &pose), column, 1.0) < 1e-13);
            assert!(relative(&twist(&difference, &pose), column, 1.0) < 1e-8);
            for (value, slope) in pairs {
                let matrix = block::<f64>(robot, slope, &q, &wrench);
                let scale = matrix.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                let (dual, difference) = slopes(robot, value, (&q, &wrench), joint);
                for (row, expected) in matrix[n * joint..n * joint + n].iter().enumerate() {
                    assert!((dual[row] - expected).abs() <= 1e-13 * scale);
                    assert!((difference[row] - expected).abs() <= 1e-7 * scale);
                }
            }
        }
    }
}

#[test]
fn jacobian_and_stiffness_are_derivatives() {
    use stiffarm_robots::{iiwa14, kuka_kr240, panda, stanford, ur5};
    check(&ur5::Robot, 3.0);
    check(&kuka_kr240::Robot, 3.0);
    check(&iiwa14::Robot, 3.0);
    check(&panda::Robot, 3.0);
    check(&stanford::Robot, 1.0);
    check(&fixtures::oblique::Robot, 3.0);
    check(&fixtures::sliding::Robot, 0.5);
    check(&fixtures::parallel::Robot, 3.0);
}

#[test]
fn the_regressor_is_the_derivative_by_joint_compliance() {
    // Of a robot whose stiffnesses are symbolic, by duals in the stiffness: dδ/dk = -B/k².
    use fixtures::symbolic::{Constants, compliance_regressor, deflection_first_order};
    let mut draws = Draws::new(5);
    let p = fixtures::PARAMETERS;
    for _ in 0..200 {
        let q: [f64; 4] = core::array::from_fn(|_| 0.6 + 0.4 * draws.unit());
        let wrench = draws.load();
        let regressor = compliance_regressor(&Constants::new(&p), &q, &wrench);
        let mut dual = fixtures::parameters_as(Dual::lit);
        dual.k2.eps = 1.0;
        let constants: Constants<Dual> = Constants::new(&dual);
        let (q, wrench) = (q.map(Dual::lit), wrench.map(Dual::lit));
        let slope = deflection_first_order(&constants, &q, &wrench).map(|d| -d.eps * p.k2 * p.k2);
        assert!(relative(&slope, &regressor[1], 0.0) < 1e-12);
    }
}
