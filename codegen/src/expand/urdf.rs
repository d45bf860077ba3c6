//! A URDF that an invocation names: the chain between two links as a table.

use core::ops::Range;

use crate::derive::{Output, derive};
use crate::robot::problem::Problem;
use crate::robot::urdf::{Chain, Refusal, Table, bytes, read, robot_file};
use crate::robot::{Located, Robot};

/// How far the table's tip may be from the URDF's, m and rad: rounding of a few dozen rotations, of arms of some
/// metres.
const AGREES: f64 = 1e-9;

/// The arm from link `base` to link `tip`, and what a reader should know of it.
///
/// # Errors
/// What is no URDF, no serial chain or no table, and where.
pub fn invoked(
    text: &str,
    path: &str,
    (base, tip): (Option<&str>, Option<&str>),
) -> Result<(Robot, Vec<String>), Vec<Located>> {
    let told = |at: Option<Range<usize>>, message, help| {
        let problem = Problem { help, ..Problem::new(at.unwrap_or(0..0), message) };
        vec![Located::new(path, text, problem)]
    };
    let refused = |refusal: Refusal| {
        // The options of the command are here words of the macro.
        let plain = |text: String| text.replace("--base", "base").replace("--tip", "tip");
        let at = bytes(text, &refusal.place);
        told(at, plain(refusal.message), refusal.help.map(plain))
    };
    let urdf = read(text, false).map_err(refused)?;
    let chain = Chain::new(&urdf.robot, base, tip).map_err(refused)?;
    let table = Table::new(&chain);
    let robot = robot_file(&chain, &table);
    if !deviation(&chain, &robot).is_some_and(|deviation| deviation <= AGREES) {
        let message = "no table in double precision holds this chain".to_owned();
        return Err(told(None, message, None));
    }
    let (robot, _) = Robot::from_toml(&robot.to_toml(), path).map_err(|error| error.errors)?;
    let mut remarks =
        vec![format!("From `{path}`: link `{}` to link `{}`.", chain.base, chain.tip)];
    remarks.extend(chain.remarks);
    Ok((robot, remarks))
}

/// The largest difference of an entry of the tip's pose, by the graph and by the URDF, at a few postures.
fn deviation(chain: &Chain, robot: &Robot) -> Option<f64> {
    let program = derive(robot, &[Output::Pose]);
    let mut worst = 0.0_f64;
    for posture in 0..8 {
        let q: Vec<f64> =
            (0..robot.dof()).map(|j| f64::from(posture * (j as i32 + 3)).sin()).collect();
        let found = program.evaluate(&q, &[0.0; 6], |_| f64::NAN).ok()?.concat();
        let tip = chain.pose(&q);
        let expected = tip.axes.into_iter().flatten().chain(tip.origin);
        for (a, b) in found.into_iter().zip(expected) {
            worst = worst.max((a - b).abs());
            if (a - b).is_nan() {
                return None;
            }
        }
    }
    Some(worst)
}
