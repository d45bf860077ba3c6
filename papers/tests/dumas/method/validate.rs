//! Prediction of tests, best of those that were not used (Dumas et al., section 5.3, Figs. 9-12).

use nalgebra::Vector6;
use stiffarm_kernels::generic::Arm;

use super::{IdentifyError, Test};

/// One test predicted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// As measured.
    pub measured: Vector6<f64>,
    /// By the model, K_C in it.
    pub predicted: Vector6<f64>,
    /// Distance of the two displacements, m.
    pub position_gap: f64,
    /// `position_gap` as a part of the measured displacement; none without a displacement.
    pub unexplained: Option<f64>,
}

/// All tests predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct Validation {
    /// In the order of the tests.
    pub tests: Vec<Checked>,
    /// Mean of the position gaps, m.
    pub mean_position_gap: f64,
    /// Largest, m.
    pub max_position_gap: f64,
    /// Mean unexplained part of the displacement.
    pub mean_unexplained: f64,
    /// Largest.
    pub max_unexplained: f64,
}

/// Compares tests with what the arm's own compliances (and beams) predict, the complementary
/// stiffness taken into account.
///
/// # Errors
/// [`IdentifyError::Unstable`].
pub fn validate(arm: &Arm, tests: &[Test]) -> Result<Validation, IdentifyError> {
    let mut checked = Vec::with_capacity(tests.len());
    for test in tests {
        let predicted = arm.deflection(&test.q, &test.wrench)?;
        let gap = test.displacement - predicted;
        let size = test.displacement.fixed_rows::<3>(0).norm();
        let position_gap = gap.fixed_rows::<3>(0).norm();
        checked.push(Checked {
            measured: test.displacement,
            predicted,
            position_gap,
            unexplained: (size > 0.0).then(|| position_gap / size),
        });
    }
    let mean = |value: &dyn Fn(&Checked) -> f64| {
        checked.iter().map(value).sum::<f64>() / checked.len() as f64
    };
    let most = |value: &dyn Fn(&Checked) -> f64| checked.iter().map(value).fold(0.0, f64::max);
    let unexplained = |c: &Checked| c.unexplained.unwrap_or(0.0);
    Ok(Validation {
        mean_position_gap: mean(&|c| c.position_gap),
        max_position_gap: most(&|c| c.position_gap),
        mean_unexplained: mean(&unexplained),
        max_unexplained: most(&unexplained),
        tests: checked,
    })
}
