//! Joint torques and deflections.

use stiffarm_kernels::{Scalar, Unstable, margin};

use super::{Arm, C, V, complementary_stiffness_of, fma};

/// The deflection to first order, summed in F.
#[inline(always)]
pub fn deflection_first_order<S: Scalar>(q: &[S; 6], w: &[S; 6]) -> [S; 6] {
    let a = Arm::at(q);
    let [t1, t2, t3, t4, t5, t6] = torques_of(&a, w);
    let c = C.map(S::lit);
    let turns = [c[0] * t1, c[1] * t2, c[2] * t3, c[3] * t4, c[4] * t5, S::lit(1.0 / 4.7e5) * t6];
    displacement_of(&a, turns)
}

/// The joint torques of the wrench, in F.
#[inline(always)]
pub(super) fn torques_of<S: Scalar>(a: &Arm<S>, w: &[S; 6]) -> [S; 6] {
    let (v1, [v4, v5], [z4, z5, z6]) = a.twists();
    let to_f = |x: S, y: S, z: S| [fma(a.c1, x, a.s1 * y), z, fma(a.s1, x, -(a.c1 * y))];
    let (f, m) = (to_f(w[0], w[1], w[2]), to_f(w[3], w[4], w[5]));
    let dot = |a: V<S>, b: V<S>| fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]));
    [
        fma(v1[0], f[0], -(v1[1] * f[2])) + m[1],
        fma(a.r2[0], f[1], -(a.r2[1] * f[0])) + m[2],
        fma(a.r3[0], f[1], -(a.r3[1] * f[0])) + m[2],
        fma(z4[0], m[0], fma(z4[1], m[1], dot(v4, f))),
        dot(v5, f) + dot(z5, m),
        dot(z6, m),
    ]
}

/// What the joints' turns displace the tool by, summed in F.
#[inline(always)]
pub(super) fn displacement_of<S: Scalar>(a: &Arm<S>, [t1, t2, t3, t4, t5, t6]: [S; 6]) -> [S; 6] {
    let (v1, [v4, v5], [z4, z5, z6]) = a.twists();
    let v = [
        fma(v1[0], t1, fma(v4[0], t4, v5[0] * t5)) - fma(a.r2[1], t2, a.r3[1] * t3),
        fma(a.r2[0], t2, fma(a.r3[0], t3, fma(v4[1], t4, v5[1] * t5))),
        fma(v4[2], t4, fma(v5[2], t5, -(v1[1] * t1))),
    ];
    let z = [
        fma(z4[0], t4, fma(z5[0], t5, z6[0] * t6)),
        t1 + fma(z4[1], t4, fma(z5[1], t5, z6[1] * t6)),
        t2 + t3 + fma(z5[2], t5, z6[2] * t6),
    ];
    let ([vx, vy, vz], [zx, zy, zz]) = (a.to_base(v), a.to_base(z));
    [vx, vy, vz, zx, zy, zz]
}

/// The deflection with the loaded geometry.
///
/// # Errors
/// `Unstable` where the symmetric part of `Kθ − K_C` is not positive definite.
#[inline(always)]
pub fn deflection<S: Scalar>(q: &[S; 6], w: &[S; 6]) -> Result<[S; 6], Unstable> {
    let a = &Arm::at(q);
    let turns = turns_of(&complementary_stiffness_of(a, w), &torques_of(a, w), w)?;
    Ok(displacement_of(a, turns))
}

/// Force and moment, N and N·m, below which the arm is surely stable.
const MARGIN: [f64; 2] = [2.18e5, 1.35e5];

