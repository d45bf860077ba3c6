//! The compliance of the tool.

use stiffarm_kernels::Scalar;

use super::{C, fma, jacobian};

/// The compliance, summed by joint in base axes; joints 2 and 3 share their axis.
#[inline(always)]
pub fn compliance<S: Scalar>(q: &[S; 6]) -> [[S; 6]; 6] {
    compliance_of(&jacobian(q))
}

#[inline(always)]
pub(super) fn compliance_of<S: Scalar>([j1, j2, j3, j4, j5, j6]: &[[S; 6]; 6]) -> [[S; 6]; 6] {
    let zero = S::lit(0.0);
    let c = C.map(S::lit);
    let scaled = |k: S, j: &[S; 6]| [k * j[0], k * j[1], k * j[2]];
    let (k1, k2, k3) = (scaled(c[0], j1), scaled(c[1], j2), scaled(c[2], j3));
    let (k4, k5) = (scaled(c[3], j4), scaled(c[4], j5));
    let mut out = [[zero; 6]; 6];
    for i in 0..3 {
        for r in i..3 {
            let last = fma(k4[i], j4[r], k5[i] * j5[r]);
            let mid = fma(k2[i], j2[r], fma(k3[i], j3[r], last));
            out[i][r] = if r < 2 { fma(k1[i], j1[r], mid) } else { mid };
            out[r][i] = out[i][r];
        }
        let both = k2[i] + k3[i];
        for r in 0..3 {
            let last = fma(k4[i], j4[3 + r], k5[i] * j5[3 + r]);
            let value = if r < 2 { fma(both, j2[3 + r], last) } else { last };
            out[i][3 + r] = if r == 2 && i < 2 { k1[i] + value } else { value };
            out[3 + r][i] = out[i][3 + r];
        }
    }
    let both = S::lit(C[1] + C[2]);
    let turned = |k: S, j: &[S; 6]| [k * j[3], k * j[4], k * j[5]];
    let k2 = [both * j2[3], both * j2[4]];
    let (k4, k5, k6) = (turned(c[3], j4), turned(c[4], j5), turned(S::lit(1.0 / 4.7e5), j6));
    for i in 0..3 {
        for r in i..3 {
            let last = fma(k4[i], j4[3 + r], fma(k5[i], j5[3 + r], k6[i] * j6[3 + r]));
            let value = if r < 2 { fma(k2[i], j2[3 + r], last) } else { last };
            out[3 + i][3 + r] = if i == 2 { c[0] + value } else { value };
            out[3 + r][3 + i] = out[3 + i][3 + r];
        }
    }
    out
}
