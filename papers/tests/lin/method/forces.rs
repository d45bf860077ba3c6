//! The tool's load and the distributed weights of the links at every joint (eq. 8).

use nalgebra::{Isometry3, Translation3, Vector3, Vector6};
use stiffarm_gap::displacement::Displacement;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Arm;

use super::{orientation_jacobian, pose_jacobian};

/// What pulls on an arm at one posture: the tool's load and the links' weights.
pub(super) struct Pulls {
    pub(super) frames: Vec<Isometry3<f64>>,
    pub(super) tool: Isometry3<f64>,
    /// The tool's load in tool axes, at its origin.
    load: Vector6<f64>,
    weights: Vec<Weight>,
}

/// The weight of one link, or of the mass fixed in its frame.
struct Weight {
    /// Row of the table, from 1.
    row: usize,
    /// Whether it is the beam's own, which hangs before the link's tip.
    spread: bool,
    /// The axes of frame `row` at the centroid.
    centroid: Isometry3<f64>,
    /// `ᵏW_ck`: in those axes, at the centroid.
    wrench: Vector6<f64>,
}

impl Weight {
    fn new(
        row: usize,
        spread: bool,
        frame: &Isometry3<f64>,
        at: Vector3<f64>,
        f: Vector3<f64>,
    ) -> Self {
        let centroid = Isometry3::from_parts(Translation3::from(at), frame.rotation);
        let force = Displacement { translation: f, rotation: Vector3::zeros() }.vector();
        Self { row, spread, centroid, wrench: orientation_jacobian(frame).tr_mul(&force) }
    }
}

impl Pulls {
    pub(super) fn new(arm: &Arm, q: &[f64], load: &Vector6<f64>) -> Self {
        let (frames, tool) = (arm.frames(q), arm.pose(q));
        let mut weights = Vec::new();
        for (k, joint) in arm.joints.iter().enumerate() {
            let (before, own) = (frames[k].translation.vector, &frames[k + 1]);
            let tip = own.translation.vector;
            let centre = tip + own.rotation * joint.com;
            weights.push(Weight::new(k + 1, false, own, centre, arm.gravity * joint.mass));
            // The beam of a prismatic joint counts as weightless.
            if let (Some(beam), Motion::Revolute) = (&joint.beam, joint.motion) {
                let force = arm.gravity * (beam.density * beam.area * (tip - before).norm());
                weights.push(Weight::new(k + 1, true, own, (before + tip) / 2.0, force));
            }
        }
        let load = orientation_jacobian(&tool).tr_mul(load);
        Self { frames, tool, load, weights }
    }

    /// Everything that `counts` and the tool's load in `frame`, about its origin.
    fn reduced(&self, frame: &Isometry3<f64>, counts: impl Fn(&Weight) -> bool) -> Vector6<f64> {
        let back = frame.inverse();
        let tool = pose_jacobian(&(back * self.tool)).tr_mul(&self.load);
        let weights = self
            .weights
            .iter()
            .filter(|weight| counts(weight))
            .map(|weight| pose_jacobian(&(back * weight.centroid)).tr_mul(&weight.wrench));
        tool + weights.sum::<Vector6<f64>>()
    }

    /// `ⁱ⁻¹F_i` of row i, from 1.
    fn at_joint(&self, row: usize) -> Vector6<f64> {
        self.reduced(&self.frames[row - 1], |weight| weight.row >= row)
    }

    /// What loads the tip of link `row` besides its own spread weight, in the axes of frame
    /// `row − 1`, at the tip.
    pub(super) fn at_tip(&self, row: usize) -> Vector6<f64> {
        let tip = self.frames[row].translation;
        let frame = Isometry3::from_parts(tip, self.frames[row - 1].rotation);
        self.reduced(&frame, |weight| weight.row > row || (weight.row == row && !weight.spread))
    }
}

/// `ⁱ⁻¹F_i` of eq. 8 for each row i: the generalized force of the tool's load and of the weights of
/// links i to n at the origin of frame i−1, in its axes. `load` is in base axes at the tool origin.
///
/// A link's weight is its beam's, at the middle of the beam, and the row's mass at its centre. In a
/// standard table the last component is the moment about the axis of joint i.
pub fn generalized_forces(arm: &Arm, q: &[f64], load: &Vector6<f64>) -> Vec<Vector6<f64>> {
    let pulls = Pulls::new(arm, q, load);
    (1..=arm.dof()).map(|row| pulls.at_joint(row)).collect()
}
