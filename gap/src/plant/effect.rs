//! The effects that reality may have: names, places, numbers.

use core::fmt;

use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use super::quantity::Quantity;

/// Something that reality does and the robot file does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "each is described by the format under its identifier")]
pub enum Effect {
    JointOffset,
    LinkGeometry,
    BaseFrame,
    ToolFrame,
    JointCompliance,
    JointHardening,
    BearingCompliance,
    LinkCompliance,
    LinkWeight,
    BaseCompliance,
    WrenchScale,
    PayloadCom,
    Backlash,
    FrictionHysteresis,
    TransmissionError,
    JointCoupling,
    ThermalGrowth,
    InstrumentScale,
    JointRatio,
    SettlingLag,
    Drift,
    Slip,
    GeometricStiffness,
}

/// Where an effect acts; joints and links count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the variants are the format's places")]
pub enum Place {
    Base,
    Joint(usize),
    Link(usize),
    Tool,
    Arm,
    Instrument,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Base => f.write_str("base"),
            Place::Joint(i) => write!(f, "joint {i}"),
            Place::Link(i) => write!(f, "link {i}"),
            Place::Tool => f.write_str("tool"),
            Place::Arm => f.write_str("arm"),
            Place::Instrument => f.write_str("instrument"),
        }
    }
}

/// The largest order of a transmission error.
pub const MOST_ORDERS: usize = 1000;

/// Components of a frame's displacement.
const FRAME: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

impl Effect {
    /// All of them, in the order of the format.
    pub const ALL: [Effect; 23] = [
        Effect::JointOffset,
        Effect::LinkGeometry,
        Effect::BaseFrame,
        Effect::ToolFrame,
        Effect::JointCompliance,
        Effect::JointHardening,
        Effect::BearingCompliance,
        Effect::LinkCompliance,
        Effect::LinkWeight,
        Effect::BaseCompliance,
        Effect::WrenchScale,
        Effect::PayloadCom,
        Effect::Backlash,
        Effect::FrictionHysteresis,
        Effect::TransmissionError,
        Effect::JointCoupling,
        Effect::ThermalGrowth,
        Effect::InstrumentScale,
        Effect::JointRatio,
        Effect::SettlingLag,
        Effect::Drift,
        Effect::Slip,
        Effect::GeometricStiffness,
    ];

