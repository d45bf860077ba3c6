//! Named frames, and which outputs are asked for at them, at markers and at the tool.

use stiffarm_kernels::{Part, Side};

use super::closed_form::Redundancy;
use super::model::{At, Output, Robot};
use super::names::no_module;
use super::problem::{Place, Problem, Report};
use super::suggest::advice;

/// The name of the inverse kinematics among outputs, and of its function where that is a closed form.
pub const INVERSE_KINEMATICS: &str = "inverse_kinematics";

/// What the inverse kinematics of seven joints is given in place of one of them, and the name of the function that tells it.
pub const ELBOW_ANGLE: &str = "elbow_angle";

/// The name of the closed form's function where it is that of another table.
pub const CLOSED_FORM: &str = "closed_form";

/// The name of the function of what gives in an arm at rest.
pub const GIVES: &str = "gives";

/// An output that is asked for: `jacobian`, or `jacobian at elbow`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Asked {
    /// The output.
    pub output: Output,
    /// The frame or marker at which it is asked for; `None` is the tool.
    pub at: Option<String>,
}

/// Something that is generated of an arm where it is asked for by its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// An output.
    Output(Asked),
    /// The inverse kinematics, with what is given of seven joints where that is chosen: a joint's name or number, or
    /// `elbow_angle`.
    InverseKinematics(Option<String>),
}

impl Wanted {
    /// Reads `inverse_kinematics`, `inverse_kinematics given a3`, or what [`Asked::read`] does.
    ///
    /// # Errors
    /// As from [`Asked::read`].
    pub fn read(text: &str) -> Result<Wanted, Refused> {
        match text.split_whitespace().collect::<Vec<_>>()[..] {
            [INVERSE_KINEMATICS] => Ok(Wanted::InverseKinematics(None)),
            [INVERSE_KINEMATICS, "given", ref what @ ..] if !what.is_empty() => {
                Ok(Wanted::InverseKinematics(Some(what.join(" "))))
            }
            _ => Asked::read(text).map(Wanted::Output),
        }
    }
}

/// Why something that is asked for cannot be had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// What was found and what was expected.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

fn refused(message: String, help: impl Into<String>) -> Refused {
    Refused { message, help: help.into() }
}

impl Asked {
    /// Reads `jacobian` or `jacobian at elbow`. Whether the arm has such a frame is for [`Robot::ask`] to say.
    ///
    /// # Errors
    /// [`Refused`]: another word than an output's name, `at`, or one name behind it.
    pub fn read(text: &str) -> Result<Asked, Refused> {
        let names: Vec<&str> =
            Output::EACH.iter().map(|output| output.name()).chain([INVERSE_KINEMATICS]).collect();
        let (word, at) = match text.split_whitespace().collect::<Vec<_>>()[..] {
            [word] => (word, None),
            [word, "at", place] => (word, Some(place.to_owned())),
            _ => (text, None),
        };
        match Output::EACH.into_iter().find(|output| output.name() == word) {
            Some(output) => Ok(Asked { output, at }),
            None => Err(refused(format!("`{word}` is no output"), advice(word, &names))),
        }
    }
}

impl Robot {
    /// Has generated what is wanted.
    ///
    /// # Errors
    /// [`Refused`] as from [`Robot::ask`] and [`Robot::nearest_closed_form`].
    pub fn want(&mut self, wanted: &Wanted) -> Result<(), Refused> {
        match wanted {
            Wanted::Output(asked) => self.ask(asked),
            Wanted::InverseKinematics(given) => {
                given.as_ref().map_or(Ok(()), |given| self.give(given))?;
                self.inverse_kinematics = Some(self.nearest_closed_form()?);
                Ok(())
            }
        }
    }

    /// Has the inverse kinematics given something of seven joints: one by its name or its number from 1, or
    /// `elbow_angle`.
    ///
    /// # Errors
    /// [`Refused`] where the arm has no such joint.
    pub fn give(&mut self, what: &str) -> Result<(), Refused> {
        let number = what.parse().ok().filter(|k| (1..=self.dof()).contains(k));
        let named = self.joints.iter().position(|joint| joint.name == what);
        self.redundancy = match (what, named.or_else(|| number.map(|k| k - 1))) {
            (ELBOW_ANGLE, None) => Some(Redundancy::ElbowAngle),
            (_, Some(joint)) => Some(Redundancy::Joint(joint)),
            (_, None) => {
                let names = self.joints.iter().map(|joint| joint.name.as_str());
                let names: Vec<&str> = names.chain([ELBOW_ANGLE]).collect();
                let message =
                    format!("the inverse kinematics is given `{what}`, which is no joint");
                return Err(refused(message, advice(what, &names)));
            }
        };
        Ok(())
    }

