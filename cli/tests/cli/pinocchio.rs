//! Our kinematics against the numbers of another program: Pinocchio's, on the robots' URDFs.

use serde_json::Value;
use stiffarm_codegen::derive::derive;
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Robot, Value as Cell};
use stiffarm_kernels::generic::Arm;
use stiffarm_kernels::{Output, Side};

use crate::support::{Folder, arm, json, list, number, numbers, read, run};

/// One posture, by Pinocchio.
struct Sample {
    q: Vec<f64>,
    /// Rotation by columns, then position: as our pose stands.
    pose: Vec<f64>,
    /// By columns.
    jacobian: Vec<f64>,
    weight_torque: Vec<f64>,
}

/// A list of rows, column by column.
fn columns(value: &Value) -> Vec<f64> {
    let rows: Vec<Vec<f64>> = list(value).iter().map(numbers).collect();
    (0..rows[0].len()).flat_map(|c| rows.iter().map(move |row| row[c])).collect()
}

fn data(robot: &str) -> (Value, Vec<Sample>) {
    let text = read(&format!("tests/data/pinocchio/{robot}.json"));
    let file = json(&text);
    let samples = list(&file["samples"]).iter().map(|s| Sample {
        q: numbers(&s["q"]),
        pose: [columns(&s["rotation"]), numbers(&s["position"])].concat(),
        jacobian: columns(&s["jacobian"]),
        weight_torque: numbers(&s["weight_torque"]),
    });
    let samples: Vec<Sample> = samples.collect();
    assert_eq!(samples.len(), 50);
    (file, samples)
}

/// Two programs that each round some dozens of operations on numbers of about 1 (torques: 100).
#[track_caller]
fn near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance, "{what}: {f} is not {e}");
    }
}

fn kernel(id: &str, output: Output, q: &[f64]) -> Vec<f64> {
    let kernels = stiffarm_robots::arm(id).expect("built in").kernels;
    let (rows, columns) = output.shape(kernels.dof());
    let mut out = vec![0.0; rows * columns];
    kernels.evaluate(output, q, &[0.0; 6], &mut out).expect("defined everywhere");
    out
}

#[test]
fn the_kernels_of_ur5_and_panda_agree() {
    for id in ["ur5", "panda"] {
        for sample in data(id).1 {
            near(&kernel(id, Output::Pose, &sample.q), &sample.pose, 1e-12, id);
            near(&kernel(id, Output::Jacobian, &sample.q), &sample.jacobian, 1e-12, id);
            if id == "panda" {
                let torque = kernel(id, Output::WeightTorque, &sample.q);
                near(&torque, &sample.weight_torque, 1e-11, "gravity");
            }
        }
    }
}

/// The paper's zeros and directions of the KR 240-2 are not the controller's: `q3 = −(A3 + 90°)`,
/// the others `−A`.
#[test]
fn the_kernels_of_the_kr240_agree() {
    for sample in data("kr240").1 {
        let mut q: Vec<f64> = sample.q.iter().map(|a| -a).collect();
        q[2] -= core::f64::consts::FRAC_PI_2;
        near(&kernel("kuka_kr240", Output::Pose, &q), &sample.pose, 1e-12, "pose");
        let jacobian: Vec<f64> =
            kernel("kuka_kr240", Output::Jacobian, &q).iter().map(|x| -x).collect();
        near(&jacobian, &sample.jacobian, 1e-12, "jacobian");
    }
}

