//! The printed functions against the graph that they were printed from, against geometry that shares nothing with it,
//! and in every kind of number; in C bit for bit.

use core::fmt::Write as _;

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use num_dual::Dual64;
use stiffarm_codegen::emit::{COptions, Precision, Sines};
use stiffarm_codegen::program::Function;
use stiffarm_codegen::robot::Robot;
use stiffarm_draws::Draws;
use stiffarm_kernels::{Convention, Numeric, Scalar};
use wide::f64x4;

#[allow(dead_code, unused_macros, unused_imports)]
#[path = "../../../tests/c/compiler.rs"]
mod compiler;
#[path = "../module.rs"]
mod module;

use module::formulas;

#[allow(dead_code, clippy::all)]
mod kr240 {
    include!(concat!(env!("OUT_DIR"), "/kr240.rs"));
}

/// What both functions are given, and where in the camera the marker is.
struct Case {
    q: [f64; 6],
    mount: [f64; 3],
    turned: [f64; 4],
    focal: [f64; 2],
    centre: [f64; 2],
    marker: [f64; 3],
    seen: [f64; 2],
    in_camera: [f64; 3],
    normal: [f64; 3],
    height: f64,
}

/// Sums of some fifty terms, none larger than some ten times the result's scale.
const ROUNDED: f64 = 1e-12;

fn cases() -> Vec<Case> {
    let mut draws = Draws::new(14);
    let case = |_| {
        let q = draws.array(-2.5, 2.5);
        let (mount, turned) = (draws.array(-0.2, 0.2), draws.array(-1.0, 1.0));
        let in_camera =
            [draws.between(-0.3, 0.3), draws.between(-0.3, 0.3), draws.between(0.5, 2.0)];
        let [w, x, y, z] = turned;
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let camera = tool(&q) * Isometry3::from_parts(Translation3::from(mount), turn);
        let normal = draws.array(-1.0, 1.0);
        Case {
            q,
            mount,
            turned,
            focal: draws.array(700.0, 900.0),
            centre: draws.array(300.0, 400.0),
            marker: (camera * Point3::from(in_camera)).coords.into(),
            seen: draws.array(0.0, 640.0),
            in_camera,
            normal: Vector3::from(normal).normalize().into(),
            height: draws.unit(),
        }
    };
    (0..1000).map(case).collect()
}

/// The tool's pose by the table's rows as Craig writes them.
fn tool(q: &[f64; 6]) -> Isometry3<f64> {
    assert_eq!(kr240::Robot::CONVENTION, Convention::Modified);
    kr240::Robot::ROWS.iter().zip(q).fold(Isometry3::identity(), |pose, (row, q)| {
        let inclined = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), row.alpha);
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), row.theta + q);
        let before = Isometry3::from_parts(Translation3::identity(), inclined);
        pose * before
            * Translation3::new(row.a, 0.0, 0.0)
            * turned
            * Translation3::new(0.0, 0.0, row.d)
    })
}

fn hand_eye<S: Scalar>(case: &Case) -> Vec<S> {
    fn lit<S: Scalar, const K: usize>(numbers: [f64; K]) -> [S; K] {
        numbers.map(S::lit)
    }
    let found = kr240::hand_eye(
        &lit(case.q),
        &lit(case.mount),
        &lit(case.turned),
        &lit(case.focal),
        &lit(case.centre),
        &lit(case.marker),
        &lit(case.seen),
    );
    [&found.residual[..], found.jacobian.as_flattened()].concat()
}

fn clearance<S: Scalar>(case: &Case, q: &[S; 6]) -> Vec<S> {
    let [corner, normal] = [case.mount, case.normal].map(|v| v.map(S::lit));
    let found = kr240::clearance(q, &corner, &normal, S::lit(case.height));
    [&[found.distance][..], &found.gradient].concat()
}

fn assert_near(got: &[f64], expected: &[f64], tolerance: f64) {
    let scale = expected.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    assert_eq!(got.len(), expected.len());
    for (a, b) in got.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance * scale, "{got:?} {expected:?}");
    }
}

