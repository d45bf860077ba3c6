//! `stiffarm eval --pose`: every branch of the inverse kinematics at a pose.

use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};
use serde::Serialize;
use stiffarm_codegen::derive::Given;
use stiffarm_gap::measurement::Dimension;
use stiffarm_kernels::Solution;

use super::Args;
use crate::input::branches::{Branches, WITHIN};
use crate::input::quantity;
use crate::input::source::Source;
use crate::terminal::failure::Failure;
use crate::terminal::text::{Align, bold, dim, indented, minus, short, table};

/// Every branch.
#[derive(Serialize)]
pub(super) struct Inverse {
    solutions: Vec<Branch>,
}

/// One branch: which of two each of shoulder, elbow and wrist has, its set-points, what they miss the pose by.
#[derive(Serialize)]
struct Branch {
    branch: usize,
    shoulder: usize,
    elbow: usize,
    wrist: usize,
    q: [f64; 6],
    distance: f64,
    angle: f64,
    reached: bool,
    within_limits: bool,
    /// Whole turns by which each joint may stand elsewhere within its limits; none where it has no limits.
    turns: [Option<Vec<i32>>; 6],
}

/// A pose from the command line: three coordinates and a rotation vector.
pub(super) fn read(text: &str) -> Result<Isometry3<f64>, Failure> {
    let kinds = [[Dimension::Length; 3], [Dimension::Angle; 3]].concat();
    let help = "a pose is x,y,z,rx,ry,rz: the tool's origin, and its rotation vector";
    let [x, y, z, rx, ry, rz] = quantity::list("--pose", text, &kinds, help)?[..] else {
        return Err(Failure::with_help("--pose: expected 6 values", help));
    };
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::new(rx, ry, rz));
    Ok(Isometry3::from_parts(Vector3::new(x, y, z).into(), rotation))
}

/// All branches at a pose, near joint values; loaded where there is a wrench or the links weigh.
pub(super) fn inverse(
    source: &Source,
    args: &Args,
    (pose, near): (&Isometry3<f64>, &[f64]),
    (wrench, given): (&Vector6<f64>, &Given),
) -> Result<Inverse, Failure> {
    let arm = Branches::new(source, args.gravity)?;
    let near = core::array::from_fn(|joint| near.get(joint).copied().unwrap_or(0.0));
    let loaded = (args.gravity || args.wrench.is_some()).then_some(wrench);
    let found = arm.at(pose, &near, (loaded, given));
    let branch = |found: Solution<f64, 6>| {
        let turned = found.turned(&near, &arm.limits);
        let q = turned.map_or(found.q, |turned| turned.q);
        let turns = |joint: usize| {
            let [low, high] = arm.limits[joint]?;
            let turn = core::f64::consts::TAU;
            let (least, most) =
                (((low - q[joint]) / turn).ceil(), ((high - q[joint]) / turn).floor());
            Some((least as i32..=most as i32).collect())
        };
        Branch {
            branch: found.branch,
            shoulder: found.branch >> 2,
            elbow: found.branch >> 1 & 1,
            wrist: found.branch & 1,
            q: q.map(|q| q + 0.0),
            distance: found.distance,
            angle: found.tilt,
            reached: found.distance <= WITHIN && found.tilt <= WITHIN,
            within_limits: turned.is_some(),
            turns: core::array::from_fn(turns),
        }
    };
    let solutions: Vec<Branch> = found.iter().map(branch).collect();
    match solutions.iter().any(|branch| !branch.distance.is_finite()) {
        true => Err(Failure::with_help(
            stiffarm_kernels::Unstable.to_string(),
            "check the load, its unit and the stiffness",
        )),
        false => Ok(Inverse { solutions }),
    }
}

/// A line for each branch.
pub(super) fn screen(source: &Source, result: &Inverse) -> String {
    let heads = ["shoulder", "elbow", "wrist", "q1", "q2", "q3", "q4", "q5", "q6", "misses by", ""];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for branch in &result.solutions {
        let side = |side: usize| if side == 0 { "−" } else { "+" }.to_owned();
        let mut row = vec![side(branch.shoulder), side(branch.elbow), side(branch.wrist)];
        row.extend(branch.q.iter().map(|q| minus(format!("{:.4}", q.to_degrees() + 0.0))));
        row.push(match branch.reached {
            true => String::new(),
            false => {
                format!("{} mm, {} mrad", short(1e3 * branch.distance), short(1e3 * branch.angle))
            }
        });
        let other = |(joint, turns): (usize, &Option<Vec<i32>>)| {
            let others = turns.iter().flatten().filter(|turns| **turns != 0);
            let texts = others.map(|turns| minus(format!("q{} {:+}°", joint + 1, 360 * turns)));
            texts.collect::<Vec<_>>()
        };
        let others: Vec<String> = branch.turns.iter().enumerate().flat_map(other).collect();
        row.push(match (branch.within_limits, branch.reached && !others.is_empty()) {
            (false, _) => "beyond the limits".to_owned(),
            (true, true) => format!("or {}", others.join(", ")),
            (true, false) => String::new(),
        });
        rows.push(row);
    }
    let reached = result.solutions.iter().filter(|branch| branch.reached).count();
    let allowed = result.solutions.iter().filter(|b| b.reached && b.within_limits).count();
    let aligns: Vec<Align> = (0..11)
        .map(|column| if (3..=8).contains(&column) { Align::Right } else { Align::Left })
        .collect();
    format!(
        "{}  {}\n\n{}\n{reached} of {} branches reach the pose, {allowed} within the limits\n",
        bold(&source.robot.name),
        dim(format!("{}, set-points in degrees", source.given)),
        indented(&table(&rows, &aligns), 2),
        result.solutions.len(),
    )
}