    /// The format's name.
    pub fn identifier(self) -> &'static str {
        match self {
            Effect::JointOffset => "joint_offset",
            Effect::LinkGeometry => "link_geometry",
            Effect::BaseFrame => "base_frame",
            Effect::ToolFrame => "tool_frame",
            Effect::JointCompliance => "joint_compliance",
            Effect::JointHardening => "joint_hardening",
            Effect::BearingCompliance => "bearing_compliance",
            Effect::LinkCompliance => "link_compliance",
            Effect::LinkWeight => "link_weight",
            Effect::BaseCompliance => "base_compliance",
            Effect::WrenchScale => "wrench_scale",
            Effect::PayloadCom => "payload_com",
            Effect::Backlash => "backlash",
            Effect::FrictionHysteresis => "friction_hysteresis",
            Effect::TransmissionError => "transmission_error",
            Effect::JointCoupling => "joint_coupling",
            Effect::ThermalGrowth => "thermal_growth",
            Effect::InstrumentScale => "instrument_scale",
            Effect::JointRatio => "joint_ratio",
            Effect::SettlingLag => "settling_lag",
            Effect::Drift => "drift",
            Effect::Slip => "slip",
            Effect::GeometricStiffness => "geometric_stiffness",
        }
    }

    /// The effect of that name.
    pub fn named(name: &str) -> Option<Effect> {
        Effect::ALL.into_iter().find(|e| e.identifier() == name)
    }

    /// Where on this arm it can act.
    pub fn places(self, arm: &Arm) -> Vec<Place> {
        let joints = || (1..=arm.dof()).map(Place::Joint);
        let turns = |i: usize| arm.joints[i - 1].motion == Motion::Revolute;
        let revolute = |p: &Place| matches!(p, Place::Joint(i) if turns(*i));
        match self {
            Effect::JointOffset
            | Effect::JointCompliance
            | Effect::JointHardening
            | Effect::BearingCompliance
            | Effect::Backlash
            | Effect::FrictionHysteresis
            | Effect::JointRatio
            | Effect::SettlingLag => joints().collect(),
            Effect::TransmissionError => joints().filter(revolute).collect(),
            Effect::JointCoupling if arm.dof() < 2 => Vec::new(),
            Effect::JointCoupling => joints().collect(),
            Effect::LinkGeometry | Effect::LinkWeight => (1..=arm.dof()).map(Place::Link).collect(),
            Effect::LinkCompliance => {
                (1..=arm.dof()).filter(|i| has_length(arm, *i)).map(Place::Link).collect()
            }
            Effect::BaseFrame | Effect::BaseCompliance | Effect::Drift => vec![Place::Base],
            Effect::ToolFrame | Effect::WrenchScale | Effect::PayloadCom => vec![Place::Tool],
            Effect::ThermalGrowth | Effect::GeometricStiffness => vec![Place::Arm],
            Effect::InstrumentScale => vec![Place::Instrument],
            Effect::Slip => vec![Place::Base, Place::Tool],
        }
    }

    /// Its parameters at a place of this arm. Of a transmission error these are the first three
    /// orders; [`Effect::quantity`] knows all.
    pub fn parameters(self, arm: &Arm, place: Place) -> Vec<(String, Quantity)> {
        use Quantity::*;
        let prismatic = match place {
            Place::Joint(i) | Place::Link(i) => {
                arm.joints.get(i - 1).is_some_and(|j| j.motion == Motion::Prismatic)
            }
            _ => false,
        };
        let length_if_prismatic = |l, a| if prismatic { l } else { a };
        let named = |list: &[(&str, Quantity)]| {
            list.iter().map(|(name, q)| ((*name).to_owned(), *q)).collect::<Vec<_>>()
        };
        let frame = |length, angle| {
            FRAME
                .iter()
                .enumerate()
                .map(move |(k, name)| ((*name).to_owned(), if k < 3 { length } else { angle }))
        };
        match self {
            Effect::JointOffset => named(&[("offset", length_if_prismatic(Length, Angle))]),
            Effect::LinkGeometry => {
                let mut list = match prismatic {
                    true => named(&[("theta", Angle), ("a", Length), ("alpha", Angle)]),
                    false => named(&[("d", Length), ("a", Length), ("alpha", Angle)]),
                };
                if matches!(place, Place::Link(i) if has_beta(arm, i)) {
                    list.push(("beta".to_owned(), Angle));
                }
                list
            }
            Effect::BaseFrame | Effect::ToolFrame => frame(Length, Angle).collect(),
            Effect::JointCompliance => {
                named(&[("compliance", length_if_prismatic(LengthPerForce, AnglePerMoment))])
            }
            Effect::JointHardening => {
                named(&[("cubic", length_if_prismatic(LengthPerForceCubed, AnglePerMomentCubed))])
            }
            Effect::BearingCompliance => {
                named(&[("tilt_x", AnglePerMoment), ("tilt_y", AnglePerMoment)])
            }
            Effect::LinkCompliance => named(&[("bending", Flexibility), ("torsion", Flexibility)]),
            Effect::LinkWeight => named(&[("mass", Mass)]),
            Effect::BaseCompliance => named(&[
                ("rock_x", AnglePerMoment),
                ("rock_y", AnglePerMoment),
                ("give", LengthPerForce),
            ]),
            Effect::WrenchScale | Effect::InstrumentScale => named(&[("scale", Ratio)]),
            Effect::PayloadCom => named(&[("x", Length), ("y", Length), ("z", Length)]),
            Effect::Backlash => named(&[("width", length_if_prismatic(Length, Angle))]),
            Effect::FrictionHysteresis => {
                named(&[("windup", length_if_prismatic(LengthPerForce, AnglePerMoment))])
            }
            Effect::TransmissionError => (1..=3)
                .flat_map(|k| [(format!("cos {k}"), Angle), (format!("sin {k}"), Angle)])
                .collect(),
            Effect::JointCoupling => (1..=arm.dof())
                .filter(|j| place != Place::Joint(*j))
                .map(|j| (format!("joint {j}"), Ratio))
                .collect(),
            Effect::ThermalGrowth => named(&[("expansion", PerKelvin)]),
            Effect::JointRatio => named(&[("ratio", Ratio)]),
            Effect::SettlingLag | Effect::GeometricStiffness => named(&[("fraction", Ratio)]),
            Effect::Drift => frame(LengthRate, AngleRate).collect(),
            Effect::Slip => {
                core::iter::once(("after".to_owned(), Row)).chain(frame(Length, Angle)).collect()
            }
        }
    }

    /// What the parameter of that name is; `None` if there is none.
    pub fn quantity(self, arm: &Arm, place: Place, name: &str) -> Option<Quantity> {
        if self == Effect::TransmissionError {
            return order(name).map(|_| Quantity::Angle);
        }
        self.parameters(arm, place).into_iter().find(|(n, _)| n == name).map(|(_, q)| q)
    }

    /// The names of its parameters, as a message lists them.
    pub fn names(self, arm: &Arm, place: Place) -> String {
        if self == Effect::TransmissionError {
            return format!("`cos k` or `sin k` with an order k of 1 to {MOST_ORDERS}");
        }
        let names: Vec<String> =
            self.parameters(arm, place).into_iter().map(|(name, _)| format!("`{name}`")).collect();
        match names.as_slice() {
            [only] => only.clone(),
            several => format!("one of {}", several.join(", ")),
        }
    }
}

/// A term of a transmission error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Cos(usize),
    Sin(usize),
}

/// `cos 2`, `sin 14`.
pub(super) fn order(name: &str) -> Option<Order> {
    let (function, k) = name.split_once(' ')?;
    let k = k.parse().ok().filter(|k| (1..=MOST_ORDERS).contains(k))?;
    match function {
        "cos" => Some(Order::Cos(k)),
        "sin" => Some(Order::Sin(k)),
        _ => None,
    }
}

/// Whether the origins of frames i − 1 and i are apart at some posture.
fn has_length(arm: &Arm, link: usize) -> bool {
    let joint = &arm.joints[link - 1];
    joint.a != 0.0 || joint.d != 0.0 || joint.motion == Motion::Prismatic
}

/// Whether the axes that row i ties together are parallel: the table's four numbers then leave one
/// of their relative directions out.
pub(super) fn has_beta(arm: &Arm, link: usize) -> bool {
    let parallel = arm.joints[link - 1].alpha.sin().abs() < 1e-9;
    let has_neighbour = match arm.convention {
        Convention::Standard => link < arm.dof(),
        Convention::Modified => link > 1,
    };
    parallel && has_neighbour
}
