use super::works::Works;
use super::*;
use crate::fixture;
use crate::rng::{Rng, Stream};

/// Three joints, one of which slides, with whole tensors.
fn weighty(convention: &str) -> Arm {
    let row = |kind: &str, k: usize| {
        let numbers = format!(
            "theta = 0.{k}1\nd = 0.{k}3\na = 0.{k}5\nalpha = 0.{k}7\nmass = {k}.5\ncom = [0.1, -0.{k}, 0.05]"
        );
        let inertia = "inertia = [0.3, 0.02, -0.03, 0.4, 0.01, 0.35]";
        format!("[[joint]]\ntype = \"{kind}\"\n{numbers}\n{inertia}\n")
    };
    let rows = [row("revolute", 1), row("prismatic", 2), row("revolute", 3)].concat();
    fixture::arm(&format!("name = \"weighty\"\nconvention = \"{convention}\"\n{rows}"))
}

/// A body that is moved is the body whose centre is there, and whose tensor is turned.
#[test]
fn a_body_is_the_same_in_another_frame() {
    let (com, mass) = (Vector3::new(0.1, -0.2, 0.3), 2.5);
    let root = Matrix3::new(0.3, 0.1, -0.2, 0.4, 0.5, 0.6, -0.1, 0.2, 0.7);
    let inertia = root * root.transpose();
    let frame = Isometry3::new(Vector3::new(0.5, 0.4, -0.3), Vector3::new(0.7, -0.4, 1.1));
    let turn = frame.rotation.to_rotation_matrix();
    let expected = body(
        mass,
        &(frame * nalgebra::Point3::from(com)).coords,
        &(turn * inertia * turn.transpose()),
    );
    for (found, expected) in moved(&frame, &body(mass, &com, &inertia)).iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
}

/// Against the textbook's, which turns a unit of each number into the base's axes.
#[test]
fn what_the_moments_ask_is_what_the_textbook_says() {
    let mut rng = Rng::new(3, Stream::Poses);
    for arm in ["standard", "modified"].map(weighty) {
        let (n, works) = (arm.dof(), Works::of(&arm));
        let mut asks = vec![0.0; 10 * n * n];
        for _ in 0..100 {
            let motion = [3.0, 2.0, 5.0].map(|most| (0..n).map(|_| most * rng.normal()).collect());
            let [q, rates, accelerations]: [Vec<f64>; 3] = motion;
            works.regressor([&q, &rates, &accelerations], &mut asks);
            let expected = arm.torque_regressor(&q, &rates, &accelerations);
            let off = DMatrix::from_column_slice(n, 10 * n, &asks) - &expected;
            // Some hundred roundings of terms of this size.
            assert!(off.amax() < 1e-13 * expected.amax(), "{:e}", off.amax());
            let moments = arm.moments();
            let torques = works.torques([&q, &rates, &accelerations], &moments);
            let expected = expected * nalgebra::DVector::from_vec(moments);
            let off = nalgebra::DVector::from_vec(torques) - &expected;
            assert!(off.amax() < 1e-12 * expected.amax(), "{:e}", off.amax());
        }
    }
}

/// Every column is the sum of base columns that the mix says: at a motion that no one has drawn.
#[test]
fn all_columns_are_sums_of_base_columns() {
    let arm = weighty("standard");
    let base = Base::of(&arm);
    let motion = |from: f64| (0..arm.dof()).map(|k| from - 0.6 * k as f64).collect::<Vec<f64>>();
    let regressor = arm.torque_regressor(&motion(0.9), &motion(-0.3), &motion(2.0));
    let sums = regressor.select_columns(&base.columns) * &base.mix;
    assert!((sums - &regressor).amax() < 1e-9 * regressor.amax());
}
