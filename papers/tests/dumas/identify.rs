//! Eqs. 20-26 and the validation of section 5.3.

use crate::method::rig::{Errors, PoseFit, Rig};
use crate::method::{IdentifyError, System, Test, Weighting, identify, normal_equations, validate};
use nalgebra::{DMatrix, DVector};
use stiffarm_kernels::generic::Arm;

use crate::robot::{carried_out, near, with_tool};

/// Tests whose displacements are eq. 17 exactly.
fn linear(arm: &Arm, count: usize) -> Vec<Test> {
    let mut tests = Rig::dumas().plan(arm, count, 5);
    for test in &mut tests {
        test.displacement = arm.deflection_first_order(&test.q, &test.wrench);
    }
    tests
}

fn rigid(arm: &Arm) -> Arm {
    let mut rigid = arm.clone();
    rigid.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    rigid
}

/// The model's own stiffnesses are not read: the arm that is fitted is rigid. One test of six rows is a
/// square system (eq. 20).
#[test]
fn exact_displacements_give_the_stiffnesses_back() {
    let arm = with_tool();
    for (weighting, count) in
        [(Weighting::SI, 10), (Weighting::triangle(3e-5, 0.25), 10), (Weighting::SI, 1)]
    {
        let tests = linear(&arm, count);
        let found = identify(&rigid(&arm), &tests, &weighting).unwrap();
        let system = System::stack(&rigid(&arm), &tests, &weighting).unwrap();
        for by in [&found.compliances, &normal_equations(&system).unwrap()] {
            for (compliance, joint) in by.iter().zip(&arm.joints) {
                near(compliance / joint.compliance, 1.0, if count > 1 { 1e-11 } else { 1e-9 });
            }
        }
        assert_eq!(found.applied_to(&arm).dof(), 6);
    }
}

/// What a design does not show is refused by name.
#[test]
fn what_the_tests_do_not_show_is_refused() {
    let arm = with_tool();
    let planned = |rig: &Rig, count: usize| {
        let mut tests = rig.plan(&arm, count, 1);
        for test in &mut tests {
            test.displacement = arm.deflection_first_order(&test.q, &test.wrench);
        }
        tests
    };
    // A vertical pull, wherever it hangs, has no moment about the vertical axis 1; the tool point
    // lies on axis 6, so that translations cannot see joint 6 and no force loads it; one test of
    // three rows shows only combinations of the other five.
    let vertical = Rig { tilt: [0.0, 0.0], ..Rig::dumas() };
    let through = Rig { lever: 0.0, ..Rig::dumas() };
    for (rig, count, weighting, open) in [
        (vertical, 23, Weighting::SI, vec![1]),
        (Rig::dumas(), 10, Weighting::TRANSLATIONS, vec![6]),
        (through, 10, Weighting::SI, vec![6]),
        (Rig::dumas(), 1, Weighting::TRANSLATIONS, vec![1, 2, 3, 4, 5, 6]),
    ] {
        let error = identify(&arm, &planned(&rig, count), &weighting).unwrap_err();
        assert_eq!(error, IdentifyError::Open(open));
    }
    // Rotations alone see every joint.
    assert!(identify(&arm, &planned(&Rig::dumas(), 10), &Weighting::ROTATIONS).is_ok());
}

/// B against eq. 21 element by element, and its normal equations by Cramer's rule.
#[test]
fn the_system_is_the_printed_one() {
    let arm = with_tool();
    let mut tests = linear(&arm, 4);
    tests[2].displacement *= 1.01;
    let system = System::stack(&arm, &tests, &Weighting::SI).unwrap();
    for (k, test) in tests.iter().enumerate() {
        let j = arm.jacobian(&test.q);
        for column in 0..6 {
            let torque: f64 = (0..6).map(|i| j[(i, column)] * test.wrench[i]).sum();
            for row in 0..6 {
                let want = j[(row, column)] * torque;
                near(system.b[(6 * k + row, column)], want, 1e-12 * (1.0 + want.abs()));
            }
        }
    }
    let scale =
        DMatrix::from_diagonal(&DVector::from_fn(6, |j, _| 1.0 / system.b.column(j).norm()));
    let b = &system.b * &scale;
    let (product, right) = (b.tr_mul(&b), b.tr_mul(&system.c));
    let found = identify(&arm, &tests, &Weighting::SI).unwrap();
    for k in 0..6 {
        let mut replaced = product.clone();
        replaced.set_column(k, &right);
        let want = replaced.determinant() / product.determinant() * scale[(k, k)];
        near(found.compliances[k] / want, 1.0, 1e-11);
    }
}

