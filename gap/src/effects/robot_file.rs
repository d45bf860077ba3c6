//! The robot file into which findings are put: its own entries, and how they are written.

use nalgebra::Isometry3;
use stiffarm_kernels::generic;
use stiffarm_table::number::Number;
use stiffarm_table::robot::{Angle, Frame, Joint, Marker, Robot, Value};

use super::{Known, Place};

/// A correction below this changes nothing, m and rad: entries are written with 12 decimals.
const FINEST: f64 = 1e-12;

/// A robot file that is being corrected. Entries that nothing is put into stay as they are, exact
/// multiples of π too.
#[derive(Clone)]
pub struct RobotFile<'a> {
    robot: Robot,
    /// As it was.
    was: &'a Robot,
    arm: &'a generic::Arm,
}

/// A row of its table.
pub struct Row<'a> {
    /// The entries.
    pub joint: &'a mut Joint,
    /// The numbers that they stood for when the findings were made.
    pub nominal: &'a generic::Joint,
}

impl<'a> RobotFile<'a> {
    /// The file, and the arm that was diagnosed.
    pub fn new(robot: &'a Robot, arm: &'a generic::Arm) -> Self {
        RobotFile { robot: robot.clone(), was: robot, arm }
    }

    /// The arm that was diagnosed.
    pub fn arm(&self) -> &'a generic::Arm {
        self.arm
    }

    /// Puts numbers into the row at a place: `put` names the entry that it took.
    pub fn at_row(
        &mut self,
        place: Place,
        put: impl FnOnce(&mut Row<'_>) -> &'static str,
    ) -> Option<String> {
        let nominal = self.arm.joints.get(place.row())?;
        let joint = self.robot.joints.get_mut(place.row())?;
        let entry = put(&mut Row { joint: &mut *joint, nominal });
        Some(format!("{entry} of {}", joint.name))
    }

    /// Puts the numbers of an effect, by their keys, into the table's own entries and names them; `None` if
    /// these hold no such thing.
    pub fn fold(&mut self, id: &str, place: Place, values: &[(&str, f64)]) -> Option<String> {
        let entries = self.robot.fold(id, place, values)?;
        Some(match place {
            Place::Joint(_) | Place::Link(_) => {
                format!("{entries} of {}", self.robot.joints[place.row()].name)
            }
            _ => entries.to_owned(),
        })
    }

    /// Puts base and tool, those of them that were fitted, where the arm that was diagnosed has them.
    pub fn place_frames(&mut self, [base, tool]: [bool; 2]) {
        if base {
            self.robot.base = frame(&self.arm.base);
        }
        if tool {
            self.robot.tool = frame(&self.arm.tool);
        }
    }

    /// Lets gravity pull as it does in the arm that was diagnosed.
    pub fn place_gravity(&mut self) {
        self.robot.gravity = <[f64; 3]>::from(self.arm.gravity).map(decimals);
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

    /// The corrected file with these effects, its numbers with as many digits as a measurement has.
    pub fn finish(self, known: &[Known]) -> Robot {
        let effects = known.iter().map(|known| known.table(self.arm)).collect();
        let (mut robot, was) = (Robot { effects, ..self.robot }, self.was);
        for (joint, was) in robot.joints.iter_mut().zip(&was.joints) {
            lengths([&mut joint.a, &mut joint.d], [&was.a, &was.d]);
            lengths(joint.com.each_mut(), was.com.each_ref());
            angles(
                [&mut joint.theta, &mut joint.alpha, &mut joint.beta],
                [&was.theta, &was.alpha, &was.beta],
            );
            for (entry, was) in
                [(&mut joint.stiffness, &was.stiffness), (&mut joint.mass, &was.mass)]
            {
                let changed = entry.as_mut().filter(|entry| Some(&**entry) != was.as_ref());
                changed.into_iter().for_each(digits);
            }
            if let (Some(beam), Some(was)) = (&mut joint.beam, &was.beam) {
                let (now, was) = (&mut beam.section, &was.section);
                for (entry, was) in
                    [(&mut now.iy, &was.iy), (&mut now.iz, &was.iz), (&mut now.j, &was.j)]
                {
                    if entry != was {
                        digits(entry);
                    }
                }
            }
        }
        for (frame, was) in [(&mut robot.base, &was.base), (&mut robot.tool, &was.tool)] {
            lengths(frame.translation.each_mut(), was.translation.each_ref());
            angles(frame.rotation.each_mut(), was.rotation.each_ref());
        }
        robot
    }

    /// The file as it is now, every digit of it.
    pub(crate) fn exact(self) -> Robot {
        self.robot
    }
}

fn frame(at: &Isometry3<f64>) -> Frame {
    let value = |x: f64| Value::Number(Number::Rounded(x));
    let angle = |x: f64| Angle::Radians(Number::Rounded(x));
    Frame {
        translation: at.translation.vector.map(value).into(),
        rotation: at.rotation.scaled_axis().map(angle).into(),
    }
}

/// Gives lengths that have changed 12 decimals, and others what they were.
fn lengths<const N: usize>(entries: [&mut Value; N], was: [&Value; N]) {
    let number = |value: &Value| value.number().map_or(0.0, Number::to_f64);
    for (entry, was) in entries.into_iter().zip(was).filter(|(entry, was)| entry != was) {
        let by = number(entry) - number(was);
        *entry = if by.abs() < FINEST { was.clone() } else { decimals(number(entry)) };
    }
}

/// The same of angles.
fn angles<const N: usize>(entries: [&mut Angle; N], was: [&Angle; N]) {
    let number = |angle: &Angle| angle.radians().unwrap_or(0.0);
    for (entry, was) in entries.into_iter().zip(was).filter(|(entry, was)| entry != was) {
        let by = number(entry) - number(was);
        *entry = match decimals(number(entry)) {
            Value::Number(rounded) if by.abs() >= FINEST => Angle::Radians(rounded),
            _ => was.clone(),
        };
    }
}

fn digits(entry: &mut Value) {
    *entry = significant(entry.number().map_or(0.0, Number::to_f64));
}

/// With 12 decimals.
fn decimals(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.12}")).unwrap_or(Number::Rounded(x)))
}

/// With nine significant digits: no measurement has more.
pub fn significant(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.8e}")).unwrap_or(Number::Rounded(x)))
}
