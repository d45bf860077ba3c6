//! Designed experiments: which poses and loads are to be measured, in which order.
//!
//! At each pose all its loads are measured one after the other, in random order; then come the
//! repeats of the whole sequence. The directions of approach follow from the joints' last moves,
//! unless every pose is approached from one side. Time goes on by half a minute a row, and the arm
//! warms up.

mod approach;
mod bench;
mod camera;
mod climate;
mod loads;
mod poses;

use stiffarm_kernels::generic::Arm;

pub use bench::placed;
pub use camera::{beside, in_view};

use crate::instrument::{Aim, Seen, View};
use crate::measurement::{Kind, Measurements, Row};

/// What the experiment is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// No, half and full payload at every pose, its centre of mass beside the tool.
    Payload,
    /// No load and three forces in various directions, with moments, at every pose.
    Force,
    /// As payload, within a tenth of the joints' ranges.
    Narrow,
    /// As payload, every joint coming to rest from below.
    OneSided,
}

impl Shape {
    /// All of them.
    pub const ALL: [Shape; 4] = [Shape::Payload, Shape::Force, Shape::Narrow, Shape::OneSided];

    /// As the command line has it.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Payload => "payload",
            Shape::Force => "force",
            Shape::Narrow => "narrow",
            Shape::OneSided => "one-sided",
        }
    }
}

/// An experiment to be laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Design {
    /// What it is.
    pub shape: Shape,
    /// Number of poses, at least 1.
    pub poses: usize,
    /// How often each pose and load is measured, at least 1.
    pub repeats: usize,
    /// The full load: a mass, kg; of the force design, the mass whose weight is the largest force.
    pub payload: f64,
    /// What is measured.
    pub kind: Kind,
    /// Decides poses, loads and order.
    pub seed: u64,
}

impl Design {
    /// The rows, nothing measured in them yet. The same design gives the same rows.
    ///
    /// Readings are whole microradians (micrometres), loads whole thousandths of SI.
    pub fn rows(&self, arm: &Arm) -> Measurements {
        match self.kind {
            Kind::Bench { angles: true, .. } => return self.read_by(arm, Seen::Level),
            Kind::Bench { lengths: 3, .. } => return self.read_by(arm, Seen::Point),
            Kind::Bench { .. } => return self.read_by(arm, Seen::Plane),
            _ => {}
        }
        let poses = poses::draw(arm, self);
        let mut design = self.at(arm, &poses);
        if self.kind == Kind::Distance {
            let middle = poses::middle(arm, &poses);
            let view = View::Distance { from: middle.into(), offset: 0.0 };
            let aim = Aim::known(Seen::Distance, "", view);
            design.rows.iter_mut().for_each(|row| row.aim = Some(Box::new(aim.clone())));
        }
        design
    }

    /// The rows at these postures, of which nothing is known but loads and moments.
    fn at(&self, arm: &Arm, poses: &[Vec<f64>]) -> Measurements {
        let mut rows = Vec::new();
        let loads = loads::draw(arm, self, poses);
        for _ in 0..self.repeats {
            for (group, (q, loads)) in poses.iter().zip(&loads).enumerate() {
                for wrench in loads {
                    let line = rows.len() as u64 + 2;
                    rows.push(Row { wrench: *wrench, group, ..Row::new(line, q.clone()) });
                }
            }
        }
        approach::fill(self, &mut rows);
        climate::fill(self.seed, &mut rows);
        Measurements::new(&format!("the {} design", self.shape.name()), self.kind, rows)
    }
}

/// A whole multiple of a step, as it is read back from a file; −0 is 0.
fn rounded(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit + 0.0
}

#[cfg(test)]
mod tests;
