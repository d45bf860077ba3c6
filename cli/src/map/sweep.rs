//! Which joints move over which values, and where the others stand.

use core::f64::consts::PI;

use stiffarm_gap::dexterity::Plane;
use stiffarm_gap::measurement::Dimension;
use stiffarm_kernels::generic::Arm;

use crate::input::quantity;
use crate::input::source::Source;
use crate::terminal::failure::Failure;

/// One of the two joints.
pub struct Moved {
    /// `q2`.
    pub name: String,
    /// deg or mm.
    pub unit: &'static str,
    angle: bool,
}

impl Moved {
    /// A value in its unit.
    pub fn shown(&self, si: f64) -> f64 {
        // The hundred-billionth of a degree that a conversion leaves is nobody's.
        let value = if self.angle { si.to_degrees() } else { 1e3 * si };
        (1e9 * value).round() / 1e9 + 0.0
    }

    /// `q2[deg]`.
    pub fn header(&self) -> String {
        format!("{}[{}]", self.name, self.unit)
    }

    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.angle
    }
}

/// The grid.
pub struct Sweep {
    /// In rad and m.
    pub plane: Plane,
    /// The joints that move.
    pub axes: [Moved; 2],
    /// Where the others stand: `q1 = 0, q4 = 45°`.
    pub others: String,
}

impl Sweep {
    /// By the options of the command line.
    ///
    /// # Errors
    /// [`Failure`]: joints that do not exist or cannot be swept, values that are none.
    pub fn new(
        source: &Source,
        arm: &Arm,
        over: &str,
        at: &str,
        steps: usize,
    ) -> Result<Sweep, Failure> {
        let readings = source.readings();
        let names: Vec<&str> = over.split(',').map(str::trim).collect();
        let [first, second] = names[..] else {
            return Err(Failure::new(format!(
                "--over: found `{over}`, expected two joints: q2,q3"
            )));
        };
        let joints = [joint("--over", first, arm)?, joint("--over", second, arm)?];
        if joints[0] == joints[1] {
            return Err(Failure::new(format!("--over: found `{over}`, expected two joints")));
        }
        let posture = posture(arm, &readings, at, joints)?;
        let [x, y] = joints;
        let plane = Plane {
            joints,
            first: values(arm, x, steps)?,
            second: values(arm, y, steps)?,
            posture,
        };
        let moved = |k: usize| {
            let angle = readings.get(k) == Some(&Dimension::Angle);
            Moved { name: format!("q{}", k + 1), unit: if angle { "deg" } else { "mm" }, angle }
        };
        let axes = joints.map(moved);
        let others = (0..arm.dof()).filter(|k| !joints.contains(k)).map(|k| {
            let joint = moved(k);
            let value = joint.shown(plane.posture[k]);
            let unit = if joint.angle { "°" } else { " mm" };
            format!("{} = {value}{unit}", joint.name)
        });
        let others = others.collect::<Vec<_>>().join(", ").replace('-', "−");
        Ok(Sweep { others, plane, axes })
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
        (None, stiffarm_kernels::Motion::Revolute) => [-PI, PI],
        (None, stiffarm_kernels::Motion::Prismatic) => {
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
fn posture(
    arm: &Arm,
    readings: &[Dimension],
    at: &str,
    moved: [usize; 2],
) -> Result<Vec<f64>, Failure> {
    let rest = |row: &stiffarm_kernels::generic::Joint| match row.limits {
        Some([low, high]) => 0.0_f64.clamp(low, high),
        None => 0.0,
    };
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
