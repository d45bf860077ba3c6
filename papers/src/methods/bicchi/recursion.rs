//! The wrench recursion of eqs. 16 to 19: loads come down the chain from the tip to the base, and
//! each link answers with its displacement as they pass.
//!
//! ```text
//! (17)  w_{i−1} = K_i w_i
//! (18)  ᴮw = K_1 K_2 … K_n ᴱw
//! (19)  K_i = K_kin(q_i) K_joint(τ_i) K_flex(w_i) = K(A_i(q_i + k_c τ_i)) K(D_i)
//! ```
//!
//! `D_i = C_i w_i` is what the link's tip does under the wrench there, in the axes of the displaced
//! tip, so that nothing is iterated where the wrench at the tool is known in the tool's own axes. The
//! printed elements are corrected: `p_kin` and `K_joint` are those of a row of the table, which the
//! printed ones are for α = 0 only; the flexibility of eq. 5 has `L/EA`, `L/GJ` and `L/EJ` on its
//! diagonal.
//!
//! Bending is small in each single link (its tip's error is about 0.4 φ of its deflection at a tip
//! slope φ), while the frames turn as far as they like. The links' own weights are left out.

use nalgebra::{Isometry3, Matrix6, Matrix6xX, Vector3, Vector6};
use stiffarm_gap::displacement::Displacement;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_study::dexterity::check_posture;

use super::ForceError;
use crate::methods::transport::wrench_matrix;

/// An elastic arm at rest under a wrench that turns with its tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The displaced frames in the base frame, m: the base's, one behind each row, the tool's.
    pub frames: Vec<Isometry3<f64>>,
    /// The wrench in each of them, N and N·m.
    pub wrenches: Vec<Vector6<f64>>,
    /// What loads each joint, N·m, positive like its motion: τ.
    pub joint_loads: Vec<f64>,
}

/// One row of an arm's table as an arm of one rigid, weightless joint, its link kept.
fn row(arm: &Arm, index: usize) -> Arm {
    let mut joint = arm.joints[index].clone();
    (joint.compliance, joint.mass) = (0.0, 0.0);
    Arm { convention: arm.convention, joints: vec![joint], ..Arm::default() }
}

impl Loaded {
    /// The arm at the joint values `q` under the wrench `tip`, in the axes of the displaced tool at
    /// its origin, N and N·m.
    ///
    /// # Errors
    /// [`ForceError::Table`] unless the table is a standard one of revolute joints;
    /// [`ForceError::Posture`], [`ForceError::NotFinite`].
    pub fn new(arm: &Arm, q: &[f64], tip: &Vector6<f64>) -> Result<Self, ForceError> {
        check_posture(arm, q)?;
        if arm.convention != Convention::Standard
            || arm.joints.iter().any(|joint| joint.motion != Motion::Revolute)
        {
            return Err(ForceError::Table);
        }
        let mut wrench = wrench_matrix(&arm.tool) * tip;
        let (mut wrenches, mut joint_loads) = (vec![*tip, wrench], Vec::new());
        let mut steps = vec![arm.tool];
        for index in (0..arm.dof()).rev() {
            let single = row(arm, index);
            let nominal = single.pose(&[q[index]]);
            let mut turn = nominal.inverse();
            turn.translation.vector = Vector3::zeros();
            let turn = wrench_matrix(&turn);
            let flexibility: Matrix6<f64> =
                turn * single.compliance(&[q[index]]) * turn.transpose();
            let bent = Displacement::new(&(flexibility * wrench)).transform();
            // τ does not depend on how far the joint itself turns.
            let load = (wrench_matrix(&(nominal * bent)) * wrench)[5];
            let turned = single.pose(&[q[index] + arm.joints[index].compliance * load]);
            steps.push(turned * bent);
            wrench = wrench_matrix(&(turned * bent)) * wrench;
            wrenches.push(wrench);
            joint_loads.push(load);
        }
        if !wrench.iter().all(|value| value.is_finite()) {
            return Err(ForceError::NotFinite { what: "a component of the wrench in the base" });
        }
        wrenches.reverse();
        joint_loads.reverse();
        let mut frames = vec![Isometry3::identity()];
        for step in steps.iter().rev() {
            frames.push(frames[frames.len() - 1] * step);
        }
        Ok(Self { frames, wrenches, joint_loads })
    }

    /// The displaced tool frame in the base frame, m.
    pub fn pose(&self) -> Isometry3<f64> {
        self.frames[self.frames.len() - 1]
    }

    /// `ᴮw = ᴮK_E ᴱw`: the tool's wrench in base axes about the base's origin, N and N·m.
    pub fn base_wrench(&self) -> Vector6<f64> {
        self.wrenches[0]
    }

    /// G as the paper has it, 6×n: the deformations of all links stay as they are while one joint
    /// turns (its T_i, with the product from j = 1 and `∂K_{i,kin}/∂q_i`). A joint turns the wrench
    /// behind it about z of the displaced frame before it: `z × f` over `z × m` there. Exact in
    /// column 1.
    pub fn gradient(&self) -> Matrix6xX<f64> {
        let z = Vector3::z();
        let column = |joint: usize| {
            let w = &self.wrenches[joint];
            let force = z.cross(&w.fixed_rows::<3>(0));
            let moment = z.cross(&w.fixed_rows::<3>(3));
            let turned = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
            wrench_matrix(&self.frames[joint]) * turned
        };
        let columns: Vec<_> = (0..self.joint_loads.len()).map(column).collect();
        // There may be none.
        Matrix6xX::from_fn(columns.len(), |row, joint| columns[joint][row])
    }
}
