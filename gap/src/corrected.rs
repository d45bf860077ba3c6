//! The robot file with what a diagnosis has found put into it.
//!
//! A robot file holds zeros, lengths, twists, springs, masses, beams and the tool; what else was
//! found is told and left out. Entries that nothing was found about stay as they are, exact
//! multiples of π too.

use core::fmt;

use nalgebra::{Isometry3, Vector6};
use stiffarm_codegen::number::Number;
use stiffarm_codegen::robot::{Angle, Convention, Joint, Motion, Robot, Value};
use stiffarm_kernels::generic::Joint as Nominal;

use crate::diagnose::{Diagnosed, Finding, Nuisance, ParameterReport};
use crate::displacement::Displacement;

/// A correction below this changes nothing, m and rad: entries are written with 12 decimals.
const FINEST: f64 = 1e-12;

/// A compliance below this part of what the file has is none.
const RIGID: f64 = 1e-9;

/// A robot with what was found in it, and what became of each number.
#[derive(Clone, Debug, PartialEq)]
pub struct Corrected {
    /// The robot; the one that was diagnosed where nothing could be put in.
    pub robot: Robot,
    /// What became of the numbers of each finding, in their order.
    pub outcomes: Vec<Outcome>,
    /// Whether the tool was fitted along, and stands in the robot where it was fitted.
    pub tool_was_fitted: bool,
}

/// What became of one number that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Identifier of the effect.
    pub effect: &'static str,
    /// Where it acts.
    pub place: String,
    /// The number and its interval.
    pub parameter: ParameterReport,
    /// Where it is now.
    pub fate: Fate,
}

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

/// The robot that `diagnosed` was made of, with what was found put into it.
///
/// A tool that was fitted along (`tool_frame` as a nuisance) is put in too.
pub fn corrected(robot: &Robot, diagnosed: &Diagnosed) -> Corrected {
    let (diagnosis, arm) = (&diagnosed.diagnosis, diagnosed.explanation.arm());
    let tool_frame = Nuisance::ToolFrame.identifier();
    let mut corrected = robot.clone();
    let mut tool = arm.tool;
    let mut outcomes = Vec::new();
    for finding in &diagnosis.findings {
        if finding.effect == tool_frame {
            tool *= displacement(&finding.parameters).transform();
        }
        let row = row_of(finding).filter(|row| *row < arm.dof() && *row < robot.joints.len());
        for parameter in &finding.parameters {
            let fate = match row {
                _ if finding.effect == tool_frame => Fate::PutIn("the tool".to_owned()),
                None => Fate::LeftOut(NO_ENTRY),
                Some(row) => {
                    let joint = &mut corrected.joints[row];
                    let at = Row { nominal: &arm.joints[row], convention: robot.convention };
                    match at.put(joint, finding.effect, &parameter.name, parameter.value) {
                        Ok(entry) => Fate::PutIn(format!("{entry} of {}", joint.name)),
                        Err(because) => Fate::LeftOut(because),
                    }
                }
            };
            let (effect, place) = (finding.effect, finding.place.clone());
            outcomes.push(Outcome { effect, place, parameter: parameter.clone(), fate });
        }
    }
    let tool_was_fitted = diagnosis.nuisances.iter().any(|n| n.name == tool_frame);
    if tool_was_fitted || diagnosis.findings.iter().any(|f| f.effect == tool_frame) {
        set_tool(&mut corrected, &tool);
    }
    Corrected { robot: corrected, outcomes, tool_was_fitted }
}

const NO_ENTRY: &str = "a robot file has no entry for it";

/// Row of the table, from 0, of a finding at a joint or link.
fn row_of(finding: &Finding) -> Option<usize> {
    let (_, number) = finding.place.split_once(' ')?;
    number.parse::<usize>().ok()?.checked_sub(1)
}

fn displacement(parameters: &[ParameterReport]) -> Displacement {
    let value = |name| parameters.iter().filter(|p| p.name == name).map(|p| p.value).sum();
    Displacement::new(&Vector6::from(["x", "y", "z", "rx", "ry", "rz"].map(value)))
}

/// A row of the table as it was diagnosed.
struct Row<'a> {
    nominal: &'a Nominal,
    convention: Convention,
}

