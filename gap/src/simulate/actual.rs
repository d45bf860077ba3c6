//! The arm as it is in one row: the table with what the effects make of it.

use std::borrow::Cow;
use std::fmt;

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};

use super::beam::Link;
use super::site::Site;

/// How a site gives under its load: from the wrench at the site (its axes, about its origin, what
/// acts on the arm from beyond it) to its displacement `[dx dy dz drx dry drz]`.
pub type Law = Box<dyn Fn(&Vector6<f64>) -> Vector6<f64> + Send + Sync>;

/// The arm in one row.
///
/// An effect changes what it acts on: the table, the load, a displacement of a site that does not
/// depend on the load, a law by which one gives, or the instrument.
pub struct Actual<'a> {
    /// As it is without effects.
    pub nominal: &'a Arm,
    /// Table, springs, beams, masses. Its tool is the real one.
    pub arm: Cow<'a, Arm>,
    /// Joint values before the springs give, n, rad (m if prismatic).
    pub joints: Vec<f64>,
    /// Wrench on the tool, base axes, N and N·m.
    pub wrench: Vector6<f64>,
    /// Where the force acts, tool frame, m.
    pub load_point: Vector3<f64>,
    /// What turns each joint beside its load, N·m (N): springs between the links before and behind
    /// it, that load no other joint. Empty where there are none.
    pub preload: Vec<f64>,
    /// Displacements that do not depend on the load, one for each site.
    pub fixed: Vec<Vector6<f64>>,
    /// What else gives, beside the arm's own springs and beams.
    pub laws: Vec<(Site, Law)>,
    /// Where the arm's base stands in the measuring frame.
    pub base: Isometry3<f64>,
    /// What the instrument makes of a metre.
    pub metre: f64,
    /// Part of the deflection beyond first order that is there on top of the model's own.
    pub loaded_geometry: f64,
}

impl fmt::Debug for Actual<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Actual").field("arm", &self.arm.name).field("joints", &self.joints).finish()
    }
}

impl<'a> Actual<'a> {
    /// The arm as the table has it, at readings `q` (n) under `wrench`.
    pub fn new(arm: &'a Arm, q: &[f64], wrench: &Vector6<f64>) -> Self {
        Self {
            joints: q.to_vec(),
            wrench: *wrench,
            load_point: Vector3::zeros(),
            preload: Vec::new(),
            fixed: vec![Vector6::zeros(); Site::count(arm.dof())],
            laws: Vec::new(),
            base: arm.base,
            metre: 1.0,
            loaded_geometry: 0.0,
            nominal: arm,
            arm: Cow::Borrowed(arm),
        }
    }

    /// The displacement of a site that does not depend on the load.
    pub fn fixed_at(&mut self, site: Site) -> &mut Vector6<f64> {
        let index = site.index(self.arm.dof());
        &mut self.fixed[index]
    }

    /// Moves a joint, rad (m if prismatic).
    pub fn turn(&mut self, joint: usize, by: f64) {
        self.joints[joint] += by;
    }

    /// Turns a joint by a torque, N·m (N), of which the other joints bear nothing.
    pub fn pull(&mut self, joint: usize, torque: f64) {
        self.preload.resize(self.joints.len(), 0.0);
        self.preload[joint] += torque;
    }

    /// What a joint bears of a load at its site.
    pub(super) fn borne(&self, row: usize, load: &Vector6<f64>) -> Vector6<f64> {
        match self.preload.get(row) {
            Some(torque) => load + Vector6::ith(axis(self.arm.joints[row].motion), *torque),
            None => *load,
        }
    }

    /// The transforms of row `row` before its joint's motion and from there to its frame.
    pub fn row(&self, row: usize) -> (Isometry3<f64>, Isometry3<f64>) {
        let joint = &self.arm.joints[row];
        let value = self.joints[row];
        let (theta, d) = match joint.motion {
            Motion::Revolute => (joint.theta + value, joint.d),
            Motion::Prismatic => (joint.theta, joint.d + value),
        };
        let along = |x, z| Isometry3::translation(x, 0.0, z);
        let about_z = Isometry3::rotation(Vector3::new(0.0, 0.0, theta));
        let inclined = Isometry3::rotation(Vector3::new(joint.alpha, 0.0, 0.0))
            * Isometry3::rotation(Vector3::new(0.0, joint.beta, 0.0));
        let motion = about_z * along(0.0, d);
        match self.arm.convention {
            Convention::Standard => {
                (Isometry3::identity(), motion * along(joint.a, 0.0) * inclined)
            }
            Convention::Modified => (inclined * along(joint.a, 0.0), motion),
        }
    }

    /// The beam of a row whose whole transform is `row`.
    pub(super) fn link(&self, row: usize, transform: &Isometry3<f64>) -> Option<Link<'_>> {
        Link::new(&self.arm.joints[row], self.arm.convention, transform)
    }

    /// Displacement of a joint by its own spring.
    pub(super) fn spring(&self, row: usize, load: &Vector6<f64>) -> Vector6<f64> {
        let joint = &self.arm.joints[row];
        let axis = axis(joint.motion);
        Vector6::ith(axis, joint.compliance * load[axis])
    }

    /// Whether nothing gives under load.
    pub(super) fn is_rigid(&self) -> bool {
        let gives = |j: &stiffarm_kernels::generic::Joint| j.compliance != 0.0 || j.beam.is_some();
        self.laws.is_empty() && !self.arm.joints.iter().any(gives)
    }
}

/// The component of a joint's displacement, and of its load, that is the joint's own: rotation
/// about z, or translation along it.
pub fn axis(motion: Motion) -> usize {
    match motion {
        Motion::Revolute => 5,
        Motion::Prismatic => 2,
    }
}
