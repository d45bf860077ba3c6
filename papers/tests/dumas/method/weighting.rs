//! How much each row of `B x = c` counts: by the noise of the instrument.

use core::f64::consts::SQRT_2;

use nalgebra::{Matrix3, Matrix6, Vector3};
use stiffarm_kernels::generic::Arm;

use super::IdentifyError;

/// Factors on the six rows of a test.
#[derive(Clone, Debug, PartialEq)]
pub enum Weighting {
    /// One factor on the three translations, 1/m, and one on the three rotations, 1/rad; 0 leaves
    /// rows out.
    Rows {
        /// On translations.
        translation: f64,
        /// On rotations.
        rotation: f64,
    },
    /// The displacement was fitted to points that were each measured before and after with
    /// independent noise: whitened by the information that the points hold, rotations and
    /// translations together.
    Points {
        /// In the tool frame, m; at least three, not on a line.
        points: Vec<Vector3<f64>>,
        /// Standard deviation of one coordinate of one point, m.
        sigma: f64,
    },
}

impl Weighting {
    /// Rows in metres and radians as they stand (Dumas et al., eq. 26).
    pub const SI: Weighting = Weighting::Rows { translation: 1.0, rotation: 1.0 };

    /// By the noise of the paper's three-point pose: `√2 σ` of a translation (the origin, before
    /// and after), `2 σ/s` of a rotation; `sigma` of one coordinate, m, and `side` of the
    /// right-angled triangle, m.
    pub fn triangle(sigma: f64, side: f64) -> Weighting {
        Weighting::Rows { translation: 1.0 / (SQRT_2 * sigma), rotation: side / (2.0 * sigma) }
    }

    /// Rows in metres and degrees: rotations count 57 times more.
    pub fn metres_and_degrees() -> Weighting {
        Weighting::Rows { translation: 1.0, rotation: 1.0_f64.to_degrees() }
    }

    /// Without rotations.
    pub const TRANSLATIONS: Weighting = Weighting::Rows { translation: 1.0, rotation: 0.0 };

    /// Without translations.
    pub const ROTATIONS: Weighting = Weighting::Rows { translation: 0.0, rotation: 1.0 };

    /// The matrix that multiplies a test's rows, 6×6.
    pub(super) fn matrix(&self, arm: &Arm, q: &[f64]) -> Result<Matrix6<f64>, IdentifyError> {
        match self {
            Weighting::Rows { translation, rotation } => {
                let (t, r) = (*translation, *rotation);
                Ok(Matrix6::from_diagonal(&nalgebra::Vector6::new(t, t, t, r, r, r)))
            }
            Weighting::Points { points, sigma } => {
                let tool = arm.pose(q).rotation;
                let mut information = Matrix6::zeros();
                for point in points {
                    // Displacement of the point by a twist of the tool: d + δ × r.
                    let mut moves = nalgebra::Matrix3x6::zeros();
                    moves.fixed_columns_mut::<3>(0).copy_from(&Matrix3::identity());
                    moves.fixed_columns_mut::<3>(3).copy_from(&-(tool * point).cross_matrix());
                    information += moves.transpose() * moves / (2.0 * sigma * sigma);
                }
                let root = information.cholesky().ok_or(IdentifyError::Collinear)?;
                Ok(root.l().transpose())
            }
        }
    }
}
