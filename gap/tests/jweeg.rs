//! Jweeg & Al-Khafaji, "Kinematic analysis of semi-flexible robot" (2012): their equations against
//! the chain, and the size of the difference that they publish.

use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::chain::two_link::{Bend, TwoLink};
use stiffarm_gap::chain::{Chain, Displacement, growth, rpy};
use stiffarm_kernels::generic::Arm;

/// Table 1 with lengths put in.
fn arm(a1: f64, a2: f64) -> Arm {
    let text = include_str!("../../robots/arms/jweeg_two_link.toml")
        .replace("a = \"a1\"", &format!("a = {a1:?}"))
        .replace("a = \"a2\"", &format!("a = {a2:?}"));
    stiffarm_gap::robot::arm(&Robot::from_toml(&text, "jweeg.toml").unwrap().0).unwrap()
}

fn planar(bend: Bend) -> Displacement {
    let translation = Vector3::new(bend.dx, bend.dy, 0.0);
    Displacement { translation, rotation: Vector3::new(0.0, 0.0, bend.phi) }
}

fn errors(bends: [Bend; 2]) -> [Displacement; 4] {
    [Displacement::ZERO, planar(bends[0]), planar(bends[1]), Displacement::ZERO]
}

fn bends(e: [f64; 6]) -> [Bend; 2] {
    [Bend { dx: e[0], dy: e[1], phi: e[2] }, Bend { dx: e[3], dy: e[4], phi: e[5] }]
}

proptest! {
    /// Eq. 20 with eq. 18 is eqs. 44-54, with eq. 19 it is eqs. 57 and 58, and its first order is
    /// the strict one.
    #[test]
    fn the_two_link_arm_is_the_chain(
        t in prop::array::uniform2(-3.0..3.0f64), e in prop::array::uniform6(-0.2..0.2f64),
    ) {
        let (arm, two) = (arm(0.4, 0.35), TwoLink { a1: 0.4, a2: 0.35 });
        let (bends, errors) = (bends(e), errors(bends(e)));
        let chain = Chain::new(&arm, &errors).unwrap();
        let exact = chain.product(&t, rpy::matrix).unwrap();
        prop_assert!((exact.fixed_view::<2, 1>(0, 3) - two.flexible(t, bends)).amax() < 1e-14);
        let turn = TwoLink::orientation(t, bends);
        prop_assert!((exact.fixed_view::<2, 2>(0, 0) - turn).amax() < 1e-14);
        let vector = chain.pose(&t).unwrap().to_homogeneous();
        prop_assert!((exact - vector).amax() < 1e-14);
        let approximate = chain.product(&t, rpy::first_order).unwrap();
        let published = two.approximate(t, bends);
        prop_assert!((approximate.fixed_view::<2, 1>(0, 3) - published).amax() < 1e-14);
        let nominal = arm.pose(&t).translation.vector;
        let strict = nominal.fixed_rows::<2>(0) + chain.displacement_first_order(&t).unwrap()
            .fixed_rows::<2>(0);
        prop_assert!((strict - two.strict(t, bends)).amax() < 1e-14);
    }

    /// Eqs. 41-43: the position with any α and d, links bending in their x-y planes.
    #[test]
    fn the_general_position(
        t in prop::array::uniform2(-3.0..3.0f64),
        alpha in prop::array::uniform2(-3.0..3.0f64),
        d in prop::array::uniform2(-0.5..0.5f64),
        e in prop::array::uniform6(-0.2..0.2f64),
    ) {
        let mut arm = arm(0.4, 0.35);
        for (k, joint) in arm.joints.iter_mut().enumerate() {
            (joint.alpha, joint.d) = (alpha[k], d[k]);
        }
        let ([one, two], errors) = (bends(e), errors(bends(e)));
        let found = Chain::new(&arm, &errors).unwrap().pose(&t).unwrap().translation.vector;
        let ((s1, c1), (s2, c2)) = (t[0].sin_cos(), t[1].sin_cos());
        let ((sa1, ca1), (sa2, ca2)) = (alpha[0].sin_cos(), alpha[1].sin_cos());
        let (sd1, cd1) = one.phi.sin_cos();
        let (x, y) = (two.dx + 0.35, two.dy);
        let px = c1 * c2 * (cd1 * x - sd1 * y * ca2) - c1 * s2 * (cd1 * ca2 * y + sd1 * x)
            - s1 * c2 * (ca1 * sd1 * x + ca1 * cd1 * y * ca2)
            + s1 * s2 * (ca1 * sd1 * ca2 * y - ca1 * cd1 * x)
            + sa1 * s1 * sa2 * y + sa1 * s1 * d[1] + c1 * (one.dx + 0.4) - ca1 * s1 * one.dy;
        let py = s1 * c2 * (cd1 * x - sd1 * y * ca2) - s1 * s2 * (sd1 * x + cd1 * ca2 * y)
            + c1 * c2 * (sd1 * ca1 * x + cd1 * ca1 * y * ca2)
            + c1 * s2 * (cd1 * ca1 * x - sd1 * ca1 * ca2 * y)
            + c1 * (ca1 * one.dy - sa1 * sa2 * y - sa1 * d[1]) + s1 * (one.dx + 0.4);
        let pz = c2 * (sa1 * sd1 * x + sa1 * cd1 * y * ca2)
            + s2 * (sa1 * cd1 * x - sa1 * sd1 * ca2 * y)
            + ca1 * sa2 * y + ca1 * d[1] + sa1 * one.dy + d[0];
        prop_assert!((found - Vector3::new(px, py, pz)).amax() < 1e-14);
    }
}

