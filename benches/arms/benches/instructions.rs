//! Instructions per call, counted by callgrind: the same on every run, so that a change of a few per cent
//! shows.
//!
//! ```text
//! cargo bench -p stiffarm-bench-arms --bench instructions               # compares with instructions.txt
//! UPDATE=1 cargo bench -p stiffarm-bench-arms --bench instructions      # rewrites it
//! ```
//!
//! Fails where a kernel takes 5 % more than is written there. The counts belong to one compiler and to
//! plain x86-64; with another one, or without valgrind, it says so and compares nothing, which is a failure
//! where `CI=true`.

#![warn(clippy::all)]

use std::collections::HashMap;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, ExitCode};

use rayon::prelude::*;
use stiffarm_bench_arms as arms;
use stiffarm_bench_arms::lanes::by_four;
use stiffarm_draws::Draws;
use stiffarm_kernels::{Inverse as _, Pose, SetPoints};

const SNAPSHOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/instructions.txt");
/// Calls that are counted, and four poses in each call of lanes.
const CALLS: usize = 1000;

type Work = (&'static str, Box<dyn Fn(usize)>);

macro_rules! work {
    ($works:ident $arm:ident $($function:ident |$q:ident, $w:ident| $args:tt),+) => {$(
        $works.push((concat!(stringify!($arm), " ", stringify!($function)), Box::new(|calls| {
            let mut draws = Draws::new(1);
            let (wrenches, poses) = (draws.loads(CALLS), draws.postures(CALLS));
            for ($q, $w) in poses.iter().zip(&wrenches).take(calls) {
                black_box($w);
                let _ = black_box(arms::$arm::plain::$function $args);
            }
        })));
        $works.push((concat!(stringify!($arm), " ", stringify!($function), " x4"), Box::new(|calls| {
            let mut draws = Draws::new(1);
            let (wrenches, poses) = (draws.loads(4 * CALLS), draws.postures(4 * CALLS));
            let (poses, wrenches) = (by_four(&poses), by_four(&wrenches));
            for ($q, $w) in poses.iter().zip(&wrenches).take(calls) {
                black_box($w);
                let _ = black_box(arms::$arm::plain::$function $args);
            }
        })));
    )+};
}

/// The same of the equations of motion, whose states are values, rates and accelerations or torques in a row.
macro_rules! motion {
    ($works:ident $arm:ident $($function:ident |$q:pat_param, $qd:pat_param, $last:pat_param| $args:tt),+) => {$(
        motion!($works $arm "" [Vec::as_slice] $function |$q, $qd, $last| $args);
        motion!($works $arm " x4" [by_four] $function |$q, $qd, $last| $args);
    )+};
    ($works:ident $arm:ident $lanes:literal [$packed:expr]
        $function:ident |$q:pat_param, $qd:pat_param, $last:pat_param| $args:tt) => {
        $works.push((concat!(stringify!($arm), " ", stringify!($function), $lanes), Box::new(|calls| {
            let states = Draws::new(1).postures::<{ 3 * arms::$arm::plain::N }>(4 * CALLS);
            for state in $packed(&states).iter().take(calls) {
                let ([$q, $qd, $last], _) = state.as_chunks::<{ arms::$arm::plain::N }>() else {
                    unreachable!("three of each joint");
                };
                let _ = black_box(arms::$arm::plain::$function $args);
            }
        })));
    };
}

/// The regressor, written into an array that is there.
macro_rules! written {
    ($works:ident $arm:ident $lanes:literal [$packed:expr]) => {
        $works.push((
            concat!(stringify!($arm), " torque_regressor::write", $lanes),
            Box::new(|calls| {
                use arms::$arm::plain::{N, Posture, torque_regressor};
                let states = Draws::new(1).postures::<{ 3 * N }>(4 * CALLS);
                let states = $packed(&states);
                let zero = states[0][0] - states[0][0];
                let mut out = [[zero; N]; 10 * N];
                for state in states.iter().take(calls) {
                    let ([q, qd, qdd], _) = state.as_chunks::<N>() else {
                        unreachable!("three of each joint");
                    };
                    torque_regressor::write(&Posture::new(q), qd, qdd, &mut out);
                    black_box(&mut out);
                }
            }),
        ));
    };
}

macro_rules! motions {
    ($works:ident $($arm:ident),+) => {$(
        motion!($works $arm
            inverse_dynamics |q, qd, qdd| (q, qd, qdd),
            bias |q, qd, _| (q, qd),
            mass_matrix |q, _, _| (q),
            forward_dynamics |q, qd, tau| (q, qd, tau),
            torque_regressor |q, qd, qdd| (q, qd, qdd)
        );
        written!($works $arm "" [Vec::as_slice]);
        written!($works $arm " x4" [by_four]);
    )+};
}

macro_rules! works {
    ($works:ident $($arm:ident),+) => {$(
        work!($works $arm
            pose |q, w| (q),
            jacobian |q, w| (q),
            complementary_stiffness |q, w| (q, w),
            deflection_first_order |q, w| (q, w),
            compliance |q, w| (q),
            deflection |q, w| (q, w)
        );
    )+};
}

/// The inverse: every branch, and one set-point under a load, at poses of the arm's own.
macro_rules! inverses {
    ($works:ident $($arm:ident $robot:expr),+) => {$(
        $works.push((
            concat!(stringify!($arm), " inverse_kinematics"),
            inverse($robot, |arm, pose, near, _| {
                black_box(arm.inverse_kinematics(pose, near));
            }),
        ));
        $works.push((
            concat!(stringify!($arm), " set_point"),
            inverse($robot, |arm, pose, near, wrench| {
                black_box(arm.set_point(pose, near, wrench, (1e-6, 1e-6)));
            }),
        ));
    )+};
}

fn inverse<A: SetPoints<6, 8, f64> + 'static>(
    arm: A,
    work: fn(&A, &Pose<f64>, &[f64; 6], &[f64; 6]),
) -> Box<dyn Fn(usize)> {
    Box::new(move |calls| {
        let mut draws = Draws::new(1);
        let (wrenches, postures) = (draws.loads(CALLS), draws.postures(CALLS));
        let poses = postures.iter().map(|q| arm.pose(&arm.posture(q)));
        let poses: Vec<Pose<f64>> = poses.collect();
        for ((pose, near), wrench) in poses.iter().zip(&postures).zip(&wrenches).take(calls) {
            work(&arm, pose, near, wrench);
        }
    })
}

