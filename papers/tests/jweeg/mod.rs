//! Jweeg & Al-Khafaji, "Kinematic analysis of semi-flexible robot" (2012): their equations against
//! the simulation of a chain with those displacements, and the size of the difference that they
//! publish.

#[allow(dead_code, reason = "what is generated stays whole")]
#[rustfmt::skip]
mod closed_form;
mod rpy;
mod two_link;

use nalgebra::{Matrix4, Vector3, Vector6};
use proptest::prelude::*;
use stiffarm_codegen::derive::{Displacements, Form, flexible};
use stiffarm_codegen::expr::Symbol;
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::displacement::Displacement;
use stiffarm_gap::simulate::{Actual, Site, State, rest};
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::methods::jweeg::growth::{self, Bend, TwoLink};
use two_link::{approximate, flexible as exact, strict};

/// Table 1 with lengths put in.
fn arm(a1: f64, a2: f64) -> Arm {
    let text = include_str!("../../../robots/arms/jweeg_two_link.toml")
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

/// A pose as a homogeneous matrix.
fn matrix(columns: [[f64; 3]; 4]) -> Matrix4<f64> {
    Matrix4::from_fn(|row, column| match row {
        3 => f64::from(column == 3),
        row => columns[column][row],
    })
}

/// A rigid arm with displacements at its places, by the simulation.
fn simulated(arm: &Arm, errors: &[Displacement], q: &[f64]) -> State {
    let mut rigid = arm.clone();
    for joint in &mut rigid.joints {
        (joint.compliance, joint.beam) = (0.0, None);
    }
    let mut actual = Actual::new(&rigid, q, &Vector6::zeros());
    for (site, error) in sites(arm).zip(errors) {
        *actual.fixed_at(site) = error.vector();
    }
    rest(&actual, None).unwrap()
}

/// The places of eq. 20.
fn sites(arm: &Arm) -> impl Iterator<Item = Site> {
    let rows = (0..arm.dof()).map(Site::Link);
    core::iter::once(Site::Base).chain(rows).chain([Site::Tool])
}

/// The chain in each form: eq. 20 with eq. 18, with eq. 19, and to the strict first order.
fn forms(arm: &Arm, errors: &[Displacement], q: &[f64]) -> [Matrix4<f64>; 3] {
    let still = simulated(arm, &vec![Displacement::ZERO; errors.len()], q);
    let each = sites(arm).zip(errors).map(|(site, error)| still.carry(site, &error.vector()));
    let twist: Vector6<f64> = each.sum();
    let nominal = arm.pose(q).to_homogeneous();
    let mut strict = nominal;
    let swung = twist.fixed_rows::<3>(3).into_owned().cross_matrix();
    let turned = nominal.fixed_view::<3, 3>(0, 0) + swung * nominal.fixed_view::<3, 3>(0, 0);
    strict.fixed_view_mut::<3, 3>(0, 0).copy_from(&turned);
    let moved = nominal.fixed_view::<3, 1>(0, 3) + twist.fixed_rows::<3>(0);
    strict.fixed_view_mut::<3, 1>(0, 3).copy_from(&moved);
    let product = |form: fn(&Displacement) -> Matrix4<f64>| rpy::product(arm, q, errors, form);
    // The simulation turns by rotation vectors: those of roll, pitch and yaw.
    let vectors: Vec<_> = errors.iter().map(|e| Displacement::of(&rpy::transform(e))).collect();
    let simulated = simulated(arm, &vectors, q).tool.to_homogeneous();
    assert!((product(rpy::matrix) - simulated).amax() < 1e-13);
    [product(rpy::matrix), product(rpy::first_order), strict]
}

/// The generated forms of arms in space, standard and modified, revolute and prismatic, with tools,
/// against the chain.
#[test]
fn generated_forms_are_the_chain() {
    for text in [
        include_str!("../../../robots/arms/ur5.toml"),
        include_str!("../../../robots/arms/kuka_kr240.toml"),
        include_str!("../../../robots/arms/stanford.toml"),
        TOOL,
    ] {
        let (robot, _) = Robot::from_toml(text, "arm.toml").unwrap();
        let arm = stiffarm_gap::robot::arm(&robot).unwrap();
        let n = robot.dof();
        let q: Vec<f64> = (0..n).map(|k| 0.9 - 0.37 * k as f64).collect();
        let entry = |place: usize, k: usize| 0.02 * ((7 * place + 3 * k) % 11) as f64 - 0.1;
        let errors: Vec<_> = (0..n + 2)
            .map(|place| Displacement::new(&Vector6::from_fn(|k, _| entry(place, k))))
            .collect();
        for (form, expected) in Form::EACH.into_iter().zip(forms(&arm, &errors, &q)) {
            let program = flexible(&robot, &Displacements::all(n), form);
            let found = program.graph.evaluate(&program.blocks[0].entries, |s| match s {
                Symbol::Joint(joint) => q[*joint],
                Symbol::Displacement { place, component } => entry(*place, *component),
                _ => f64::NAN,
            });
            let columns = core::array::from_fn(|c| core::array::from_fn(|r| found[3 * c + r]));
            // A few dozen roundings of numbers of order one.
            let off = (matrix(columns) - expected).amax();
            assert!(off < 1e-13, "{} {form:?} {off}", robot.name);
        }
    }
}

/// A tool turned about no axis of the last frame.
const TOOL: &str = "name = 'tool'\nconvention = 'standard'\n\
    [[joint]]\ntype = 'revolute'\nalpha = 'pi/2'\nd = 0.3\n\
    [[joint]]\ntype = 'prismatic'\ntheta = 'pi/6'\na = 0.2\nalpha = 0.4\n\
    [[joint]]\ntype = 'revolute'\na = 0.1\n\
    [tool]\ntranslation = [0.1, 0.2, -0.3]\nrotation = [0.3, -0.2, 0.9]\n";

proptest! {
    /// Eq. 20 with eq. 18 is eqs. 44-54, with eq. 19 it is eqs. 57 and 58, and its first order is
    /// the strict one.
    #[test]
    fn the_two_link_arm_is_the_chain(
        t in prop::array::uniform2(-3.0..3.0f64), e in prop::array::uniform6(-0.2..0.2f64),
    ) {
        let (arm, two) = (arm(0.4, 0.35), TwoLink { a1: 0.4, a2: 0.35 });
        let (bends, errors) = (bends(e), errors(bends(e)));
        let found = [exact(two, t, bends), approximate(two, t, bends), strict(two, t, bends)];
        for (found, expected) in found.into_iter().zip(forms(&arm, &errors, &t)) {
            prop_assert!((matrix(found.columns()) - expected).amax() < 1e-14);
        }
    }
}

/// The published largest differences are 6.3e-8 m in px and 2.9e-8 m in py. A weight at the tip of
/// two equal links that gives the first gives the second; it scales with the square of the weight.
#[test]
fn the_published_difference() {
    for length in [0.2, 0.4, 1.0] {
        let two = TwoLink { a1: length, a2: length };
        let unit = growth::largest(two, 1e-3, 0.0);
        assert!((unit[1].size / unit[0].size - 0.459).abs() < 5e-4);
        let w = 1e-3 * (6.3e-8 / unit[0].size).sqrt();
        let [px, py] = growth::largest(two, w, 0.0);
        assert!((px.size / 6.3e-8 - 1.0).abs() < 1e-3);
        assert!((py.size - 2.89e-8).abs() < 1e-10, "{py:?}");
        assert_eq!((px.degrees, py.degrees), ([4.0, -5.0], [4.0, 40.0]));
        for (part, expected) in [(1.0 / 3.0, [7.0e-9, 3.2e-9]), (2.0 / 3.0, [2.8e-8, 1.28e-8])] {
            let less = growth::largest(two, w * part, 0.0);
            assert!((less[0].size / expected[0] - 1.0).abs() < 0.01);
            assert!((less[1].size / expected[1] - 1.0).abs() < 0.01);
        }
        // The other reading of "the angles of joint with addition 40" cannot be told apart.
        let [px, py] = growth::largest(two, 1e-3, 40.0);
        assert!((py.size / px.size - 0.4536).abs() < 5e-4);
        assert_eq!((px.degrees, py.degrees), ([4.0, -35.0], [4.0, -5.0]));
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

/// In space the gap of both approximations grows with the square of the errors: ten times the errors,
/// a hundred times the gap.
#[test]
fn growth_in_space() {
    let arm = stiffarm_papers::methods::arm("ur5").unwrap();
    let error = Vector6::new(1e-4, -2e-4, 1e-4, 2e-4, -1e-4, 3e-4);
    let q = [0.3, -1.2, 0.9, 0.4, -0.8, 1.1];
    let gaps = |scale: f64| {
        let [exact, approximate, strict] =
            forms(&arm, &[Displacement::new(&(error * scale)); 8], &q);
        [(exact - approximate).norm(), (exact - strict).norm()]
    };
    for (small, large) in [(0.1, 1.0), (1.0, 10.0)] {
        for (small, large) in gaps(small).into_iter().zip(gaps(large)) {
            assert!((large / small - 100.0).abs() < 3.0);
        }
    }
}
