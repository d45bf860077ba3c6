//! Batches give what the kernels give pose by pose, to the bit, in either layout and on all cores.

use stiffarm::kernels::batch::{
    Error, Layout, Number, Wrenches, evaluate, evaluate_columns, evaluate_parallel,
};
use stiffarm::kernels::{Kernels, Output};

use crate::compare::Draws;

/// The same numbers quantity after quantity.
fn by_quantity<T: Copy>(by_pose: &[T], poses: usize) -> Vec<T> {
    let size = by_pose.len().checked_div(poses).unwrap_or(0);
    (0..size).flat_map(|k| (0..poses).map(move |pose| by_pose[pose * size + k])).collect()
}

/// Of each pose `state` numbers of the joints.
struct Case<T> {
    poses: usize,
    state: usize,
    q: Vec<T>,
    wrenches: Vec<T>,
}

fn case<T: Number>(state: usize, poses: usize, draws: &mut Draws) -> Case<T> {
    let mut draw = |count: usize, scale: f64| -> Vec<T> {
        (0..count).map(|_| T::lit(0.6 + scale * draws.unit())).collect()
    };
    Case { poses, state, q: draw(state * poses, 2.5), wrenches: draw(6 * poses, 10.0) }
}

/// Every pose by a call of its own.
fn one_by_one<T: Number>(
    robot: &impl Kernels<T>,
    output: Output,
    case: &Case<T>,
    wrench: impl Fn(usize) -> [T; 6],
) -> Vec<T> {
    let (rows, columns) = output.shape(robot.dof());
    let mut out = vec![T::lit(0.0); rows * columns * case.poses];
    for (pose, out) in out.chunks_mut(rows * columns).enumerate() {
        let q = &case.q[pose * case.state..][..case.state];
        robot.evaluate(output, q, &wrench(pose), out).expect("the arm is stable");
    }
    out
}

fn slices<T>(columns: &[Vec<T>]) -> Vec<&[T]> {
    columns.iter().map(Vec::as_slice).collect()
}

fn check<T, R>(robot: &R, outputs: &[Output])
where
    T: Number + PartialEq + core::fmt::Debug,
    R: Kernels<T> + Kernels<T::Lanes> + Sync,
{
    let mut draws = Draws::new(8);
    for poses in [0, 1, 3, 4, 7, 8, 9, 21, stiffarm_draws::few_or_many(1100, 2500)] {
        for &output in outputs {
            let case = case::<T>(output.state(Kernels::<T>::dof(robot)), poses, &mut draws);
            let wrench = |pose: usize| core::array::from_fn(|k| case.wrenches[6 * pose + k]);
            let q_rows = by_quantity(&case.q, poses);
            let wrench_rows = by_quantity(&case.wrenches, poses);
            let each = one_by_one(robot, output, &case, wrench);
            let same = one_by_one(robot, output, &case, |_| wrench(0));
            let columns = |rows: &'_ [T]| -> Vec<Vec<T>> {
                rows.chunks(poses.max(1)).map(<[T]>::to_vec).collect()
            };
            let (q, loads) = (columns(&q_rows), columns(&wrench_rows));
            if poses > 0 {
                let mut out = vec![T::lit(f64::NAN); each.len()];
                evaluate_columns(robot, output, &slices(&q), &slices(&loads), &mut out)
                    .expect("the arm is stable");
                assert_eq!(out, each, "{} columns {poses}", output.name());
            }
            let layouts = [
                (Layout::Poses, &case.q, &case.wrenches),
                (Layout::Quantities, &q_rows, &wrench_rows),
            ];
            for (layout, q, wrenches) in layouts {
                for run in [evaluate::<T, R>, evaluate_parallel::<T, R>] {
                    let expected = |by_pose: &[T]| match layout {
                        Layout::Poses => by_pose.to_vec(),
                        Layout::Quantities => by_quantity(by_pose, poses),
                    };
                    let mut out = vec![T::lit(f64::NAN); each.len()];
                    run(robot, output, layout, q, Wrenches::Each(wrenches), &mut out)
                        .expect("the arm is stable");
                    assert_eq!(out, expected(&each), "{} {layout:?} {poses}", output.name());
                    if poses > 0 {
                        let one = wrench(0);
                        run(robot, output, layout, q, Wrenches::One(&one), &mut out)
                            .expect("the arm is stable");
                        assert_eq!(out, expected(&same), "{} {layout:?} {poses}", output.name());
                    }
                }
            }
        }
    }
}

