//! A simulated UR10 that a loop of computed torques drives along the path. It starts beside it, at the path's rates:
//! the errors fade as the loop's gains say.

use stiffarm::kernels::Unstable;

use crate::Real;
use crate::computed_torque::{Gains, step};
use crate::path::{self, N};
use crate::robots::ur10_moving::Robot;
use crate::simulated::moved;

/// Periods of the run: one second at 1 kHz.
pub const PERIODS: u32 = 1_000;

/// How far each joint starts from the path, milliradian.
pub const ASIDE: [i32; N] = [100, -80, 60, -100, 80, -60];

/// What the errors fade with: both roots of `s² + K_d s + K_p` are −10/s.
pub const FADING: i32 = 10;

/// Joint values, rates, and the torques that the motors held on the way there: rad, rad/s, N·m.
pub type Moved<S> = [[S; N]; 3];

/// Runs the loop for a second, in so many periods; shows what each ends with.
pub fn run<S: Real>(periods: u32, mut see: impl FnMut(Result<&Moved<S>, Unstable>)) {
    let period = S::of(periods.cast_signed()).recip();
    let rate = S::of(FADING);
    let gains = Gains { stiffness: rate * rate, damping: S::of(2) * rate };
    let start = path::at(S::of(0));
    let (mut q, mut qd) = (start.q, start.qd);
    for (value, aside) in q.iter_mut().zip(ASIDE) {
        *value = *value + S::of(1_000).recip() * S::of(aside);
    }
    for k in 0..periods {
        let target = path::at(S::of(k.cast_signed()) * period);
        let torques = step(&Robot, (&q, &qd), &target, &gains);
        match moved(&Robot, (&q, &qd), &torques, period) {
            Ok(next) => (q, qd) = next,
            Err(unstable) => return see(Err(unstable)),
        }
        see(Ok(&[q, qd, torques]));
    }
}
