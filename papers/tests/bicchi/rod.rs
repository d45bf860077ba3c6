//! A geometrically exact planar rod, which shares no code with the recursion.
//!
//! The wrench is known in the tip's frame, so each link is an initial value problem from its tip:
//! with the tip at the origin, `r' = −(1 + n/EA) t`, `θ' = −M/EJ`, `M = m − r × f`, by Runge and
//! Kutta's method of the fourth order. At a joint the direction turns back by `q + k_c M`.

use stiffarm_kernels::generic::Arm;

const STEPS: usize = 200;

/// The wrench in the base (fx, fy, mz) and the tip there (x, y, angle), of an arm whose links lie
/// along x (`α = d = 0`), under (fx, fy, mz) in the tip's frame. The links do not stretch if
/// `stretch` is false.
pub fn exact(arm: &Arm, q: &[f64], [fx, fy, m]: [f64; 3], stretch: bool) -> ([f64; 3], [f64; 3]) {
    // x, y and direction in the tip's frame.
    let mut at = [0.0; 3];
    let moment = |at: &[f64; 3]| m - (at[0] * fy - at[1] * fx);
    for (joint, q) in arm.joints.iter().zip(q).rev() {
        let beam = joint.beam.as_ref().unwrap();
        let (ej, ea) = (beam.youngs_modulus * beam.iz, beam.youngs_modulus * beam.area);
        let rate = |at: &[f64; 3]| {
            let (s, c) = at[2].sin_cos();
            let longer = if stretch { 1.0 + (fx * c + fy * s) / ea } else { 1.0 };
            [-longer * c, -longer * s, -moment(at) / ej]
        };
        let h = joint.a / STEPS as f64;
        for _ in 0..STEPS {
            let along = |k: &[f64; 3], part: f64| -> [f64; 3] {
                std::array::from_fn(|i| at[i] + part * h * k[i])
            };
            let k1 = rate(&at);
            let k2 = rate(&along(&k1, 0.5));
            let k3 = rate(&along(&k2, 0.5));
            let k4 = rate(&along(&k3, 1.0));
            let sum = |i: usize| k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i];
            at = std::array::from_fn(|i| at[i] + h / 6.0 * sum(i));
        }
        at[2] -= q + joint.compliance * moment(&at);
    }
    let (s, c) = at[2].sin_cos();
    let turned = |x: f64, y: f64| [c * x + s * y, -s * x + c * y];
    let ([wx, wy], [x, y]) = (turned(fx, fy), turned(-at[0], -at[1]));
    ([wx, wy, moment(&at)], [x, y, -at[2]])
}

#[test]
fn a_link_under_a_moment_is_an_arc() {
    let mut arm = super::arms::arm(3, 500.0);
    arm.joints.truncate(1);
    arm.joints[0].compliance = 0.0;
    let curvature = 100.0 / 500.0_f64;
    let (wrench, tip) = exact(&arm, &[0.0], [0.0, 0.0, 100.0], true);
    let arc = [curvature.sin() / curvature, (1.0 - curvature.cos()) / curvature, curvature];
    super::arms::assert_close(&tip, &arc, 1e-13);
    assert_eq!(wrench, [0.0, 0.0, 100.0]);
}
