//! The links as beams in the posture of the arm, and their part of the tool's deflection.
//!
//! Links are linear: the flexibilities of a clamped chain add up at the tool (Castigliano's second
//! theorem, Lin et al., eqs. 30-32), each carried there from its beam's tip (eqs. 5-8 and 24-26).

use std::vec::Vec;

use nalgebra::{Isometry3, Matrix3, Matrix6, Rotation3, Vector3, Vector6};

use super::arm::{Arm, Beam, Convention};
use super::kinematics::origin;
use super::spatial::{blocks, lower, stack, upper, wrench_transport};
use crate::Motion;

/// Below this sine of the angle between chord and axis the two count as parallel: far above the
/// rounding of frames, far below any angle that a table means.
const PARALLEL: f64 = 1e-9;

/// The beam of one row at one posture.
pub(super) struct Link<'a> {
    beam: &'a Beam,
    motion: Motion,
    /// Number of the row, from 1.
    pub(super) row: usize,
    /// Beam axes in the base frame.
    rotation: Rotation3<f64>,
    /// Length of the chord, m.
    pub(super) length: f64,
    /// Where the beam ends, in the base frame, m.
    pub(super) tip: Vector3<f64>,
    /// z of the frame that it begins in, base axes.
    begins: Vector3<f64>,
}

/// The axes of a beam along `chord` as [`Beam`] defines them. `x` is the x axis of the frame that
/// settles y where the chord is parallel to `z`, the z axis of the previous frame.
fn beam_axes(chord: &Vector3<f64>, z: &Vector3<f64>, x: &Vector3<f64>) -> Rotation3<f64> {
    let along = chord.normalize();
    let across = z - along * along.dot(z);
    let third =
        if across.norm() > PARALLEL { across.normalize() } else { along.cross(x).normalize() };
    Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[along, third.cross(&along), third]))
}

impl<'a> Link<'a> {
    /// `None` where the two frames share their origin: nothing is there to bend.
    fn new(arm: &'a Arm, row: usize, frames: &[Isometry3<f64>]) -> Option<Self> {
        let joint = &arm.joints[row - 1];
        let beam = joint.beam.as_ref()?;
        let (previous, own) = (&frames[row - 1], &frames[row]);
        let chord = origin(own) - origin(previous);
        let length = chord.norm();
        if length == 0.0 {
            return None;
        }
        let x = match arm.convention {
            Convention::Standard => {
                own * (Rotation3::new(-joint.beta * Vector3::y()) * Vector3::x())
            }
            Convention::Modified => previous * Vector3::x(),
        };
        let begins = previous * Vector3::z();
        let rotation = beam_axes(&chord, &begins, &x);
        Some(Link { beam, motion: joint.motion, row, rotation, length, tip: origin(own), begins })
    }

    /// The beam's weight per unit length, base axes, N/m.
    fn load(&self, gravity: &Vector3<f64>) -> Vector3<f64> {
        self.mass_per_length() * gravity
    }

    fn mass_per_length(&self) -> f64 {
        match self.motion {
            Motion::Revolute => self.beam.density * self.beam.area,
            Motion::Prismatic => 0.0,
        }
    }

    /// Its mass, kg, and its tensor of inertia about its middle in base axes as a thin rod's.
    pub(super) fn rod(&self) -> (f64, Matrix3<f64>) {
        let chord = self.rotation * Vector3::x() * self.length;
        let mass = self.mass_per_length() * self.length;
        let across =
            Matrix3::from_diagonal_element(chord.norm_squared()) - chord * chord.transpose();
        (mass, across * (mass / 12.0))
    }

    /// The middle of the chord, in the base frame, m.
    pub(super) fn middle(&self) -> Vector3<f64> {
        self.tip - self.rotation * Vector3::x() * (self.length / 2.0)
    }

