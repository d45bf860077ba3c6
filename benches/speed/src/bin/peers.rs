//! For `benches/peers/run.sh`: writes joint vectors of the KUKA KR 240-2 with its poses and Jacobians
//! (little-endian doubles) into a directory, and prints the kernels' own times.

use std::io::Write as _;
use std::path::Path;

use stiffarm_bench::arms::kuka_kr240::{fused, plain};
use stiffarm_bench::arms::textbook;
use stiffarm_bench::draws::Draws;
use stiffarm_bench::lanes::by_eight;
use stiffarm_bench::timing::{Candidate, medians};
use stiffarm_kernels::Output;

const POSES: usize = 2048;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let directory = std::env::args().nth(1).ok_or("usage: peers DIRECTORY")?;
    let mut draws = Draws::new(1);
    let wrenches = draws.wrenches(POSES);
    let arm = textbook("kuka_kr240");
    let write = |name: &str, numbers: &mut dyn Iterator<Item = f64>| -> std::io::Result<()> {
        let mut file = std::fs::File::create(Path::new(&directory).join(name))?;
        let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
        file.write_all(&bytes)
    };
    for (path, poses) in [("random", draws.random::<6>(POSES)), ("smooth", draws.smooth(POSES))] {
        write(&format!("{path}.q"), &mut poses.as_flattened().iter().copied())?;
        for (name, output) in [("pose", Output::Pose), ("jacobian", Output::Jacobian)] {
            let mut numbers = Vec::new();
            for (q, w) in poses.iter().zip(&wrenches) {
                numbers.extend(arm.evaluate(output, q, w)?);
            }
            write(&format!("{path}.{name}"), &mut numbers.into_iter())?;
        }
        let input = (&poses[..], &wrenches[..]);
        let (q8, w8) = (by_eight(&poses), by_eight(&wrenches));
        let lanes = (&q8[..], &w8[..]);
        let mut candidates = [
            Candidate::new("stiffarm pose", 1, input, |q, _| plain::pose(q)),
            Candidate::new("stiffarm jacobian", 1, input, |q, _| plain::jacobian(q)),
            Candidate::new("stiffarm-fused pose", 1, input, |q, _| fused::pose(q)),
            Candidate::new("stiffarm-fused jacobian", 1, input, |q, _| fused::jacobian(q)),
            Candidate::new("stiffarm-x8 pose", 8, lanes, |q, _| plain::pose(q)),
            Candidate::new("stiffarm-x8 jacobian", 8, lanes, |q, _| plain::jacobian(q)),
        ];
        let times = medians(&mut candidates, 41);
        for (candidate, time) in candidates.iter().zip(times) {
            println!("{} {path} {time:.1}", candidate.name);
        }
    }
    Ok(())
}
