//! KUKA KR 240-2 unrolled by hand: what a careful person would write, and the yardstick for the
//! generator.
//!
//! All sines and cosines of a pose are taken together; θ2 + θ3 is one angle; θ6 enters the pose only.
//! Everything is worked out in the plane of the arm (frame 1) or in frame 3, where axes 3 and 4 are unit
//! vectors, and turned into base axes at the end. Vectors of frame 3: the tool from the wrist is
//! `(-k, m, h)`, the wrist from the elbow `(0.055, 1.1, 0)`. Frame F is frame 1 with its y upright:
//! `(radial, up, across)`.

mod compliance;
mod deflection;

use stiffarm_kernels::{Pose, Scalar, Unstable};

pub use compliance::compliance;
use compliance::compliance_of;
pub use deflection::{deflection, deflection_first_order};
use deflection::{displacement_of, torques_of, turns_of};

/// Joint compliances, rad/(N·m) (Dumas et al. 2011, Table 2).
const C: [f64; 5] = [1.0 / 3.8e6, 1.0 / 6.6e6, 1.0 / 3.9e6, 1.0 / 5.6e5, 1.0 / 6.6e5];

type V<S> = [S; 3];

/// The first five joints' part, which all outputs share.
struct Arm<S> {
    c1: S,
    s1: S,
    c2: S,
    s2: S,
    c: S,
    s: S,
    c4: S,
    s4: S,
    c5: S,
    s5: S,
    /// Tool from the wrist in frame 3: `(-k, m, h)`.
    k: S,
    m: S,
    h: S,
    /// 0.23 s5.
    b: S,
    /// Tool from the elbow in frame 3: `(e, g, h)`.
    e: S,
    g: S,
    /// Tool from axis 3, and from axis 2, in F (without the part across, h).
    r3: [S; 2],
    r2: [S; 2],
}

fn fma<S: Scalar>(a: S, b: S, c: S) -> S {
    S::mul_add(a, b, c)
}

/// `(c x - s y, s x + c y)`.
fn turn<S: Scalar>(c: S, s: S, x: S, y: S) -> [S; 2] {
    [fma(c, x, -(s * y)), fma(s, x, c * y)]
}

impl<S: Scalar> Arm<S> {
    #[inline(always)]
    fn new(sines: [S; 5], cosines: [S; 5]) -> Self {
        let ([s1, s2, s, s4, s5], [c1, c2, c, c4, c5]) = (sines, cosines);
        let (b, m) = (S::lit(0.23) * s5, S::lit(0.23) * c5);
        let (k, h) = (c4 * b, s4 * b);
        let (e, g) = (S::lit(0.055) - k, S::lit(1.1) + m);
        let r3 = turn(c, s, e, g);
        let r2 = [fma(S::lit(1.25), c2, r3[0]), fma(S::lit(1.25), s2, r3[1])];
        Arm { c1, s1, c2, s2, c, s, c4, s4, c5, s5, k, m, h, b, e, g, r3, r2 }
    }

    #[inline(always)]
    fn at(q: &[S; 6]) -> Self {
        let (sines, cosines) = S::sin_cos_all([q[0], q[1], q[1] + q[2], q[3], q[4]]);
        Arm::new(sines, cosines)
    }

    /// From frame 3 to F.
    #[inline(always)]
    fn to_f(&self, [x, y, z]: V<S>) -> V<S> {
        let [radial, up] = turn(self.c, self.s, x, y);
        [radial, up, z]
    }

    /// From F to base axes.
    #[inline(always)]
    fn to_base(&self, [radial, up, across]: V<S>) -> V<S> {
        let (c1, s1) = (self.c1, self.s1);
        [fma(c1, radial, s1 * across), fma(s1, radial, -(c1 * across)), up]
    }

    /// From base axes to frame 3.
    #[inline(always)]
    fn to_three(&self, [x, y, z]: V<S>) -> V<S> {
        let radial = fma(self.c1, x, self.s1 * y);
        let across = fma(self.s1, x, -(self.c1 * y));
        [fma(self.c, radial, self.s * z), fma(self.c, z, -(self.s * radial)), across]
    }

    /// Translations and axes of joints 1, 4, 5 in F, and axis 6; those of 2 and 3 are
    /// `(-r_up, r_radial, 0)` and across.
    #[inline(always)]
    fn twists(&self) -> ([S; 2], [V<S>; 2], [V<S>; 3]) {
        let v1 = [self.h, S::lit(0.35) + self.r2[0]];
        let v4 = [self.c * self.h, self.s * self.h, self.k];
        let v5 = self.to_f([-(self.c4 * self.m), -self.b, self.s4 * self.m]);
        let z4 = [-self.s, self.c, S::lit(0.0)];
        let z5 = [self.c * self.s4, self.s * self.s4, self.c4];
        let z6 = self.to_f([-(self.c4 * self.s5), self.c5, self.s4 * self.s5]);
        (v1, [v4, v5], [z4, z5, z6])
    }
}

