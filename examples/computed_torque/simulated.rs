//! An arm that moves: what a control loop is tried on.

use stiffarm::kernels::{Scalar, Unstable, has};

/// Joint values and rates after `period` seconds of motors that hold their torques, by one step of the classical
/// Runge-Kutta method of fourth order.
///
/// # Errors
/// [`Unstable`] where a joint moves no mass.
pub fn moved<S: Scalar, const N: usize, A>(
    arm: &A,
    (q, qd): (&[S; N], &[S; N]),
    torques: &[S; N],
    period: S,
) -> Result<([S; N], [S; N]), Unstable>
where
    A: has::ForwardDynamics<N, S>,
{
    let half = S::lit(0.5) * period;
    let slope = |q: &[S; N], qd: &[S; N]| arm.forward_dynamics(&arm.posture(q), qd, torques);
    let first = slope(q, qd)?;
    let v2 = ahead(qd, &first, half);
    let second = slope(&ahead(q, qd, half), &v2)?;
    let v3 = ahead(qd, &second, half);
    let third = slope(&ahead(q, &v2, half), &v3)?;
    let v4 = ahead(qd, &third, period);
    let fourth = slope(&ahead(q, &v3, period), &v4)?;
    Ok((
        ahead(q, &mean([qd, &v2, &v3, &v4]), period),
        ahead(qd, &mean([&first, &second, &third, &fourth]), period),
    ))
}

/// `x + time · rate`.
fn ahead<S: Scalar, const N: usize>(x: &[S; N], rate: &[S; N], time: S) -> [S; N] {
    let mut at = *x;
    for (at, rate) in at.iter_mut().zip(rate) {
        *at = *at + time * *rate;
    }
    at
}

/// `(a + 2 b + 2 c + d) / 6`.
fn mean<S: Scalar, const N: usize>([a, b, c, d]: [&[S; N]; 4]) -> [S; N] {
    let mut mean = *a;
    for (k, a) in mean.iter_mut().enumerate() {
        *a = S::lit(1.0 / 6.0) * (*a + S::lit(2.0) * (b[k] + c[k]) + d[k]);
    }
    mean
}
