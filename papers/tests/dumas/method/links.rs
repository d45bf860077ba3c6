//! What is the links' and not the joints' (Dumas et al., section 5.3: links 2 and 3 make up to 21 %
//! and 4.8 % of the displacement).
//!
//! Bending of a link in the plane of two joints that carry its ends looks like springs at these
//! joints: for parallel axes it is exactly the compliance block `L/6EI [[2, 1], [1, 2]]`.

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use super::system::links_only;

/// One link's part of a displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Row of the table whose beam it is, from 1.
    pub row: usize,
    /// Twist of the tool by this beam only, m and rad.
    pub twist: Vector6<f64>,
    /// Size of its translation over that of the whole arm's; 0 if nothing moves.
    pub part: f64,
}

/// What each beam of the arm adds to the displacement under the wrench `w`, to first order.
pub fn shares(arm: &Arm, q: &[f64], w: &Vector6<f64>) -> Vec<Share> {
    let whole = arm.deflection_first_order(q, w).fixed_rows::<3>(0).norm();
    let share = |row: usize| {
        let mut only = links_only(arm);
        for (_, joint) in only.joints.iter_mut().enumerate().filter(|(other, _)| *other != row) {
            joint.beam = None;
        }
        let twist = only.deflection_first_order(q, w);
        let size = twist.fixed_rows::<3>(0).norm();
        Share { row: row + 1, twist, part: if whole > 0.0 { size / whole } else { 0.0 } }
    };
    (0..arm.dof()).filter(|&row| arm.joints[row].beam.is_some()).map(share).collect()
}