/// Pose of the tool.
#[inline(always)]
pub fn pose<S: Scalar>(q: &[S; 6]) -> Pose<S> {
    let angles = [q[0], q[1], q[1] + q[2], q[3], q[4], q[5]];
    let ([s1, s2, s, s4, s5, s6], [c1, c2, c, c4, c5, c6]) = S::sin_cos_all(angles);
    pose_of(&Arm::new([s1, s2, s, s4, s5], [c1, c2, c, c4, c5]), [c6, s6])
}

#[inline(always)]
fn pose_of<S: Scalar>(a: &Arm<S>, [c6, s6]: [S; 2]) -> Pose<S> {
    let (c4, s4, c5, s5) = (a.c4, a.s4, a.c5, a.s5);
    let (along, beside) = (c4 * c5, s4 * c5);
    let x = [fma(c6, along, -(s6 * s4)), c6 * s5, -fma(c6, beside, s6 * c4)];
    let y = [-fma(s6, along, c6 * s4), -(s6 * s5), fma(s6, beside, -(c6 * c4))];
    let z = [-(c4 * s5), c5, s4 * s5];
    let [x, y, z] = [x, y, z].map(|v| a.to_base(a.to_f(v)));
    let position = a.to_base([S::lit(0.35) + a.r2[0], a.r2[1], a.h]);
    Pose { rotation: [x, y, z], position }
}

/// The Jacobian.
#[inline(always)]
pub fn jacobian<S: Scalar>(q: &[S; 6]) -> [[S; 6]; 6] {
    jacobian_of(&Arm::at(q))
}

#[inline(always)]
fn jacobian_of<S: Scalar>(a: &Arm<S>) -> [[S; 6]; 6] {
    let zero = S::lit(0.0);
    let (v1, [v4, v5], [z4, z5, z6]) = a.twists();
    let column = |v: V<S>, z: V<S>| [v[0], v[1], v[2], z[0], z[1], z[2]];
    let flat = |[radial, up]: [S; 2]| [a.c1 * -up, a.s1 * -up, radial];
    let across = [a.s1, -a.c1, zero];
    [
        column(
            [fma(a.c1, v1[0], -(a.s1 * v1[1])), fma(a.s1, v1[0], a.c1 * v1[1]), zero],
            [zero, zero, S::lit(1.0)],
        ),
        column(flat(a.r2), across),
        column(flat(a.r3), across),
        column(a.to_base(v4), [a.c1 * z4[0], a.s1 * z4[0], z4[1]]),
        column(a.to_base(v5), a.to_base(z5)),
        column([zero; 3], a.to_base(z6)),
    ]
}

/// K_C by contraction in frame 3: `(f × z_i) · v_j` in both triangles, `m · (z_i × z_j)` in row j of
/// column i.
#[inline(always)]
pub fn complementary_stiffness<S: Scalar>(q: &[S; 6], w: &[S; 6]) -> [[S; 6]; 6] {
    complementary_stiffness_of(&Arm::at(q), w)
}

#[inline(always)]
fn complementary_stiffness_of<S: Scalar>(a: &Arm<S>, w: &[S; 6]) -> [[S; 6]; 6] {
    let zero = S::lit(0.0);
    let [fx, fy, fz] = a.to_three([w[0], w[1], w[2]]);
    let [mx, my, mz] = a.to_three([w[3], w[4], w[5]]);
    // Axis 2 from axis 3 in frame 3: the upper arm turned back by θ3.
    let c3 = fma(a.c2, a.c, a.s2 * a.s);
    let s3 = fma(a.c2, a.s, -(a.s2 * a.c));
    let r2 = [fma(S::lit(1.25), c3, a.e), fma(S::lit(-1.25), s3, a.g)];
    let r1 = S::lit(0.35) + a.r2[0];
    // Translations in frame 3; z1 is (s, c, 0), z2 and z3 are (0, 0, 1), z4 is (0, 1, 0).
    let v1 = [a.c * a.h, -(a.s * a.h), -r1];
    let (v2, v3) = ([-r2[1], r2[0]], [-a.g, a.e]);
    let v4 = [a.h, a.k];
    let z5 = [a.s4, a.c4];
    let v5 = [-(a.c4 * a.m), -a.b, a.s4 * a.m];
    let z6 = [-(a.c4 * a.s5), a.c5, a.s4 * a.s5];
    // f × z of each joint.
    let f1 = [-(fz * a.c), fz * a.s, fma(fx, a.c, -(fy * a.s))];
    let f4 = [-fz, fx];
    let f5 = [fy * z5[1], fma(fz, z5[0], -(fx * z5[1])), -(fy * z5[0])];
    // m × z of each joint.
    let m1 = [-(mz * a.c), mz * a.s, fma(mx, a.c, -(my * a.s))];
    let m4 = [-mz, mx];
    let m5 = [my * z5[1], fma(mz, z5[0], -(mx * z5[1])), -(my * z5[0])];
    let dot = |a: V<S>, b: V<S>| fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
    let flat = |a: V<S>, b: [S; 2]| fma(a[0], b[0], a[1] * b[1]);
    let force = [
        [dot(f1, v1), flat(f1, v2), flat(f1, v3), fma(f1[0], v4[0], f1[2] * v4[1]), dot(f1, v5)],
        [zero, fma(fy, v2[0], -(fx * v2[1])), fma(fy, v3[0], -(fx * v3[1])), fy * v4[0], {
            fma(fy, v5[0], -(fx * v5[1]))
        }],
        [zero; 5],
        [zero, zero, zero, fma(f4[0], v4[0], f4[1] * v4[1]), fma(f4[0], v5[0], f4[1] * v5[2])],
        [zero, zero, zero, zero, dot(f5, v5)],
    ];
    // m · (z_i × z_j) = (m × z_i) · z_j.
    let one = m1[2];
    let (m15, m16) = (fma(m1[0], z5[0], m1[2] * z5[1]), dot(m1, z6));
    let (m25, m26) = (my * z5[0], fma(my, z6[0], -(mx * z6[1])));
    let (m45, m46) = (fma(m4[0], z5[0], m4[1] * z5[1]), fma(m4[0], z6[0], m4[1] * z6[2]));
    let m56 = dot(m5, z6);
    let f = |i: usize, j: usize| if i == 2 { force[1][j] } else { force[i][j] };
    [
        [f(0, 0), f(0, 1) + one, f(0, 2) + one, f(0, 3) + m1[1], f(0, 4) + m15, m16],
        [f(0, 1), f(1, 1), f(1, 2), f(1, 3) - mx, f(1, 4) + m25, m26],
        [f(0, 2), f(1, 2), f(1, 2), f(1, 3) - mx, f(1, 4) + m25, m26],
        [f(0, 3), f(1, 3), f(1, 3), f(3, 3), f(3, 4) + m45, m46],
        [f(0, 4), f(1, 4), f(1, 4), f(3, 4), f(4, 4), m56],
        [zero; 6],
    ]
}