#[test]
fn imported_robots_agree() {
    let folder = Folder::new();
    for robot in ["ur5", "kr240", "panda", "oblique"] {
        let (file, samples) = data(robot);
        let word = |key: &str| file[key].as_str().expect("text").to_owned();
        let out = folder.name("arm.toml");
        let (base, tip) = (word("base"), word("tip"));
        let urdf = word("urdf");
        run(&format!("--quiet import {urdf} --base {base} --tip {tip} --toml {out}")).good();
        let toml = read(&out);
        let (parsed, warnings) = Robot::from_toml(&toml, "arm.toml").expect("sound");
        assert!(warnings.is_empty());
        let arm: Arm = stiffarm_gap::robot::arm(&parsed).expect("numbers");
        // No first row can place an axis that leans.
        assert_eq!(toml.contains("[base]"), robot == "oblique", "{robot}");
        for sample in samples {
            let pose = arm.pose(&sample.q);
            let rotation = pose.rotation.to_rotation_matrix();
            let tip = pose.translation.vector;
            let found = [rotation.matrix().as_slice(), tip.as_slice()].concat();
            near(&found, &sample.pose, 1e-12, robot);
            near(arm.jacobian(&sample.q).as_slice(), &sample.jacobian, 1e-12, robot);
            let torque = arm.weight_torque(&sample.q);
            near(torque.as_slice(), &sample.weight_torque, 1e-11, robot);
        }
    }
}

/// The textbook is what everything else is compared with.
#[test]
fn the_textbook_agrees() {
    let panda = arm("panda");
    for sample in data("panda").1 {
        near(panda.jacobian(&sample.q).as_slice(), &sample.jacobian, 1e-12, "jacobian");
        let torque = panda.weight_torque(&sample.q);
        near(torque.as_slice(), &sample.weight_torque, 1e-11, "gravity");
    }
}

/// The links of a robot of the collection as Pinocchio had them.
fn with_links(arm: &str, links: &Value) -> Robot {
    let toml = stiffarm_robots::arm(arm).expect("built in").toml;
    let (mut robot, _) = Robot::from_toml(toml, arm).expect("sound");
    let exact = |x: &f64| Cell::Number(Number::from_decimal(&format!("{x:?}")).expect("a number"));
    for (joint, link) in robot.joints.iter_mut().zip(list(links)) {
        let three = |key: &str| numbers(&link[key]).iter().map(exact).collect::<Vec<_>>();
        let one = |key: &str| Some(exact(&number(&link[key])));
        joint.mass = one("mass");
        joint.com = three("com").try_into().expect("three");
        joint.inertia = Some(three("inertia").try_into().expect("six"));
        joint.drive.gear = one("gear");
        joint.drive.rotor_inertia = one("rotor_inertia");
    }
    robot
}

/// The textbook and the graph that every kernel is printed from, at twenty states of six arms. Two programs each sum
/// some hundred products whose sizes are those of the largest entry, and a few powers of ten above where links fold
/// back on each other: 1e-12 of the largest.
#[test]
fn the_equations_of_motion_agree() {
    let motion = Output::EACH.into_iter().filter(|output| output.is_of_motion());
    let outputs: Vec<Output> = motion.collect();
    let mut regressors = 0;
    for arm in ["panda", "ur10", "kuka_kr240", "iiwa14", "stanford", "puma560"] {
        let text = read(&format!("tests/data/pinocchio/dynamics/{arm}.json"));
        let file = json(&text);
        let robot = with_links(arm, &file["links"]);
        let textbook: Arm = stiffarm_gap::robot::arm(&robot).expect("numbers");
        let samples = list(&file["samples"]);
        assert_eq!(samples.len(), 20);
        for &output in &outputs {
            let graph = derive(&robot, &[output]);
            for sample in samples.iter().filter(|sample| !sample[output.name()].is_null()) {
                let of_joints = output.inputs().iter().filter(|i| i.side() == Side::Joints);
                let state: Vec<f64> =
                    of_joints.flat_map(|input| numbers(&sample[input.name()])).collect();
                let expected = numbers(&sample[output.name()]);
                regressors += usize::from(output == Output::TorqueRegressor);
                let largest = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                let by_textbook = textbook.evaluate(output, &state, &[0.0; 6]).expect("stable");
                let by_graph = graph.evaluate(&state, &[0.0; 6], |_| f64::NAN).expect("stable");
                let what = format!("{arm}, {}", output.name());
                near(&by_textbook, &expected, 1e-12 * largest, &what);
                near(&by_graph.concat(), &expected, 1e-12 * largest, &what);
            }
        }
    }
    assert_eq!(regressors, 4, "two of each arm in the modified convention");
}
