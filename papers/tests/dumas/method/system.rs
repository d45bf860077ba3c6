//! The stacked system `B x = c` (Dumas et al., eqs. 20-24), weighted.

use nalgebra::{DMatrix, DVector};
use stiffarm_kernels::generic::Arm;

use super::{IdentifyError, Test, Weighting};

/// A column below this part of what the load could have given is rounding.
const ROUNDING: f64 = 1e-9;

/// `B x = c` of some tests, rows weighted.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// 6t×n for t tests; column j is what a compliance of joint j of 1 rad/(N·m) gives.
    pub b: DMatrix<f64>,
    /// 6t; the measured displacements less what the model's links give.
    pub c: DVector<f64>,
    /// Columns that hold nothing but rounding.
    pub empty: Vec<bool>,
}

impl System {
    /// Stacks the tests. Unknown are the compliances of all joints, whatever the model has for
    /// them; beams of the model are taken as known and their part of the displacement is
    /// subtracted.
    ///
    /// # Errors
    /// Those of the weights.
    pub fn stack(arm: &Arm, tests: &[Test], by: &Weighting) -> Result<System, IdentifyError> {
        let n = arm.dof();
        let links = links_only(arm);
        let mut b = DMatrix::zeros(6 * tests.len(), n);
        let mut c = DVector::zeros(6 * tests.len());
        let mut possible: f64 = 0.0;
        for (k, test) in tests.iter().enumerate() {
            let weights = by.matrix(arm, &test.q)?;
            let block = weights * arm.compliance_regressor(&test.q, &test.wrench);
            b.rows_mut(6 * k, 6).copy_from(&block);
            let bend = links.deflection_first_order(&test.q, &test.wrench);
            let moved = weights * (test.displacement - bend);
            c.rows_mut(6 * k, 6).copy_from(&moved);
            // With every lever as long as the longest and every axis along the load.
            let jacobian = arm.jacobian(&test.q);
            let reach = jacobian.fixed_rows::<3>(0).amax();
            let force = test.wrench.fixed_rows::<3>(0).norm();
            let moment = test.wrench.fixed_rows::<3>(3).norm();
            let (t, r) = (weights.fixed_columns::<3>(0), weights.fixed_columns::<3>(3));
            possible += ((t.norm() * reach + r.norm()) * (force * reach + moment)).powi(2);
        }
        let floor = ROUNDING * possible.sqrt();
        let empty = b.column_iter().map(|column| column.norm() <= floor).collect();
        Ok(System { b, c, empty })
    }
}

/// The arm with its joints rigid.
pub(super) fn links_only(arm: &Arm) -> Arm {
    let mut links = arm.clone();
    links.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    links
}
