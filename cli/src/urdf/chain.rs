//! What lies between base and tip: joints that move, and fixed transforms between them.

use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Unit, Vector3};
use stiffarm_codegen::robot::Motion;
use urdf_rs::{Joint, JointType, Pose, Robot};

use super::angle::roll_pitch_yaw;
use super::masses::{self, Lump};
use super::refusal::{Place, Refusal};
use super::tree::{Tree, moves};

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
    pub end: IsometryMatrix3<f64>,
    /// In base axes, m/s².
    pub gravity: Vector3<f64>,
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
    pub before: IsometryMatrix3<f64>,
    /// In the joint's frame.
    pub axis: Unit<Vector3<f64>>,
    /// rad or m.
    pub limits: Option<[f64; 2]>,
    /// What moves with this joint and not with the next, in the joint's frame.
    pub lump: Lump,
}

impl Chain {
    /// The chain from `base` (by default the root) to `tip` (by default the only end of the tree).
    ///
    /// # Errors
    /// [`Refusal`]: no such chain, or a joint in it that a table cannot hold.
    pub fn new(robot: &Robot, base: Option<&str>, tip: Option<&str>) -> Result<Chain, Refusal> {
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
            end: IsometryMatrix3::identity(),
            gravity: Vector3::new(0.0, 0.0, -GRAVITY),
            remarks: Vec::new(),
        };
        chain.turn_gravity(&tree)?;
        for joint in path {
            chain.end *= isometry(&joint.origin);
            if let Some(motion) = motion(joint)? {
                let before = core::mem::replace(&mut chain.end, IsometryMatrix3::identity());
                let lump = masses::lump(&tree, &joint.child.link, tip, &mut chain.remarks);
                let (axis, limits) = (axis(joint)?, limits(joint, &mut chain.remarks));
                let name = joint.name.clone();
                chain.steps.push(Step { name, motion, before, axis, limits, lump });
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
        let each = path.iter().map(|joint| isometry(&joint.origin));
        let turn = each.fold(IsometryMatrix3::identity(), |whole, next| whole * next);
        self.gravity = turn.rotation.inverse() * self.gravity;
        Ok(())
    }

    /// The tip in the base frame.
    pub fn pose(&self, q: &[f64]) -> IsometryMatrix3<f64> {
        let mut frame = IsometryMatrix3::identity();
        for (step, q) in self.steps.iter().zip(q) {
            frame *= step.before
                * match step.motion {
                    Motion::Revolute => IsometryMatrix3::from_parts(
                        Translation3::identity(),
                        Rotation3::from_axis_angle(&step.axis, *q),
                    ),
                    Motion::Prismatic => IsometryMatrix3::from_parts(
                        Translation3::from(step.axis.into_inner() * *q),
                        Rotation3::identity(),
                    ),
                };
        }
        frame * self.end
    }
}

/// A URDF's origin as a transform.
pub fn isometry(pose: &Pose) -> IsometryMatrix3<f64> {
    IsometryMatrix3::from_parts(
        Translation3::new(pose.xyz[0], pose.xyz[1], pose.xyz[2]),
        Rotation3::from_matrix_unchecked(roll_pitch_yaw(pose.rpy.0)),
    )
}

/// How a joint moves; none if it is fixed.
fn motion(joint: &Joint) -> Result<Option<Motion>, Refusal> {
    let at = || Place::Joint(joint.name.clone());
    let kind = match joint.joint_type {
        JointType::Fixed => return Ok(None),
        JointType::Revolute | JointType::Continuous => Motion::Revolute,
        JointType::Prismatic => Motion::Prismatic,
        JointType::Floating => return Err(unfit(joint, "floating")),
        JointType::Planar => return Err(unfit(joint, "planar")),
        JointType::Spherical => return Err(unfit(joint, "spherical")),
    };
    if let Some(mimic) = &joint.mimic {
        let message = format!(
            "joint `{}` follows joint `{}`: expected joints that each have their own value",
            joint.name, mimic.joint
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

fn axis(joint: &Joint) -> Result<Unit<Vector3<f64>>, Refusal> {
    let found = joint.axis.xyz.0;
    Unit::try_new(Vector3::from(found), 1e-9).ok_or_else(|| {
        let message = format!("joint `{}`: its axis {found:?} has no direction", joint.name);
        Refusal::new(message, Place::Joint(joint.name.clone()))
    })
}

/// Of a joint that has some.
fn limits(joint: &Joint, remarks: &mut Vec<String>) -> Option<[f64; 2]> {
    if joint.joint_type == JointType::Continuous {
        return None;
    }
    let (lower, upper) = (joint.limit.lower, joint.limit.upper);
    let sound = lower.is_finite() && upper.is_finite() && lower < upper;
    if !sound {
        remarks.push(format!("joint `{}` has no limits that could be carried over", joint.name));
    }
    sound.then_some([lower, upper])
}
