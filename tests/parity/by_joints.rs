//! Outputs that are generated on request: derivatives by the joints. Compiled, in both precisions, against the textbook,
//! its differences and dual numbers.

use stiffarm::kernels::parity::{self, Comparison, Subject};
use stiffarm::kernels::{Kernels, Output};
use stiffarm_codegen::robot::Robot;

stiffarm::robot! {
    /// Springs in all joints, a spherical wrist.
    pub mod kr240 from "robots/arms/kuka_kr240.toml";
    outputs: hessian, jacobian_rate, compliance_by_joints, deflection_by_joints, manipulability,
             manipulability_by_joints;
}
stiffarm::robot! {
    /// Seven joints.
    pub mod iiwa from "robots/arms/iiwa14.toml";
    outputs: hessian, jacobian_rate, compliance_by_joints, deflection_by_joints, manipulability,
             manipulability_by_joints;
}
stiffarm::robot! {
    /// Five joints, one of which slides, one of which is rigid, and beams.
    pub mod various from "tests/c/arm.toml";
    outputs: hessian, jacobian_rate, compliance_by_joints, deflection_by_joints, manipulability,
             manipulability_by_joints;
}

fn check<R: Kernels<f64> + Kernels<f32> + Sync>(robot: &R, file: &str) {
    let path = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("the file is here");
    let (table, _) = Robot::from_toml(&text, file).expect("the file is valid");
    let arm = stiffarm_gap::robot::arm(&table).expect("every parameter has a number");
    let double = parity::compiled(robot, |x: f64| x);
    let single = parity::compiled(robot, |x: f32| f64::from(x));
    let outputs = Kernels::<f64>::outputs(robot);
    assert!(outputs.len() == 6 && outputs.iter().all(|output| output.is_on_request()));
    let (generated, single) = (&double, Some(&single as _));
    let subject = Subject { outputs, arm: &arm, beyond: None, generated, single };
    for line in parity::agreement(&subject, 1000, 3, &|_| {}).lines {
        assert_eq!(line.exceeded().next(), None, "{file} {line:?}");
        let by_differences = line.output != Output::Manipulability;
        assert_eq!(line.worst[Comparison::Differences as usize].is_some(), by_differences);
    }
}

#[test]
fn derivatives_agree_in_every_way() {
    check(&kr240::Robot, "robots/arms/kuka_kr240.toml");
    check(&iiwa::Robot, "robots/arms/iiwa14.toml");
    check(&various::Robot, "tests/c/arm.toml");
}

/// At the wrist's singularity, and with the arm stretched out: no manipulability, and no number that is none.
#[test]
fn a_singular_posture_has_no_manipulability_and_no_gradient() {
    let postures: [[f64; 6]; 2] = [[0.3, 1.0, 0.2, 0.4, 0.0, 0.1], [0.0; 6]];
    for q in postures {
        let q32 = q.map(|x| x as f32);
        assert!(kr240::manipulability(&q)[0] < 1e-15 && kr240::manipulability(&q32)[0] < 1e-6);
        let gradient = kr240::manipulability_by_joints(&q);
        assert!(gradient.iter().all(|x| x.is_finite()), "{gradient:?}");
        assert!(kr240::manipulability_by_joints(&q32).iter().all(|x| x.is_finite()));
    }
    assert_eq!(kr240::manipulability_by_joints(&postures[0]), [0.0; 6]);
}

/// The tool accelerates by J q̈ + J̇ q̇: by differences of its pose along a path.
#[test]
fn the_rate_of_the_jacobian_is_the_tools_acceleration() {
    const STEP: f64 = 1e-4;
    let (q, rates) = ([0.3, 1.0, 0.2, 0.4, 0.7, 0.1], [0.5, -0.3, 0.8, 0.2, -0.6, 0.4]);
    let place = |t: f64| {
        let q = core::array::from_fn(|k| q[k] + t * rates[k]);
        stiffarm_robots::kuka_kr240::pose(&q).position
    };
    let (before, now, after) = (place(-STEP), place(0.0), place(STEP));
    let rate = kr240::jacobian_rate(&q, &rates);
    for k in 0..3 {
        let expected = (before[k] - 2.0 * now[k] + after[k]) / (STEP * STEP);
        let got: f64 = rate.iter().zip(rates).map(|(column, rate)| column[k] * rate).sum();
        // Rounding of two metres over the square of the step.
        assert!((got - expected).abs() < 1e-7, "{got} {expected}");
    }
}
