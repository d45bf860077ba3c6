//! The inverse kinematics in C: the bits of the Rust kernels, of tables with a closed form and of one near it.

use stiffarm::kernels::{ElbowAngle, Inverse, Pose, SetPoints, Solutions, has};
use stiffarm::robot;
use stiffarm_codegen::emit::{Precision, Sines};
use stiffarm_codegen::robot::{Family, Robot, Wanted};
use stiffarm_draws::Draws;

use crate::compiler::{Folder, compile, run, with_each_compiler};
use crate::program::SIDES;

with_each_compiler! {
    branches_are_the_rust_kernels_bits
    set_points_are_the_rust_kernels_bits
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
fn program(function: &str, (given, elbow): (&str, bool), [joints, branches]: [usize; 2]) -> String {
    let (pose, load, all) = (joints, joints + 12, joints + 18);
    let load = match function {
        "set_points" => format!(", &x[{load}]"),
        _ if elbow => format!(", {ANGLE:?}"),
        _ => String::new(),
    };
    let values = joints * branches;
    format!(
        "#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include \"arm.h\"

static void put(const double *x, unsigned int size)
{{
    unsigned int k;

    for (k = 0U; k < size; k++)
    {{
        uint64_t bits;
        (void)memcpy(&bits, &x[k], sizeof bits);
        (void)printf(\"%\" PRIx64 \" \", bits);
    }}
}}

int main(void)
{{
    double x[{all}];
    static const double sides[6] = {{{}}};
    arm_{function}_t out;
    unsigned int k = 0U;
    uint64_t bits;

    (void)sides;
    while (scanf(\"%\" SCNx64, &bits) == 1)
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
        sides().map(|side| format!("{side:?}")).join(", ")
    )
}

fn sides() -> [f64; 6] {
    core::array::from_fn(|k| SIDES[k % SIDES.len()])
}

/// Compiles an arm's C and the program around one function of it.
fn compiled(compiler: &str, id: &str, outputs: &[&str]) -> Folder {
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
    let folder = Folder::new(&format!("{function}-{compiler}-{}", id.replace('/', "-")));
    for precision in [Precision::F32, Precision::F64] {
        folder.write_c(&robot, "arm", (precision, Sines::Polynomial));
        compile(compiler, &folder, &["-O2", "-c", "arm.c"]);
    }
    let form = robot.inverse_kinematics.expect("it was asked for");
    let size = [robot.dof(), form.branches()];
    let elbow = form.family == Family::ElbowAngle;
    folder.write("main.c", &program(function, (given, elbow), size));
    compile(compiler, &folder, &["-O2", "arm.c", "main.c", "-o", "branches", "-lm"]);
    folder
}

/// Postures' own poses, singular ones, poses out of reach, and numbers that are none.
fn check<const N: usize, const K: usize, A: Inverse<N, K> + has::Pose<N>>(
    compiler: &str,
    (arm, id, outputs): (&A, &str, &[&str]),
    branches: impl Fn(&Pose<f64>, &[f64; N], &[f64; 6]) -> Solutions<f64, N, K>,
) {
    let folder = compiled(compiler, id, outputs);
    let mut draws = Draws::new(5);
    let (mut input, mut expected) = (String::new(), Vec::new());
    for k in 0..300 {
        let mut q: [f64; N] = draws.array(-3.1, 3.1);
        if k % 5 == 0 {
            q[4 % N] = 0.0;
        }
        let Pose { rotation, mut position } = arm.pose(&arm.posture(&q));
        match k % 7 {
            1 => position = position.map(|x| 9.0 * x),
            2 if k < 10 => position[0] = f64::NAN,
            _ => {}
        }
        let (pose, near) = (Pose { rotation, position }, draws.array(-3.1, 3.1));
        let wrench = draws.load().map(|x| if k % 11 == 3 { 1e9 * x } else { x });
        let columns = pose.columns();
        let numbers = near.iter().chain(columns.as_flattened()).chain(&wrench);
        let bits = numbers.map(|x| x.to_bits());
        input.extend(bits.map(|bits| format!("{bits:x} ")));
        input.push('\n');
        let found = branches(&pose, &near, &wrench);
        let all = found.q.as_flattened().iter().chain(&found.distance).chain(&found.tilt);
        expected.push(all.copied().collect::<Vec<f64>>());
    }
    let said = run(&folder, "branches", &input);
    assert_eq!(said.lines().count(), expected.len());
    for (line, expected) in said.lines().zip(&expected) {
        let found =
            line.split_whitespace().map(|word| u64::from_str_radix(word, 16).expect("bits"));
        for (found, expected) in found.map(f64::from_bits).zip(expected) {
            let same = found.to_bits() == expected.to_bits();
            assert!(same || found.is_nan() && expected.is_nan(), "{id}: {found:?} {expected:?}");
        }
    }
}

fn branches_are_the_rust_kernels_bits(compiler: &str) {
    let calibrated = calibrated::Robot { sides: sides() };
    macro_rules! check {
        ($arm:expr, $id:literal) => {
            check(compiler, (&$arm, $id, &OUTPUTS[..2]), |pose, near, _| {
                $arm.closed_form(pose, near)
            })
        };
    }
    check!(kr240::Robot, "robots/arms/kuka_kr240.toml");
    check!(irb120::Robot, "robots/arms/irb120.toml");
    check!(puma560::Robot, "robots/arms/puma560.toml");
    check!(ur10::Robot, "robots/arms/ur10.toml");
    check!(calibrated, "tests/data/calibrated_ur10.toml");
    check(
        compiler,
        (&calibrated, "tests/data/calibrated_ur10.toml", &OUTPUTS[..3]),
        |pose, near, _| calibrated.inverse_kinematics(pose, near),
    );
    check!(panda::Robot, "robots/arms/panda.toml");
    check!(iiwa14::Robot, "robots/arms/iiwa14.toml");
    check(
        compiler,
        (&elbow::Robot, "robots/arms/iiwa14.toml", &WITH_ELBOW[..2]),
        |pose, near, _| elbow::Robot.closed_form_at(pose, near, ANGLE),
    );
    check!(stanford::Robot, "robots/arms/stanford.toml");
    check!(plane::Robot, "robots/arms/bicchi_3r.toml");
    check!(general::Robot, "tests/data/general.toml");
}

fn set_points_are_the_rust_kernels_bits(compiler: &str) {
    let calibrated = loaded::calibrated::Robot { sides: sides() };
    macro_rules! check {
        ($arm:expr, $id:literal) => {
            check(compiler, (&$arm, $id, &OUTPUTS), |pose, near, wrench| {
                $arm.set_points(pose, near, wrench)
            })
        };
    }
    check!(loaded::lin::Robot, "robots/arms/lin_elbow.toml");
    check!(loaded::kr240::Robot, "robots/arms/kuka_kr240.toml");
    check!(loaded::panda::Robot, "robots/arms/panda.toml");
    check!(loaded::plane::Robot, "robots/arms/bicchi_3r.toml");
    check!(calibrated, "tests/data/calibrated_kuka.toml");
    let elbow = loaded::elbow::Robot;
    check(compiler, (&elbow, "robots/arms/iiwa14.toml", &WITH_ELBOW), |pose, near, wrench| {
        elbow.set_points(pose, near, wrench)
    });
}
