//! Every output by every way there is to it: nanoseconds per pose, and the ratio to the plain kernel.
//!
//! ```text
//! cargo bench -p stiffarm-bench --bench speed
//! cargo bench -p stiffarm-bench --bench speed -- inverse       # the inverse alone
//! RUSTFLAGS="-C target-cpu=native" cargo bench -p stiffarm-bench --bench speed --features fma
//! cargo bench -p stiffarm-bench --bench speed --features dispatch
//! ```
//!
//! `plain` and `fused` are the generated functions of one pose, `given` those that are handed sines and
//! cosines, `x4` and `x8` four and eight poses in lanes, `batch` the same through slices (`cores` on all
//! of them), `textbook` the generic runtime on nalgebra, `ideal` the hand-unrolled arm. All results are
//! compared with the textbook's before anything is timed.

use std::hint::black_box;

use stiffarm_bench::arms::{self, textbook};
use stiffarm_bench::ideal;
use stiffarm_bench::timing::{Candidate, print};
use stiffarm_bench_arms::lanes::{by_eight, by_four};
use stiffarm_draws::Draws;
use stiffarm_kernels::batch::{self, Layout, Wrenches, evaluate, evaluate_parallel};
use stiffarm_kernels::generic;
use stiffarm_kernels::{
    Arm as _, Inverse as _, Kernels, Output, Pose, Scalar, SetPoints as _, has::Pose as _,
};

const POSES: usize = 2048;
const ROUNDS: usize = 41;

/// Refuses to time what is not right.
fn compare(
    kernels: &dyn Kernels<f64>,
    arm: &generic::Arm,
    output: Output,
    q: &[f64],
    w: &[f64; 6],
) {
    let expected = arm.evaluate(output, q, w).expect("the arm is stable");
    let mut got = vec![0.0; expected.len()];
    kernels.evaluate(output, q, w, &mut got).expect("the arm is stable");
    let scale = expected.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
    for (a, b) in got.iter().zip(&expected) {
        assert!((a - b).abs() <= 1e-11 * scale, "{} of {}: {a} {b}", output.name(), arm.name);
    }
}

/// One output of one arm: random poses, a smooth path, and each call waiting for the last.
macro_rules! output {
    ($arm:ident $function:ident $kind:ident |$q:ident, $w:ident| $args:tt $($ideal:ident)?) => {{
        let arm = textbook(stringify!($arm));
        let mut draws = Draws::new(1);
        let wrenches = draws.loads(POSES);
        let (random, smooth) = (draws.postures(POSES), draws.path(POSES));
        let (rows, columns) = Output::$kind.shape(arm.dof());
        for (q, w) in random.iter().zip(&wrenches).take(64) {
            compare(&arms::$arm::plain::Robot, &arm, Output::$kind, q, w);
            compare(&arms::$arm::fused::Robot, &arm, Output::$kind, q, w);
        }
        for (path, poses) in [("", &random), (", smooth", &smooth)] {
            let input = (&poses[..], &wrenches[..]);
            let (q4, w4) = (by_four(poses), by_four(&wrenches));
            let (q8, w8) = (by_eight(poses), by_eight(&wrenches));
            let (x4, x8) = ((&q4[..], &w4[..]), (&q8[..], &w8[..]));
            let postures: Vec<_> =
                poses.iter().map(arms::$arm::plain::Posture::new).collect();
            let given = (&postures[..], &wrenches[..]);
            let robot = &arms::$arm::plain::Robot;
            let (q_flat, w_flat) = (poses.as_flattened(), wrenches.as_flattened());
            let batch = |cores: bool| {
                let mut out = vec![0.0; rows * columns * POSES];
                move || {
                    let wrenches = Wrenches::Each(w_flat);
                    let (kind, layout) = (Output::$kind, Layout::Poses);
                    let done = match cores {
                        false => evaluate(robot, kind, layout, q_flat, wrenches, &mut out),
                        true => evaluate_parallel(robot, kind, layout, q_flat, wrenches, &mut out),
                    };
                    done.expect("the arm is stable");
                    black_box(&mut out);
                }
            };
            let mut out = vec![0.0; rows * columns];
            let generic = || {
                for (q, w) in poses.iter().zip(&wrenches) {
                    out = arm.evaluate(Output::$kind, q, w).expect("the arm is stable");
                    black_box(&mut out);
                }
            };
            let mut candidates = vec![
                Candidate::new("plain", 1, input, |$q, $w| {
                    let _ = $w;
                    arms::$arm::plain::$function $args
                }),
                Candidate::new("fused", 1, input, |$q, $w| {
                    let _ = $w;
                    arms::$arm::fused::$function $args
                }),
                Candidate::new("given", 1, given, |$q, $w| {
                    let _ = $w;
                    arms::$arm::plain::$function::given $args
                }),
                Candidate::new("x4", 4, x4, |$q, $w| {
                    let _ = $w;
                    arms::$arm::plain::$function $args
                }),
                Candidate::new("x8", 8, x8, |$q, $w| {
                    let _ = $w;
                    arms::$arm::plain::$function $args
                }),
                Candidate::new("fused x4", 4, x4, |$q, $w| {
                    let _ = $w;
                    arms::$arm::fused::$function $args
                }),
                Candidate::new("fused x8", 8, x8, |$q, $w| {
                    let _ = $w;
                    arms::$arm::fused::$function $args
                }),
                Candidate::run("batch", POSES, batch(false)),
                Candidate::run("cores", POSES, batch(true)),
                Candidate::run("textbook", POSES, generic),
            ];
            $(
                candidates.push(Candidate::new("ideal", 1, input, |$q, $w| {
                    let _ = $w;
                    $ideal::$function $args
                }));
                candidates.push(Candidate::new("ideal x4", 4, x4, |$q, $w| {
                    let _ = $w;
                    $ideal::$function $args
                }));
                candidates.push(Candidate::new("ideal x8", 8, x8, |$q, $w| {
                    let _ = $w;
                    $ideal::$function $args
                }));
            )?
            print(&format!("{}{path}", stringify!($function)), &mut candidates, ROUNDS);
        }
    }};
}

