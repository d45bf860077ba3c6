//! Comparing kernels with the textbook.

use stiffarm::kernels::generic::Arm;
use stiffarm::kernels::{Kernels, Output, Scalar};

/// Joint values and wrenches by a small deterministic generator (PCG's multiplier).
pub struct Draws(u64);

impl Draws {
    pub fn new(seed: u64) -> Self {
        Draws(seed.wrapping_mul(2).wrapping_add(1))
    }

    /// Uniform in (-1, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Joint values within ±3 rad or ±0.5 m beyond 0.6 m.
    pub fn posture(&mut self, arm: &Arm) -> Vec<f64> {
        use stiffarm::kernels::Motion;
        arm.joints
            .iter()
            .map(|joint| match joint.motion {
                Motion::Revolute => 3.0 * self.unit(),
                Motion::Prismatic => 0.6 + 0.5 * self.unit(),
            })
            .collect()
    }

    /// Up to 100 N and 30 N·m: every arm here stays clearly stable under it.
    pub fn wrench(&mut self) -> [f64; 6] {
        core::array::from_fn(|k| self.unit() * if k < 3 { 100.0 } else { 30.0 })
    }
}

/// The largest deviation of an output from the textbook, relative to its largest entry.
pub fn deviation<S: Scalar>(
    kernels: &dyn Kernels<S>,
    arm: &Arm,
    output: Output,
    (q, wrench): (&[f64], &[f64; 6]),
    back: impl Fn(S) -> f64,
) -> f64 {
    let expected = arm.evaluate(output, q, wrench).expect("the textbook finds the arm stable");
    let (rows, columns) = output.shape(arm.dof());
    let mut got = vec![S::lit(0.0); rows * columns];
    let cast: Vec<S> = q.iter().map(|x| S::lit(*x)).collect();
    kernels.evaluate(output, &cast, &wrench.map(S::lit), &mut got).expect("the kernel agrees");
    let got: Vec<f64> = got.into_iter().map(back).collect();
    relative(&got, &expected)
}

/// Largest difference relative to the largest entry; an exact zero asks for an exact zero.
pub fn relative(got: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(got.len(), expected.len());
    assert!(got.iter().all(|x| x.is_finite()), "a kernel returned {got:?}");
    let scale = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let worst = got.iter().zip(expected).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    if worst == 0.0 { 0.0 } else { worst / scale }
}