/// The marker as a pinhole shows it, and the interaction matrix of a point (Chaumette & Hutchinson 2006, eq. 11): the
/// velocity of its image by that of the camera along and about its own axes.
#[test]
fn the_reprojection_is_that_of_a_pinhole_and_its_jacobian_the_interaction_matrix() {
    for case in cases() {
        let [x, y, depth] = case.in_camera;
        let (x, y, z) = (x / depth, y / depth, 1.0 / depth);
        let [fx, fy] = case.focal;
        let residual =
            [fx * x + case.centre[0] - case.seen[0], fy * y + case.centre[1] - case.seen[1]];
        let rows =
            [[-z, 0.0, x * z, x * y, -(1.0 + x * x), y], [0.0, -z, y * z, 1.0 + y * y, -x * y, -x]];
        let columns = (0..6).flat_map(|k| [fx * rows[0][k], fy * rows[1][k]]);
        let expected: Vec<f64> = residual.into_iter().chain(columns).collect();
        assert_near(&hand_eye::<f64>(&case), &expected, ROUNDED);
    }
}

#[test]
fn the_clearance_is_a_points_distance_and_its_gradient_that_of_dual_numbers() {
    for case in cases() {
        let corner = tool(&case.q) * Point3::from(case.mount);
        let distance = corner.coords.dot(&Vector3::from(case.normal)) - case.height;
        let mut expected = vec![distance];
        for joint in 0..6 {
            let mut q = case.q.map(Dual64::lit);
            q[joint].eps = 1.0;
            expected.push(clearance(&case, &q)[0].eps);
        }
        assert_near(&clearance(&case, &case.q), &expected, ROUNDED);
    }
}

/// Sines of an input of one's own.
#[test]
fn the_height_is_that_of_the_turned_tool_and_its_slopes_those_of_dual_numbers() {
    for case in cases() {
        let [roll, pitch] = [case.normal[0], case.normal[1]];
        let turned =
            UnitQuaternion::from_euler_angles(roll, pitch, 0.0) * tool(&case.q).translation.vector;
        let found = kr240::height(&case.q, &[roll, pitch]);
        let mut slopes = [0.0; 8];
        for (k, slope) in slopes.iter_mut().enumerate() {
            let mut values = [case.q.as_slice(), &[roll, pitch]]
                .concat()
                .into_iter()
                .map(Dual64::lit)
                .collect::<Vec<_>>();
            values[k].eps = 1.0;
            let (q, attitude) = values.split_at(6);
            let q = q.try_into().expect("six");
            *slope = kr240::height(q, &[attitude[0], attitude[1]]).height.eps;
        }
        let got = [&[found.height][..], &found.by_joints, &found.by_attitude].concat();
        assert_near(&got, &[&[turned.z][..], &slopes].concat(), ROUNDED);
    }
}

fn robot() -> Robot {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/arms/kuka_kr240.toml");
    let text = std::fs::read_to_string(path).expect("the arm is in the collection");
    Robot::for_kernels(&text, path).expect("the file is valid").0
}

#[test]
fn printed_text_is_the_graph() {
    let robot = robot();
    let eye = Function::new(&robot, "hand_eye", "", formulas::hand_eye).expect("no mistakes");
    let clear = Function::new(&robot, "clearance", "", formulas::clearance).expect("no mistakes");
    let counted = [kr240::hand_eye::OPS, kr240::clearance::OPS]
        .map(|ops| (ops.flops(), ops.div, ops.sin_cos));
    let of_graph = [&eye, &clear].map(|function| function.ops());
    assert_eq!(counted, of_graph.map(|ops| (ops.flops(), ops.div, ops.sin_cos)));
    for case in cases() {
        let none = |_: &_| f64::NAN;
        let inputs: [&[f64]; 6] =
            [&case.mount, &case.turned, &case.focal, &case.centre, &case.marker, &case.seen];
        assert_near(
            &hand_eye::<f64>(&case),
            &eye.evaluate(&case.q, &inputs, none).concat(),
            ROUNDED,
        );
        let inputs: [&[f64]; 3] = [&case.mount, &case.normal, &[case.height]];
        assert_near(
            &clearance(&case, &case.q),
            &clear.evaluate(&case.q, &inputs, none).concat(),
            ROUNDED,
        );
    }
}

