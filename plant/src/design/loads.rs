//! Loads.

use nalgebra::{Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::super::reality::Reality;
use super::super::transform::{rotation, slide};
use super::{Design, Shape, rounded};
use crate::rng::{Rng, Stream};

/// Gravity where the robot file has none, m/s².
const STANDARD: f64 = 9.80665;

/// The loads of each posture, in the order in which they are measured.
pub(super) fn draw(arm: &Arm, design: &Design, poses: &[Vec<f64>]) -> Vec<Vec<Vector6<f64>>> {
    let mut rng = Rng::new(design.seed, Stream::Loads);
    // The payload's centre of mass in the tool frame, well within a hand's breadth.
    let centre = Vector3::new(rng.between(-0.05, 0.05), rng.between(-0.05, 0.05), 0.08);
    let of = |q: &Vec<f64>| {
        let mut loads = match design.shape {
            Shape::Force => forces(design, &mut rng),
            _ => payloads(arm, design, q, &centre),
        };
        // Without a load there is nothing to see of a displacement.
        if design.kind.is_difference() {
            loads.retain(|load| *load != Vector6::zeros());
        }
        rng.shuffle(&mut loads);
        loads
    };
    poses.iter().map(of).collect()
}

/// No, half and full payload. Its moment is that of its place at the posture as the robot file has
/// it.
fn payloads(arm: &Arm, design: &Design, q: &[f64], centre: &Vector3<f64>) -> Vec<Vector6<f64>> {
    let lever = rotation(&Reality::nominal(arm).tool_at(q)) * centre;
    let down = if arm.gravity == Vector3::zeros() {
        Vector3::new(0.0, 0.0, -STANDARD)
    } else {
        arm.gravity
    };
    let weight = |mass: f64| {
        let force = mass * down;
        whole(&force, &lever.cross(&force))
    };
    [0.0, 0.5, 1.0].map(|part| weight(part * design.payload)).to_vec()
}

/// No load and three forces of half to full size, with a moment of a tenth of a metre's lever.
fn forces(design: &Design, rng: &mut Rng) -> Vec<Vector6<f64>> {
    let full = design.payload * STANDARD;
    let mut loads = vec![Vector6::zeros()];
    for _ in 0..3 {
        let force = full * rng.between(0.5, 1.0) * rng.direction();
        let moment = 0.1 * full * rng.unit() * rng.direction();
        loads.push(whole(&force, &moment));
    }
    loads
}

fn whole(force: &Vector3<f64>, moment: &Vector3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|k, _| rounded(if k < 3 { force[k] } else { moment[k - 3] }, 1e3))
}

impl Reality {
    /// The tool frame of the rigid arm.
    pub(super) fn tool_at(&self, q: &[f64]) -> nalgebra::Matrix4<f64> {
        let situation = super::super::assemble::Situation {
            values: q.to_vec(),
            directions: vec![0.0; q.len()],
            growth: 1.0,
            tool_frame: Vector6::zeros(),
            wrench: Vector6::zeros(),
        };
        let chain = self.chain(&situation, &slide(0, 0.0));
        chain.shape(&vec![0.0; chain.unknowns]).tool
    }
}
