//! What the table's own entries hold is put into them.

use super::super::decimal::of_double;
use super::super::model::{Angle, Convention, Frame, Joint, Motion, Robot, Value};
use super::super::space::{Frame as Moved, norm, times};
use super::read::Found;
use super::{Beyond, Law, Move, Spring};
use crate::number::Number;

/// What of a compliance may be left for it to be none.
const RIGID: f64 = 1e-9;

impl Robot {
    /// Puts an effect into the table; whether it has entries for it.
    pub(super) fn fold(&mut self, found: &Found) -> bool {
        let row = found.place.row();
        let v = &found.values;
        match found.id {
            "base_frame" => self.base = frame(placed(&self.base).then(&displacement(v))),
            "tool_frame" => self.tool = frame(placed(&self.tool).then(&displacement(v))),
            "gravity_tilt" => {
                let turned = turn([v[0], v[1], 0.0]).direction(self.gravity.each_ref().map(double));
                self.gravity = turned.map(value);
            }
            "joint_offset" => {
                let joint = &mut self.joints[row];
                match joint.motion {
                    Motion::Revolute => add_angle(&mut joint.theta, v[0]),
                    Motion::Prismatic => add(&mut joint.d, v[0]),
                }
            }
            "joint_compliance" => soften(&mut self.joints[row], v[0]),
            "link_geometry" => {
                let joint = &mut self.joints[row];
                match joint.motion {
                    Motion::Revolute => add(&mut joint.d, v[0]),
                    Motion::Prismatic => add_angle(&mut joint.theta, v[0]),
                }
                add(&mut joint.a, v[1]);
                add_angle(&mut joint.alpha, v[2]);
                add_angle(&mut joint.beta, v[3]);
            }
            "link_com" => {
                self.joints[row].com.iter_mut().zip(v).for_each(|(entry, by)| add(entry, *by));
            }
            "link_weight" => self.weigh(row, v[0]),
            "link_compliance" => return bend(&mut self.joints[row], v),
            _ => return false,
        }
        true
    }

    /// Adds mass at the link's centre; of a link without any that is the middle of its chord.
    fn weigh(&mut self, row: usize, mass: f64) {
        let standard = self.convention == Convention::Standard;
        let joint = &mut self.joints[row];
        if joint.mass.is_none() {
            let (a, d) = (double(&joint.a), double(&joint.d));
            let [alpha, beta] =
                [&joint.alpha, &joint.beta].map(|angle| angle.radians().unwrap_or(0.0));
            let chord = if standard {
                let row = turn([alpha, 0.0, 0.0]).then(&turn([0.0, beta, 0.0]));
                row.inverse().direction([a, 0.0, d])
            } else {
                [0.0, 0.0, d]
            };
            joint.com = times(chord, -0.5).map(value);
        }
        let whole = joint.mass.as_ref().map_or(0.0, double) + mass;
        joint.mass = Some(value(whole.max(0.0)));
    }
}

/// Whether a row can say where its link is weighed: it has a centre of mass, or the middle of its chord
/// stays where it is in its frame.
pub(super) fn has_centre(robot: &Robot, row: usize) -> bool {
    let joint = &robot.joints[row];
    let stays = robot.convention == Convention::Standard || joint.a.is_zero();
    joint.mass.is_some() || (joint.motion == Motion::Revolute && stays)
}

