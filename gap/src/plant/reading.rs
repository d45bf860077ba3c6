//! From what the controller reads to where the joints really are, before anything yields.

use stiffarm_kernels::Motion;

use super::laws::Order;
use super::reality::{RealJoint, Reality};
use crate::measurement::Row;

impl Reality {
    /// Real joint values, rad (m if prismatic), of a row and the one before it.
    pub(super) fn joint_values(&self, row: &Row, before: Option<&Row>) -> Vec<f64> {
        let one = |(j, joint): (usize, &RealJoint)| {
            let reading = row.q[j];
            let coupled: f64 = joint.couplings.iter().map(|(other, c)| c * row.q[*other]).sum();
            let moved = before.map_or(0.0, |b| reading - b.q[j]);
            let side = direction(row, j);
            reading + joint.offset + joint.ratio * reading + joint.transmission(reading) + coupled
                - joint.lag * moved
                - side * joint.width / 2.0
        };
        self.joints.iter().enumerate().map(one).collect()
    }
}

/// The direction from which a joint came to rest; 0 where the row does not say.
pub(super) fn direction(row: &Row, joint: usize) -> f64 {
    row.direction.as_ref().map_or(0.0, |s| f64::from(s[joint]))
}

impl RealJoint {
    fn transmission(&self, reading: f64) -> f64 {
        if self.motion == Motion::Prismatic {
            return 0.0;
        }
        let term = |(order, amplitude): &(Order, f64)| match order {
            Order::Cos(k) => amplitude * (*k as f64 * reading).cos(),
            Order::Sin(k) => amplitude * (*k as f64 * reading).sin(),
        };
        self.orders.iter().map(term).sum()
    }
}