impl Row<'_> {
    /// Adds one number of an effect to the row; the entry that holds it, or why none does.
    fn put(
        &self,
        joint: &mut Joint,
        effect: &str,
        name: &str,
        value: f64,
    ) -> Result<&'static str, &'static str> {
        match (effect, name, joint.motion) {
            ("joint_offset", _, Motion::Revolute) | ("link_geometry", "theta", _) => {
                turn(&mut joint.theta, value);
                Ok("theta")
            }
            ("joint_offset", _, Motion::Prismatic) | ("link_geometry", "d", _) => {
                shift(&mut joint.d, value);
                Ok("d")
            }
            ("link_geometry", "a", _) => {
                shift(&mut joint.a, value);
                Ok("a")
            }
            ("link_geometry", "alpha", _) => {
                turn(&mut joint.alpha, value);
                Ok("alpha")
            }
            ("link_geometry", ..) => Err("a row of the table has no such angle"),
            ("joint_compliance", ..) => {
                let whole = self.nominal.compliance + value;
                let gives = whole > RIGID * self.nominal.compliance;
                joint.stiffness = gives.then(|| significant(1.0 / whole));
                Ok("stiffness")
            }
            ("link_weight", ..) => self.weigh(joint, value),
            ("link_compliance", ..) => self.bend(joint, name, value),
            _ => Err(NO_ENTRY),
        }
    }

    /// Adds mass at the link's centre of mass; at the middle of the chord where the file has none.
    fn weigh(&self, joint: &mut Joint, mass: f64) -> Result<&'static str, &'static str> {
        let (nominal, whole) = (self.nominal, self.nominal.mass + mass);
        if nominal.mass == 0.0 && joint.com.iter().all(Value::is_zero) {
            let (sine, cosine) = nominal.alpha.sin_cos();
            let chord = match (self.convention, joint.motion) {
                (Convention::Standard, Motion::Revolute) => {
                    [nominal.a, nominal.d * sine, nominal.d * cosine]
                }
                (Convention::Modified, Motion::Revolute) if nominal.a == 0.0 => {
                    [0.0, 0.0, nominal.d]
                }
                _ => return Err("the middle of this link moves in its own frame: give it a com"),
            };
            joint.com = chord.map(|x| Value::Number(decimals(-0.5 * x)));
        }
        joint.mass = (whole > 0.0).then(|| significant(whole));
        Ok("mass")
    }

    /// Adds 1/EI in both planes, or 1/GJ, to the row's beam; its area, weight and moduli stay.
    fn bend(
        &self,
        joint: &mut Joint,
        name: &str,
        value: f64,
    ) -> Result<&'static str, &'static str> {
        let (Some(beam), Some(nominal)) = (&mut joint.beam, &self.nominal.beam) else {
            return Err("the file has no beam there");
        };
        // The second moment m' with 1/(modulus m') = 1/(modulus m) + value.
        let softened = |modulus: f64, moment: f64| {
            let softer = 1.0 / (modulus * moment) + value;
            (softer > RIGID / (modulus * moment)).then(|| significant(1.0 / (modulus * softer)))
        };
        const RIGID_LINK: &str = "no beam is rigid";
        let section = &mut beam.section;
        if name == "torsion" {
            section.j = softened(nominal.shear_modulus, nominal.j).ok_or(RIGID_LINK)?;
            return Ok("the beam's j");
        }
        let iy = softened(nominal.youngs_modulus, nominal.iy).ok_or(RIGID_LINK)?;
        let iz = softened(nominal.youngs_modulus, nominal.iz).ok_or(RIGID_LINK)?;
        (section.iy, section.iz) = (iy, iz);
        Ok("the beam's iy and iz")
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

fn shift(entry: &mut Value, by: f64) {
    if by.abs() >= FINEST {
        let was = entry.number().map_or(0.0, Number::to_f64);
        *entry = Value::Number(decimals(was + by));
    }
}

fn turn(entry: &mut Angle, by: f64) {
    if by.abs() >= FINEST {
        *entry = Angle::Radians(decimals(entry.radians().unwrap_or(0.0) + by));
    }
}

/// With 12 decimals.
fn decimals(x: f64) -> Number {
    Number::from_decimal(&format!("{x:.12}")).unwrap_or(Number::Rounded(x))
}

/// With nine significant digits: no measurement has more.
fn significant(x: f64) -> Value {
    Value::Number(Number::from_decimal(&format!("{x:.8e}")).unwrap_or(Number::Rounded(x)))
}

#[cfg(test)]
mod tests;
