//! What an effect sees of one row when it is linearised.

use nalgebra::{Isometry3, Matrix6xX, Vector3, Vector6};

use stiffarm_kernels::generic::Arm;

use super::Carrier;
use crate::measurement::Row;
use crate::simulate::{Actual, Moment, Site, State};

/// One state of the arm in one row.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The arm of the robot file.
    pub nominal: &'a Arm,
    /// The row.
    pub row: &'a Row,
    /// When it was measured.
    pub when: &'a Moment,
    /// The arm as it is in the row, with the wrench of this state (none if it is the unloaded one).
    pub actual: &'a Actual<'a>,
    /// The arm at rest.
    pub state: &'a State,
    /// The measured point, base frame, m.
    pub point: Vector3<f64>,
    /// Where the base stands in the measuring frame.
    pub base: &'a Isometry3<f64>,
}

impl Scene<'_> {
    /// Columns of the twists that displacements of one site cause, each given in the site's axes.
    pub fn carried(&self, site: Site, displacements: &[Vector6<f64>]) -> Matrix6xX<f64> {
        let columns: Vec<_> = displacements.iter().map(|d| self.state.carry(site, d)).collect();
        Matrix6xX::from_columns(&columns)
    }

    /// The twists that motions of a carrier cause, all its columns for each motion; none without
    /// one.
    pub fn moved(&self, carrier: Option<Carrier>, motions: &[f64]) -> Matrix6xX<f64> {
        let Some(carrier) = carrier else { return Matrix6xX::zeros(0) };
        let size = carrier.size();
        let twists = carrier.twists(self.state);
        Matrix6xX::from_fn(size * motions.len(), |row, column| {
            twists[(row, column % size)] * motions[column / size]
        })
    }

    /// Force on the tool, base axes, N.
    pub fn force(&self) -> Vector3<f64> {
        self.actual.wrench.fixed_rows::<3>(0).into_owned()
    }

    /// Moment on the tool, base axes, N·m.
    pub fn moment(&self) -> Vector3<f64> {
        self.actual.wrench.fixed_rows::<3>(3).into_owned()
    }

    /// Direction from which a joint came to rest; 0 where it is not known.
    pub fn direction(&self, joint: usize) -> f64 {
        direction(self.row, joint)
    }
}

/// Direction from which a joint came to rest; 0 where it is not known.
pub(super) fn direction(row: &Row, joint: usize) -> f64 {
    row.direction.as_ref().map_or(0.0, |all| f64::from(all[joint]))
}
