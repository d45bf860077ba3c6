//! The inverse kinematics in C: the bits of the Rust kernels in both precisions, of tables with a closed form, of one near
//! it, and of those that are searched. In CUDA and NumPy, whose sines are others: the same branches.

use std::process::Command;

use stiffarm::kernels::{ElbowAngle, Inverse, Pose, SetPoints, Solutions, has};
use stiffarm::robot;
use stiffarm_codegen::emit::{CudaOptions, Precision, Sines, cuda, python};
use stiffarm_codegen::robot::{Family, Robot, Wanted};
use stiffarm_draws::{Draws, few_or_many};

use crate::bits::Bits;
use crate::compiler::{CUDA, Folder, compile, optimised, run, spoken, with_each_compiler};
use crate::program::{SIDES, types};

with_each_compiler! {
    branches_are_the_rust_kernels_bits
    set_points_are_the_rust_kernels_bits
    branches_of_singles_are_the_rust_kernels_bits
    set_points_of_singles_are_the_rust_kernels_bits
}

robot! { mod kr240 from "robots/arms/kuka_kr240.toml"; outputs: pose, inverse_kinematics; }
robot! { mod irb120 from "robots/arms/irb120.toml"; outputs: pose, inverse_kinematics; }
robot! { mod puma560 from "robots/arms/puma560.toml"; outputs: pose, inverse_kinematics; }
robot! { mod ur10 from "robots/arms/ur10.toml"; outputs: pose, inverse_kinematics; }
robot! { mod calibrated from "tests/data/calibrated_ur10.toml"; outputs: pose, inverse_kinematics; }
robot! { mod panda from "robots/arms/panda.toml"; outputs: pose, inverse_kinematics; }
robot! { mod iiwa14 from "robots/arms/iiwa14.toml"; outputs: pose, inverse_kinematics; }
robot! {
    mod elbow from "robots/arms/iiwa14.toml";
    outputs: pose, inverse_kinematics given elbow_angle;
}
robot! { mod stanford from "robots/arms/stanford.toml"; outputs: pose, inverse_kinematics; }
robot! { mod plane from "robots/arms/bicchi_3r.toml"; outputs: pose, inverse_kinematics; }
robot! { mod general from "tests/data/general.toml"; outputs: pose, inverse_kinematics; }
robot! { mod searched from "tests/data/offset_wrist.toml"; outputs: pose, inverse_kinematics; }
robot! { mod by_three from "robots/arms/panda.toml"; outputs: pose, inverse_kinematics given 3; }

/// Arms under a load: one of whose links bend, one that bears any load, and what a tracker found.
mod loaded {
    use super::robot;

    macro_rules! arms {
        ($($name:ident $file:literal)*) => {$(
            robot! {
                pub mod $name from $file;
                outputs: pose, jacobian, deflection_with_gravity, inverse_kinematics;
            }
        )*};
    }
    arms! {
        lin "robots/arms/lin_elbow.toml"
        kr240 "robots/arms/kuka_kr240.toml"
        panda "robots/arms/panda.toml"
        plane "robots/arms/bicchi_3r.toml"
        calibrated "tests/data/calibrated_kuka.toml"
        searched "tests/data/offset_wrist.toml"
    }
    robot! {
        pub mod elbow from "robots/arms/iiwa14.toml";
        outputs: pose, jacobian, deflection_with_gravity, inverse_kinematics given elbow_angle;
    }
}

const OUTPUTS: [&str; 4] = ["pose", "inverse_kinematics", "jacobian", "deflection_with_gravity"];

/// The same with the elbow's angle given.
const WITH_ELBOW: [&str; 4] =
    ["pose", "inverse_kinematics given elbow_angle", "jacobian", "deflection_with_gravity"];

/// That angle where it is told, rad.
const ANGLE: f64 = 0.5;

