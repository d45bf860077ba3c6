//! How well the numbers of a fit are known, and what is left of the readings beside them.

use nalgebra::{DMatrix, Vector6};

use crate::diagnose::fit::{Basis, Model, squares};
use crate::diagnose::search::{Explained, Search};

/// How well the numbers that were fitted are known.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spread {
    /// `S` with `S Sᵀ` the covariance of what was fitted: frames (of the
    /// first session), then effects; no points.
    pub(super) root: DMatrix<f64>,
    /// Variance that is left of each measured number, m² and rad²; 0 of those not measured.
    pub(super) left: Vector6<f64>,
}

impl Search<'_, '_> {
    /// Of the numbers of a fit.
    pub(crate) fn spread(&self, now: &Explained) -> Spread {
        let normal = self.normal(now);
        let left = squares(&now.fit.predicted.gaps, &now.weights);
        let variance = self.scale(now).variance(left, normal.nrows());
        let root = Basis::new(&normal).t * variance.sqrt();
        // Elsewhere an arm stands in the frame of one session, and is seen from nowhere in particular.
        let frames = self.problem.frames().enumerate();
        let one = frames.filter(|(_, (_, session))| *session == 0);
        let mut kept: Vec<usize> = one.flat_map(|(k, _)| 6 * k..6 * k + 6).collect();
        kept.extend(Model::nuisances(self.problem)..root.nrows());
        Spread {
            root: root.select_rows(&kept),
            left: now.weights.map(|w| if w > 0.0 { variance / (w * w) } else { 0.0 }),
        }
    }
}