    /// Flexibility of the tip in base axes, 6×6.
    pub(super) fn flexibility(&self) -> Matrix6<f64> {
        let turn = blocks(self.rotation.matrix());
        turn * self.beam.flexibility(self.length) * turn.transpose()
    }

    /// How that changes as the tip moves at velocity `v`: the beam grows, and its axes turn with the chord.
    pub(super) fn stretched(&self, v: &Vector3<f64>) -> Matrix6<f64> {
        let [x, z] = [Vector3::x(), Vector3::z()].map(|axis| self.rotation * axis);
        let dx = (v - x * x.dot(v)) / self.length;
        // z is the part of `begins` across the chord, of length 1; along a chord that is parallel to it nothing turns.
        let across = self.begins - x * x.dot(&self.begins);
        let dz = match across.norm() > PARALLEL {
            true => {
                let change = -(dx * x.dot(&self.begins) + x * dx.dot(&self.begins));
                (change - z * z.dot(&change)) / across.norm()
            }
            false => -x * dx.dot(&z),
        };
        let turned = blocks(&Matrix3::from_columns(&[dx, dz.cross(&x) + z.cross(&dx), dz]));
        let turn = blocks(self.rotation.matrix());
        let half = turned * self.beam.flexibility(self.length) * turn.transpose();
        let grown = self.beam.flexibility_by_length(self.length) * x.dot(v);
        half + half.transpose() + turn * grown * turn.transpose()
    }

    /// Twist of the tip in base axes under the beam's own weight.
    fn sag(&self, gravity: &Vector3<f64>) -> Vector6<f64> {
        let load = self.rotation.inverse() * self.load(gravity);
        let twist = self.beam.spread_load_twist(self.length, &load);
        stack(self.rotation * upper(&twist), self.rotation * lower(&twist))
    }
}

impl Arm {
    /// The beams of the arm at one posture, base to tip.
    pub(super) fn links(&self, q: &[f64]) -> Vec<Link<'_>> {
        let frames = self.frames(q);
        (1..=self.dof()).filter_map(|row| Link::new(self, row, &frames)).collect()
    }

    /// Flexibility of all links at the tool origin, 6×6: the sum of `Wᵀ F W`, `F` the
    /// flexibility of a beam's tip and `W` carrying the tool's wrench there.
    pub(super) fn links_compliance(&self, q: &[f64]) -> Matrix6<f64> {
        let tool = self.tool_origin(q);
        let at_tool = |link: &Link<'_>| {
            let to_tip = wrench_transport(&tool, &link.tip);
            to_tip.transpose() * link.flexibility() * to_tip
        };
        self.links(q).iter().map(at_tool).sum()
    }

    /// Twist of the tool by the bending of all links under the tool's wrench, link by link.
    pub(super) fn links_deflection(&self, q: &[f64], w: &Vector6<f64>) -> Vector6<f64> {
        let tool = self.tool_origin(q);
        let at_tool = |link: &Link<'_>| {
            let to_tip = wrench_transport(&tool, &link.tip);
            to_tip.tr_mul(&(link.flexibility() * (to_tip * w)))
        };
        self.links(q).iter().map(at_tool).sum()
    }

    /// Twist of the tool by the bending of all links under the arm's weights: each beam under
    /// its own weight and under everything that hangs beyond its tip (Lin et al., eq. 8).
    pub(super) fn links_sag(&self, q: &[f64]) -> Vector6<f64> {
        let tool = self.tool_origin(q);
        let weights = self.weights(q);
        let at_tool = |link: &Link<'_>| {
            let hanging = weights.iter().filter(|weight| weight.beyond >= link.row);
            let at_tip: Vector6<f64> = hanging.map(|weight| weight.wrench_at(&link.tip)).sum();
            let twist = link.flexibility() * at_tip + link.sag(&self.falling());
            wrench_transport(&tool, &link.tip).tr_mul(&twist)
        };
        self.links(q).iter().map(at_tool).sum()
    }
}
