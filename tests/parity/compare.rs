//! Comparing kernels with the textbook.

use stiffarm::kernels::generic::{Arm, Joint};
use stiffarm::kernels::{Input, Kernels, Output, Part, Scalar, Side};

/// Numbers for the parameters of a symbolic arm: as its struct, by name, and for any scalar.
macro_rules! parameters {
    (
        pub const $set:ident: $($ty:ident)::+<f64> = { $($name:ident: $value:expr),* $(,)? };
        pub fn $lookup:ident;
    ) => {
        pub const $set: $($ty)::+<f64> = $($ty)::+ { $($name: $value),* };

        pub fn $lookup(name: &str) -> Option<f64> {
            [$((stringify!($name), $value)),*].into_iter().find(|(n, _)| *n == name).map(|(_, x)| x)
        }

        #[allow(dead_code)]
        pub fn parameters_as<S>(cast: impl Fn(f64) -> S) -> $($ty)::+<S> {
            $($ty)::+ { $($name: cast($value)),* }
        }
    };
}

/// Joint values and wrenches by a small deterministic generator (PCG's multiplier).
pub struct Draws(u64);

impl Draws {
    pub fn new(seed: u64) -> Self {
        Draws(seed.wrapping_mul(2).wrapping_add(1))
    }

    /// Uniform in (-1, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
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

    /// Up to 100 N and 30 N·m, or what leaves the softest joint clearly stable at full reach.
    pub fn wrench(&mut self, arm: &Arm) -> [f64; 6] {
        let reach: f64 = arm.joints.iter().map(|j| j.a.abs() + j.d.abs()).sum();
        let softest = arm.joints.iter().map(|j| j.compliance).fold(0.0, f64::max);
        let bearable = 0.02 / (softest * (1.0 + reach));
        core::array::from_fn(|k| self.unit() * bearable.min(if k < 3 { 100.0 } else { 30.0 }))
    }
}

/// The largest deviation of an output from the textbook, relative to the output's scale.
pub fn deviation<S: Scalar>(
    kernels: &dyn Kernels<S>,
    arm: &Arm,
    output: Output,
    (q, wrench): (&[f64], &[f64; 6]),
    (cancelled, back): (f64, impl Fn(S) -> f64),
) -> f64 {
    let expected = arm.evaluate(output, q, wrench).expect("the textbook finds the arm stable");
    let (rows, columns) = output.shape(arm.dof());
    let mut got = vec![S::lit(0.0); rows * columns];
    let cast: Vec<S> = q.iter().map(|x| S::lit(*x)).collect();
    kernels.evaluate(output, &cast, &wrench.map(S::lit), &mut got).expect("the kernel agrees");
    let got: Vec<f64> = got.into_iter().map(back).collect();
    relative(&got, &expected, cancelled * terms(arm, output, q, wrench))
}

/// How far the terms of an output may cancel in double precision before its largest entry is no scale
/// any more: a horizontal arm's weights turn no vertical joint, and the textbook says so to rounding.
pub const CANCELLED: f64 = 1e-3;
/// The same in single precision, whose rounding is a thirtieth of the tolerance.
pub const CANCELLED_F32: f64 = 0.1;

/// Largest difference relative to the output's scale: its largest entry, or `floor`.
pub fn relative(got: &[f64], expected: &[f64], floor: f64) -> f64 {
    assert_eq!(got.len(), expected.len());
    assert!(got.iter().all(|x| x.is_finite()), "a kernel returned {got:?}");
    let largest = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let worst = got.iter().zip(expected).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    if worst == 0.0 { 0.0 } else { worst / largest.max(floor) }
}

/// The size of the terms that an output is summed of.
pub fn terms(arm: &Arm, output: Output, q: &[f64], wrench: &[f64; 6]) -> f64 {
    let rows = arm.joints.iter().zip(q);
    let reach: f64 = rows.map(|(j, q)| j.a.abs() + j.d.abs() + q.abs()).sum::<f64>()
        + arm.tool.translation.vector.norm();
    let lever = 1.0 + reach;
    let loads = [
        output.takes(Input::Wrench).then(|| wrench.iter().map(|x| x.abs()).sum::<f64>() * lever),
        output.depends_on(Part::Weights).then(|| {
            let mass = |j: &Joint| j.mass * (1.0 + j.com.norm()) + beam_mass(j, reach);
            arm.gravity.norm() * lever * arm.joints.iter().map(mass).sum::<f64>()
        }),
    ];
    let load = loads.into_iter().flatten().reduce(|a, b| a + b).unwrap_or(1.0);
    let soft = |j: &Joint| j.compliance + beam_compliance(j, reach);
    let gives = match output.depends_on(Part::Stiffness) {
        true => arm.joints.iter().map(soft).sum(),
        false => 1.0,
    };
    let at_tool = |side: Side| match side {
        Side::Axes | Side::Twist | Side::Wrench => lever,
        _ => 1.0,
    };
    at_tool(output.rows()) * at_tool(output.columns()) * gives * load
}

fn beam_mass(joint: &Joint, length: f64) -> f64 {
    joint.beam.as_ref().map_or(0.0, |b| b.density * b.area * length)
}

fn beam_compliance(joint: &Joint, length: f64) -> f64 {
    joint.beam.as_ref().map_or(0.0, |b| {
        let bending = 1.0 / (b.youngs_modulus * b.iy.min(b.iz));
        length * (1.0 + length * length) * (bending + 1.0 / (b.shear_modulus * b.j))
    })
}
