//! Whose axes loads and gravity are told in.

use nalgebra::{Isometry3, Vector3, Vector6};

use crate::simulate::{Actual, rotation, translation};

/// Whose axes the loads of the rows and gravity are told in.
///
/// A robot file tells gravity in the arm's, and loads are told there where a cell in the wrist takes them. Weights hang
/// as a levelled tracker's frame does, whichever way the arm's base leans in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// The arm's base.
    Arm,
    /// The measuring frame, whose −z is down.
    Measuring,
}

impl Axes {
    /// Gravity in the arm's axes, where its base stands so; `own` is the robot file's.
    pub(crate) fn gravity(self, base: &Isometry3<f64>, own: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Axes::Arm => *own,
            Axes::Measuring => base.rotation.inverse() * (-Vector3::z() * own.norm()),
        }
    }

    /// Tells load and gravity in the arm's axes, of which all else knows.
    pub(super) fn tell(self, actual: &mut Actual<'_>) {
        if self == Axes::Arm {
            return;
        }
        let gravity = self.gravity(&actual.base, &actual.arm.gravity);
        actual.arm.to_mut().gravity = gravity;
        let back = actual.base.rotation.inverse();
        let (force, moment) = (translation(&actual.wrench), rotation(&actual.wrench));
        let (force, moment) = (back * force, back * moment);
        actual.wrench = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
    }
}
