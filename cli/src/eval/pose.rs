//! `stiffarm eval --pose`: every branch of the inverse kinematics at a pose.

use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector6};
use serde::Serialize;
use stiffarm_codegen::derive::Given;
use stiffarm_codegen::robot::{Family, Motion};
use stiffarm_document::text::{Align, bold, dim, indented, minus, short, table};
use stiffarm_gap::measurement::Dimension;

use super::Args;
use crate::input::branches::{Branches, WITHIN};
use crate::input::quantity;
use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// Every branch.
#[derive(Serialize)]
pub(super) struct Inverse {
    /// What every branch has as `--q` or `--given` has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    given: Option<Kept>,
    solutions: Vec<Branch>,
    /// What the bits of a branch's number choose, from the highest.
    #[serde(skip)]
    bits: Vec<&'static str>,
}

/// What is given of seven joints.
#[derive(Clone, Copy, Serialize)]
#[serde(untagged)]
enum Kept {
    /// A joint, from 1.
    Joint(usize),
    /// The elbow's angle, by its name.
    Elbow(&'static str),
}

impl std::fmt::Display for Kept {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Kept::Joint(joint) => write!(f, "joint {joint}"),
            Kept::Elbow(_) => f.write_str("the elbow angle"),
        }
    }
}

/// One branch: which of two each of shoulder, elbow and wrist has (0 where the arm has but one), its set-points, what they
/// miss the pose by.
#[derive(Serialize)]
struct Branch {
    branch: usize,
    shoulder: usize,
    elbow: usize,
    wrist: usize,
    q: Vec<f64>,
    distance: f64,
    angle: f64,
    reached: bool,
    within_limits: bool,
    /// Whole turns by which each joint may stand elsewhere within its limits; none where it has no limits.
    turns: Vec<Option<Vec<i32>>>,
}

impl Branch {
    /// What is chosen of two by a bit's name.
    fn side(&self, bit: &str) -> usize {
        match bit {
            "shoulder" => self.shoulder,
            "elbow" => self.elbow,
            _ => self.wrist,
        }
    }
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
    let told = args.given.as_ref().map(|text| {
        text.split_once('=').map_or((text.as_str(), None), |(what, value)| (what, Some(value)))
    });
    let arm = Branches::new(source, args.gravity, told.map(|(what, _)| what))?;
    let elbow = arm.form.family == Family::ElbowAngle;
    let kept = arm.form.given.map(|joint| Kept::Joint(joint + 1));
    let kept = kept.or_else(|| elbow.then_some(Kept::Elbow("elbow_angle")));
    let (mut near, mut given) = (near.to_vec(), given.clone());
    match (told.and_then(|(_, value)| value), kept) {
        (Some(value), Some(_)) => {
            let kind = arm.form.given.map_or(Dimension::Angle, |joint| source.readings()[joint]);
            let value =
                quantity::list("--given", value, &[kind], "one value stands behind the `=`")?[0];
            near.resize(source.robot.dof(), 0.0);
            match arm.form.given {
                Some(joint) => near[joint] = value,
                None => given.elbow_angle = Some(value),
            }
        }
        (None, Some(kept)) if near.is_empty() => {
            return Err(Failure::with_help(
                format!(
                    "--pose: found no --q, and the pose leaves one of {} joints free",
                    source.robot.dof()
                ),
                format!(
                    "give --q q1,q2,…: every branch has {kept} as it has it; or --given WHAT=VALUE"
                ),
            ));
        }
        _ => {}
    }
    let loaded = (args.gravity || args.wrench.is_some()).then_some(wrench);
    let bits = arm.form.bits();
    let joints = &source.robot.joints;
    let solutions: Vec<Branch> = arm
        .at(pose, &near, (loaded, &given))
        .into_iter()
        // A search tells those that it has found.
        .filter(|found| !arm.form.is_search() || found.distance.is_finite())
        .map(|found| {
            let side = |name: &str| {
                let at = bits.iter().rev().position(|bit| *bit == name);
                at.map_or(0, |at| found.number >> at & 1)
            };
            let turns = joints.iter().zip(&found.q).enumerate().map(|(k, (joint, q))| {
                let [low, high] = joint.limits?;
                let turn = core::f64::consts::TAU;
                let (least, most) = (((low - q) / turn).ceil(), ((high - q) / turn).floor());
                let moves = joint.motion == Motion::Revolute && arm.form.given != Some(k);
                Some(if moves { (least as i32..=most as i32).collect() } else { vec![0] })
            });
            Branch {
                branch: found.number,
                shoulder: side("shoulder"),
                elbow: side("elbow"),
                wrist: side("wrist"),
                turns: turns.collect(),
                reached: found.distance <= WITHIN && found.tilt <= WITHIN,
                within_limits: found.within,
                q: found.q,
                distance: found.distance,
                angle: found.tilt,
            }
        })
        .collect();
    match solutions.iter().any(|branch| !branch.distance.is_finite()) {
        true => Err(Failure::with_help(
            stiffarm_kernels::Unstable.to_string(),
            "check the load, its unit and the stiffness",
        )),
        false => Ok(Inverse { given: kept, solutions, bits }),
    }
}

/// A line for each branch.
pub(super) fn screen(source: &Source, result: &Inverse) -> String {
    let joints = &source.robot.joints;
    let heads = result.bits.iter().map(|bit| (*bit).to_owned());
    let mut heads: Vec<String> =
        heads.chain((1..=joints.len()).map(|joint| format!("q{joint}"))).collect();
    heads.extend(["misses by".to_owned(), String::new()]);
    let mut rows = vec![heads];
    for branch in &result.solutions {
        let side = |bit: &&str| if branch.side(bit) == 0 { "−" } else { "+" }.to_owned();
        let mut row: Vec<String> = result.bits.iter().map(side).collect();
        row.extend(branch.q.iter().zip(joints).map(|(q, joint)| {
            minus(match joint.motion {
                Motion::Revolute => format!("{:.4}", q.to_degrees() + 0.0),
                Motion::Prismatic => format!("{:.4}", 1e3 * q + 0.0),
            })
        }));
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
    let first = result.bits.len();
    let aligns: Vec<Align> = (0..first + joints.len() + 2)
        .map(|column| match (first..first + joints.len()).contains(&column) {
            true => Align::Right,
            false => Align::Left,
        })
        .collect();
    let slides = joints.iter().any(|joint| joint.motion == Motion::Prismatic);
    let unit = if slides { "degrees and mm" } else { "degrees" };
    let held = result.given.map_or_else(String::new, |kept| format!(", {kept} as given"));
    format!(
        "{}  {}\n\n{}\n{reached} of {} branches reach the pose, {allowed} within the limits\n",
        bold(&source.robot.name),
        dim(format!("{}, set-points in {unit}{held}", source.given)),
        indented(&table(&rows, &aligns), 2),
        result.solutions.len(),
    )
}
