//! The arm at rest: where everything is and what acts on it.

use nalgebra::{DVector, Isometry3, Matrix6, Matrix6xX, Point3, Vector3, Vector6};
use stiffarm_kernels::Motion;

use super::actual::{Actual, axis};
use super::site::Site;

/// The arm at rest under a load.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Tool frame in the base frame, m.
    pub tool: Isometry3<f64>,
    /// Joint values where the springs have come to rest, n, rad (m if prismatic).
    pub joints: Vec<f64>,
    /// What turns each joint there, loads and springs beside it, n, N·m (N if prismatic).
    pub torque: DVector<f64>,
    /// For each site the frame in which its displacement is expressed, in the base frame.
    pub(super) frames: Vec<Isometry3<f64>>,
    /// For each site the wrench in those axes about the displaced origin.
    pub(super) loads: Vec<Vector6<f64>>,
    /// For each site its displacement.
    pub(crate) displacements: Vec<Vector6<f64>>,
    pub(super) motions: Vec<Motion>,
    /// For each site what carries its displacement to the tool, if the loads are to follow.
    pub(super) carriers: Option<Vec<Matrix6<f64>>>,
}

impl State {
    fn index(&self, site: Site) -> usize {
        site.index(self.motions.len())
    }

    /// The wrench at a site: its axes, about its origin; what acts on the arm from beyond it.
    pub fn load(&self, site: Site) -> &Vector6<f64> {
        &self.loads[self.index(site)]
    }

    /// The displacement of a site, in its own axes.
    pub fn displacement(&self, site: Site) -> &Vector6<f64> {
        &self.displacements[self.index(site)]
    }

    /// The frame in which a site's displacement is expressed, in the base frame.
    pub fn frame(&self, site: Site) -> &Isometry3<f64> {
        &self.frames[self.index(site)]
    }

    /// Twist of the tool, base axes, at the tool origin, by a small displacement of a site given in
    /// its own axes. Of a displacement measurement, what the moved loads do is part of it.
    pub fn carry(&self, site: Site, displacement: &Vector6<f64>) -> Vector6<f64> {
        match &self.carriers {
            Some(carriers) => carriers[self.index(site)] * displacement,
            None => self.carry_rigid(self.index(site), displacement),
        }
    }

    /// Twists of the tool by the six unit displacements of the measuring frame against the base, base
    /// axes: the arm itself stays as it is.
    pub fn base_moved(&self) -> Matrix6xX<f64> {
        let columns: [_; 6] = std::array::from_fn(|k| self.carry_rigid(0, &Vector6::ith(k, 1.0)));
        Matrix6xX::from_columns(&columns)
    }

    /// The same with nothing giving.
    pub(super) fn carry_rigid(&self, index: usize, displacement: &Vector6<f64>) -> Vector6<f64> {
        let frame = &self.frames[index];
        let shift = frame.rotation * displacement.fixed_rows::<3>(0);
        let turn = frame.rotation * displacement.fixed_rows::<3>(3);
        let lever = self.tool.translation.vector - frame.translation.vector;
        let moved = shift + turn.cross(&lever);
        Vector6::new(moved.x, moved.y, moved.z, turn.x, turn.y, turn.z)
    }

    /// Twist of the tool per unit of a joint's motion: rad, or m if it is prismatic.
    pub fn twist_of_joint(&self, joint: usize) -> Vector6<f64> {
        self.carry(Site::Joint(joint), &Vector6::ith(axis(self.motions[joint]), 1.0))
    }

    /// Twist of the tool per unit of each joint's motion, 6×n, base axes.
    pub fn jacobian(&self) -> Matrix6xX<f64> {
        let columns: Vec<_> = (0..self.motions.len()).map(|j| self.twist_of_joint(j)).collect();
        Matrix6xX::from_columns(&columns)
    }

    /// Twist of the tool to first order when a force is added at a point (m, base frame) with a
    /// moment, base axes, that the sites before `up_to` carry: every spring, beam and law gives.
    pub fn yielding(
        &self,
        actual: &Actual<'_>,
        (force, moment, point): (&Vector3<f64>, &Vector3<f64>, &Vector3<f64>),
        up_to: Site,
    ) -> Vector6<f64> {
        let n = self.motions.len();
        let mut twist = Vector6::zeros();
        let at_site = |site: Site| {
            let frame = self.frame(site);
            let lever = point - frame.translation.vector;
            let (f, m) = (frame.rotation.inverse() * force, moment + lever.cross(force));
            let m = frame.rotation.inverse() * m;
            Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
        };
        let reached = |site: Site| self.index(site) <= self.index(up_to);
        for row in 0..n {
            let joint = &actual.arm.joints[row];
            let site = Site::Joint(row);
            if reached(site) && joint.compliance != 0.0 {
                twist += self.carry(site, &actual.spring(row, &at_site(site)));
            }
            let site = Site::Link(row);
            if reached(site) && joint.beam.is_some() {
                let (before, behind) = actual.row(row);
                if let Some(link) = actual.link(row, &(before * behind)) {
                    let gives = link.give(&at_site(site), &Vector3::zeros());
                    twist += self.carry(site, &gives);
                }
            }
        }
        for (site, law) in actual.laws.iter().filter(|(site, _)| reached(*site)) {
            // Laws need not be linear: the difference about the load there is, as small as the
            // change.
            let (at, change) = (self.borne(actual, *site), at_site(*site));
            let gives = (law(&(at + change * STEP)) - law(&(at - change * STEP))) / (2.0 * STEP);
            twist += self.carry(*site, &gives);
        }
        twist
    }

    /// What the laws of a site bear there.
    fn borne(&self, actual: &Actual<'_>, site: Site) -> Vector6<f64> {
        match site {
            Site::Joint(row) => actual.borne(row, self.load(site)),
            _ => *self.load(site),
        }
    }

    /// How far a joint gives per unit of a torque about it: rad/(N·m), of a prismatic one m/N.
    pub fn gives(&self, actual: &Actual<'_>, joint: usize) -> f64 {
        let (site, axis) = (Site::Joint(joint), axis(self.motions[joint]));
        let (at, change) = (self.borne(actual, site), Vector6::ith(axis, 1.0));
        let laws = actual.laws.iter().filter(|(of, _)| *of == site);
        let each = laws.map(|(_, law)| (law(&(at + change)) - law(&(at - change)))[axis] / 2.0);
        actual.arm.joints[joint].compliance + each.sum::<f64>()
    }

    /// Twist of the tool to first order as gravity changes by so much (base axes, m/s²): what the
    /// weights of the links do.
    pub fn weighed(&self, actual: &Actual<'_>, gravity: &Vector3<f64>) -> Vector6<f64> {
        let none = Vector3::zeros();
        let mut twist = Vector6::zeros();
        for (row, joint) in actual.arm.joints.iter().enumerate() {
            let site = Site::Link(row);
            let frame = self.frame(site);
            if joint.mass != 0.0 {
                let (weight, at) = (gravity * joint.mass, frame * Point3::from(joint.com));
                twist += self.yielding(actual, (&weight, &none, &at.coords), site);
            }
            let (before, behind) = actual.row(row);
            if let Some(link) = actual.link(row, &(before * behind)) {
                let (weight, at) = (link.weight(gravity), frame * Point3::from(link.middle()));
                twist += self.yielding(actual, (&weight, &none, &at.coords), Site::Joint(row));
                let own = frame.rotation.inverse() * weight;
                twist += self.carry(site, &link.give(&Vector6::zeros(), &own));
            }
        }
        twist
    }
}

/// Part of an added load by which a law is differentiated.
const STEP: f64 = 1e-3;
