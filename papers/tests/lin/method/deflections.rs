//! What bending links do to the tool: YT, YC and YD of any table.
//!
//! Every link k is clamped at the origin of frame k−1 and loaded by all that hangs beyond its tip
//! and by its own spread weight; its tip moves by `d_k` and turns by `φ_k` (base axes). With p the
//! tool origin and p_k the tip of link k, Lin, Chiang & Cui combine these three ways:
//!
//! ```text
//! YT = Σ d_k                      each link's own deflection, turned to base axes (eqs. 24-29)
//! YC = Σ d_k + φ_k × (p − p_k)    Castigliano's theorem for the clamped chain (eqs. 30-32)
//! YD = J dθ,  dθ_i = z_i · Σ φ_k  over the links k that joint i moves (eqs. 33-36, 42-46)
//! ```
//!
//! YC is exact for beams that bend little: it is the whole deflection of an arm with rigid joints.
//! YT leaves out that a link's tip turns all that is beyond it; YD lets every joint turn by what
//! the links beyond it turn. So YD contains YC − YT, and beyond it turns that a clamped elastic
//! chain does not make: `YT + YD` counts the slopes of the beams more than once. For the two-link
//! arm `YC = YT + A L2 C12/E1I1`, and `YT + YD = YC + A L1 C1/E1I1 + B (L1 C1 + 2 L2 C12)/E2I2`.

use nalgebra::{DVector, Isometry3, Vector3, Vector6};
use stiffarm_gap::displacement::Displacement;
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_kernels::{Motion, Unstable};

use super::forces::Pulls;
use super::orientation_jacobian;

/// What one link does, base axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkDeflection {
    /// Row of the table, from 1.
    pub row: usize,
    /// Where its tip is: the origin of frame `row`.
    pub tip: Vector3<f64>,
    /// Displacement and rotation of its tip, the other end clamped, at the tip.
    pub twist: Vector6<f64>,
}

/// The deflection of the tool by the links, at the tool origin, base axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Deflections {
    /// Each row that has a beam, base to tip.
    pub links: Vec<LinkDeflection>,
    /// YT: the sum of the links' own deflections (eqs. 26-29, with eq. 28 corrected).
    pub timoshenko: Vector6<f64>,
    /// YC: the exact deflection of the clamped chain (eqs. 30-32).
    pub castigliano: Vector6<f64>,
    /// dθ: the angular deflection of each joint by eqs. 33-36, rad; 0 for a prismatic joint.
    pub joint_angles: DVector<f64>,
    /// YD: what these angles do to the tool (eqs. 42-46).
    pub angular: Vector6<f64>,
}

impl Deflections {
    /// YC − YT: what the links' slopes do to the tool through the levers beyond them. In the
    /// two-link arm its y is `A L2 C12/E1I1`.
    pub fn carried(&self) -> Vector6<f64> {
        self.castigliano - self.timoshenko
    }

    /// YTD = YT + YD, the paper's total (eq. 47).
    pub fn timoshenko_total(&self) -> Vector6<f64> {
        self.timoshenko + self.angular
    }

    /// What YTD has beyond the clamped elastic chain, YTD − YC: slopes of beams counted again.
    pub fn counted_again(&self) -> Vector6<f64> {
        self.timoshenko_total() - self.castigliano
    }
}

/// YT, YC and YD of an arm under the tool's `load` (base axes, at the tool origin) and all weights.
/// Joint springs do not give way here.
///
/// # Errors
/// [`Unstable`], never for joints that are rigid.
pub fn deflections(arm: &Arm, q: &[f64], load: &Vector6<f64>) -> Result<Deflections, Unstable> {
    let pulls = Pulls::new(arm, q, load);
    let tool = pulls.tool.translation.vector;
    let with_beam = (1..=arm.dof()).filter(|row| arm.joints[row - 1].beam.is_some());
    let links: Vec<_> =
        with_beam.map(|row| link(arm, row, q[row - 1], &pulls)).collect::<Result<_, _>>()?;
    let timoshenko = links.iter().map(|link| link.twist).sum();
    let castigliano = links.iter().map(|link| at_tool(link, &tool)).sum();
    let jacobian = arm.jacobian(q);
    let turn = |joint: usize| {
        let first = match arm.convention {
            Convention::Standard => joint + 1,
            Convention::Modified => joint + 2,
        };
        let slopes = links.iter().filter(|link| link.row >= first).map(|link| slope(&link.twist));
        let axis = match arm.joints[joint].motion {
            Motion::Revolute => slope(&jacobian.column(joint).into_owned()),
            Motion::Prismatic => Vector3::zeros(),
        };
        axis.dot(&slopes.sum())
    };
    let joint_angles = DVector::from_fn(arm.dof(), |joint, _| turn(joint));
    let angular = &jacobian * &joint_angles;
    Ok(Deflections { links, timoshenko, castigliano, joint_angles, angular })
}

fn slope(twist: &Vector6<f64>) -> Vector3<f64> {
    Displacement::new(twist).rotation
}

/// A tip's twist as the tool follows it.
fn at_tool(link: &LinkDeflection, tool: &Vector3<f64>) -> Vector6<f64> {
    let Displacement { translation, rotation } = Displacement::new(&link.twist);
    let translation = translation + rotation.cross(&(tool - link.tip));
    Displacement { translation, rotation }.vector()
}

/// One link as an arm of its own: clamped in frame `row − 1`, in whose axes everything is.
fn link(arm: &Arm, row: usize, q: f64, pulls: &Pulls) -> Result<LinkDeflection, Unstable> {
    let before = &pulls.frames[row - 1];
    let mut joint = arm.joints[row - 1].clone();
    (joint.compliance, joint.mass) = (0.0, 0.0);
    let single = Arm {
        name: String::new(),
        convention: arm.convention,
        joints: vec![joint],
        base: Isometry3::identity(),
        tool: Isometry3::identity(),
        tool_rotation_vector: Vector3::zeros(),
        gravity: before.rotation.inverse() * arm.gravity,
    };
    let bent = single.deflection_with_gravity(&[q], &pulls.at_tip(row))?;
    let twist = orientation_jacobian(before) * bent;
    Ok(LinkDeflection { row, tip: pulls.frames[row].translation.vector, twist })
}
