//! For `benches/peers/run.sh`: writes joint vectors and wrenches of the KUKA KR 240-2 with the textbook's
//! results (little-endian doubles) into a directory, and prints the kernels' own times.

use std::io::Write as _;
use std::path::Path;

use stiffarm_bench::arms::kuka_kr240::{fused, plain};
use stiffarm_bench::arms::textbook;
use stiffarm_bench::timing::{Candidate, medians};
use stiffarm_bench_arms::lanes::by_eight;
use stiffarm_draws::Draws;
use stiffarm_kernels::{Output, Pose};

const POSES: usize = 2048;

/// The outputs that peers are given; `all` are all but the last.
const OUTPUTS: [Output; 7] = [
    Output::Pose,
    Output::Jacobian,
    Output::ComplementaryStiffness,
    Output::JointTorque,
    Output::Compliance,
    Output::Deflection,
    Output::DeflectionFirstOrder,
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let directory = std::env::args().nth(1).ok_or("usage: peers DIRECTORY")?;
    let mut draws = Draws::new(1);
    let wrenches = draws.loads(POSES);
    let arm = textbook("kuka_kr240");
    let write = |name: &str, numbers: &[f64]| -> std::io::Result<()> {
        let mut file = std::fs::File::create(Path::new(&directory).join(name))?;
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        file.write_all(&bytes)
    };
    for (path, poses) in [("random", draws.postures::<6>(POSES)), ("smooth", draws.path(POSES))] {
        write(&format!("{path}.q"), poses.as_flattened())?;
        write(&format!("{path}.w"), wrenches.as_flattened())?;
        let mut all = vec![Vec::new(); POSES];
        for output in OUTPUTS {
            let mut numbers = Vec::new();
            for ((q, w), all) in poses.iter().zip(&wrenches).zip(&mut all) {
                let one = arm.evaluate(output, q, w)?;
                numbers.extend_from_slice(&one);
                if output != Output::DeflectionFirstOrder {
                    all.extend(one);
                }
            }
            write(&format!("{path}.{}", output.name()), &numbers)?;
        }
        write(&format!("{path}.all"), &all.concat())?;
        time(path, &poses, &wrenches);
    }
    Ok(())
}

/// Name of the text and way, output, and path, with the nanoseconds of a pose.
fn time(path: &str, poses: &[[f64; 6]], wrenches: &[[f64; 6]]) {
    let input = (poses, wrenches);
    let (q8, w8) = (by_eight(poses), by_eight(wrenches));
    let lanes = (&q8[..], &w8[..]);
    let mut candidates = vec![
        Candidate::new("stiffarm pose", 1, input, |q, _| plain::pose(q)),
        Candidate::new("stiffarm-fused pose", 1, input, |q, _| fused::pose(q)),
        Candidate::new("stiffarm-x8 pose", 8, lanes, |q, _| plain::pose(q)),
        Candidate::new("stiffarm jacobian", 1, input, |q, _| plain::jacobian(q)),
        Candidate::new("stiffarm-fused jacobian", 1, input, |q, _| fused::jacobian(q)),
        Candidate::new("stiffarm-x8 jacobian", 8, lanes, |q, _| plain::jacobian(q)),
        Candidate::new("stiffarm compliance", 1, input, |q, _| plain::compliance(q)),
        Candidate::new("stiffarm-fused compliance", 1, input, |q, _| fused::compliance(q)),
        Candidate::new("stiffarm-x8 compliance", 8, lanes, |q, _| plain::compliance(q)),
    ];
    macro_rules! with_wrench {
        ($($function:ident)*) => {$(
            candidates.extend([
                Candidate::new(concat!("stiffarm ", stringify!($function)), 1, input, plain::$function),
                Candidate::new(
                    concat!("stiffarm-fused ", stringify!($function)), 1, input, fused::$function,
                ),
                Candidate::new(
                    concat!("stiffarm-x8 ", stringify!($function)), 8, lanes, plain::$function,
                ),
            ]);
        )*};
    }
    with_wrench!(complementary_stiffness deflection_first_order deflection);
    // So many numbers are written where they are to stand, as the peers' are.
    macro_rules! written {
        ($name:literal, $lanes:literal, $way:ident, $input:expr) => {
            let first = $way::all(&$input.0[0], &$input.1[0]).expect("the arm is stable");
            candidates.push(Candidate::writing($name, $lanes, $input, first, |q, w, out| {
                $way::all::write(&$way::Posture::new(q), w, out).expect("the arm is stable");
            }));
        };
    }
    written!("stiffarm all", 1, plain, input);
    written!("stiffarm-fused all", 1, fused, input);
    written!("stiffarm-x8 all", 8, plain, lanes);
    let of_pose = |pose: &Pose<f64>| pose.rotation[2][0];
    let of_matrix = |matrix: &[[f64; 6]; 6]| matrix[3][0];
    let mut serial = [
        Candidate::serial("stiffarm pose", input, |q, _| plain::pose(q), of_pose),
        Candidate::serial("stiffarm-fused pose", input, |q, _| fused::pose(q), of_pose),
        Candidate::serial("stiffarm jacobian", input, |q, _| plain::jacobian(q), of_matrix),
        Candidate::serial("stiffarm-fused jacobian", input, |q, _| fused::jacobian(q), of_matrix),
        Candidate::serial(
            "stiffarm complementary_stiffness",
            input,
            plain::complementary_stiffness,
            of_matrix,
        ),
        Candidate::serial(
            "stiffarm-fused complementary_stiffness",
            input,
            fused::complementary_stiffness,
            of_matrix,
        ),
    ];
    // Lanes come by themselves: for a while after instructions on 512 bits Intel's cores are clocked lower, and the peers,
    // which run alone, have none.
    let (mut lanes, mut single): (Vec<_>, Vec<_>) =
        candidates.into_iter().partition(|candidate| candidate.name.starts_with("stiffarm-x8"));
    for (path, candidates) in [
        (path.to_owned(), &mut single[..]),
        (format!("{path}-serial"), &mut serial[..]),
        (path.to_owned(), &mut lanes[..]),
    ] {
        let times = medians(candidates, 41);
        for (candidate, time) in candidates.iter().zip(times) {
            println!("{} {path} {time:.1}", candidate.name);
        }
    }
}