fn works() -> Vec<Work> {
    let mut works: Vec<Work> = Vec::new();
    works!(works planar_2r, ur10, kuka_kr240, iiwa14);
    motions!(works ur10, panda);
    {
        use arms::SIDES as sides;
        use arms::inverse::{calibrated_kuka, calibrated_ur10, irb120, kuka_kr240, ur10};
        inverses!(works
            ur10 ur10::Robot,
            kuka_kr240 kuka_kr240::Robot,
            irb120 irb120::Robot,
            calibrated_ur10 calibrated_ur10::Robot { sides },
            calibrated_kuka calibrated_kuka::Robot { sides }
        );
    }
    works
}

/// Instructions of this program when it does `name` so many times; `None` if callgrind does not run.
fn instructions(name: &str, calls: usize) -> Option<u64> {
    let program = std::env::current_exe().ok()?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["--count", name, &calls.to_string()])
        .output()
        .ok()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let line = text.lines().find(|line| line.contains("Collected :"))?;
    line.rsplit(' ').next()?.parse().ok()
}

/// The table as it is now.
fn count() -> Option<String> {
    let names: Vec<&str> = works().iter().map(|(name, _)| *name).collect();
    let line = |name: &&str| {
        let (none, all) = (instructions(name, 0)?, instructions(name, CALLS)?);
        let per_call = (all - none) as f64 / CALLS as f64;
        Some(format!("{name:<44} {per_call:>6.0}\n"))
    };
    let lines: String = names.par_iter().map(line).collect::<Option<_>>()?;
    Some(format!("# {}, instructions per call\n{lines}", arms::RUSTC))
}

/// Lines that are more than 5 % above the snapshot's.
fn slower(table: &str, snapshot: &str) -> Vec<String> {
    let read = |line: &str| -> Option<(String, f64)> {
        let (name, count) = line.rsplit_once(' ')?;
        Some((name.trim().to_owned(), count.parse().ok()?))
    };
    let known: HashMap<String, f64> = snapshot.lines().filter_map(read).collect();
    let told = |(name, now): (String, f64)| match known.get(&name) {
        None => Some(format!("{name}: not in the snapshot")),
        Some(before) => (now > 1.05 * before)
            .then(|| format!("{name}: {now} instructions, the snapshot has {before}")),
    };
    table.lines().filter_map(read).filter_map(told).collect()
}

/// A remark on one's own machine; in CI a gate that compares nothing is open.
fn not_compared(why: &str) -> ExitCode {
    eprintln!("nothing is compared: {why}");
    if std::env::var("CI").is_ok_and(|ci| ci == "true") {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, flag, name, calls] = &arguments[..]
        && flag == "--count"
    {
        let works = works();
        let work = works.iter().find(|(known, _)| known == name).expect("one of the works");
        work.1(calls.parse().expect("a number"));
        return ExitCode::SUCCESS;
    }
    let Some(table) = count() else { return not_compared("valgrind does not run") };
    print!("{table}");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(Path::new(SNAPSHOT), table).expect("the snapshot can be written");
        return ExitCode::SUCCESS;
    }
    let snapshot = std::fs::read_to_string(SNAPSHOT).unwrap_or_default();
    if snapshot.lines().next() != table.lines().next() {
        return not_compared("the snapshot was made with another compiler");
    }
    let slower = slower(&table, &snapshot);
    slower.iter().for_each(|line| eprintln!("{line}"));
    if slower.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