/// Everything that the fused function gives.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct All<S> {
    pub pose: Pose<S>,
    pub jacobian: [[S; 6]; 6],
    pub complementary_stiffness: [[S; 6]; 6],
    pub joint_torque: [S; 6],
    pub compliance: [[S; 6]; 6],
    pub deflection: [S; 6],
}

/// All together, from one set of sines and cosines.
///
/// # Errors
/// `Unstable` where the symmetric part of `Kθ − K_C` is not positive definite.
#[inline(always)]
pub fn all<S: Scalar>(q: &[S; 6], w: &[S; 6]) -> Result<All<S>, Unstable> {
    let angles = [q[0], q[1], q[1] + q[2], q[3], q[4], q[5]];
    let ([s1, s2, s, s4, s5, s6], [c1, c2, c, c4, c5, c6]) = S::sin_cos_all(angles);
    let a = &Arm::new([s1, s2, s, s4, s5], [c1, c2, c, c4, c5]);
    let jacobian = jacobian_of(a);
    let complementary_stiffness = complementary_stiffness_of(a, w);
    let joint_torque = torques_of(a, w);
    let turns = turns_of(&complementary_stiffness, &joint_torque, w)?;
    Ok(All {
        pose: pose_of(a, [c6, s6]),
        compliance: compliance_of(&jacobian),
        deflection: displacement_of(a, turns),
        jacobian,
        complementary_stiffness,
        joint_torque,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arms::textbook;
    use stiffarm_draws::Draws;
    use stiffarm_kernels::Output;

    #[test]
    fn the_ideal_is_right() {
        let arm = textbook("kuka_kr240");
        let mut draws = Draws::new(1);
        for (q, w) in draws.postures::<6>(500).iter().zip(draws.loads(500)) {
            let all = all(q, &w).expect("stable");
            let outputs: [(Output, Vec<f64>); 12] = [
                (Output::Pose, pose(q).columns().as_flattened().to_vec()),
                (Output::Jacobian, jacobian(q).as_flattened().to_vec()),
                (
                    Output::ComplementaryStiffness,
                    complementary_stiffness(q, &w).as_flattened().to_vec(),
                ),
                (Output::DeflectionFirstOrder, deflection_first_order(q, &w).to_vec()),
                (Output::Compliance, compliance(q).as_flattened().to_vec()),
                (Output::Deflection, deflection(q, &w).expect("stable").to_vec()),
                (Output::Pose, all.pose.columns().as_flattened().to_vec()),
                (Output::Jacobian, all.jacobian.as_flattened().to_vec()),
                (
                    Output::ComplementaryStiffness,
                    all.complementary_stiffness.as_flattened().to_vec(),
                ),
                (Output::JointTorque, all.joint_torque.to_vec()),
                (Output::Compliance, all.compliance.as_flattened().to_vec()),
                (Output::Deflection, all.deflection.to_vec()),
            ];
            for (output, got) in outputs {
                let expected = arm.evaluate(output, q, &w).expect("stable");
                let scale = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                for (k, (a, b)) in got.iter().zip(&expected).enumerate() {
                    let off = (a - b).abs() / scale;
                    assert!(off < 1e-13, "{} entry {k}: {a} {b}", output.name());
                }
            }
        }
    }
}
