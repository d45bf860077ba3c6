//! Outputs that are generated on request: derivatives by the joints. Compiled, in both precisions, against the textbook,
//! its differences and dual numbers.

use num_dual::Dual64;
use stiffarm::kernels::parity::{self, Comparison, Subject};
use stiffarm::kernels::{Kernels, Output, Scalar};
use stiffarm_codegen::derive::{Program, derive};

use crate::compare::{Draws, collection, read};

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
             manipulability_by_joints, inverse_dynamics_by_joints, inverse_dynamics_by_rates;
}
stiffarm::robot! {
    /// Published inertias.
    pub mod ur10 from "robots/arms/ur10.toml";
    outputs: inverse_dynamics_by_joints, inverse_dynamics_by_rates;
}
stiffarm::robot! {
    /// Seven links with products of inertia.
    pub mod panda from "robots/arms/panda.toml";
    outputs: inverse_dynamics_by_joints, inverse_dynamics_by_rates;
}

fn check<R: Kernels<f64> + Kernels<f32> + Sync>(robot: &R, file: &str) {
    let path = format!("{}/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("the file is here");
    let (_, arm) = read(&text, file);
    let double = parity::compiled(robot, |x: f64| x);
    let single = parity::compiled(robot, |x: f32| f64::from(x));
    let outputs = Kernels::<f64>::outputs(robot);
    assert!(!outputs.is_empty() && outputs.iter().all(|output| output.is_on_request()));
    let (generated, single) = (&double, Some(&single as _));
    let subject = Subject { outputs, arm: &arm, beyond: None, generated, single };
    for line in
        parity::agreement(&subject, stiffarm_draws::few_or_many(200, 1000), 3, &|_| {}).lines
    {
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
    check(&ur10::Robot, "robots/arms/ur10.toml");
    check(&panda::Robot, "robots/arms/panda.toml");
}

/// By a joint's acceleration the torques change as the mass matrix says, whatever the motion: by dual numbers through
/// the compiled inverse dynamics, and so by joint values and rates.
#[test]
fn inverse_dynamics_has_these_derivatives() {
    use stiffarm_robots::panda::inverse_dynamics;
    let mut draws = Draws::new(31);
    for _ in 0..100 {
        let state: [[f64; 7]; 3] =
            core::array::from_fn(|_| core::array::from_fn(|_| 2.0 * draws.unit()));
        let [q, rates, accelerations] = &state;
        let by = [
            panda::inverse_dynamics_by_joints(q, rates, accelerations),
            panda::inverse_dynamics_by_rates(q, rates),
            stiffarm_robots::panda::mass_matrix(q),
        ];
        for (part, matrix) in by.iter().enumerate() {
            let largest = matrix.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            for (joint, column) in matrix.iter().enumerate() {
                let mut moved = state.map(|part| part.map(Dual64::lit));
                moved[part][joint].eps = 1.0;
                let torque = inverse_dynamics(&moved[0], &moved[1], &moved[2]);
                // Some hundred roundings of terms that may be ten times what they sum up to.
                let near = |(t, c): (&Dual64, &f64)| (t.eps - c).abs() < 1e-13 * (1.0 + largest);
                assert!(torque.iter().zip(column).all(near), "{torque:?} {column:?}");
            }
        }
    }
}

/// Of every arm of the collection, as the graph tells them.
fn every_arm(states: usize) {
    for (entry, robot, arm) in collection() {
        let moves = robot.joints.iter().any(|joint| joint.inertia.is_some());
        let asked = |output: &Output| output.is_on_request() && (moves || !output.is_of_motion());
        let outputs: Vec<Output> = Output::EACH.into_iter().filter(asked).collect();
        let programs = outputs.iter().map(|output| derive(&robot, &[*output]));
        let programs: Vec<Program> = programs.collect();
        let generated = |output, state: &[f64], w: &[f64; 6]| {
            let at = outputs.iter().position(|known| *known == output).expect("it was asked for");
            programs[at].evaluate(state, w, |_| f64::NAN).map(|blocks| blocks.concat())
        };
        let (outputs, generated) = (&outputs, &generated);
        let subject = Subject { outputs, arm: &arm, beyond: None, generated, single: None };
        for line in parity::agreement(&subject, states, 5, &|_| {}).lines {
            let worst = line.worst.map(|worst| worst.map_or("-".into(), |x| format!("{x:.1e}")));
            println!("{} {} {}", entry.id, line.output.name(), worst.join(" "));
            assert_eq!(line.exceeded().next(), None, "{} {line:?}", entry.id);
        }
    }
}

#[test]
fn what_is_on_request_agrees_for_every_arm() {
    every_arm(100);
}

#[test]
#[ignore = "ten thousand states of every arm take minutes"]
fn what_is_on_request_agrees_at_ten_thousand_states() {
    every_arm(10_000);
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
