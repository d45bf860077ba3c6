//! What the plant makes of each effect: its own law, that shares nothing with the diagnosis but the
//! definition.

use super::reality::{Jump, RealJoint, Reality};
use super::transform::rotation_of;
use super::truth::Truth;
use crate::effects::*;
use nalgebra::{Vector3, Vector6};

/// Puts a truth into the arm.
pub(super) type Law = fn(&mut Reality, &Truth);

/// Every effect that the plant can have, in the order of the format.
const LAWS: [(&dyn Effect, Law); 32] = [
    (&JointOffset, |arm, t| arm.joint(t).offset += t.value("offset")),
    (&LinkGeometry, |arm, t| {
        let row = arm.joint(t);
        row.theta += t.value("theta");
        row.d += t.value("d");
        row.a += t.value("a");
        row.alpha += t.value("alpha");
        row.beta += t.value("beta");
    }),
    (&BaseFrame, |arm, t| arm.base_frame += sixfold(t)),
    (&ToolFrame, |arm, t| arm.tool_frame += sixfold(t)),
    (&JointCompliance, |arm, t| arm.joint(t).gear.compliance += t.value("compliance")),
    (&JointHardening, |arm, t| arm.joint(t).gear.cubic += t.value("cubic")),
    (&BearingCompliance, |arm, t| {
        arm.joint(t).tilt[0] += t.value("tilt_x");
        arm.joint(t).tilt[1] += t.value("tilt_y");
    }),
    (&LinkCompliance, |arm, t| {
        let beam = arm.joint(t).beam.get_or_insert_default();
        beam.bend_y += t.value("bending");
        beam.bend_z += t.value("bending");
        beam.torsion += t.value("torsion");
    }),
    (&LinkWeight, |arm, t| {
        let row = arm.joint(t);
        let hangs = if row.mass > 0.0 { &mut row.mass } else { &mut row.mass_on_chord };
        *hangs += t.value("mass");
    }),
    (&BaseCompliance, |arm, t| {
        let [x, y, all] = ["rock_x", "rock_y", "rock"].map(|name| t.value(name));
        arm.rock += Vector3::new(x + all, y + all, all);
        arm.give += t.value("give");
    }),
    (&WrenchScale, |arm, t| arm.wrench_scale += t.value("scale")),
    (&PayloadCom, |arm, t| {
        arm.payload += Vector3::new(t.value("x"), t.value("y"), t.value("z"));
    }),
    (&Backlash, |arm, t| arm.joint(t).width += t.value("width")),
    (&LoadedBacklash, |arm, t| arm.joint(t).gear.play += t.value("width")),
    (&SoftZone, |arm, t| {
        arm.joint(t).gear.zones.push((t.value("threshold"), t.value("compliance")));
    }),
    (&Counterbalance, |arm, t| {
        let [cos, sin] = &mut arm.joint(t).counterbalance;
        *cos += t.value("cos");
        *sin += t.value("sin");
    }),
    (&FrictionHysteresis, |arm, t| arm.joint(t).gear.windup += t.value("windup")),
    (&TransmissionError, |arm, t| {
        let terms = t.values.iter().filter_map(|(name, v)| Some((Order::named(name)?, *v)));
        arm.joint(t).orders.extend(terms);
    }),
    (&MotorError, |arm, t| {
        let ripple = ["order", "cos", "sin"].map(|name| t.value(name));
        arm.joint(t).ripples.push(ripple);
    }),
    (&JointCoupling, |arm, t| {
        let number = |name: &str| name.strip_prefix("joint ")?.parse::<usize>().ok();
        let terms = t.values.iter().filter_map(|(name, v)| Some((number(name)? - 1, *v)));
        arm.joint(t).couplings.extend(terms);
    }),
    (&ThermalGrowth, |arm, t| arm.expansion += t.value("expansion")),
    (&InstrumentScale, |arm, t| arm.instrument_scale += t.value("scale")),
    (&JointRatio, |arm, t| arm.joint(t).ratio += t.value("ratio")),
    (&SettlingLag, |arm, t| arm.joint(t).lag += t.value("fraction")),
    (&Drift, |arm, t| arm.drift += sixfold(t)),
    (&Slip, |arm, t| {
        let jump = Jump { after: t.value("after") as usize, by: sixfold(t) };
        let slips = if t.place == Place::Tool { &mut arm.tool_slips } else { &mut arm.base_slips };
        slips.push(jump);
    }),
    (&Latency, |arm, t| arm.delay += t.value("delay")),
    (&GravityTilt, |arm, t| {
        let file = rotation_of(&arm.tilt).tr_mul(&arm.gravity);
        arm.tilt += Vector3::new(t.value("x"), t.value("y"), 0.0);
        arm.gravity = rotation_of(&arm.tilt) * file;
    }),
    (&LinkCom, |arm, t| {
        arm.joint(t).com += Vector3::new(t.value("x"), t.value("y"), t.value("z"));
    }),
    (&BearingWobble, |arm, t| {
        let [x, y] = &mut arm.joint(t).wobble;
        x[0] += t.value("cos_x");
        x[1] += t.value("sin_x");
        y[0] += t.value("cos_y");
        y[1] += t.value("sin_y");
    }),
    (&JointWarming, |arm, t| arm.joint(t).warming += t.value("rate")),
    (&GeometricStiffness, |arm, t| arm.geometric += t.value("fraction")),
];

/// Every effect that the plant can have, in the order of the format.
pub fn effects() -> Vec<&'static dyn Effect> {
    LAWS.iter().map(|(effect, _)| *effect).collect()
}

/// Whether the plant has a law for an effect.
pub fn has_law(effect: &dyn Effect) -> bool {
    law(effect).is_some()
}

/// The plant's law for an effect; none for one that it does not know.
pub(super) fn law(effect: &dyn Effect) -> Option<Law> {
    LAWS.iter().find(|(known, _)| *known == effect).map(|(_, law)| *law)
}

impl Reality {
    /// The row at which a truth acts.
    fn joint(&mut self, truth: &Truth) -> &mut RealJoint {
        &mut self.joints[truth.place.row()]
    }
}

/// A frame's displacement.
fn sixfold(truth: &Truth) -> Vector6<f64> {
    let names = ["x", "y", "z", "rx", "ry", "rz"];
    Vector6::from_fn(|k, _| truth.value(names[k]))
}

/// A term of a transmission error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Cos(usize),
    Sin(usize),
}

impl Order {
    /// `cos 2`, `sin 14`.
    fn named(name: &str) -> Option<Order> {
        let (function, order) = name.split_once(' ')?;
        let order = order.parse().ok()?;
        match function {
            "cos" => Some(Order::Cos(order)),
            "sin" => Some(Order::Sin(order)),
            _ => None,
        }
    }
}
