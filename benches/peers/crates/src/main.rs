//! The equations of motion of a UR10 and a Panda by the crates dynibo (f64) and featherstone (f32) beside stiffarm in
//! Rust: each result compared with the textbook's, then timed by turns. Prints the median nanoseconds a call and, of the
//! peers, how many times stiffarm's that is: the least, the median and the most over the rounds.
//!
//! ```text
//! crates-peer DIRECTORY
//! crates-peer              # the inverse kinematics alone
//! ```

mod inverse;

use std::fmt::Write as _;

use dynibo::Robot;
use featherstone::prelude::*;
use nalgebra::{Matrix3, Rotation3, Vector3};
use rustix::time::{ClockId, clock_gettime};

stiffarm::robot! {
    /// Six joints.
    pub mod ur10 from "../../../robots/arms/ur10.toml";
    outputs: inverse_dynamics, mass_matrix, forward_dynamics;
}
stiffarm::robot! {
    /// Seven joints.
    pub mod panda from "../../../robots/arms/panda.toml";
    outputs: inverse_dynamics, mass_matrix, forward_dynamics;
}

const ROUNDS: usize = 41;

type Call<'a> = Box<dyn FnMut(&[f64], &mut [f64]) + 'a>;

fn read(path: &str) -> Vec<f64> {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    bytes.as_chunks().0.iter().map(|eight| f64::from_le_bytes(*eight)).collect()
}

/// A line of numbers for gravity and one for each link: see the command that wrote them.
fn links(path: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let number = |word: &str| word.parse().expect("a number");
    text.lines().map(|line| line.split(' ').map(number).collect()).collect()
}

fn urdf(links: &[Vec<f64>]) -> String {
    let mut text = String::from("<robot name=\"arm\"><link name=\"link0\"/>");
    for (k, x) in links[1..].iter().enumerate() {
        let _ = write!(
            text,
            "<joint name=\"joint{0}\" type=\"revolute\"><parent link=\"link{k}\"/><child link=\"link{0}\"/>\
             <origin xyz=\"{1} {2} {3}\" rpy=\"{4} 0 0\"/><axis xyz=\"0 0 1\"/>\
             <limit lower=\"-10\" upper=\"10\" effort=\"1e4\" velocity=\"100\"/></joint><link name=\"link{0}\"><inertial>\
             <mass value=\"{5}\"/><origin xyz=\"{6} {7} {8}\"/><inertia ixx=\"{9}\" ixy=\"{10}\" ixz=\"{11}\" \
             iyy=\"{12}\" iyz=\"{13}\" izz=\"{14}\"/></inertial></link>",
            k + 1,
            x[0],
            x[1],
            x[2],
            x[3],
            x[4],
            x[5],
            x[6],
            x[7],
            x[8],
            x[9],
            x[10],
            x[11],
            x[12],
            x[13],
        );
    }
    text + "</robot>"
}

fn articulated(links: &[Vec<f64>]) -> ArticulatedBody {
    let vector = |x: &[f64]| Vector3::new(x[0] as f32, x[1] as f32, x[2] as f32);
    let mut body = ArticulatedBody::new();
    body.set_gravity(vector(&links[0]));
    for (k, x) in links[1..].iter().enumerate() {
        let [xx, xy, xz, yy, yz, zz] = core::array::from_fn(|i| x[8 + i] as f32);
        let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let inertia = SpatialInertia::from_mass_inertia(x[4] as f32, vector(&x[5..8]), tensor);
        // From the parent's coordinates to the joint's, whose place is told in the joint's axes.
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), x[3] as f32).inverse();
        let origin = turn * vector(&x[..3]);
        let place = SpatialTransform::from_rotation_translation(*turn.matrix(), origin);
        body.add_body(
            format!("link{k}"),
            k as i32 - 1,
            GenJoint::Revolute { axis: Vector3::z() },
            inertia,
            place,
        );
    }
    body
}

fn single(to: &mut [f32], from: &[f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from as f32);
}

/// Joint values as featherstone 0.1 takes them: its joints turn the other way than their rates and torques count.
fn turned(to: &mut [f32], from: &[f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = -(*from as f32));
}

fn double<'a>(to: &mut [f64], from: impl IntoIterator<Item = &'a f32>) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = f64::from(*from));
}

/// Nanoseconds of this process on a processor: other programs do not disturb them as much as the clock's.
fn processor_time() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    1e9 * now.tv_sec as f64 + now.tv_nsec as f64
}

/// The least, the median and the most.
fn spread(times: &[f64]) -> (f64, f64, f64) {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    (sorted[0], sorted[sorted.len() / 2], sorted[sorted.len() - 1])
}