    /// Has nothing generated but what is asked for from now on.
    pub fn want_nothing(&mut self) {
        (self.outputs, self.at) = (Vec::new(), Vec::new());
        (self.inverse_kinematics, self.redundancy) = (None, None);
    }

    /// Adds an output to those that are generated. Where none is asked for at the tool, the tool has every one.
    ///
    /// # Errors
    /// [`Refused`]: a frame or marker that there is not, or an output that cannot be told there.
    pub fn ask(&mut self, asked: &Asked) -> Result<(), Refused> {
        let output = asked.output;
        let Some(place) = &asked.at else {
            self.outputs.push(output);
            return Ok(());
        };
        let row = self.row_of(place)?;
        let size = |side: Side| {
            side.each() == Side::Joints || side.each().count(0) == side.each().count(1)
        };
        // What is told of the tool's frame, whichever that is: it, its twist, what it gives or bears.
        let of_a_frame = output.depends_on(Part::Tool) || output.rows() == Side::Twist;
        if !of_a_frame || !size(output.rows()) || !size(output.columns()) {
            let message = format!("`{}` is not told of a frame", output.name());
            return Err(refused(message, "ask for it without `at`"));
        }
        if output.depends_on(Part::Weights) && row + 1 < self.dof() {
            let message =
                format!("`{}` at `{place}`: links beyond it weigh on the arm too", output.name());
            return Err(refused(message, "ask for it at the tool, or at a frame on the last link"));
        }
        if self.at.iter().all(|at| at.place != *place || at.output != output) {
            self.at.push(At { place: place.clone(), output });
        }
        Ok(())
    }

    /// The row in whose link a frame or a marker is fixed, from 0.
    fn row_of(&self, place: &str) -> Result<usize, Refused> {
        if let Some(named) = self.frames.iter().find(|named| named.name == place) {
            return Ok(named.row);
        }
        let names = self.frames.iter().map(|named| named.name.as_str());
        let names: Vec<&str> = names.chain(self.markers.iter().map(|m| m.name.as_str())).collect();
        let Some(marker) = self.markers.iter().find(|marker| marker.name == place) else {
            let help = match names.is_empty() {
                true => "the robot has no [[frame]] and no [[marker]]".to_owned(),
                false => advice(place, &names),
            };
            return Err(refused(format!("`{place}` is no frame of this robot"), help));
        };
        if let Some((message, help)) = no_module(place) {
            return Err(refused(message, help));
        }
        let symbolic = self.tool.translation.iter().any(|length| length.number().is_none());
        if marker.translation.is_none() || symbolic {
            let what = if symbolic { "the tool that it stands on" } else { "its place" };
            let message =
                format!("nothing can be told of the marker `{place}`: {what} is no number");
            return Err(refused(message, "give it numbers, or leave the marker out of `outputs`"));
        }
        Ok(self.dof() - 1)
    }

    /// What is asked for, in the words of [`Asked::read`]; nothing where that is every output of the tool.
    pub fn asked(&self) -> Vec<String> {
        let tool = if self.outputs.is_empty() { Vec::new() } else { self.generated() };
        let tool = tool.into_iter().map(|output| output.name().to_owned());
        let places = self.places().into_iter();
        let at = places.flat_map(|(place, outputs)| {
            outputs.into_iter().map(move |output| format!("{} at {place}", output.name()))
        });
        let given = match self.redundancy {
            Some(Redundancy::Joint(joint)) => format!(" given {}", joint + 1),
            Some(Redundancy::ElbowAngle) => format!(" given {ELBOW_ANGLE}"),
            None => String::new(),
        };
        let inverse = self.inverse_kinematics.map(|_| format!("{INVERSE_KINEMATICS}{given}"));
        tool.chain(inverse).chain(at).collect()
    }

    /// The places at which outputs are generated, each with its outputs, in the order of frames and markers.
    pub fn places(&self) -> Vec<(&str, Vec<Output>)> {
        let names = self.frames.iter().map(|named| named.name.as_str());
        let names = names.chain(self.markers.iter().map(|marker| marker.name.as_str()));
        let asked = |name: &str, output: &Output| {
            self.at.iter().any(|at| at.place == name && at.output == *output)
        };
        let outputs = |name| Output::EACH.into_iter().filter(|o| asked(name, o)).collect();
        let all = names.map(|name| (name, outputs(name)));
        all.filter(|(_, outputs): &(_, Vec<Output>)| !outputs.is_empty()).collect()
    }
}

/// Has generated of a robot what is asked for.
pub(crate) fn ask<L: Place>(robot: &mut Robot, wanted: &[(Wanted, L)], report: &mut Report<L>) {
    for (wanted, at) in wanted {
        if let Err(no) = robot.want(wanted) {
            report.error(Problem::new(at.clone(), no.message).help(no.help));
        }
    }
}
