//! Joints that move over their limits, and where the others stand.

use core::f64::consts::PI;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Joint};

use crate::input::quantity;
use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// Values of each of some joints, and a value of each of the others, in rad and m.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    /// The joints that move, from 0.
    pub joints: Vec<usize>,
    /// The values of each, ascending, both limits included.
    pub values: Vec<Vec<f64>>,
    /// Where all joints stand that do not move.
    pub posture: Vec<f64>,
}

impl Axes {
    /// By the options of the command line: `over` is `q2,q3`, `at` is `q1=0,q4=45deg`.
    ///
    /// # Errors
    /// [`Failure`]: joints that do not exist or cannot be swept, values that are none.
    pub fn new(
        source: &Source,
        arm: &Arm,
        over: &str,
        at: &str,
        steps: usize,
    ) -> Result<Axes, Failure> {
        let names = over.split(',').map(str::trim);
        let joints = names.map(|name| joint("--over", name, arm)).collect::<Result<Vec<_>, _>>()?;
        if let Some(twice) = joints.iter().enumerate().find(|(k, j)| joints[..*k].contains(j)) {
            return Err(Failure::new(format!(
                "--over: found q{} twice in `{over}`, expected each joint once",
                twice.1 + 1
            )));
        }
        let posture = posture(source, arm, at, &joints)?;
        let values = joints.iter().map(|joint| values(arm, *joint, steps));
        Ok(Axes { values: values.collect::<Result<_, _>>()?, joints, posture })
    }
}

/// `q3` as joint index 2.
fn joint(option: &str, name: &str, arm: &Arm) -> Result<usize, Failure> {
    let number = name.strip_prefix('q').and_then(|digits| digits.parse::<usize>().ok());
    number.and_then(|n| n.checked_sub(1)).filter(|k| *k < arm.dof()).ok_or_else(|| {
        let n = arm.dof();
        Failure::new(format!("{option}: found `{name}`, expected a joint, q1 to q{n}"))
    })
}

/// Over the limits, both ends included.
fn values(arm: &Arm, joint: usize, steps: usize) -> Result<Vec<f64>, Failure> {
    let row = &arm.joints[joint];
    let [low, high] = match (row.limits, row.motion) {
        (Some(limits), _) => limits,
        (None, Motion::Revolute) => [-PI, PI],
        (None, Motion::Prismatic) => {
            return Err(Failure::with_help(
                format!("--over: joint {} is prismatic and has no limits", joint + 1),
                "give it `limits` in the robot file",
            ));
        }
    };
    let last = (steps - 1) as f64;
    Ok((0..steps).map(|k| low + (high - low) * k as f64 / last).collect())
}

/// Where the joints stand: 0 or the limit next to it, but for what `at` says.
fn posture(source: &Source, arm: &Arm, at: &str, moved: &[usize]) -> Result<Vec<f64>, Failure> {
    let rest = |row: &Joint| match row.limits {
        Some([low, high]) => 0.0_f64.clamp(low, high),
        None => 0.0,
    };
    let readings = source.readings();
    let mut posture: Vec<f64> = arm.joints.iter().map(rest).collect();
    for text in at.split(',').map(str::trim).filter(|text| !text.is_empty()) {
        let Some((name, value)) = text.split_once('=') else {
            return Err(Failure::new(format!("--at: found `{text}`, expected qI=VALUE")));
        };
        let k = joint("--at", name.trim(), arm)?;
        if moved.contains(&k) {
            let message = format!("--at: joint {} is one of those that move over the map", k + 1);
            return Err(Failure::new(message));
        }
        let kind = readings[k];
        posture[k] = quantity::read(value, Some(kind)).ok_or_else(|| {
            let (si, units) = (kind.si().name, kind.units());
            Failure::new(format!(
                "--at: {name}: found `{value}`, expected {kind}: a number in {si}, or with a unit \
                 behind it, one of {units}"
            ))
        })?;
    }
    Ok(posture)
}
