//! The two-link arm of Jweeg & Al-Khafaji (Table 1: α = d = 0): its flexible kinematics, their
//! approximation, the strict first order, and the difference in closed form.
//!
//! Angles θ and dφ are in rad, lengths in m, positions in the base's x-y plane. With `x = a2 + δx2`
//! and `y = δy2` the tool is, exactly,
//!
//! ```text
//! px = cos θ1 (a1 + δx1) − sin θ1 δy1 + cos(θ12 + dφ1) x − sin(θ12 + dφ1) y
//! py = sin θ1 (a1 + δx1) + cos θ1 δy1 + sin(θ12 + dφ1) x + cos(θ12 + dφ1) y
//! ```
//!
//! where θ12 = θ1 + θ2: the turn dφ2 of the last tip does not enter the position.

use nalgebra::{Matrix2, Vector2};

use super::displacement::{lag, versine};

/// How one link's tip is displaced in the frame of its undeformed tip (eq. 27).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bend {
    /// δx, along the link, m.
    pub dx: f64,
    /// δy, across it, m.
    pub dy: f64,
    /// dφ, rad.
    pub phi: f64,
}

/// Lengths of the two links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLink {
    /// a1, m.
    pub a1: f64,
    /// a2, m.
    pub a2: f64,
}

/// Sines and cosines as eqs. 53-58 need them.
struct Angles {
    s1: f64,
    c1: f64,
    s2: f64,
    c2: f64,
}

impl Angles {
    fn new(theta: [f64; 2]) -> Self {
        let ((s1, c1), (s2, c2)) = (theta[0].sin_cos(), theta[1].sin_cos());
        Self { s1, c1, s2, c2 }
    }
}

impl TwoLink {
    /// Eqs. 53 and 54 with any `s`, `c` in the places of sin dφ1 and cos dφ1.
    fn printed(&self, theta: [f64; 2], [one, two]: [Bend; 2], s: f64, c: f64) -> Vector2<f64> {
        let Angles { s1, c1, s2, c2 } = Angles::new(theta);
        let (x, y) = (two.dx + self.a2, two.dy);
        let px = c1 * c2 * (c * x - s * y) - c1 * s2 * (c * y + s * x) - s1 * c2 * (s * x + c * y)
            + s1 * s2 * (s * y - c * x)
            + c1 * (one.dx + self.a1)
            - s1 * one.dy;
        let py = s1 * c2 * (c * x - s * y) - s1 * s2 * (s * x + c * y)
            + c1 * c2 * (s * x + c * y)
            + c1 * s2 * (c * x - s * y)
            + c1 * one.dy
            + s1 * (one.dx + self.a1);
        Vector2::new(px, py)
    }

    /// The flexible kinematic equation, eqs. 53 and 54, m.
    pub fn flexible(&self, theta: [f64; 2], bends: [Bend; 2]) -> Vector2<f64> {
        let (s, c) = bends[0].phi.sin_cos();
        self.printed(theta, bends, s, c)
    }

    /// The approximate flexible kinematic equation, eqs. 57 and 58 literally, m: the product of
    /// eq. 20 with the matrices of eq. 19. It keeps the products dφ1 δx2 and dφ1 δy2, which the
    /// paper says are taken as zero: [`TwoLink::strict`] leaves them out.
    pub fn approximate(&self, theta: [f64; 2], bends: [Bend; 2]) -> Vector2<f64> {
        self.printed(theta, bends, bends[0].phi, 1.0)
    }

    /// The strict first order in δx, δy and dφ, m: eqs. 57 and 58 plus `dφ1 (δx2 s12 + δy2 c12)`
    /// and `dφ1 (−δx2 c12 + δy2 s12)`. On the paper's rig these products are about as large as
    /// the difference that it publishes.
    pub fn strict(&self, theta: [f64; 2], bends: [Bend; 2]) -> Vector2<f64> {
        let (s12, c12) = (theta[0] + theta[1]).sin_cos();
        let (phi, two) = (bends[0].phi, bends[1]);
        let products = Vector2::new(two.dx * s12 + two.dy * c12, -two.dx * c12 + two.dy * s12);
        self.approximate(theta, bends) + phi * products
    }