/// Reads joint values, a pose and a wrench as bits, prints all branches as bits.
fn program(
    precision: Precision,
    function: &str,
    (given, elbow): (&str, bool),
    [joints, branches]: [usize; 2],
) -> String {
    let [real, word, scan, print] = types(precision);
    let (pose, load, all) = (joints, joints + 12, joints + 18);
    let load = match function {
        "set_points" => format!(", &x[{load}]"),
        _ if elbow => format!(", ({real}){ANGLE:?}"),
        _ => String::new(),
    };
    let values = joints * branches;
    format!(
        "#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include \"arm.h\"

static void put(const {real} *x, unsigned int size)
{{
    unsigned int k;

    for (k = 0U; k < size; k++)
    {{
        {word} bits;
        (void)memcpy(&bits, &x[k], sizeof bits);
        (void)printf(\"%\" {print} \" \", bits);
    }}
}}

int main(void)
{{
    {real} x[{all}];
    static const {real} sides[6] = {{{}}};
    arm_{function}_t out;
    unsigned int k = 0U;
    {word} bits;

    (void)sides;
    while (scanf(\"%\" {scan}, &bits) == 1)
    {{
        (void)memcpy(&x[k], &bits, sizeof bits);
        k++;
        if (k == {all}U)
        {{
            k = 0U;
            arm_{function}(x{given}, &x[{pose}]{load}, &out);
            put(out.q, {values}U);
            put(out.distance, {branches}U);
            put(out.tilt, {branches}U);
            (void)printf(\"\\n\");
        }}
    }}
    return 0;
}}
",
        sides::<f64>().map(|side| format!("({real}){side:?}")).join(", ")
    )
}

/// The same with CUDA's text, whose kernel is launched once for so many lines.
fn cuda_program(
    function: &str,
    (given, elbow): (&str, bool),
    [joints, branches]: [usize; 2],
    count: usize,
) -> String {
    let (pose, load, all) = (joints, joints + 12, joints + 18);
    let load = match function {
        "set_points" => format!(", x + {load} * COUNT"),
        _ if elbow => ", angle".to_owned(),
        _ => String::new(),
    };
    let values = joints * branches;
    format!(
        "{CUDA}#define COUNT {count}U
#include \"arm.cu\"

static double x[{all} * COUNT];
static double sides[6 * COUNT];
static double angle[COUNT];
static double q[{values} * COUNT];
static double distance[{branches} * COUNT];
static double tilt[{branches} * COUNT];

static void put(const double *of, unsigned int size)
{{
    unsigned int k;

    for (k = 0U; k < size; k++)
    {{
        uint64_t bits;
        (void)memcpy(&bits, &of[k * COUNT], sizeof bits);
        (void)printf(\"%\" PRIx64 \" \", bits);
    }}
}}

int main(void)
{{
    static const double side[6] = {{{}}};
    unsigned int i;
    unsigned int k;

    blockDim.x = 3U;
    for (i = 0U; i < COUNT; i++)
    {{
        angle[i] = {ANGLE:?};
        for (k = 0U; k < 6U; k++)
        {{
            sides[k * COUNT + i] = side[k];
        }}
        for (k = 0U; k < {all}U; k++)
        {{
            uint64_t bits = 0U;
            if (scanf(\"%\" SCNx64, &bits) != 1)
            {{
                return 1;
            }}
            (void)memcpy(&x[k * COUNT + i], &bits, sizeof bits);
        }}
    }}
    LAUNCH(arm_{function}_batch(COUNT, x{given}, x + {pose} * COUNT{load}, q, distance, tilt));
    for (i = 0U; i < COUNT; i++)
    {{
        put(q + i, {values}U);
        put(distance + i, {branches}U);
        put(tilt + i, {branches}U);
        (void)printf(\"\\n\");
    }}
    return (int)(sides[0] - side[0] + angle[0] - {ANGLE:?});
}}
",
        sides::<f64>().map(|side| format!("{side:?}")).join(", ")
    )
}

/// The same with NumPy's text, called once for all lines.
fn python_program(function: &str, (given, elbow): (&str, bool), joints: usize) -> String {
    let load = match function {
        "set_points" => ", x[:, -6:]".to_owned(),
        _ if elbow => format!(", {ANGLE:?}"),
        _ => String::new(),
    };
    format!(
        "import struct
import sys

import arm
import numpy as np

x = np.array([[struct.unpack('<d', int(word, 16).to_bytes(8, 'little'))[0] for word in line.split()] for line in sys.stdin])
sides = {:?}
out = arm.{function}(x[:, :{joints}]{given}, x[:, {joints}:{}]{load})
parts = [out['q'].swapaxes(-1, -2), out['distance'], out['tilt']]
for row in np.concatenate([part.reshape(len(x), -1) for part in parts], axis=-1):
    print(' '.join(format(struct.unpack('<Q', struct.pack('<d', y))[0], 'x') for y in row))
",
        sides::<f64>(),
        joints + 12,
    )
}

fn sides<S: Bits>() -> [S; 6] {
    core::array::from_fn(|k| S::lit(SIDES[k % SIDES.len()]))
}

/// Writes an arm's text and the program around one function of it, and what that says to an input.
fn said(
    compiler: &str,
    precision: Precision,
    (id, outputs): (&str, &[&str]),
    input: &str,
) -> String {
    let text = std::fs::read_to_string(format!("{}/{id}", env!("CARGO_MANIFEST_DIR")));
    let (mut robot, _) = Robot::from_toml(&text.expect("the file"), "arm.toml").expect("valid");
    robot = robot.with_effects().expect("effects of kernels");
    for output in outputs {
        robot.want(&Wanted::read(output).expect("an output")).expect("it has one");
    }
    let near = !robot.is_as_its_table() || robot.closed_form().is_err();
    let function = match outputs.len() {
        2 if near => "closed_form",
        2 | 3 => "inverse_kinematics",
        _ => "set_points",
    };
    let given = if robot.beyond.takes_sides() { ", sides" } else { "" };
    let [real, ..] = types(precision);
    let folder = Folder::new(&format!("{function}-{compiler}-{real}-{}", id.replace('/', "-")));
    let form = robot.inverse_kinematics.expect("it was asked for");
    let size = [robot.dof(), form.branches()];
    let given = (given, form.family == Family::ElbowAngle);
    match compiler {
        "cuda" => {
            let options = CudaOptions { name: "arm".to_owned(), precision: Precision::F64 };
            folder.write("arm.cu", &cuda(&robot, &options).expect("numbers only"));
            folder.write("main.c", &cuda_program(function, given, size, input.lines().count()));
            compile(
                "cc",
                &folder,
                &[optimised(), "-Wno-unused-function", "main.c", "-o", "branches", "-lm"],
            );
        }
        "python3" => {
            folder.write("arm.py", &python(&robot));
            folder.write("main.py", &python_program(function, given, robot.dof()));
            let mut python = Command::new(compiler);
            python.arg("main.py").current_dir(folder.path());
            return spoken(python, input);
        }
        _ => {
            folder.write_c(&robot, "arm", (precision, Sines::Polynomial));
            folder.write("main.c", &program(precision, function, given, size));
            compile(compiler, &folder, &[optimised(), "arm.c", "main.c", "-o", "branches", "-lm"]);
        }
    }
    run(&folder, "branches", input)
}

/// Postures' own poses, singular ones, poses out of reach, and numbers that are none.
fn check<S: Bits, const N: usize, const K: usize, A: Inverse<N, K, S> + has::Pose<N, S>>(
    compiler: &str,
    (arm, id, outputs): (&A, &str, &[&str]),
    branches: impl Fn(&Pose<S>, &[S; N], &[S; 6]) -> Solutions<S, N, K>,
) {
    let mut draws = Draws::new(5);
    let (mut input, mut expected) = (String::new(), Vec::new());
    for k in 0..few_or_many(60, 300) {
        let mut q: [f64; N] = draws.array(-3.1, 3.1);
        if k % 5 == 0 {
            q[4 % N] = 0.0;
        }
        let Pose { rotation, mut position } = arm.pose(&arm.posture(&q.map(S::lit)));
        match k % 7 {
            1 => position = position.map(|x| S::lit(9.0) * x),
            2 if k < 10 => position[0] = S::lit(f64::NAN),
            _ => {}
        }
        let near = draws.array(-3.1, 3.1).map(S::lit);
        let pose = Pose { rotation, position };
        let wrench = draws.load().map(|x| S::lit(if k % 11 == 3 { 1e9 * x } else { x }));
        let columns = pose.columns();
        let numbers = near.iter().chain(columns.as_flattened()).chain(&wrench);
        let bits = numbers.map(|x| x.word());
        input.extend(bits.map(|bits| format!("{bits:x} ")));
        input.push('\n');
        let found = branches(&pose, &near, &wrench);
        let all = found.q.as_flattened().iter().chain(&found.distance).chain(&found.tilt);
        expected.push(all.copied().collect::<Vec<S>>());
    }
    let said = said(compiler, S::PRECISION, (id, outputs), &input);
    assert_eq!(said.lines().count(), expected.len());
    let (mut all, mut others) = (0, 0);
    for (line, expected) in said.lines().zip(&expected) {
        let found: Vec<S> = line.split_whitespace().map(S::read).collect();
        assert_eq!(found.len(), expected.len());
        if !["cuda", "python3"].contains(&compiler) {
            for (found, expected) in found.iter().zip(expected) {
                assert!(found.same(*expected), "{id}: {found:?} {expected:?}");
            }
            continue;
        }
        let doubles = |all: &[S]| -> Vec<f64> { all.iter().map(|x| (*x).into()).collect() };
        let (found, expected) = (doubles(&found), &doubles(expected));
        let same = |at: usize, other: usize, within: f64| {
            let (a, b) = (found[at], expected[other]);
            let by = (a - b).abs();
            a.is_nan() && b.is_nan()
                || a == b
                || by.min((by - core::f64::consts::TAU).abs()) < within
        };
        for branch in 0..K {
            let missed = (N * K + branch, N * K + K + branch);
            // A load that displaces the links by kilometres is beyond the first order.
            if expected[missed.0].is_finite() && expected[missed.1] > 2.0 {
                continue;
            }
            all += 1;
            if compiler == "python3" && K == 16 {
                // A search's solutions are in no order, and of a pose out of reach several may be the nearest.
                let off = |of: &[f64], k: usize| of[N * K + k].powi(2) + of[N * K + K + k].powi(2);
                let (told, least) = (off(&found, 0), off(expected, branch));
                let again = |k| (0..N).all(|joint| same(N * k + joint, N * branch + joint, 1e-6));
                let nearest = least > 1e-12 && (told - least).abs() < 1e-9 * least;
                others += usize::from(least.is_finite() && !nearest && !(0..K).any(again));
                continue;
            }
            let told = same(missed.0, missed.0, 1e-9) && same(missed.1, missed.1, 1e-9);
            let joints = (N * branch..N * branch + N).all(|k| same(k, k, 1e-6));
            // Where no number is told, the joint values say nothing.
            others += usize::from(!told || !joints && expected[missed.0].is_finite());
        }
    }
    println!("{id} {compiler}: {others} of {all} branches are others");
    assert!(others * 100 <= all, "{id}: {others} of {all}");
}

/// In CUDA, a thread after the other, and in NumPy.
#[test]
#[cfg_attr(not(unix), ignore = "needs cc")]
fn cuda_has_the_rust_kernels_branches() {
    branches_are_the_rust_kernels_bits("cuda");
    set_points_are_the_rust_kernels_bits("cuda");
}

#[test]
#[ignore = "needs NumPy"]
fn numpy_has_the_rust_kernels_branches() {
    branches_are_the_rust_kernels_bits("python3");
    set_points_are_the_rust_kernels_bits("python3");
}

fn branches_are_the_rust_kernels_bits(compiler: &str) {
    branches::<f64>(compiler);
}

fn set_points_are_the_rust_kernels_bits(compiler: &str) {
    set_points::<f64>(compiler);
}

fn branches_of_singles_are_the_rust_kernels_bits(compiler: &str) {
    branches::<f32>(compiler);
}

fn set_points_of_singles_are_the_rust_kernels_bits(compiler: &str) {
    set_points::<f32>(compiler);
}

fn branches<S: Bits>(compiler: &str) {
    let calibrated = calibrated::Robot { sides: sides::<S>() };
    macro_rules! check {
        ($arm:expr, $id:literal) => {
            check::<S, _, _, _>(compiler, (&$arm, $id, &OUTPUTS[..2]), |pose, near, _| {
                $arm.closed_form(pose, near)
            })
        };
    }
    check!(kr240::Robot, "robots/arms/kuka_kr240.toml");
    check!(irb120::Robot, "robots/arms/irb120.toml");
    check!(puma560::Robot, "robots/arms/puma560.toml");
    check!(ur10::Robot, "robots/arms/ur10.toml");
    check!(calibrated, "tests/data/calibrated_ur10.toml");
    check::<S, _, _, _>(
        compiler,
        (&calibrated, "tests/data/calibrated_ur10.toml", &OUTPUTS[..3]),
        |pose, near, _| calibrated.inverse_kinematics(pose, near),
    );
    check!(panda::Robot, "robots/arms/panda.toml");
    check!(iiwa14::Robot, "robots/arms/iiwa14.toml");
    check::<S, _, _, _>(
        compiler,
        (&elbow::Robot, "robots/arms/iiwa14.toml", &WITH_ELBOW[..2]),
        |pose, near, _| elbow::Robot.closed_form_at(pose, near, S::lit(ANGLE)),
    );
    check!(stanford::Robot, "robots/arms/stanford.toml");
    check!(plane::Robot, "robots/arms/bicchi_3r.toml");
    check!(general::Robot, "tests/data/general.toml");
    check::<S, _, _, _>(
        compiler,
        (&searched::Robot, "tests/data/offset_wrist.toml", &OUTPUTS[..3]),
        |pose, near, _| searched::Robot.inverse_kinematics(pose, near),
    );
    check::<S, _, _, _>(
        compiler,
        (
            &by_three::Robot,
            "robots/arms/panda.toml",
            &["pose", "inverse_kinematics given 3", "jacobian"],
        ),
        |pose, near, _| by_three::Robot.inverse_kinematics(pose, near),
    );
}

fn set_points<S: Bits>(compiler: &str) {
    let calibrated = loaded::calibrated::Robot { sides: sides::<S>() };
    macro_rules! check {
        ($arm:expr, $id:literal) => {
            check::<S, _, _, _>(compiler, (&$arm, $id, &OUTPUTS), |pose, near, wrench| {
                $arm.set_points(pose, near, wrench)
            })
        };
    }
    check!(loaded::lin::Robot, "robots/arms/lin_elbow.toml");
    check!(loaded::kr240::Robot, "robots/arms/kuka_kr240.toml");
    check!(loaded::panda::Robot, "robots/arms/panda.toml");
    check!(loaded::plane::Robot, "robots/arms/bicchi_3r.toml");
    check!(calibrated, "tests/data/calibrated_kuka.toml");
    check!(loaded::searched::Robot, "tests/data/offset_wrist.toml");
    let elbow = loaded::elbow::Robot;
    check::<S, _, _, _>(
        compiler,
        (&elbow, "robots/arms/iiwa14.toml", &WITH_ELBOW),
        |pose, near, wrench| elbow.set_points(pose, near, wrench),
    );
}
