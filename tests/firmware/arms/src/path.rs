//! The path that both loops follow: a smooth step from one posture to another within a second.

use crate::Real;
use crate::computed_torque::Target;

/// Joints.
pub const N: usize = 6;

/// Postures at both ends, milliradian.
const FROM: [i32; N] = [-900, -1300, 1700, -2000, -1400, 300];
const TO: [i32; N] = [1100, -600, 900, -1200, 1500, -1800];

/// Where the joints are to be at `t`, s, between 0 and 1.
pub fn at<S: Real>(t: S) -> Target<S, N> {
    let milli = S::of(1_000).recip();
    let (six, two) = (S::of(6), S::of(2));
    let way = t * t * (S::of(3) - two * t);
    let (rate, acceleration) = (six * t * (S::of(1) - t), six * (S::of(1) - two * t));
    let scaled = |s: S| core::array::from_fn(|k| milli * (s * S::of(TO[k] - FROM[k])));
    let mut q = scaled(way);
    for (value, from) in q.iter_mut().zip(FROM) {
        *value = *value + milli * S::of(from);
    }
    Target { q, qd: scaled(rate), qdd: scaled(acceleration) }
}