impl Beyond {
    /// Takes in what the table does not hold.
    pub(super) fn take(&mut self, found: &Found) {
        let (joint, form) = (found.place.row(), found.form);
        let v: Vec<Number> = found.values.iter().map(|x| number(*x)).collect();
        let mut moves = |law| self.moves.push(Move::Joint(joint, law));
        match found.id {
            "joint_ratio" => moves(Law::Ratio(v[0])),
            "joint_coupling" => moves(Law::Coupling(form, v[0])),
            "transmission_error" => moves(Law::Wave(form, [v[0], v[1]])),
            "backlash" => moves(Law::Backlash(v[0])),
            "joint_warming" => moves(Law::Warming(v[0])),
            "thermal_growth" => self.moves.push(Move::Growth(v[0])),
            "friction_hysteresis" => self.windup.push((joint, v[0])),
            "joint_hardening" => self.hardening.push((joint, v[0])),
            "bearing_compliance" => self.springs.push(Spring::Bearing(joint, [v[0], v[1]])),
            "base_compliance" => self.springs.push(Spring::Base([v[0], v[1], v[2]])),
            "link_compliance" => self.springs.push(Spring::Link(joint, [v[0], v[1]])),
            "wrench_scale" => {
                let scale = 1.0 + self.wrench_scale.to_f64();
                self.wrench_scale = number(scale * (1.0 + found.values[0]) - 1.0);
            }
            _ => {
                for (sum, by) in self.load_point.iter_mut().zip(v) {
                    *sum = *sum + by;
                }
            }
        }
    }
}

/// Adds to the joint's compliance; what is no longer compliant is rigid.
fn soften(joint: &mut Joint, by: f64) {
    let own = joint.stiffness.as_ref().map_or(0.0, |k| 1.0 / double(k));
    let whole = own + by;
    joint.stiffness = (whole > RIGID * own).then(|| value(1.0 / whole));
}

/// Adds 1/EI in both planes and 1/GJ to the row's beam; area, weight and moduli stay. A row without a beam
/// has no entries for it, nor one that would be rigid.
fn bend(joint: &mut Joint, v: &[f64]) -> bool {
    let Some(beam) = joint.beam.as_mut() else { return false };
    let softened = |modulus: &Value, moment: &Value, by: f64| {
        let own = 1.0 / (double(modulus) * double(moment));
        let whole = own + by;
        (whole > RIGID * own).then(|| value(1.0 / (double(modulus) * whole)))
    };
    let (e, g, section) = (&beam.youngs_modulus, &beam.shear_modulus, &beam.section);
    let [y, z, j] = [(e, &section.iy, v[0]), (e, &section.iz, v[0]), (g, &section.j, v[1])]
        .map(|(modulus, moment, by)| softened(modulus, moment, by));
    let (Some(y), Some(z), Some(j)) = (y, z, j) else { return false };
    (beam.section.iy, beam.section.iz, beam.section.j) = (y, z, j);
    true
}

/// A number; the readers let nothing stand that is not finite, and symbols are refused before.
fn double(value: &Value) -> f64 {
    value.number().map_or(0.0, Number::to_f64)
}

fn number(x: f64) -> Number {
    of_double(x).unwrap_or(Number::ZERO)
}

fn value(x: f64) -> Value {
    Value::Number(number(x))
}

/// What nothing is added to stays exact.
fn add(entry: &mut Value, by: f64) {
    if by != 0.0 {
        *entry = value(double(entry) + by);
    }
}

fn add_angle(entry: &mut Angle, by: f64) {
    if by != 0.0 {
        *entry = Angle::Radians(number(entry.radians().unwrap_or(0.0) + by));
    }
}

fn turn(vector: [f64; 3]) -> Moved {
    let angle = norm(vector);
    if angle == 0.0 { Moved::IDENTITY } else { Moved::turned(times(vector, 1.0 / angle), angle) }
}

/// A displacement as a transform: the origin moves, and the frame turns about its moved origin.
fn displacement(v: &[f64]) -> Moved {
    Moved::moved([v[0], v[1], v[2]]).then(&turn([v[3], v[4], v[5]]))
}

fn placed(frame: &Frame) -> Moved {
    let rotation = frame.rotation.each_ref().map(|angle| angle.radians().unwrap_or(0.0));
    Moved::moved(frame.translation.each_ref().map(double)).then(&turn(rotation))
}

fn frame(moved: Moved) -> Frame {
    let radians = |x: f64| Angle::from_radians(x).unwrap_or(Angle::ZERO);
    Frame { translation: moved.origin.map(value), rotation: moved.rotation_vector().map(radians) }
}
