//! The grid of a map: the two joints that move, as they are shown, and where the others stand.

use stiffarm_gap::measurement::Dimension;
use stiffarm_kernels::generic::Arm;
use stiffarm_study::dexterity::Plane;

use super::axes::Axes;
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
    pub fn new(
        source: &Source,
        arm: &Arm,
        over: &str,
        at: &str,
        steps: usize,
    ) -> Result<Sweep, Failure> {
        let readings = source.readings();
        let Axes { joints, values, posture } = Axes::new(source, arm, over, at, steps)?;
        let (Ok(joints), Ok([first, second])) =
            (<[usize; 2]>::try_from(joints), <[Vec<f64>; 2]>::try_from(values))
        else {
            return Err(Failure::new(format!(
                "--over: found `{over}`, expected two joints: q2,q3"
            )));
        };
        let plane = Plane { joints, first, second, posture };
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
