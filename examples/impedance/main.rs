//! A control loop that is written once and runs on two arms in two precisions: each is pulled to a pose nearby by
//! springs at its tool, every joint a damper.
//!
//! ```text
//! cargo run -p stiffarm --example impedance
//! ```

mod step;

use step::{Impedance, step};
use stiffarm::kernels::{Arm, Scalar, has};

stiffarm::robot! {
    /// Six joints.
    pub mod ur10 from "robots/arms/ur10.toml";
    outputs: pose, jacobian;
}
stiffarm::robot! {
    /// Seven joints.
    pub mod iiwa14 from "robots/arms/iiwa14.toml";
    outputs: pose, jacobian;
}

/// Seconds of a period.
const PERIOD: f64 = 1e-3;

/// How far the tool is from where it is pulled to after so many periods, m.
fn pulled<S: Scalar + Into<f64>, const N: usize, A>(arm: &A, periods: usize) -> f64
where
    A: has::Pose<N, S> + has::Jacobian<N, S>,
{
    let angle = |k: usize| S::lit(0.3 + 0.2 * k as f64);
    let target = arm.pose(&arm.posture(&core::array::from_fn(angle)));
    let impedance = Impedance {
        stiffness: [2e3, 2e3, 2e3, 2e2, 2e2, 2e2].map(S::lit),
        damping: [10.0, 10.0, 10.0, 1.0, 1.0, 1.0].map(S::lit),
    };
    let mut q: [S; N] = core::array::from_fn(|k| angle(k) + S::lit(0.2));
    let mut rates = [S::lit(0.0); N];
    for _ in 0..periods {
        // Joints without mass that brake with 50 N·m·s/rad.
        rates =
            step(arm, (&q, &rates), &target, &impedance).map(|torque| S::lit(1.0 / 50.0) * torque);
        for (angle, rate) in q.iter_mut().zip(rates) {
            *angle = *angle + S::lit(PERIOD) * rate;
        }
    }
    let here = arm.pose(&arm.posture(&q)).position;
    let square = |(a, b): (S, S)| ((a - b) * (a - b)).into();
    here.into_iter().zip(target.position).map(square).sum::<f64>().sqrt()
}

fn report<S: Scalar + Into<f64>, const N: usize, A>(arm: &A, what: &str, most: f64)
where
    A: has::Pose<N, S> + has::Jacobian<N, S>,
{
    let (before, after) = (pulled(arm, 0), pulled(arm, 40_000));
    println!("{}, {N} joints, {what}: {before:.3} m off, then {after:.1e} m", A::NAME);
    assert!(after < most, "{after} m");
}

fn main() {
    // In single precision an angle stays where a period would turn it by less than half a digit, 6e-8 rad: joints that
    // brake with 3e-3 N·m against springs of 2 kN/m, some decimetres away.
    report::<f64, 6, _>(&ur10::Robot, "f64", 1e-6);
    report::<f32, 6, _>(&ur10::Robot, "f32", 3e-5);
    report::<f64, 7, _>(&iiwa14::Robot, "f64", 1e-6);
    report::<f32, 7, _>(&iiwa14::Robot, "f32", 3e-5);
    let reach: f64 =
        <ur10::Robot as stiffarm::kernels::Numeric<6>>::ROWS.iter().map(|row| row.a.abs()).sum();
    let limits = <ur10::Robot as Arm<6>>::LIMITS;
    println!("{reach:.3} m of upper and lower arm; the elbow from {:?} rad", limits[2]);
}