#[test]
fn single_precision_and_lanes_agree() {
    for four in cases().chunks_exact(4) {
        for case in four {
            let single: Vec<f64> = hand_eye::<f32>(case).into_iter().map(f64::from).collect();
            // Inputs rounded to 6e-8, magnified by depths down to half a metre of an arm of four.
            assert_near(&single, &hand_eye::<f64>(case), 2e-5);
        }
        let q = core::array::from_fn(|joint| {
            f64x4::from([0, 1, 2, 3].map(|k: usize| four[k].q[joint]))
        });
        let lanes = clearance(&four[0], &q);
        for (k, case) in four.iter().enumerate() {
            let lane: Vec<f64> = lanes.iter().map(|x| x.to_array()[k]).collect();
            assert_eq!(lane, clearance(&four[0], &case.q));
        }
    }
}

/// A program that reads the bits of inputs and prints those of results.
const MAIN: &str = r#"
#include "kr240.h"
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static int numbers(double *to, int count)
{
    for (int k = 0; k < count; k++)
    {
        uint64_t bits;
        if (scanf("%" SCNx64, &bits) != 1)
        {
            return 0;
        }
        memcpy(&to[k], &bits, sizeof bits);
    }
    return 1;
}

static void print(const double *from, int count)
{
    for (int k = 0; k < count; k++)
    {
        uint64_t bits;
        memcpy(&bits, &from[k], sizeof bits);
        printf("%" PRIx64 " ", bits);
    }
}

int main(void)
{
    double in[26];
    while (numbers(in, 26))
    {
        kr240_hand_eye_t eye;
        kr240_clearance_t clear;
        kr240_posture_t posture;
        kr240_height_t height;
        kr240_hand_eye(in, in + 6, in + 9, in + 13, in + 15, in + 17, in + 20, &eye);
        kr240_posture(in, &posture);
        kr240_given_clearance(&posture, in + 6, in + 22, in[25], &clear);
        kr240_given_height(&posture, in + 22, &height);
        print(height.height, KR240_HEIGHT_HEIGHT_SIZE);
        print(height.by_attitude, KR240_HEIGHT_BY_ATTITUDE_SIZE);
        print(eye.residual, KR240_HAND_EYE_RESIDUAL_SIZE);
        print(eye.jacobian, KR240_HAND_EYE_JACOBIAN_SIZE);
        print(clear.distance, KR240_CLEARANCE_DISTANCE_SIZE);
        print(clear.gradient, KR240_CLEARANCE_GRADIENT_SIZE);
        printf("\n");
    }
    return 0;
}
"#;

#[test]
#[cfg_attr(not(unix), ignore = "needs cc")]
fn c_has_the_bits_of_rust() {
    let robot = robot();
    let options =
        COptions { name: "kr240".into(), precision: Precision::F64, sines: Sines::Polynomial };
    let files = module::of(&robot).expect("no mistakes").c(&options).expect("numbers only");
    let folder = compiler::Folder::new("program");
    folder.write("kr240.h", &files.header);
    folder.write("kr240.c", &files.source);
    folder.write("main.c", MAIN);
    compiler::compile("cc", &folder, &["-O1", "main.c", "kr240.c", "-o", "program"]);
    let mut input = String::new();
    for case in cases() {
        let parts: [&[f64]; 9] = [
            &case.q,
            &case.mount,
            &case.turned,
            &case.focal,
            &case.centre,
            &case.marker,
            &case.seen,
            &case.normal,
            &[case.height],
        ];
        parts.concat().iter().for_each(|x| write!(input, "{:x} ", x.to_bits()).expect("written"));
    }
    let printed = compiler::run(&folder, "program", &input);
    assert_eq!(printed.lines().count(), cases().len());
    for (line, case) in printed.lines().zip(cases()) {
        let height = kr240::height(&case.q, &[case.normal[0], case.normal[1]]);
        let height = [&[height.height][..], &height.by_attitude].concat();
        let rust = [height, hand_eye::<f64>(&case), clearance(&case, &case.q)].concat();
        let bits: Vec<String> = rust.iter().map(|x| format!("{:x}", x.to_bits())).collect();
        assert_eq!(line.trim_end(), bits.join(" "));
    }
}
