//! The robot file into which findings are put: its own entries, and how they are written.

use nalgebra::Isometry3;
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Angle, Convention, Frame, Joint, Marker, Robot, Value};
use stiffarm_kernels::generic;

use super::{Known, Place};

/// A correction below this changes nothing, m and rad: entries are written with 12 decimals.
const FINEST: f64 = 1e-12;

/// A compliance below this part of what the file has is none.
pub(super) const RIGID: f64 = 1e-9;

/// A robot file that is being corrected. Entries that nothing is put into stay as they are, exact
/// multiples of π too.
#[derive(Clone)]
pub struct RobotFile<'a> {
    robot: Robot,
    arm: &'a generic::Arm,
    base: Option<Isometry3<f64>>,
    tool: Option<Isometry3<f64>>,
}

/// A row of its table.
pub struct Row<'a> {
    /// The entries.
    pub joint: &'a mut Joint,
    /// The numbers that they stood for when the findings were made.
    pub nominal: &'a generic::Joint,
    /// Of the table.
    pub convention: Convention,
}

impl<'a> RobotFile<'a> {
    /// The file, and the arm that was diagnosed.
    pub fn new(robot: &Robot, arm: &'a generic::Arm) -> Self {
        RobotFile { robot: robot.clone(), arm, base: None, tool: None }
    }

    /// The arm that was diagnosed.
    pub fn arm(&self) -> &'a generic::Arm {
        self.arm
    }

    /// Puts numbers into the row at a place: `put` names the entries that it took; `None` if there
    /// are none that hold them, and the row is then as it was.
    pub fn at_row(
        &mut self,
        place: Place,
        put: impl FnOnce(&mut Row<'_>) -> Option<&'static str>,
    ) -> Option<String> {
        let (row, convention) = (place.row(), self.robot.convention);
        let nominal = self.arm.joints.get(row)?;
        let joint = self.robot.joints.get_mut(row)?;
        let mut changed = joint.clone();
        let entries = put(&mut Row { joint: &mut changed, nominal, convention })?;
        *joint = changed;
        Some(format!("{entries} of {}", joint.name))
    }

    /// Moves the tool.
    pub fn move_tool(&mut self, by: &Isometry3<f64>) -> Option<String> {
        *self.tool.get_or_insert(self.arm.tool) *= by;
        Some("[tool]".to_owned())
    }

    /// Moves the base.
    pub fn move_base(&mut self, by: &Isometry3<f64>) -> Option<String> {
        *self.base.get_or_insert(self.arm.base) *= by;
        Some("[base]".to_owned())
    }

    /// Puts base and tool, those of them that were fitted, where the arm that was diagnosed has them.
    pub fn place_frames(&mut self, [base, tool]: [bool; 2]) {
        self.base = base.then_some(self.arm.base);
        self.tool = tool.then_some(self.arm.tool);
    }

    /// Puts a measured point where it was found, tool frame, m.
    pub fn place_marker(&mut self, name: &str, at: [f64; 3]) {
        let translation = Some(at.map(decimals));
        match self.robot.markers.iter_mut().find(|marker| marker.name == name) {
            Some(marker) => marker.translation = translation,
            None => self.robot.markers.push(Marker { name: name.to_owned(), translation }),
        }
    }

    /// Puts an effect into entries of the table, or else among those that are `known`, on top of the
    /// same one where there is one; names where it is.
    pub fn put(&mut self, effect: &Known, known: &mut Vec<Known>) -> String {
        if let Some(entries) = effect.effect.write(self, effect.spot, &effect.values) {
            return entries;
        }
        let same = |k: &&mut Known| {
            k.effect == effect.effect && k.spot == effect.spot && k.session == effect.session
        };
        match known.iter_mut().find(same) {
            Some(there) => {
                there.values.iter_mut().zip(&effect.values).for_each(|(sum, more)| *sum += more);
            }
            None => known.push(effect.clone()),
        }
        "an [[effect]]".to_owned()
    }

    /// The corrected file with these effects.
    pub fn finish(mut self, known: &[Known]) -> Robot {
        for (frame, found) in [(&mut self.robot.base, self.base), (&mut self.robot.tool, self.tool)]
        {
            if let Some(found) = found {
                set(frame, &found);
            }
        }
        self.robot.effects = known.iter().map(|known| known.table(self.arm)).collect();
        self.robot
    }
}

/// Puts a frame where it was found; numbers that have not changed stay exact.
fn set(frame: &mut Frame, found: &Isometry3<f64>) {
    let (position, rotation) = (found.translation.vector, found.rotation.scaled_axis());
    for (entry, is) in frame.translation.iter_mut().zip(position.iter()) {
        let was = entry.number().map_or(0.0, Number::to_f64);
        shift(entry, is - was);
    }
    for (entry, is) in frame.rotation.iter_mut().zip(rotation.iter()) {
        let was = entry.radians().unwrap_or(0.0);
        turn(entry, is - was);
    }
}

/// Adds to a length.
pub fn shift(entry: &mut Value, by: f64) {
    if by.abs() >= FINEST {
        let was = entry.number().map_or(0.0, Number::to_f64);
        *entry = decimals(was + by);
    }
}

/// Adds to an angle.
pub fn turn(entry: &mut Angle, by: f64) {
    if by.abs() >= FINEST {
        let Value::Number(number) = decimals(entry.radians().unwrap_or(0.0) + by) else { return };
        *entry = Angle::Radians(number);
    }
}

/// With 12 decimals.
pub fn decimals(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.12}")).unwrap_or(Number::Rounded(x)))
}

/// With nine significant digits: no measurement has more.
pub fn significant(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.8e}")).unwrap_or(Number::Rounded(x)))
}
