//! For `benches/peers/run.sh`: writes what peers of the equations of motion are fed into a directory, for each arm its
//! links (`ARM.links`, text), states and the textbook's results (little-endian doubles) and its kernels in C; and prints
//! the times of the kernels in Rust.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use stiffarm_bench::arms::{self, FILES, textbook};
use stiffarm_bench::timing::{Candidate, medians};
use stiffarm_bench_arms::lanes::by_eight;
use stiffarm_codegen::emit::{COptions, Precision, Sines};
use stiffarm_codegen::program::{Formulas, Module, Term};
use stiffarm_codegen::robot::Robot;
use stiffarm_draws::Draws;
use stiffarm_kernels::Output;
use stiffarm_kernels::generic::{Arm, Convention};

const STATES: usize = 2048;

const OUTPUTS: [Output; 7] = [
    Output::InverseDynamics,
    Output::Bias,
    Output::MassMatrix,
    Output::ForwardDynamics,
    Output::TorqueRegressor,
    Output::InverseDynamicsByJoints,
    Output::InverseDynamicsByRates,
];

type Failure = Box<dyn std::error::Error>;

/// The kernels of one arm, one state and eight in lanes.
macro_rules! candidates {
    ($arm:ident, $n:literal, $states:expr, $eight:expr) => {{
        let (states, eight) = (&$states[..], &$eight[..]);
        let mut all = Vec::new();
        candidates!(all $arm $n "stiffarm-rust" 1 states);
        candidates!(all $arm $n "stiffarm-rust-x8" 8 eight);
        all
    }};
    ($all:ident $arm:ident $n:literal $way:literal $lanes:literal $states:ident) => {
        candidates!($all $arm $n $way $lanes $states
            inverse_dynamics |q, qd, qdd| (q, qd, qdd),
            bias |q, qd, _| (q, qd),
            mass_matrix |q, _, _| (q),
            forward_dynamics |q, qd, tau| (q, qd, tau),
            torque_regressor |q, qd, qdd| (q, qd, qdd)
        );
        $all.push(Candidate::writing(
            concat!(stringify!($arm), " torque_regressor::write ", $way),
            $lanes,
            ($states, $states),
            [[$states[0][0]; $n]; 10 * $n],
            |state, _, out| {
                use arms::$arm::plain::{Posture, torque_regressor};
                let ([q, qd, qdd], _) = state.as_chunks::<$n>() else {
                    unreachable!("three of each joint");
                };
                torque_regressor::write(&Posture::new(q), qd, qdd, out);
            },
        ));
    };
    ($all:ident $arm:ident $n:literal $way:literal $lanes:literal $states:ident
        $($function:ident |$q:pat_param, $qd:pat_param, $last:pat_param| $args:tt),+) => {$(
        $all.push(Candidate::new(
            concat!(stringify!($arm), " ", stringify!($function), " ", $way),
            $lanes,
            ($states, $states),
            |state, _| {
                let ([$q, $qd, $last], _) = state.as_chunks::<$n>() else {
                    unreachable!("three of each joint");
                };
                arms::$arm::plain::$function $args
            },
        ));
    )+};
}
fn main() -> Result<(), Failure> {
    let directory = std::env::args().nth(1).ok_or("usage: dynamics DIRECTORY")?;
    let directory = Path::new(&directory);
    let states = Draws::new(1).postures::<18>(STATES);
    write(directory, "ur10", &states)?;
    let eight = by_eight(&states);
    time(&mut candidates!(ur10, 6, states, eight));
    let states = Draws::new(1).postures::<21>(STATES);
    write(directory, "panda", &states)?;
    let eight = by_eight(&states);
    time(&mut candidates!(panda, 7, states, eight));
    Ok(())
}

/// Everything of one arm; states are values, rates and accelerations or torques in a row.
fn write<const M: usize>(directory: &Path, id: &str, states: &[[f64; M]]) -> Result<(), Failure> {
    let (_, text) = FILES.iter().find(|(known, _)| *known == id).ok_or("one of the arms")?;
    let (robot, _) = Robot::from_toml(text, id)?;
    let robot = Robot { outputs: OUTPUTS.to_vec(), ..robot };
    let name = id.to_owned();
    let kernels = Module::new(&robot)
        .function("torque_derivatives", "How the torques of a motion change", torque_derivatives)?
        .c(&COptions { name, precision: Precision::F64, sines: Sines::Polynomial })?;
    std::fs::write(directory.join(format!("{id}.h")), kernels.header)?;
    std::fs::write(directory.join(format!("{id}.c")), kernels.source)?;
    let arm = textbook(id);
    std::fs::write(directory.join(format!("{id}.links")), links(&arm)?)?;
    let numbers = |name: &str, numbers: &[f64]| {
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(directory.join(format!("{id}.{name}")), bytes)
    };
    numbers("states", states.as_flattened())?;
    for output in OUTPUTS {
        let mut results = Vec::new();
        for state in states {
            let state = &state[..output.state(arm.dof())];
            results.extend(arm.evaluate(output, state, &[0.0; 6])?);
        }
        numbers(output.name(), &results)?;
    }
    Ok(())
}

/// By joint values, rates and accelerations, which have much in common.
fn torque_derivatives(f: &Formulas<'_>) {
    let n = f.joints().len();
    for (name, unit, output) in [
        ("by_joints", "N·m/rad", Output::InverseDynamicsByJoints),
        ("by_rates", "N·m·s/rad", Output::InverseDynamicsByRates),
        ("by_accelerations", "kg·m²", Output::MassMatrix),
    ] {
        let columns: Vec<Vec<Term<'_>>> = f.output(output).chunks(n).map(<[_]>::to_vec).collect();
        f.result(name, unit, output.sentence(), columns);
    }
}

/// A line for gravity and one for each link, in the axes of its joint, z along it: where the joint stands in those of
/// the joint before, `x y z` and its turn about x; mass; centre; tensor of inertia about that, xx xy xz yy yz zz.
fn links(arm: &Arm) -> Result<String, Failure> {
    let mut text = format!("{} {} {}\n", arm.gravity.x, arm.gravity.y, arm.gravity.z);
    let (mut before, mut turned) = (Isometry3::identity(), 0.0);
    for joint in &arm.joints {
        if joint.theta != 0.0 || joint.beta != 0.0 {
            return Err("the peers are given tables without offsets".into());
        }
        let lean = Isometry3::from_parts(
            Translation3::new(joint.a, 0.0, 0.0),
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), joint.alpha),
        );
        // In the modified convention a row begins with its lean, in the standard one it ends with it.
        let (place, alpha, row) = match arm.convention {
            Convention::Modified => (lean, joint.alpha, Isometry3::identity()),
            Convention::Standard => (before, turned, lean),
        };
        let origin = place * nalgebra::Point3::new(0.0, 0.0, joint.d);
        let centre = row * nalgebra::Point3::from(joint.com);
        let turn = row.rotation.to_rotation_matrix();
        let i = turn * joint.inertia * turn.transpose();
        write!(text, "{} {} {} {alpha}", origin.x, origin.y, origin.z)?;
        write!(text, " {} {} {} {}", joint.mass, centre.x, centre.y, centre.z)?;
        let tensor = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
        tensor.iter().try_for_each(|at| write!(text, " {}", i[*at]))?;
        text.push('\n');
        (before, turned) = (lean, joint.alpha);
    }
    Ok(text)
}

fn time(candidates: &mut [Candidate<'_>]) {
    let times = medians(candidates, 41);
    for (candidate, time) in candidates.iter().zip(times) {
        println!("{} {time:.1}", candidate.name);
    }
}