/// Largest px and py of the difference on the paper's grid of postures and where they stand (deg),
/// for the first link's turn of a cantilever under a weight at the arm's tip, `dφ1 = w (a1² cos
/// θ1/2 + a1 a2 cos θ12)`. `offset` is added to θ1.
fn largest(two: TwoLink, w: f64, offset: f64) -> [(f64, f64, f64); 2] {
    let mut found = [(0.0, 0.0, 0.0); 2];
    for i in 0..6 {
        for j in 0..20 {
            let (d1, d2) = (4.0 + 5.0 * f64::from(i), -35.0 + 5.0 * f64::from(j));
            let t = [(d1 + offset).to_radians(), d2.to_radians()];
            let bending = two.a1 * t[0].cos() / 2.0 + two.a2 * (t[0] + t[1]).cos();
            let bend = Bend { phi: w * two.a1 * bending, ..Bend::default() };
            let difference: Vector2<f64> = two.difference(t, [bend, Bend::default()]);
            for (best, size) in found.iter_mut().zip(difference.iter()) {
                if size.abs() > best.0 {
                    *best = (size.abs(), d1, d2);
                }
            }
        }
    }
    found
}

/// The published largest differences are 6.3e-8 m in px and 2.9e-8 m in py. A weight at the tip of
/// two equal links that gives the first gives the second; it scales with the square of the weight.
#[test]
fn the_published_difference() {
    for length in [0.2, 0.4, 1.0] {
        let two = TwoLink { a1: length, a2: length };
        let unit = largest(two, 1e-3, 0.0);
        assert!((unit[1].0 / unit[0].0 - 0.459).abs() < 5e-4);
        let w = 1e-3 * (6.3e-8 / unit[0].0).sqrt();
        let [px, py] = largest(two, w, 0.0);
        assert!((px.0 / 6.3e-8 - 1.0).abs() < 1e-3);
        assert!((py.0 - 2.89e-8).abs() < 1e-10, "{py:?}");
        assert_eq!(((px.1, px.2), (py.1, py.2)), ((4.0, -5.0), (4.0, 40.0)));
        for (part, expected) in [(1.0 / 3.0, [7.0e-9, 3.2e-9]), (2.0 / 3.0, [2.8e-8, 1.28e-8])] {
            let less = largest(two, w * part, 0.0);
            assert!((less[0].0 / expected[0] - 1.0).abs() < 0.01);
            assert!((less[1].0 / expected[1] - 1.0).abs() < 0.01);
        }
        // The other reading of "the angles of joint with addition 40" cannot be told apart.
        let [px, py] = largest(two, 1e-3, 40.0);
        assert!((py.0 / px.0 - 0.4536).abs() < 5e-4);
        assert_eq!(((px.1, px.2), (py.1, py.2)), ((4.0, -35.0), (4.0, -5.0)));
    }
}

/// The turn that the published px implies, for lengths of the second link that the text leaves
/// open.
#[test]
fn the_turn_behind_the_published_difference() {
    for (a2, phi) in
        [(0.2, 7.94e-4), (0.3, 6.48e-4), (0.4, 5.61e-4), (0.5, 5.02e-4), (1.0, 3.55e-4)]
    {
        let row = growth::two_link(a2, &[phi])[0];
        assert!((row.difference / 6.3e-8 - 1.0).abs() < 3e-3, "{row:?}");
    }
}

/// The difference in space: a six-joint arm's errors grown tenfold make it a hundred times larger.
#[test]
fn growth_in_space() {
    let text = include_str!("../../robots/arms/ur5.toml");
    let arm = stiffarm_gap::robot::arm(&Robot::from_toml(text, "ur5.toml").unwrap().0).unwrap();
    let error = Displacement {
        translation: Vector3::new(1e-4, -2e-4, 1e-4),
        rotation: Vector3::new(2e-4, -1e-4, 3e-4),
    };
    let q = [0.3, -1.2, 0.9, 0.4, -0.8, 1.1];
    let rows = growth::chain(&arm, &q, &[error; 8], &[0.1, 1.0, 10.0]).unwrap();
    for pair in rows.windows(2) {
        assert!((pair[1].approximate / pair[0].approximate - 100.0).abs() < 3.0);
        assert!((pair[1].strict / pair[0].strict - 100.0).abs() < 3.0);
    }
}