macro_rules! arm {
    ($arm:ident $($ideal:ident)?) => {
        println!("{}: ns per pose (ratio to plain)", stringify!($arm));
        output!($arm pose Pose |q, w| (q) $($ideal)?);
        output!($arm jacobian Jacobian |q, w| (q) $($ideal)?);
        output!($arm complementary_stiffness ComplementaryStiffness |q, w| (q, w) $($ideal)?);
        output!($arm deflection_first_order DeflectionFirstOrder |q, w| (q, w) $($ideal)?);
        output!($arm compliance Compliance |q, w| (q) $($ideal)?);
        output!($arm deflection Deflection |q, w| (q, w) $($ideal)?);
    };
}

/// Everything by the one function for it, by the six functions that it stands for, and by the textbook.
fn together() {
    use arms::kuka_kr240::{fused, plain};
    let arm = textbook("kuka_kr240");
    let mut draws = Draws::new(1);
    let wrenches = draws.loads(POSES);
    let poses = draws.postures(POSES);
    let input = (&poses[..], &wrenches[..]);
    let (q8, w8) = (by_eight(&poses), by_eight(&wrenches));
    let x8 = (&q8[..], &w8[..]);
    let outputs = [
        Output::Pose,
        Output::Jacobian,
        Output::ComplementaryStiffness,
        Output::JointTorque,
        Output::Compliance,
        Output::Deflection,
    ];
    let mut out = Vec::new();
    let generic = || {
        for (q, w) in poses.iter().zip(&wrenches) {
            out = outputs.map(|o| arm.evaluate(o, q, w).expect("the arm is stable")).to_vec();
            black_box(&mut out);
        }
    };
    let mut candidates = [
        Candidate::new("plain", 1, input, plain::all),
        Candidate::new("fused", 1, input, fused::all),
        Candidate::new("ideal", 1, input, ideal::all),
        Candidate::new("six functions", 1, input, |q, w| {
            let (pose, jacobian) = (fused::pose(q), fused::jacobian(q));
            let torque = fused::joint_torque(q, w);
            let stiffness = fused::complementary_stiffness(q, w);
            (pose, jacobian, stiffness, torque, fused::compliance(q), fused::deflection(q, w))
        }),
        Candidate::new("x8", 8, x8, plain::all),
        Candidate::new("fused x8", 8, x8, fused::all),
        Candidate::new("ideal x8", 8, x8, ideal::all),
        Candidate::run("textbook", POSES, generic),
    ];
    println!("kuka_kr240, everything together");
    print("all", &mut candidates, ROUNDS);
}

/// Large batches on one core and on all of them, some in a row: the first wakes the other cores.
fn cores() {
    use arms::kuka_kr240::fused::Robot;
    const MANY: usize = 50 * POSES;
    const IN_A_ROW: usize = 20;
    let mut draws = Draws::new(1);
    let wrenches = draws.loads(MANY);
    let poses = draws.postures::<6>(MANY);
    let (q, w) = (poses.as_flattened(), wrenches.as_flattened());
    println!("kuka_kr240, {MANY} poses in one batch");
    for (row, output) in [
        ("pose", Output::Pose),
        ("jacobian", Output::Jacobian),
        ("deflection_first_order", Output::DeflectionFirstOrder),
        ("deflection", Output::Deflection),
    ] {
        let (rows, columns) = output.shape(6);
        let run = |layout: Layout, all: bool| {
            let mut out = vec![0.0; rows * columns * MANY];
            move || {
                let wrenches = Wrenches::Each(w);
                let work = |_: &rayon::Scope<'_>| {
                    for _ in 0..IN_A_ROW {
                        let done = match all {
                            false => evaluate(&Robot, output, layout, q, wrenches, &mut out),
                            true => {
                                evaluate_parallel(&Robot, output, layout, q, wrenches, &mut out)
                            }
                        };
                        done.expect("the arm is stable");
                        black_box(&mut out);
                    }
                };
                // A thread of the pool works along; any other would wait for it.
                rayon::scope(work);
            }
        };
        let mut candidates = [
            Candidate::run("one core", IN_A_ROW * MANY, run(Layout::Poses, false)),
            Candidate::run("all cores", IN_A_ROW * MANY, run(Layout::Poses, true)),
            Candidate::run("by quantity", IN_A_ROW * MANY, run(Layout::Quantities, false)),
            Candidate::run("all cores", IN_A_ROW * MANY, run(Layout::Quantities, true)),
        ];
        print(row, &mut candidates, ROUNDS);
    }
}

