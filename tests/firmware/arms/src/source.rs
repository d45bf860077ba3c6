//! The simulated arm that the loop reads: a payload carried from one posture to another, motors
//! that hold what they were told one period before, and three readings that are broken.

use crate::Real;
use crate::path::{self, N};
use crate::robots::ur5_springs as arm;
use crate::set_point::{Correction, Reading, Refusal, correct};

/// Periods of the run: one second at 1 kHz.
pub const PERIODS: u32 = 1_000;

/// Periods whose readings are broken: a wrench that is NaN, an encoder that is infinite, one that
/// is finite and no angle.
pub const BROKEN: [u32; 3] = [250, 500, 750];

/// Weight of the payload, N, and its centre in tool axes, mm.
pub const WEIGHT: i32 = 50;
/// See [`WEIGHT`].
pub const CENTRE: [i32; 3] = [20, -10, 60];

/// The target of a period.
pub fn target<S: Real>(period: u32) -> [S; N] {
    path::at(S::of(period.cast_signed()) * S::of(PERIODS.cast_signed()).recip()).q
}

/// The wrench of the payload's weight in tool axes, for a tool with these axes.
pub fn payload<S: Real>(rotation: &[[S; 3]; 3]) -> [S; 6] {
    let [x, y, z] = rotation;
    let weight = -S::of(WEIGHT);
    let [fx, fy, fz] = [x[2] * weight, y[2] * weight, z[2] * weight];
    let milli = S::of(1_000).recip();
    let [cx, cy, cz] = CENTRE.map(|mm| milli * S::of(mm));
    [fx, fy, fz, cy * fz - cz * fy, cz * fx - cx * fz, cx * fy - cy * fx]
}

/// Runs the loop; shows each period's target, reading and result.
pub fn run<S: Real>(mut see: impl FnMut(&[S; N], &Reading<S>, &Result<Correction<S>, Refusal>)) {
    let mut held = target(0);
    for period in 0..PERIODS {
        let target = target(period);
        let wrench = payload(&arm::pose(&target).rotation);
        let mut reading = Reading { encoders: held, wrench };
        match BROKEN.iter().position(|broken| *broken == period) {
            Some(0) => reading.wrench[4] = S::NAN,
            Some(1) => reading.encoders[2] = -S::INFINITY,
            Some(_) => reading.encoders[0] = S::of(1_000_000) * S::of(1_000_000),
            None => {}
        }
        let result = correct(&reading, &target);
        if let Ok(correction) = &result {
            held = correction.set_point;
        }
        see(&target, &reading, &result);
    }
}