#[test]
fn batches_are_poses_one_by_one() {
    use stiffarm_robots::{kuka_kr240, stanford, ur10};
    let at_rest = [Output::Jacobian, Output::ComplementaryStiffness, Output::Deflection];
    check::<f64, _>(&kuka_kr240::Robot, &at_rest);
    check::<f32, _>(&kuka_kr240::Robot, &at_rest);
    check::<f64, _>(&stanford::Robot, &at_rest);
    let moving = [Output::InverseDynamics, Output::ForwardDynamics, Output::TorqueRegressor];
    check::<f64, _>(&ur10::Robot, &moving);
    check::<f32, _>(&ur10::Robot, &moving);
    let by = [Output::InverseDynamicsByJoints, Output::InverseDynamicsByRates];
    check::<f64, _>(&crate::by_joints::ur10::Robot, &by);
    check::<f32, _>(&crate::by_joints::ur10::Robot, &by);
    check::<f64, _>(
        &crate::by_joints::kr240::Robot,
        &[Output::Hessian, Output::DeflectionByJoints],
    );
}

#[test]
fn poses_that_buckle_are_named_and_left_single() {
    let robot = &stiffarm_robots::kuka_kr240::Robot;
    let poses = 3000;
    let mut case = case::<f64>(6, poses, &mut Draws::new(9));
    let heavy = [5, 6, 1029, 2999];
    for pose in heavy {
        // Stretched out and pressed from the tip towards the base, far beyond buckling.
        case.q[6 * pose..][..6].fill(0.0);
        case.wrenches[6 * pose..][..6].copy_from_slice(&[-1e9, 0.0, -1e9, 0.0, 0.0, 0.0]);
        let wrench = core::array::from_fn(|k| case.wrenches[6 * pose + k]);
        let q = &case.q[6 * pose..][..6];
        let single = Kernels::<f64>::evaluate(robot, Output::Deflection, q, &wrench, &mut [0.0; 6]);
        assert_eq!(single, Err(stiffarm::kernels::Error::Unstable));
    }
    for run in [evaluate::<f64, _>, evaluate_parallel::<f64, _>] {
        let mut out = vec![f64::NAN; 6 * poses];
        let wrenches = Wrenches::Each(&case.wrenches);
        let done = run(robot, Output::Deflection, Layout::Poses, &case.q, wrenches, &mut out);
        assert_eq!(done, Err(Error::Unstable { first: 5, count: 4 }));
        for (pose, out) in out.chunks(6).enumerate() {
            let expected = heavy.contains(&pose);
            assert!(out.iter().all(|x| x.is_nan() == expected), "pose {pose}: {out:?}");
        }
    }
}

#[test]
fn columns_that_do_not_fit_are_refused() {
    let robot = &stiffarm_robots::kuka_kr240::Robot;
    let run = |q: &[usize], wrench: &[usize], out: usize| {
        let columns = |lengths: &[usize]| -> Vec<Vec<f64>> {
            lengths.iter().map(|length| vec![0.0; *length]).collect()
        };
        let (q, wrench, mut out) = (columns(q), columns(wrench), vec![7.0; out]);
        let (q, wrench) = (slices(&q), slices(&wrench));
        let done = evaluate_columns(robot, Output::JointTorque, &q, &wrench, &mut out);
        assert!(done.is_ok() || out.iter().all(|x| *x == 7.0), "something was written");
        done.map_err(|e| e.to_string())
    };
    assert_eq!(run(&[2; 6], &[2; 6], 12), Ok(()));
    assert_eq!(run(&[0; 6], &[0; 6], 0), Ok(()));
    assert_eq!(
        run(&[2; 5], &[2; 6], 12).unwrap_err(),
        "q holds 10 numbers, which is no multiple of a pose's 6"
    );
    assert!(run(&[2, 2, 2, 2, 2, 1], &[2; 6], 12).unwrap_err().starts_with("q holds 11 numbers"));
    assert_eq!(run(&[2; 6], &[], 12).unwrap_err(), "wrench holds 0 numbers where 12 are needed");
    assert_eq!(run(&[2; 6], &[2; 6], 11).unwrap_err(), "out holds 11 numbers where 12 are needed");
}

#[test]
fn slices_that_do_not_fit_are_refused() {
    let robot = &stiffarm_robots::kuka_kr240::Robot;
    let run = |q: usize, wrench: usize, out: usize| {
        let (q, wrench, mut out) = (vec![0.0; q], vec![0.0; wrench], vec![7.0; out]);
        let wrenches = Wrenches::Each(&wrench);
        let done = evaluate(robot, Output::JointTorque, Layout::Quantities, &q, wrenches, &mut out);
        assert!(done.is_ok() || out.iter().all(|x| *x == 7.0), "something was written");
        done.map_err(|e| e.to_string())
    };
    assert_eq!(run(12, 12, 12), Ok(()));
    assert_eq!(
        run(13, 12, 12),
        Err("q holds 13 numbers, which is no multiple of a pose's 6".to_string())
    );
    assert_eq!(run(12, 6, 12), Err("wrench holds 6 numbers where 12 are needed".to_string()));
    assert_eq!(run(12, 12, 18), Err("out holds 18 numbers where 12 are needed".to_string()));
}
