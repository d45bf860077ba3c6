//! Computed torque, written once for two arms in two precisions: each simulated arm starts beside the posture that it is
//! to hold, and its errors fade as the gains say, whatever it weighs.
//!
//! ```text
//! cargo run -p stiffarm --example computed_torque
//! ```

mod simulated;
mod step;

use simulated::moved;
use step::{Gains, Target, step};
use stiffarm::kernels::{Scalar, Unstable, has};

stiffarm::robot! {
    /// Six joints.
    pub mod ur10 from "robots/arms/ur10.toml";
    outputs: inverse_dynamics, forward_dynamics;
}
stiffarm::robot! {
    /// Seven joints.
    pub mod panda from "robots/arms/panda.toml";
    outputs: inverse_dynamics, forward_dynamics;
}

/// Seconds of a period.
const PERIOD: f64 = 1e-3;
/// Both roots of the errors' equation, 1/s.
const FADING: f64 = 10.0;
/// How far each joint is off at first, rad.
const ASIDE: f64 = 0.1;

/// The most that a joint is off after so many periods, rad.
fn off<S: Scalar + Into<f64>, const N: usize, A>(arm: &A, periods: usize) -> Result<f64, Unstable>
where
    A: has::InverseDynamics<N, S> + has::ForwardDynamics<N, S>,
{
    let rest = [S::lit(0.0); N];
    let posture = core::array::from_fn(|k| S::lit(0.3 - 0.4 * k as f64));
    let target = Target { q: posture, qd: rest, qdd: rest };
    let gains = Gains { stiffness: S::lit(FADING * FADING), damping: S::lit(2.0 * FADING) };
    let (mut q, mut qd) = (posture.map(|angle| angle + S::lit(ASIDE)), rest);
    for _ in 0..periods {
        let torques = step(arm, (&q, &qd), &target, &gains);
        (q, qd) = moved(arm, (&q, &qd), &torques, S::lit(PERIOD))?;
    }
    let error = |(a, b): (S, S)| (a - b).into().abs();
    Ok(q.into_iter().zip(posture).map(error).fold(0.0, f64::max))
}

fn report<S: Scalar + Into<f64>, const N: usize, A>(arm: &A, what: &str) -> Result<(), Unstable>
where
    A: has::InverseDynamics<N, S> + has::ForwardDynamics<N, S>,
{
    let (before, after) = (off(arm, 0)?, off(arm, 500)?);
    let time = 500.0 * PERIOD * FADING;
    let expected = ASIDE * (1.0 + time) * (-time).exp();
    println!("{}, {N} joints, {what}: {before:.3} rad off, then {after:.5}", A::NAME);
    // Torques that are held for a period are half of one late, of the 1/10 s in which the errors fade.
    assert!((after / expected - 1.0).abs() < 0.05, "{after} rad, {expected} rad by the gains");
    Ok(())
}

fn main() -> Result<(), Unstable> {
    report::<f64, 6, _>(&ur10::Robot, "f64")?;
    report::<f32, 6, _>(&ur10::Robot, "f32")?;
    report::<f64, 7, _>(&panda::Robot, "f64")?;
    report::<f32, 7, _>(&panda::Robot, "f32")
}
