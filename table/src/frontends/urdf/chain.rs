//! What lies between base and tip: joints that move, and fixed transforms between them.

use super::angle::roll_pitch_yaw;
use super::document::{Elements, Joint, Kind, Origin};
use super::masses::{self, Lump};
use super::refusal::{Place, Refusal};
use super::tree::{Tree, moves};
use crate::robot::space::{Frame, Vector, norm, times};
use crate::robot::{Motion, inertia};

/// Gravity along −z of the root, m/s².
const GRAVITY: f64 = 9.80665;

/// A serial chain as the URDF has it.
#[derive(Clone, Debug)]
pub struct Chain {
    /// The robot's name.
    pub name: String,
    /// The link at its foot.
    pub base: String,
    /// The link at its end.
    pub tip: String,
    /// The joints that move, base to tip.
    pub steps: Vec<Step>,
    /// From the last moving joint's frame to the tip's.
    pub end: Frame,
    /// In base axes, m/s².
    pub gravity: Vector,
    /// What one has to know of it: links that were left out.
    pub remarks: Vec<String>,
}

/// One joint that moves.
#[derive(Clone, Debug)]
pub struct Step {
    /// The joint's name.
    pub name: String,
    /// Revolute or prismatic.
    pub motion: Motion,
    /// From the frame of the joint before (the base's for the first) to this joint's at rest.
    pub before: Frame,
    /// A unit vector in the joint's frame.
    pub axis: Vector,
    /// rad or m.
    pub limits: Option<[f64; 2]>,
    /// What moves with this joint and not with the next, in the joint's frame.
    pub lump: Lump,
    /// Viscous friction, N·m·s/rad or N·s/m, and dry friction, N·m or N.
    pub friction: [f64; 2],
}

impl Chain {
    /// The chain from `base` (by default the root) to `tip` (by default the only end of the tree).
    ///
    /// # Errors
    /// [`Refusal`]: no such chain, or a joint in it that a table cannot hold.
    pub fn new(robot: &Elements, base: Option<&str>, tip: Option<&str>) -> Result<Chain, Refusal> {
        let tree = Tree::new(robot)?;
        let base = match base {
            Some(base) => base,
            None => tree.root()?,
        };
        let tip = match tip {
            Some(tip) => tip,
            None => tree.only_tip(base)?,
        };
        let path = tree.path(base, tip)?;
        let mut chain = Chain {
            name: if robot.name.trim().is_empty() { tip } else { &robot.name }.to_owned(),
            base: base.to_owned(),
            tip: tip.to_owned(),
            steps: Vec::new(),
            end: Frame::IDENTITY,
            gravity: [0.0, 0.0, -GRAVITY],
            remarks: Vec::new(),
        };
        chain.turn_gravity(&tree)?;
        for joint in path {
            chain.end = chain.end.then(&frame(&joint.origin));
            if let Some(motion) = motion(joint)? {
                let before = core::mem::replace(&mut chain.end, Frame::IDENTITY);
                let mut lump = masses::lump(&tree, &joint.child, tip, &mut chain.remarks);
                let tensor = lump.tensor(&Frame::IDENTITY.axes);
                if let Some(why) = tensor.and_then(inertia::unphysical) {
                    chain.remarks.push(format!(
                        "link `{}` and what is fixed to it: {why}: taken as a mass at its centre",
                        joint.child
                    ));
                    lump = lump.at_a_point();
                }
                let (axis, limits) = (axis(joint)?, limits(joint, &mut chain.remarks));
                let name = joint.name.clone();
                chain.steps.push(Step {
                    name,
                    motion,
                    before,
                    axis,
                    limits,
                    lump,
                    friction: joint.friction,
                });
            }
        }
        if chain.steps.is_empty() {
            let message = format!("nothing moves between link `{base}` and link `{tip}`");
            return Err(Refusal::new(message, Place::Link(tip.to_owned())));
        }
        Ok(chain)
    }

    /// Gravity is −z of the root; the base may be turned against it.
    fn turn_gravity(&mut self, tree: &Tree<'_>) -> Result<(), Refusal> {
        let Ok(root) = tree.root() else { return Ok(()) };
        let path = tree.path(root, &self.base)?;
        if path.iter().any(|joint| moves(joint)) {
            self.remarks.push(format!(
                "joints move between the root `{root}` and the base `{}`: gravity is taken along \
                 −z of the base",
                self.base
            ));
            return Ok(());
        }
        let each = path.iter().map(|joint| frame(&joint.origin));
        let turn = each.fold(Frame::IDENTITY, |whole, next| whole.then(&next));
        self.gravity = turn.inverse().direction(self.gravity);
        Ok(())
    }

    /// The tip in the base frame.
    pub fn pose(&self, q: &[f64]) -> Frame {
        let moved = |step: &Step, q: f64| match step.motion {
            Motion::Revolute => Frame::turned(step.axis, q),
            Motion::Prismatic => Frame::moved(times(step.axis, q)),
        };
        let steps = self.steps.iter().zip(q);
        let at = |at: Frame, (step, q): (&Step, &f64)| at.then(&step.before).then(&moved(step, *q));
        steps.fold(Frame::IDENTITY, at).then(&self.end)
    }
}

/// A URDF's origin as a frame.
pub fn frame(origin: &Origin) -> Frame {
    Frame { origin: origin.xyz, ..roll_pitch_yaw(origin.rpy) }
}

/// How a joint moves; none if it is fixed.
fn motion(joint: &Joint) -> Result<Option<Motion>, Refusal> {
    let at = || Place::Joint(joint.name.clone());
    let kind = match joint.kind {
        Kind::Fixed => return Ok(None),
        Kind::Revolute | Kind::Continuous => Motion::Revolute,
        Kind::Prismatic => Motion::Prismatic,
        Kind::Floating => return Err(unfit(joint, "floating")),
        Kind::Planar => return Err(unfit(joint, "planar")),
        Kind::Spherical => return Err(unfit(joint, "spherical")),
    };
    if let Some(mimic) = &joint.mimic {
        let message = format!(
            "joint `{}` follows joint `{}`: expected joints that each have their own value",
            joint.name, mimic
        );
        let help = "a serial arm has one value per joint: choose a --tip before the coupled joint";
        return Err(Refusal::new(message, at()).help(help));
    }
    Ok(Some(kind))
}

fn unfit(joint: &Joint, kind: &str) -> Refusal {
    let name = &joint.name;
    let message = format!("joint `{name}` is {kind}, expected one that turns or slides on an axis");
    let help = "choose --base and --tip so that the chain between them does without it";
    Refusal::new(message, Place::Joint(name.clone())).help(help)
}

fn axis(joint: &Joint) -> Result<Vector, Refusal> {
    let length = norm(joint.axis);
    if length > 1e-9 {
        return Ok(times(joint.axis, 1.0 / length));
    }
    let message = format!("joint `{}`: its axis {:?} has no direction", joint.name, joint.axis);
    Err(Refusal::new(message, Place::Joint(joint.name.clone())))
}

/// Of a joint that has some.
fn limits(joint: &Joint, remarks: &mut Vec<String>) -> Option<[f64; 2]> {
    if joint.kind == Kind::Continuous {
        return None;
    }
    let [lower, upper] = joint.limits;
    let sound = lower.is_finite() && upper.is_finite() && lower < upper;
    if !sound {
        remarks.push(format!("joint `{}` has no limits that could be carried over", joint.name));
    }
    sound.then_some([lower, upper])
}
