//! The table of an arm.

use std::string::String;
use std::vec::Vec;

use nalgebra::{Isometry3, Matrix3, Vector3};

pub use crate::Convention;
use crate::Motion;

/// A serial arm: its Denavit-Hartenberg table and what hangs on it. By default it has no joints, and no weight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arm {
    /// The arm's name.
    pub name: String,
    /// Which of the two conventions the rows follow.
    pub convention: Convention,
    /// The rows of the table, base to tip.
    pub joints: Vec<Joint>,
    /// Frame 0 in the world, in whose axes poses, twists and wrenches are told.
    pub base: Isometry3<f64>,
    /// Tool frame in the last frame.
    pub tool: Isometry3<f64>,
    /// The rotation vector (axis × angle, rad, in the last frame) that [`Arm::tool`] was made from.
    /// Only [`Arm::parameter_jacobian`] reads it: of the vectors of one rotation it says which.
    pub tool_rotation_vector: Vector3<f64>,
    /// Gravity in the axes of frame 0, m/s².
    pub gravity: Vector3<f64>,
}

/// One row of the table. By default it is a rigid joint that turns, without length or mass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joint {
    /// Revolute or prismatic.
    pub motion: Motion,
    /// Rotation about z, rad; the offset added to `q` if the joint is revolute.
    pub theta: f64,
    /// Translation along z, m; the offset added to `q` if the joint is prismatic.
    pub d: f64,
    /// Translation along x, m.
    pub a: f64,
    /// Rotation about x, rad.
    pub alpha: f64,
    /// Rotation about y behind it, rad: between parallel axes `d` and `alpha` do not say all (Hayati).
    pub beta: f64,
    /// 1/k of the joint's spring, rad/(N·m), or m/N if it is prismatic; 0 is rigid.
    pub compliance: f64,
    /// Mass of the link that this joint moves, kg.
    pub mass: f64,
    /// Its centre of mass in the row's own frame, m.
    pub com: Vector3<f64>,
    /// Its tensor of inertia about that centre in the row's own axes, kg·m².
    pub inertia: Matrix3<f64>,
    /// What turns the joint, and what holds it back.
    pub drive: Drive,
    /// Joint limits, rad or m. Nothing here depends on them.
    pub limits: Option<[f64; 2]>,
    /// The link as an elastic beam; without one it is rigid, and weightless but for its mass.
    pub beam: Option<Beam>,
}

/// Motor, gear and friction of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Turns of the motor per turn of the joint; rad/m if it is prismatic.
    pub gear: f64,
    /// Moment of inertia of all that turns with the motor, at the motor, kg·m².
    pub rotor_inertia: f64,
    /// Friction that knows the direction alone, at the joint, N·m (N if it is prismatic).
    pub coulomb: f64,
    /// Friction in proportion to the rate, at the joint, N·m·s/rad (N·s/m if it is prismatic).
    pub viscous: f64,
}

impl Default for Drive {
    /// A motor at the joint that has neither inertia nor friction.
    fn default() -> Self {
        Drive { gear: 1.0, rotor_inertia: 0.0, coulomb: 0.0, viscous: 0.0 }
    }
}

/// A straight elastic beam from the origin of frame i−1 to the origin of frame i.
///
/// Its x axis is that chord. Its z axis is the part of z of frame i−1 perpendicular to the chord;
/// where the chord is parallel to that axis, its y axis is x of frame i before its beta (standard) or of frame i−1
/// (modified), and z = x × y.
///
/// The beam is an Euler-Bernoulli one, and a Timoshenko one where it has a shear coefficient. On a
/// prismatic joint its length follows the joint; such a beam counts as weightless.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// E, Pa.
    pub youngs_modulus: f64,
    /// G, Pa.
    pub shear_modulus: f64,
    /// A, m².
    pub area: f64,
    /// Second moment of area about the beam's y axis, m⁴.
    pub iy: f64,
    /// Second moment of area about the beam's z axis, m⁴.
    pub iz: f64,
    /// Torsion constant, m⁴.
    pub j: f64,
    /// kg/m³; 0 is weightless.
    pub density: f64,
    /// Timoshenko's κ; `None` leaves shear out.
    pub shear_coefficient: Option<f64>,
}

impl Arm {
    /// Number of joints.
    pub fn dof(&self) -> usize {
        self.joints.len()
    }
}