/// Solves `(Kθ − K_C) t = τ`. Nothing depends on θ6, so the first five joints are a system of their own.
#[inline(always)]
pub(super) fn turns_of<S: Scalar>(
    k_c: &[[S; 6]; 6],
    torque: &[S; 6],
    w: &[S; 6],
) -> Result<[S; 6], Unstable> {
    let [mut t1, mut t2, mut t3, mut t4, mut t5, t6] = *torque;
    let less = |x: S, a: S, b: S| fma(-a, b, x);
    let at = |row: usize, column: usize| {
        let k = k_c[column][row];
        if row == column { S::lit(if row < 5 { 1.0 / C[row] } else { 4.7e5 }) - k } else { -k }
    };
    let ([a11, mut a21, mut a31, mut a41, mut a51], [a12, mut a22, mut a32, mut a42, mut a52]) = (
        [at(0, 0), at(1, 0), at(2, 0), at(3, 0), at(4, 0)],
        [at(0, 1), at(1, 1), at(2, 1), at(3, 1), at(4, 1)],
    );
    let ([a13, mut a23, mut a33, mut a43, mut a53], [a14, mut a24, mut a34, mut a44, mut a54]) = (
        [at(0, 2), at(1, 2), at(2, 2), at(3, 2), at(4, 2)],
        [at(0, 3), at(1, 3), at(2, 3), at(3, 3), at(4, 3)],
    );
    let [a15, mut a25, mut a35, mut a45, mut a55] =
        [at(0, 4), at(1, 4), at(2, 4), at(3, 4), at(4, 4)];
    let i1 = a11.recip();
    (a21, a31, a41, a51) = (a21 * i1, a31 * i1, a41 * i1, a51 * i1);
    (a22, a32, a42, a52) =
        (less(a22, a21, a12), less(a32, a31, a12), less(a42, a41, a12), less(a52, a51, a12));
    (a23, a33, a43, a53) =
        (less(a23, a21, a13), less(a33, a31, a13), less(a43, a41, a13), less(a53, a51, a13));
    (a24, a34, a44, a54) =
        (less(a24, a21, a14), less(a34, a31, a14), less(a44, a41, a14), less(a54, a51, a14));
    (a25, a35, a45, a55) =
        (less(a25, a21, a15), less(a35, a31, a15), less(a45, a41, a15), less(a55, a51, a15));
    (t2, t3, t4, t5) = (less(t2, a21, t1), less(t3, a31, t1), less(t4, a41, t1), less(t5, a51, t1));
    let i2 = a22.recip();
    (a32, a42, a52) = (a32 * i2, a42 * i2, a52 * i2);
    (a33, a43, a53) = (less(a33, a32, a23), less(a43, a42, a23), less(a53, a52, a23));
    (a34, a44, a54) = (less(a34, a32, a24), less(a44, a42, a24), less(a54, a52, a24));
    (a35, a45, a55) = (less(a35, a32, a25), less(a45, a42, a25), less(a55, a52, a25));
    (t3, t4, t5) = (less(t3, a32, t2), less(t4, a42, t2), less(t5, a52, t2));
    let i3 = a33.recip();
    (a43, a53) = (a43 * i3, a53 * i3);
    (a44, a54) = (less(a44, a43, a34), less(a54, a53, a34));
    (a45, a55) = (less(a45, a43, a35), less(a55, a53, a35));
    (t4, t5) = (less(t4, a43, t3), less(t5, a53, t3));
    let i4 = a44.recip();
    a54 = a54 * i4;
    (a55, t5) = (less(a55, a54, a45), less(t5, a54, t4));
    if !margin(w, MARGIN.map(S::lit)).is_positive() && !definite(at) {
        return Err(Unstable);
    }
    t5 = t5 * a55.recip();
    t4 = less(t4, a45, t5) * i4;
    t3 = less(less(t3, a35, t5), a34, t4) * i3;
    t2 = less(less(less(t2, a25, t5), a24, t4), a23, t3) * i2;
    t1 = less(less(less(less(t1, a15, t5), a14, t4), a13, t3), a12, t2) * i1;
    let row = [k_c[0][5], k_c[1][5], k_c[2][5], k_c[3][5], k_c[4][5]];
    let own =
        fma(row[0], t1, fma(row[1], t2, fma(row[2], t3, fma(row[3], t4, fma(row[4], t5, t6)))));
    Ok([t1, t2, t3, t4, t5, S::lit(1.0 / 4.7e5) * own])
}

/// Whether the pivots of `L D Lᵀ` of a matrix and its transpose together are positive.
#[inline(always)]
#[allow(clippy::needless_range_loop, reason = "rows and columns of a matrix")]
fn definite<S: Scalar>(at: impl Fn(usize, usize) -> S) -> bool {
    let mut twice: [[S; 6]; 6] = core::array::from_fn(|column| {
        core::array::from_fn(|row| at(row, column) + at(column, row))
    });
    let mut positive = true;
    for k in 0..6 {
        positive &= twice[k][k].is_positive();
        let inverse = twice[k][k].recip();
        for column in k + 1..6 {
            let factor = -(twice[k][column] * inverse);
            for row in column..6 {
                twice[column][row] = fma(factor, twice[k][row], twice[column][row]);
            }
        }
    }
    positive
}
