//! The effects that this plant can have: names, places and numbers as they are written of logs.

use stiffarm_kernels::generic::Arm;

/// Where an effect of motion acts; joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// A joint.
    Joint(usize),
    /// A motor that turns with two joints: with the sum of their values (1) or the difference (−1).
    Pair(usize, usize, i8),
    /// A link.
    Link(usize),
    /// What the arm holds in a run.
    Tool(usize),
    /// All joints.
    Arm,
    /// The base.
    Base,
    /// Between the controller and the arm.
    Interface,
}

impl core::fmt::Display for Spot {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Spot::Joint(joint) => write!(f, "joint {}", joint + 1),
            Spot::Pair(a, b, sum) => {
                write!(f, "joints {} {} {}", a + 1, if *sum > 0 { "+" } else { "−" }, b + 1)
            }
            Spot::Link(link) => write!(f, "link {}", link + 1),
            Spot::Tool(run) => write!(f, "the tool in run {}", run + 1),
            Spot::Arm => f.write_str("every joint"),
            Spot::Base => f.write_str("the base"),
            Spot::Interface => f.write_str("the interface"),
        }
    }
}

/// In which rows an effect shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    /// What drives the joints.
    Torque,
    /// Where they are, less where they were to be.
    Position,
}

/// Where an effect may act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    Joints,
    Pairs,
    JointsOrAll,
    Links,
    Tool,
    Base,
    Interface,
}

/// The ten numbers of a body: mass, first moments, and the tensor of the second about the frame's origin.
const BODY: &[(&str, &str)] = &[
    ("m", "kg"),
    ("mx", "kg·m"),
    ("my", "kg·m"),
    ("mz", "kg·m"),
    ("xx", "kg·m²"),
    ("xy", "kg·m²"),
    ("yy", "kg·m²"),
    ("xz", "kg·m²"),
    ("yz", "kg·m²"),
    ("zz", "kg·m²"),
];

/// An effect.
#[derive(Debug, PartialEq)]
pub struct Law {
    /// Its identifier.
    pub name: &'static str,
    /// Where it shows.
    pub rows: &'static [Rows],
    at: At,
    /// Names and SI units.
    pub numbers: &'static [(&'static str, &'static str)],
}

const fn torque(
    name: &'static str,
    at: At,
    numbers: &'static [(&'static str, &'static str)],
) -> Law {
    Law { name, rows: &[Rows::Torque], at, numbers }
}

const fn position(
    name: &'static str,
    at: At,
    numbers: &'static [(&'static str, &'static str)],
) -> Law {
    Law { name, rows: &[Rows::Position], at, numbers }
}

/// All of them.
pub static LAWS: [Law; 24] = [
    torque("coulomb_friction", At::Joints, &[("coulomb", "N·m")]),
    torque("viscous_friction", At::Joints, &[("viscous", "N·m·s/rad")]),
    torque("friction_curve", At::Joints, &[("root", "N·m/√(rad/s)")]),
    torque("stribeck", At::Joints, &[("torque", "N·m"), ("speed", "rad/s")]),
    torque("presliding", At::Joints, &[("torque", "N·m"), ("distance", "rad")]),
    torque("load_friction", At::Joints, &[("part", "1")]),
    torque("torque_saturation", At::Joints, &[("part", "1/(N·m)")]),
    torque("asymmetric_friction", At::Joints, &[("half_difference", "N·m")]),
    torque("torque_offset", At::Joints, &[("offset", "N·m")]),
    torque("torque_scale", At::JointsOrAll, &[("scale", "1")]),
    torque("rotor_inertia", At::Joints, &[("inertia", "kg·m²")]),
    torque("counterbalance", At::Joints, &[("cos", "N·m"), ("sin", "N·m")]),
    torque(
        "joint_coupling",
        At::Pairs,
        &[("inertia", "kg·m²"), ("viscous", "N·m·s/rad"), ("coulomb", "N·m")],
    ),
    torque("torque_ripple", At::Joints, &[("order", "1"), ("cos", "N·m"), ("sin", "N·m")]),
    torque("joint_elasticity", At::Joints, &[("compliance", "rad/(N·m)")]),
    torque("warm_up", At::Joints, &[("rate", "1/min")]),
    torque("link_inertia", At::Links, BODY),
    torque("payload", At::Tool, BODY),
    torque("gravity_direction", At::Base, &[("rx", "rad"), ("ry", "rad"), ("rz", "rad")]),
    torque("joint_offset", At::Joints, &[("offset", "rad")]),
    Law {
        name: "latency",
        rows: &[Rows::Torque, Rows::Position],
        at: At::Interface,
        numbers: &[("delay", "s")],
    },
    position("tracking_lag", At::Joints, &[("lag", "s"), ("inertia", "s²")]),
    position("servo_droop", At::Joints, &[("compliance", "rad/(N·m)")]),
    position("backlash", At::Joints, &[("width", "rad")]),
];

impl Law {
    /// The effect of a name.
    pub fn named(name: &str) -> Option<&'static Law> {
        LAWS.iter().find(|law| law.name == name)
    }

    /// Where on this arm it may act, in so many runs.
    pub fn spots(&self, arm: &Arm, runs: usize) -> Vec<Spot> {
        let n = arm.dof();
        let joints = (0..n).map(Spot::Joint);
        match self.at {
            At::Joints => joints.collect(),
            At::JointsOrAll => joints.chain([Spot::Arm]).collect(),
            At::Pairs => {
                let both = |b: usize| [Spot::Pair(b - 1, b, 1), Spot::Pair(b - 1, b, -1)];
                (1..n).flat_map(both).collect()
            }
            At::Links => (0..n).map(Spot::Link).collect(),
            At::Tool => (0..runs).map(Spot::Tool).collect(),
            At::Base => vec![Spot::Base],
            At::Interface => vec![Spot::Interface],
        }
    }

    /// Numbers that say what the effect is like, not how large it is.
    pub fn is_form(&self, number: &str) -> bool {
        ["speed", "distance", "order"].contains(&number)
    }
}