/// Condition numbers of a typical design: B in SI about 17, its columns scaled 1.7; the printed
/// normal equations lose nothing here.
#[test]
fn the_printed_normal_equations_are_well_enough_conditioned() {
    let arm = with_tool();
    let tests = carried_out(&arm, (23, 2), Errors::quoted(), PoseFit::GramSchmidt);
    let found = identify(&arm, &tests, &Weighting::SI).unwrap();
    assert!((8.0..35.0).contains(&found.condition), "{}", found.condition);
    assert!((1.2..3.0).contains(&found.scaled_condition), "{}", found.scaled_condition);
    let system = System::stack(&arm, &tests, &Weighting::SI).unwrap();
    for (a, b) in found.compliances.iter().zip(&normal_equations(&system).unwrap()) {
        near(a / b, 1.0, 1e-12);
    }
}

/// The displacements are those of the exact equilibrium, the model leaves K_C out: a bias of a
/// tenth of a percent.
#[test]
fn leaving_k_c_out_is_negligible() {
    let arm = with_tool();
    let tests = carried_out(&arm, (23, 2), Errors::NONE, PoseFit::GramSchmidt);
    let found = identify(&arm, &tests, &Weighting::triangle(3e-5, 0.25)).unwrap();
    let each = found.compliances.iter().zip(&arm.joints);
    let biases: Vec<f64> = each.map(|(c, joint)| joint.compliance / c - 1.0).collect();
    assert!(biases.iter().all(|bias| bias.abs() < 3e-3), "{biases:?}");
    assert!(biases.iter().any(|bias| bias.abs() > 1e-5), "{biases:?}");
}

/// Ten tests identify, thirteen others check (section 5.3): without noise only the second order is
/// left, with the paper's noise a small part of the displacement.
#[test]
fn tests_that_were_not_used_are_predicted() {
    let arm = with_tool();
    let weighting = Weighting::triangle(3e-5, 0.25);
    let [exact, noisy] = [Errors::NONE, Errors::quoted()].map(|errors| {
        let tests = carried_out(&arm, (23, 8), errors, PoseFit::Kabsch);
        let found = identify(&arm, &tests[..10], &weighting).unwrap();
        validate(&found.applied_to(&arm), &tests[10..]).unwrap()
    });
    assert_eq!(exact.tests.len(), 13);
    assert!(exact.max_unexplained < 5e-3, "{}", exact.max_unexplained);
    assert!(noisy.mean_unexplained < 0.1, "{}", noisy.mean_unexplained);
    assert!(noisy.mean_position_gap < 0.1e-3 && noisy.max_position_gap < 0.6e-3);
    let first = &noisy.tests[0];
    let gap = (first.measured - first.predicted).fixed_rows::<3>(0).norm();
    near(first.position_gap, gap, 1e-15);
}

/// Whitened by the information of the three points = least squares over the nine coordinates of the
/// points themselves.
#[test]
fn weights_by_points_are_the_points_themselves() {
    let arm = with_tool();
    let tests = carried_out(&arm, (5, 4), Errors::quoted(), PoseFit::Kabsch);
    let points = Rig::dumas().reflectors();
    let mut b = DMatrix::zeros(9 * tests.len(), 6);
    let mut c = DVector::zeros(9 * tests.len());
    for (k, test) in tests.iter().enumerate() {
        let regressor = arm.compliance_regressor(&test.q, &test.wrench);
        for (i, point) in points.iter().enumerate() {
            let lever = arm.pose(&test.q).rotation * point;
            let motion = |twist: &[f64]| {
                let turn = nalgebra::Vector3::new(twist[3], twist[4], twist[5]);
                nalgebra::Vector3::new(twist[0], twist[1], twist[2]) + turn.cross(&lever)
            };
            let row = 9 * k + 3 * i;
            for j in 0..6 {
                let column: Vec<f64> = regressor.column(j).iter().copied().collect();
                b.view_mut((row, j), (3, 1)).copy_from(&motion(&column));
            }
            c.rows_mut(row, 3).copy_from(&motion(test.displacement.as_slice()));
        }
    }
    let scale = 1e6;
    let want = (&b / scale).svd(true, true).solve(&c, 1e-14).unwrap() / scale;
    let sigma = 3e-5;
    let weighting = Weighting::Points { points: points.into(), sigma };
    let found = identify(&arm, &tests, &weighting).unwrap();
    for (compliance, want) in found.compliances.iter().zip(want.iter()) {
        near(compliance / want, 1.0, 1e-10);
    }
}

/// Three points on a line are no weights, and rows of no weight leave every joint open.
#[test]
fn what_weighs_nothing_is_refused() {
    let arm = with_tool();
    let tests = linear(&arm, 3);
    let nothing = Weighting::Rows { translation: 0.0, rotation: 0.0 };
    assert!(matches!(identify(&arm, &tests, &nothing), Err(IdentifyError::Open(_))));
    let line = Weighting::Points { points: vec![Default::default(); 3], sigma: 1e-5 };
    let error = identify(&arm, &tests, &line).unwrap_err();
    assert_eq!(error, IdentifyError::Collinear);
}
