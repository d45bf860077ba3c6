//! The robot file into which findings are put: its own entries, and how they are written.

use core::fmt;

use nalgebra::Isometry3;
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Angle, Convention, Joint, Robot, Value};
use stiffarm_kernels::generic;

use super::{ParameterReport, Place};

/// A correction below this changes nothing, m and rad: entries are written with 12 decimals.
const FINEST: f64 = 1e-12;

/// A compliance below this part of what the file has is none.
pub(super) const RIGID: f64 = 1e-9;

const NO_ENTRY: &str = "a robot file has no entry for it";

/// Where a number that was found is now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// In this entry of the robot file.
    PutIn(String),
    /// In none, for this reason.
    LeftOut(&'static str),
}

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fate::PutIn(entry) => write!(f, "in {entry}"),
            Fate::LeftOut(because) => write!(f, "left out: {because}"),
        }
    }
}

/// A robot file that is being corrected. Entries that nothing is put into stay as they are, exact
/// multiples of π too.
pub struct RobotFile<'a> {
    robot: Robot,
    arm: &'a generic::Arm,
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
        RobotFile { robot: robot.clone(), arm, tool: None }
    }

    /// The arm that was diagnosed.
    pub fn arm(&self) -> &'a generic::Arm {
        self.arm
    }

    /// Puts each number into an entry of the row at a place: `put` names the entry that it took, or
    /// why none could.
    pub fn at_row(
        &mut self,
        place: Place,
        numbers: &[ParameterReport],
        put: impl Fn(&mut Row<'_>, &ParameterReport) -> Result<&'static str, &'static str>,
    ) -> Vec<Fate> {
        let (row, convention) = (place.row(), self.robot.convention);
        let (Some(joint), Some(nominal)) =
            (self.robot.joints.get_mut(row), self.arm.joints.get(row))
        else {
            return self.no_entry(numbers);
        };
        let mut row = Row { joint, nominal, convention };
        let each = numbers.iter().map(|number| match put(&mut row, number) {
            Ok(entry) => Fate::PutIn(format!("{entry} of {}", row.joint.name)),
            Err(because) => Fate::LeftOut(because),
        });
        each.collect()
    }

    /// Moves the tool.
    pub fn move_tool(&mut self, by: &Isometry3<f64>, numbers: &[ParameterReport]) -> Vec<Fate> {
        *self.tool.get_or_insert(self.arm.tool) *= by;
        numbers.iter().map(|_| Fate::PutIn("the tool".to_owned())).collect()
    }

    /// Puts the tool where the arm that was diagnosed has it.
    pub fn fit_tool(&mut self) {
        self.tool.get_or_insert(self.arm.tool);
    }

    /// No entry holds these.
    pub fn no_entry(&self, numbers: &[ParameterReport]) -> Vec<Fate> {
        numbers.iter().map(|_| Fate::LeftOut(NO_ENTRY)).collect()
    }

    /// The corrected file.
    pub fn finish(mut self) -> Robot {
        if let Some(tool) = self.tool {
            set_tool(&mut self.robot, &tool);
        }
        self.robot
    }
}

/// Puts the tool where it was found; numbers that have not changed stay exact.
fn set_tool(robot: &mut Robot, tool: &Isometry3<f64>) {
    let (position, rotation) = (tool.translation.vector, tool.rotation.scaled_axis());
    for (entry, is) in robot.tool.translation.iter_mut().zip(position.iter()) {
        let was = entry.number().map_or(0.0, Number::to_f64);
        shift(entry, is - was);
    }
    for (entry, is) in robot.tool.rotation.iter_mut().zip(rotation.iter()) {
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