    /// The approximate minus the flexible equation, m, without cancellation at any size:
    ///
    /// ```text
    /// Δpx = X (1 − cos f) − Y (f − sin f)      X = c12 (a2 + δx2) − s12 δy2
    /// Δpy = Y (1 − cos f) + X (f − sin f)      Y = s12 (a2 + δx2) + c12 δy2,  f = dφ1
    /// ```
    ///
    /// Neither δx1, δy1 nor dφ2 enters. It grows with the square of dφ1.
    pub fn difference(&self, theta: [f64; 2], bends: [Bend; 2]) -> Vector2<f64> {
        let (s12, c12) = (theta[0] + theta[1]).sin_cos();
        let (x, y) = (self.a2 + bends[1].dx, bends[1].dy);
        let arm = Vector2::new(c12 * x - s12 * y, s12 * x + c12 * y);
        let (square, cube) = (versine(bends[0].phi), lag(bends[0].phi));
        Vector2::new(arm.x * square - arm.y * cube, arm.y * square + arm.x * cube)
    }

    /// The orientation of the tool, columns n and o in the plane: eqs. 44, 45, 47 and 48, corrected
    /// (`s1 s2 sd12` has sd12, not sd1−2, and a minus in eq. 45; `c1 s2` stands with cd12 in eq.
    /// 47; `s12` with sd12 in eq. 48). cd1−2 and sd1−2 of eq. 56 are not needed.
    pub fn orientation(theta: [f64; 2], bends: [Bend; 2]) -> Matrix2<f64> {
        let Angles { s1, c1, s2, c2 } = Angles::new(theta);
        let (sd12, cd12) = (bends[0].phi + bends[1].phi).sin_cos();
        let (s12, c12) = (theta[0] + theta[1]).sin_cos();
        let nx = c12 * cd12 - s12 * sd12;
        let ny = c1 * c2 * sd12 - s1 * s2 * sd12 + c2 * s1 * cd12 + c1 * s2 * cd12;
        let ox = s1 * s2 * sd12 - c1 * c2 * sd12 - c1 * s2 * cd12 - s1 * c2 * cd12;
        let oy = c12 * cd12 - s12 * sd12;
        Matrix2::new(nx, ox, ny, oy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ARM: TwoLink = TwoLink { a1: 0.4, a2: 0.35 };

    fn bend(dx: f64, dy: f64, phi: f64) -> Bend {
        Bend { dx, dy, phi }
    }

    /// The compact form of this file's head.
    fn compact([t1, t2]: [f64; 2], [one, two]: [Bend; 2]) -> Vector2<f64> {
        let turn = nalgebra::Rotation2::new;
        turn(t1) * Vector2::new(ARM.a1 + one.dx, one.dy)
            + turn(t1 + t2 + one.phi) * Vector2::new(ARM.a2 + two.dx, two.dy)
    }

    /// θ = 20°, 30°, dφ = 0.01, 0.02: the corrected equations, and what the printed ones give.
    #[test]
    fn orientation_and_the_misprints() {
        let theta = [20f64.to_radians(), 30f64.to_radians()];
        let bends = [bend(0.0, 0.0, 0.01), bend(0.0, 0.0, 0.02)];
        let found = TwoLink::orientation(theta, bends);
        let sum = theta[0] + theta[1] + 0.03;
        assert!((found - nalgebra::Rotation2::new(sum).into_inner()).amax() < 1e-15);
        assert!((found[(1, 0)] - 0.784980484849).abs() < 1e-12);
        assert!((found[(0, 1)] + 0.784980484849).abs() < 1e-12);
        assert!((found[(1, 1)] - 0.619520490707).abs() < 1e-12);

        let Angles { s1, c1, s2, c2 } = Angles::new(theta);
        let ((sp, cp), (sm, cm)) = (0.03f64.sin_cos(), (-0.01f64).sin_cos());
        let (s12, c12) = (theta[0] + theta[1]).sin_cos();
        let eq45 = c1 * c2 * sp + s1 * s2 * sm + c2 * s1 * cm + c1 * s2 * cp;
        let eq47 = s1 * s2 * sm - c1 * c2 * sp - c1 * s2 * cm - s1 * c2 * cp;
        let eq48 = c12 * cp - s12 * sm;
        assert!((eq45 - 0.788518414654).abs() < 1e-12);
        assert!((eq47 + 0.792008012567).abs() < 1e-12);
        assert!((eq48 - 0.650158693713).abs() < 1e-12);
        // What the misprints add, in closed form.
        let [t1, t2] = theta;
        let added = 2.0 * 0.01f64.sin() * t1.sin() * (t2 + 0.02).sin();
        assert!((eq45 - found[(1, 0)] - added).abs() < 1e-15);
        let added = -2.0 * 0.02f64.sin() * t2.sin() * (t1 + 0.01).sin();
        assert!((eq47 - found[(0, 1)] - added).abs() < 1e-15);
        let added = 2.0 * 0.02f64.sin() * 0.01f64.cos() * (t1 + t2).sin();
        assert!((eq48 - found[(1, 1)] - added).abs() < 1e-15);
    }

    /// Deflections like those of the paper's rig: the products that eqs. 57 and 58 keep are as
    /// large as the published difference.
    #[test]
    fn kept_products_are_as_large_as_the_difference() {
        let theta = [0.07, -0.09];
        let bends = [bend(3e-6, 1.25e-4, 5.6e-4), bend(3e-6, 5e-5, 2e-4)];
        let kept = (ARM.strict(theta, bends) - ARM.approximate(theta, bends)).norm();
        assert!((kept - 2.8e-8).abs() < 1e-9, "{kept}");
        let difference = ARM.difference(theta, bends).norm();
        assert!((0.4..2.0).contains(&(kept / difference)), "{difference}");
    }

    proptest! {
        #[test]
        fn flexible_is_the_compact_form(
            t in prop::array::uniform2(-3.0..3.0f64), e in prop::array::uniform6(-0.3..0.3f64),
        ) {
            let bends = [bend(e[0], e[1], e[2]), bend(e[3], e[4], e[5])];
            prop_assert!((ARM.flexible(t, bends) - compact(t, bends)).amax() < 1e-14);
            let direct = ARM.approximate(t, bends) - ARM.flexible(t, bends);
            prop_assert!((ARM.difference(t, bends) - direct).amax() < 1e-14);
        }

        /// Against its own series: no digit is lost in small turns.
        #[test]
        fn the_difference_is_stable(t in -3.0..3.0f64, exponent in -12.0..-3.0f64) {
            let phi = 10f64.powf(exponent);
            let found = ARM.difference([t, 0.2], [bend(0.0, 0.0, phi), Bend::default()]);
            let (s, c) = (t + 0.2).sin_cos();
            let (square, cube) = (phi * phi / 2.0, phi * phi * phi / 6.0);
            let (square, cube) =
                (square * (1.0 - phi * phi / 12.0), cube * (1.0 - phi * phi / 20.0));
            let expected =
                ARM.a2 * Vector2::new(c * square - s * cube, s * square + c * cube);
            prop_assert!((found - expected).norm() < 1e-11 * expected.norm());
        }

        #[test]
        fn strict_is_linear(t in prop::array::uniform2(-3.0..3.0f64)) {
            let bends = |h: f64| [bend(h, 2.0 * h, -h), bend(-h, 3.0 * h, h)];
            let change = |h: f64| ARM.strict(t, bends(h)) - ARM.strict(t, bends(0.0));
            prop_assert!((change(1.0) - change(1e-2) * 100.0).amax() < 1e-12);
            let exact = ARM.flexible(t, bends(1e-6)) - ARM.flexible(t, bends(0.0));
            prop_assert!((change(1e-6) - exact).amax() < 1e-10);
        }
    }
}
