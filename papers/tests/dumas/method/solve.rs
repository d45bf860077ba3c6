//! Least squares over the stacked system (Dumas et al., eqs. 25-26).

use nalgebra::DVector;
use stiffarm_kernels::generic::Arm;

use super::{IdentifyError, System, Test, Weighting};

/// Singular values of the scaled columns below this part of the largest are not determined.
const UNDETERMINED: f64 = 1e-8;

/// A component of a null direction below this does not belong to it.
const BELONGS: f64 = 1e-4;

/// What the tests say.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// Of each joint, rad/(N·m) or m/N; negative if the tests say so.
    pub compliances: DVector<f64>,
    /// Condition number of B, weighted.
    pub condition: f64,
    /// Condition number of B with its columns brought to length 1.
    pub scaled_condition: f64,
}

impl Identified {
    /// Of each joint, N·m/rad or N/m; none if a compliance is not positive.
    pub fn stiffnesses(&self) -> Option<Vec<f64>> {
        self.compliances.iter().map(|c| (*c > 0.0).then(|| 1.0 / c)).collect()
    }

    /// The arm with these compliances; one that is not positive becomes rigid.
    pub fn applied_to(&self, arm: &Arm) -> Arm {
        let mut soft = arm.clone();
        for (joint, compliance) in soft.joints.iter_mut().zip(&self.compliances) {
            joint.compliance = compliance.max(0.0);
        }
        soft
    }
}

/// The compliances that make `|B x − c|²` least, by singular values of the columns, each brought to
/// length one. How sure they are, and which pull would show a joint that is refused, says
/// [`measured`](stiffarm_gap::identify::measured).
///
/// # Errors
/// [`IdentifyError::Open`] names every joint that the tests leave open; otherwise as
/// [`System::stack`].
pub fn identify(arm: &Arm, tests: &[Test], by: &Weighting) -> Result<Identified, IdentifyError> {
    let system = System::stack(arm, tests, by)?;
    let n = system.b.ncols();
    let scale = DVector::from_fn(n, |j, _| match system.empty[j] {
        true => 0.0,
        false => 1.0 / system.b.column(j).norm(),
    });
    let mut scaled = system.b.clone();
    for (mut column, factor) in scaled.column_iter_mut().zip(&scale) {
        column *= *factor;
    }
    let rows = scaled.nrows().max(n);
    let svd = scaled.resize_vertically(rows, 0.0).svd(true, true);
    let (least, most) = (svd.singular_values.min(), svd.singular_values.max());
    let null = |k: &usize| most <= 0.0 || svd.singular_values[*k] <= UNDETERMINED * most;
    let moves = |j: usize, k: usize| svd.v_t.as_ref().is_none_or(|v| v[(k, j)].abs() > BELONGS);
    let open = |j: &usize| system.empty[*j] || (0..n).filter(null).any(|k| moves(*j, k));
    let open: Vec<usize> = (0..n).filter(open).map(|j| j + 1).collect();
    if !open.is_empty() {
        return Err(IdentifyError::Open(open));
    }
    let right = system.c.clone().resize_vertically(rows, 0.0);
    // Both sides of the decomposition were asked for.
    let x = svd.solve(&right, 0.0).unwrap_or_else(|_| DVector::zeros(n));
    let values = system.b.singular_values();
    Ok(Identified {
        compliances: x.component_mul(&scale),
        condition: values.max() / values.min(),
        scaled_condition: most / least,
    })
}

/// `(Bᵀ B)⁻¹ Bᵀ c` as it is printed (eq. 26), which squares the condition number; none if the tests
/// leave a joint open.
pub fn normal_equations(system: &System) -> Option<DVector<f64>> {
    let inverse = system.b.tr_mul(&system.b).try_inverse()?;
    Some(inverse * system.b.tr_mul(&system.c))
}
