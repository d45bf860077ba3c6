//! From what the controller reads to where the joints really are, before anything yields.

use stiffarm_kernels::Motion;

use super::late;
use super::laws::Order;
use super::observe::InOrder;
use super::reality::{RealJoint, Reality};
use crate::measurement::Row;

impl Reality {
    /// Real joint values, rad (m if prismatic), when a row is measured.
    pub(super) fn joint_values(&self, at: InOrder<'_>) -> Vec<f64> {
        let row = at.row;
        let late = || late::readings_at(at.sitting(), row.time? - self.delay);
        let then = if self.delay == 0.0 { None } else { late() };
        let q = then.as_ref().unwrap_or(&row.q);
        let one = |(j, joint): (usize, &RealJoint)| {
            let reading = q[j];
            let coupled: f64 = joint.couplings.iter().map(|(other, c)| c * q[*other]).sum();
            let moved = at.before().map_or(0.0, |b| row.q[j] - b.q[j]);
            let side = direction(row, j);
            reading + joint.offset + joint.ratio * reading + joint.transmission(reading) + coupled
                - joint.lag * moved
                - side * joint.width / 2.0
                + joint.warming * at.warmth()
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
        // By amplitude and phase.
        let ripple = |[order, c, s]: &[f64; 3]| c.hypot(*s) * (order * reading - s.atan2(*c)).cos();
        self.orders.iter().map(term).sum::<f64>() + self.ripples.iter().map(ripple).sum::<f64>()
    }
}
