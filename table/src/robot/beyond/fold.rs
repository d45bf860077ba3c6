//! What the table's own entries hold is put into them.

use super::super::decimal::of_double;
use super::super::model::{Angle, Convention, Frame, Joint, Motion, Robot, Value};
use super::super::space::{Frame as Moved, times};
use super::read::Found;
use super::{Beyond, Law, Move, Place, Spring};
use crate::number::Number;

/// What of a compliance may be left for it to be none.
const RIGID: f64 = 1e-9;

impl Robot {
    /// Puts the numbers of an effect at a place, by their keys, into the table's own entries, and names
    /// these; `None` if there are none that hold them, and the table is then as it was. Symbols count as zero.
    pub fn fold(&mut self, id: &str, place: Place, values: &[(&str, f64)]) -> Option<&'static str> {
        let of = |key: &str| values.iter().find(|(k, _)| *k == key).map_or(0.0, |(_, by)| *by);
        let six = ["x", "y", "z", "rx", "ry", "rz"].map(of);
        let (row, convention) = (place.row(), self.convention);
        let joint = self.joints.get_mut(row)?;
        match id {
            "base_frame" => {
                self.base = frame(placed(&self.base).then(&displacement(six)));
                Some("[base]")
            }
            "tool_frame" => {
                self.tool = frame(placed(&self.tool).then(&displacement(six)));
                Some("[tool]")
            }
            "joint_offset" => match joint.motion {
                Motion::Revolute => {
                    add_angle(&mut joint.theta, of("offset"));
                    Some("theta")
                }
                Motion::Prismatic => {
                    add(&mut joint.d, of("offset"));
                    Some("d")
                }
            },
            "joint_compliance" => {
                soften(joint, of("compliance"));
                Some("stiffness")
            }
            "link_geometry" => {
                let Joint { theta, alpha, beta, .. } = joint;
                let angles = [(theta, "theta"), (alpha, "alpha"), (beta, "beta")];
                angles.into_iter().for_each(|(entry, key)| add_angle(entry, of(key)));
                add(&mut joint.d, of("d"));
                add(&mut joint.a, of("a"));
                Some("the lengths and angles")
            }
            "link_com" => {
                joint.com.iter_mut().zip(six).for_each(|(entry, by)| add(entry, by));
                Some("com")
            }
            "link_weight" if has_centre(joint, convention) => {
                weigh(joint, convention, of("mass"));
                Some("mass")
            }
            "link_compliance" => bend(joint, of("bending"), of("torsion")),
            _ => None,
        }
    }

    /// Takes an effect into the table's own entries; whether it has any for it.
    pub(super) fn takes(&mut self, found: &Found) -> bool {
        if found.id != "gravity_tilt" {
            return self.fold(found.id, found.place, &found.values).is_some();
        }
        let tilt = Moved::by_rotation([found.values[0].1, found.values[1].1, 0.0]);
        self.gravity = tilt.direction(self.gravity.each_ref().map(Value::or_zero)).map(value);
        true
    }
}

/// Adds mass at the link's centre; of a link without any that is the middle of its chord.
fn weigh(joint: &mut Joint, convention: Convention, by: f64) {
    if !is_weighed(joint) {
        let (a, d) = (joint.a.or_zero(), joint.d.or_zero());
        let [alpha, beta] = [joint.alpha.or_zero(), joint.beta.or_zero()];
        let chord = match convention {
            Convention::Standard => {
                let row = Moved::by_rotation([alpha, 0.0, 0.0])
                    .then(&Moved::by_rotation([0.0, beta, 0.0]));
                row.inverse().direction([a, 0.0, d])
            }
            Convention::Modified => [0.0, 0.0, d],
        };
        joint.com = times(chord, -0.5).map(value);
    }
    let whole = joint.mass.as_ref().map_or(0.0, Value::or_zero) + by;
    joint.mass = Some(value(whole.max(0.0)));
}

/// Whether the row says where its link is weighed.
fn is_weighed(joint: &Joint) -> bool {
    joint.mass.as_ref().is_some_and(|mass| mass.or_zero() != 0.0)
        || !joint.com.iter().all(Value::is_zero)
}

/// Whether a row can say where its link is weighed: it has a centre of mass, or the middle of its chord
/// stays where it is in its frame.
pub(super) fn has_centre(joint: &Joint, convention: Convention) -> bool {
    let stays = convention == Convention::Standard || joint.a.is_zero();
    is_weighed(joint) || (joint.motion == Motion::Revolute && stays)
}

impl Beyond {
    /// Takes in what the table does not hold.
    pub(super) fn take(&mut self, found: &Found) {
        let (joint, form) = (found.place.row(), found.form);
        let v: Vec<Number> = found.values.iter().map(|(_, x)| number(*x)).collect();
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
            "base_compliance" => {
                let [x, y, all] = [0, 1, 2].map(|k| found.values[k].1);
                let turns = [x + all, y + all, all].map(number);
                self.springs.push(Spring::Base([turns[0], turns[1], turns[2], v[3]]));
            }
            "link_compliance" => self.springs.push(Spring::Link(joint, [v[0], v[1]])),
            "wrench_scale" => {
                let scale = 1.0 + self.wrench_scale.to_f64();
                self.wrench_scale = number(scale * (1.0 + found.values[0].1) - 1.0);
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
    let own = joint.stiffness.as_ref().map_or(0.0, |k| 1.0 / k.or_zero());
    let whole = own + by;
    joint.stiffness = (whole > RIGID * own).then(|| value(1.0 / whole));
}

/// Adds 1/EI in both planes and 1/GJ to the row's beam; area, weight and moduli stay. A row without a beam
/// has no entries for it, nor one that would be rigid.
fn bend(joint: &mut Joint, bending: f64, torsion: f64) -> Option<&'static str> {
    let beam = joint.beam.as_mut()?;
    let softened = |modulus: &Value, moment: &Value, by: f64| {
        let own = 1.0 / (modulus.or_zero() * moment.or_zero());
        let whole = own + by;
        (whole > RIGID * own).then(|| value(1.0 / (modulus.or_zero() * whole)))
    };
    let (e, g, section) = (&beam.youngs_modulus, &beam.shear_modulus, &beam.section);
    let [y, z] = [&section.iy, &section.iz].map(|moment| softened(e, moment, bending));
    let j = softened(g, &section.j, torsion);
    (beam.section.iy, beam.section.iz, beam.section.j) = (y?, z?, j?);
    Some("the beam's iy, iz and j")
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
        *entry = value(entry.or_zero() + by);
    }
}

fn add_angle(entry: &mut Angle, by: f64) {
    if by != 0.0 {
        *entry = Angle::Radians(number(entry.or_zero() + by));
    }
}

/// A displacement as a transform: the origin moves, and the frame turns about its moved origin.
fn displacement(v: [f64; 6]) -> Moved {
    Moved::moved([v[0], v[1], v[2]]).then(&Moved::by_rotation([v[3], v[4], v[5]]))
}

fn placed(frame: &Frame) -> Moved {
    let rotation = frame.rotation.each_ref().map(Angle::or_zero);
    Moved::moved(frame.translation.each_ref().map(Value::or_zero))
        .then(&Moved::by_rotation(rotation))
}

fn frame(moved: Moved) -> Frame {
    let radians = |x: f64| Angle::from_radians(x).unwrap_or(Angle::ZERO);
    Frame { translation: moved.origin.map(value), rotation: moved.rotation_vector().map(radians) }
}
