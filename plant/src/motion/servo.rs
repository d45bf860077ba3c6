//! A position-driven arm: servos that follow commands late, with an error, and with play.
//!
//! Each joint obeys `J/K q̈ + D/K q̇ + q = q_cmd(t − delay) − g(q)/K` behind its servo, and drags a play
//! behind it. Backward differences of the second order: a servo without inertia or damping is one too.

use super::control::Track;
use super::machine::Machine;
use super::truth::MotionTruth;
use crate::course::Course;

/// One joint's servo.
#[derive(Clone, Copy, Debug, Default)]
struct Servo {
    /// D/K, s.
    lag: f64,
    /// J/K, s².
    inertia: f64,
    /// 1/K.
    compliance: f64,
    half_width: f64,
}

/// Where a servo is and was: the newest first.
#[derive(Clone, Copy, Debug)]
struct Past {
    q: [f64; 2],
    qd: [f64; 2],
    /// Behind the play.
    joint: f64,
}

/// Follows a course by position.
pub(super) fn served(
    real: &Machine,
    truths: &[MotionTruth],
    course: &dyn Course,
    step: f64,
) -> Track {
    let start = course.at(0.0).q;
    let mut servos = vec![Servo::default(); start.len()];
    for truth in truths {
        let Some(joint) = truth.spot.joint() else { continue };
        let (servo, size) = (&mut servos[joint], truth.values[0]);
        match truth.law.name {
            "tracking_lag" => {
                servo.lag += size;
                servo.inertia += truth.value("inertia");
            }
            "servo_droop" => servo.compliance += size,
            "backlash" => servo.half_width += 0.5 * size,
            _ => {}
        }
    }
    let loads = real.weights(&start);
    let rest = |((q, servo), load): ((&f64, &Servo), &f64)| {
        let q = q - servo.compliance * load;
        Past { q: [q; 2], qd: [0.0; 2], joint: q }
    };
    let mut past: Vec<Past> = start.iter().zip(&servos).zip(&loads).map(rest).collect();
    let mut track = Track::new(start.len(), step);
    let steps = (course.duration() / step).ceil() as usize;
    for k in 0..=steps {
        let time = k as f64 * step;
        let sent = course.at(time - real.delay).q;
        let joints: Vec<f64> = past.iter().map(|p| p.joint).collect();
        let loads = real.weights(&joints);
        for (((servo, past), sent), load) in servos.iter().zip(&mut past).zip(&sent).zip(&loads) {
            servo.step(past, sent - servo.compliance * load, step);
        }
        Track::push(&mut track.q, past.iter().map(|p| p.joint));
        Track::push(&mut track.sent, course.at(time).q);
    }
    track
}

impl Servo {
    fn step(&self, past: &mut Past, wanted: f64, step: f64) {
        let ahead = 1.5 / step;
        let behind = |[last, before]: [f64; 2]| (0.5 * before - 2.0 * last) / step;
        let (of_q, of_qd) = (behind(past.q), behind(past.qd));
        let held = self.inertia * (ahead * of_q + of_qd) + self.lag * of_q;
        let q = (wanted - held) / (1.0 + ahead * (self.lag + ahead * self.inertia));
        let qd = ahead * q + of_q;
        past.q = [q, past.q[0]];
        past.qd = [qd, past.qd[0]];
        past.joint = past.joint.clamp(q - self.half_width, q + self.half_width);
    }
}
