//! The two-link arm of Jweeg & Al-Khafaji (Table 1: α = d = 0): its flexible kinematics, their
//! approximation and the strict first order.
//!
//! The three poses are generated from the table (`stiffarm generate jweeg_two_link --emit rust
//! --flexible dx,dy,dphi`, in `closed_form.rs`); the same command gives them for any other arm.
//! Angles θ and dφ are in rad, lengths in m, positions in the base's x-y plane. With `x = a2 + δx2`
//! and `y = δy2` the tool is, exactly,
//!
//! ```text
//! px = cos θ1 (a1 + δx1) − sin θ1 δy1 + cos(θ12 + dφ1) x − sin(θ12 + dφ1) y
//! py = sin θ1 (a1 + δx1) + cos θ1 δy1 + sin(θ12 + dφ1) x + cos(θ12 + dφ1) y
//! ```
//!
//! where θ12 = θ1 + θ2: the turn dφ2 of the last tip does not enter the position.

use nalgebra::Vector2;
use proptest::prelude::*;
use stiffarm_kernels::Pose;
use stiffarm_papers::methods::jweeg::growth::{Bend, TwoLink};

use super::closed_form::{self, Parameters};

/// The flexible kinematic equation, eqs. 44 to 54, corrected.
pub fn flexible(two: TwoLink, theta: [f64; 2], bends: [Bend; 2]) -> Pose<f64> {
    closed_form::exact(&parameters(two), &theta, &places(bends))
}

/// The approximate flexible kinematic equation: the product of eq. 20 with the matrices of eq. 19,
/// its position eqs. 57 and 58 to the letter. It keeps the products dφ1 δx2 and dφ1 δy2, which the
/// paper says are taken as zero: [`strict`] leaves them out.
pub fn approximate(two: TwoLink, theta: [f64; 2], bends: [Bend; 2]) -> Pose<f64> {
    closed_form::published(&parameters(two), &theta, &places(bends))
}

/// The strict first order in δx, δy and dφ: the position is that of eqs. 57 and 58 plus `dφ1 (δx2
/// s12 + δy2 c12)` and `dφ1 (−δx2 c12 + δy2 s12)`. On the paper's rig these products are about as
/// large as the difference that it publishes.
pub fn strict(two: TwoLink, theta: [f64; 2], bends: [Bend; 2]) -> Pose<f64> {
    closed_form::first_order(&parameters(two), &theta, &places(bends))
}

fn parameters(two: TwoLink) -> Parameters<f64> {
    Parameters { a1: two.a1, a2: two.a2 }
}

/// The displacements of the chain's four places: base, the tips of both links, tool.
fn places(bends: [Bend; 2]) -> [[f64; 6]; 4] {
    let [one, two] = bends.map(|b| [b.dx, b.dy, 0.0, 0.0, 0.0, b.phi]);
    [[0.0; 6], one, two, [0.0; 6]]
}

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

fn place(pose: Pose<f64>) -> Vector2<f64> {
    assert_eq!(pose.position[2], 0.0);
    Vector2::new(pose.position[0], pose.position[1])
}

/// Deflections like those of the paper's rig: the products that eqs. 57 and 58 keep are as
/// large as the published difference.
#[test]
fn kept_products_are_as_large_as_the_difference() {
    let theta = [0.07, -0.09];
    let bends = [bend(3e-6, 1.25e-4, 5.6e-4), bend(3e-6, 5e-5, 2e-4)];
    let kept = (place(strict(ARM, theta, bends)) - place(approximate(ARM, theta, bends))).norm();
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
        prop_assert!((place(flexible(ARM, t, bends)) - compact(t, bends)).amax() < 1e-14);
        let direct = place(approximate(ARM, t, bends)) - place(flexible(ARM, t, bends));
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
}