/// Each call waits for the last. `called` is the ideal behind a call, as a function of that size is unless
/// it is forced into the loop.
fn latency() {
    use arms::kuka_kr240::{fused, plain};
    #[inline(never)]
    fn jacobian(q: &[f64; 6]) -> [[f64; 6]; 6] {
        ideal::jacobian(q)
    }
    #[inline(never)]
    fn stiffness(q: &[f64; 6], w: &[f64; 6]) -> [[f64; 6]; 6] {
        ideal::complementary_stiffness(q, w)
    }
    let mut draws = Draws::new(1);
    let wrenches = draws.loads(POSES);
    let poses = draws.postures(POSES);
    let input = (&poses[..], &wrenches[..]);
    let entry = |matrix: &[[f64; 6]; 6]| matrix[4][3];
    println!("kuka_kr240, each call waiting for the last");
    let mut candidates = [
        Candidate::serial("plain", input, |q, _| plain::jacobian(q), entry),
        Candidate::serial("fused", input, |q, _| fused::jacobian(q), entry),
        Candidate::serial("ideal", input, |q, _| ideal::jacobian(q), entry),
        Candidate::serial("called", input, |q, _| jacobian(q), entry),
    ];
    print("jacobian", &mut candidates, ROUNDS);
    let mut candidates = [
        Candidate::serial("plain", input, plain::complementary_stiffness, entry),
        Candidate::serial("fused", input, fused::complementary_stiffness, entry),
        Candidate::serial("ideal", input, ideal::complementary_stiffness, entry),
        Candidate::serial("called", input, stiffness, entry),
    ];
    print("complementary_stiffness", &mut candidates, ROUNDS);
}

/// Every branch at a pose of the arm's own, the closed form alone and with the steps behind it, one by one and in lanes; and one
/// set-point under a load.
macro_rules! inverse {
    ($arm:ident $robot:expr, $lanes:expr) => {{
        let (arm, lanes) = ($robot, $lanes);
        let mut draws = Draws::new(1);
        let (wrenches, postures) = (draws.loads(POSES), draws.postures::<6>(POSES));
        let stands = |q: &[f64; 6]| -> (Pose<f64>, [f64; 6]) { (arm.pose(&arm.posture(q)), *q) };
        let poses: Vec<_> = postures.iter().map(stands).collect();
        let input = (&poses[..], &wrenches[..]);
        let mut candidates = [
            Candidate::new("closed form", 1, input, |(pose, q), _| arm.closed_form(pose, q)),
            Candidate::new("all branches", 1, input, |(pose, q), _| {
                arm.inverse_kinematics(pose, q)
            }),
            Candidate::new("set-points", 1, input, |(pose, q), w| arm.set_points(pose, q, w)),
            Candidate::new("in lanes", 1, input, |(pose, q), w| {
                batch::set_points(&arm, &lanes, pose, q, w)
            }),
            Candidate::new("set-point", 1, input, |(pose, q), w| {
                arm.set_point(pose, q, w, (1e-6, 1e-6))
            }),
        ];
        print(stringify!($arm), &mut candidates, ROUNDS);
    }};
}

fn inverses() {
    use arms::SIDES as sides;
    use arms::inverse::{calibrated_kuka, calibrated_ur10, irb120, kuka_kr240, ur10};
    let in_lanes = sides.map(<<f64 as batch::Number>::Lanes as Scalar>::lit);
    println!("the inverse: ns per pose (ratio to the closed form)");
    inverse!(kuka_kr240 kuka_kr240::Robot, kuka_kr240::Robot);
    inverse!(ur10 ur10::Robot, ur10::Robot);
    inverse!(irb120 irb120::Robot, irb120::Robot);
    inverse!(calibrated_kuka calibrated_kuka::Robot { sides }, calibrated_kuka::Robot { sides: in_lanes });
    inverse!(calibrated_ur10 calibrated_ur10::Robot { sides }, calibrated_ur10::Robot { sides: in_lanes });
}

fn main() {
    if std::env::args().any(|argument| argument == "inverse") {
        return inverses();
    }
    arm!(kuka_kr240 ideal);
    together();
    latency();
    cores();
    arm!(ur10);
    arm!(iiwa14);
    arm!(planar_2r);
    inverses();
}