/// Compares every way with the textbook's results, the last to single precision, and times all by turns.
fn compete(directory: &str, arm: &str, output: &str, n: usize, mut ways: [(&str, Call<'_>); 3]) {
    let states = read(&format!("{directory}/{arm}.states"));
    let expected = read(&format!("{directory}/{arm}.{output}"));
    let calls = states.len() / (3 * n);
    let size = expected.len() / calls;
    let scale = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut out = vec![0.0; 64 * size];
    for (peer, call) in &mut ways {
        // A mass matrix's condition, some 10^3, times rounding.
        let most = if *peer == "featherstone-f32" { 1e-3 } else { 1e-11 };
        for (state, expected) in states.chunks(3 * n).zip(expected.chunks(size)) {
            call(state, &mut out[..size]);
            for (a, b) in out.iter().zip(expected) {
                assert!((a - b).abs() <= most * scale, "{peer} {arm} {output}: {a}, not {b}");
            }
        }
    }
    let mut times = [const { Vec::new() }; 3];
    for round in 0..=ROUNDS {
        for ((_, call), times) in ways.iter_mut().zip(&mut times) {
            let start = processor_time();
            // The results of 64 states are written over and over, so that they stay in the first cache.
            for states in states.chunks(3 * n * 64) {
                states.chunks(3 * n).zip(out.chunks_mut(size)).for_each(|(x, out)| call(x, out));
                std::hint::black_box(&mut out);
            }
            // The first round warms up.
            if round > 0 {
                times.push((processor_time() - start) / calls as f64);
            }
        }
    }
    print!("{arm} {output}: stiffarm-rust {:.1}", spread(&times[0]).1);
    for ((peer, _), of_peer) in ways.iter().zip(&times).skip(1) {
        let ratios: Vec<f64> = of_peer.iter().zip(&times[0]).map(|(a, b)| a / b).collect();
        let (least, middle, most) = spread(&ratios);
        print!(", {peer} {:.1} ({least:.2} {middle:.2} {most:.2})", spread(of_peer).1);
    }
    println!();
}

macro_rules! arm {
    ($directory:ident $arm:ident $n:literal) => {{
        let links = links(&format!("{}/{}.links", $directory, stringify!($arm)));
        let path = format!("{}/{}.urdf", $directory, stringify!($arm));
        std::fs::write(&path, urdf(&links)).expect("the directory can be written to");
        let dynibo = || Robot::from_urdf(&path).expect("a robot");
        let (mut first, mut second, mut third) = (dynibo(), dynibo(), dynibo());
        let [mut body, mut again, mut another] = [(); 3].map(|()| articulated(&links));
        compete(
            $directory,
            stringify!($arm),
            "inverse_dynamics",
            $n,
            [
                (
                    "stiffarm",
                    Box::new(|x, out| {
                        let ([q, qd, qdd], _) = x.as_chunks::<$n>() else { unreachable!() };
                        out.copy_from_slice(&$arm::inverse_dynamics(q, qd, qdd));
                    }),
                ),
                (
                    "dynibo",
                    Box::new(|x, out| {
                        let [q, qd, qdd] = [&x[..$n], &x[$n..2 * $n], &x[2 * $n..]];
                        first.inverse_dynamics(q, qd, qdd, &[], out).expect("torques");
                    }),
                ),
                (
                    "featherstone-f32",
                    Box::new(|x, out| {
                        turned(body.q.as_mut_slice(), &x[..$n]);
                        single(body.qd.as_mut_slice(), &x[$n..2 * $n]);
                        single(body.qdd.as_mut_slice(), &x[2 * $n..]);
                        double(out, &rnea_inverse_dynamics(&body).0);
                    }),
                ),
            ],
        );
        compete(
            $directory,
            stringify!($arm),
            "mass_matrix",
            $n,
            [
                (
                    "stiffarm",
                    Box::new(|x, out| {
                        let ([q, ..], _) = x.as_chunks::<$n>() else { unreachable!() };
                        out.copy_from_slice($arm::mass_matrix(q).as_flattened());
                    }),
                ),
                ("dynibo", Box::new(|x, out| second.mass_matrix(&x[..$n], out).expect("a matrix"))),
                (
                    "featherstone-f32",
                    Box::new(|x, out| {
                        turned(again.q.as_mut_slice(), &x[..$n]);
                        double(out, &crba_mass_matrix(&again));
                    }),
                ),
            ],
        );
        compete(
            $directory,
            stringify!($arm),
            "forward_dynamics",
            $n,
            [
                (
                    "stiffarm",
                    Box::new(|x, out| {
                        let ([q, qd, tau], _) = x.as_chunks::<$n>() else { unreachable!() };
                        out.copy_from_slice(&$arm::forward_dynamics(q, qd, tau).expect("masses"));
                    }),
                ),
                (
                    "dynibo",
                    Box::new(|x, out| {
                        let [q, qd, tau] = [&x[..$n], &x[$n..2 * $n], &x[2 * $n..]];
                        third.forward_dynamics(q, qd, tau, &[], out).expect("accelerations");
                    }),
                ),
                (
                    "featherstone-f32",
                    Box::new(|x, out| {
                        turned(another.q.as_mut_slice(), &x[..$n]);
                        single(another.qd.as_mut_slice(), &x[$n..2 * $n]);
                        single(another.tau.as_mut_slice(), &x[2 * $n..]);
                        double(out, aba_forward_dynamics(&mut another));
                    }),
                ),
            ],
        );
    }};
}

fn main() {
    let directory = std::env::args().nth(1);
    let Some(directory) = directory.as_deref() else { return inverse::all(None) };
    if std::path::Path::new(directory).join("ur10.links").exists() {
        arm!(directory ur10 6);
        arm!(directory panda 7);
    }
    inverse::all(Some(directory));
}
