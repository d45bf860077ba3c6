//! Eqs. 20-26 and the validation of section 5.3.

use nalgebra::{DMatrix, DVector};
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::dumas::rig::{Errors, PoseFit, Rig, carry_out};
use stiffarm_papers::dumas::{
    IdentifyError, Method, Settings, System, Test, Weighting, identify, validate,
};

use crate::robot::{near, with_tool};

/// Tests whose displacements are eq. 17 exactly.
fn linear(arm: &Arm, count: usize) -> Vec<Test> {
    let mut tests = Rig::dumas().plan(arm, count, 5).unwrap();
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

/// The model's own stiffnesses are not read: the arm that is fitted is rigid.
#[test]
fn exact_displacements_give_the_stiffnesses_back() {
    let arm = with_tool();
    for method in [Method::Orthogonal, Method::NormalEquations] {
        for weighting in [Weighting::SI, Weighting::triangle(3e-5, 0.25)] {
            let settings = Settings { method, ..Settings::new(weighting) };
            let found = identify(&rigid(&arm), &linear(&arm, 10), &settings).unwrap();
            assert_eq!(found.freedom, 54);
            assert!(found.weak.is_empty());
            for (estimate, joint) in found.joints.iter().zip(&arm.joints) {
                near(estimate.compliance / joint.compliance, 1.0, 1e-11);
                near(estimate.stiffness().unwrap() * joint.compliance, 1.0, 1e-11);
            }
            assert_eq!(found.applied_to(&arm).dof(), 6);
        }
    }
}

/// One test of six rows is a square system (eq. 20).
#[test]
fn one_test_is_enough_where_it_loads_every_joint() {
    let arm = with_tool();
    let found = identify(&arm, &linear(&arm, 1), &Settings::new(Weighting::SI)).unwrap();
    assert_eq!((found.freedom, found.reduced_chi2), (0, None));
    for (estimate, joint) in found.joints.iter().zip(&arm.joints) {
        near(estimate.compliance / joint.compliance, 1.0, 1e-9);
        assert_eq!(estimate.stiffness_interval(), [0.0, f64::INFINITY]);
    }
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
    let found = identify(&arm, &tests, &Settings::new(Weighting::SI)).unwrap();
    for k in 0..6 {
        let mut replaced = product.clone();
        replaced.set_column(k, &right);
        let want = replaced.determinant() / product.determinant() * scale[(k, k)];
        near(found.joints[k].compliance / want, 1.0, 1e-11);
    }
}

/// Condition numbers of a typical design: B in SI about 17, its columns scaled 1.7; the printed
/// normal equations lose nothing here.
#[test]
fn the_printed_normal_equations_are_well_enough_conditioned() {
    let arm = with_tool();
    let rig = Rig::dumas();
    let plan = rig.plan(&arm, 23, 2).unwrap();
    let tests = carry_out(&arm, &rig, &plan, Errors::quoted(), PoseFit::GramSchmidt, 3).unwrap();
    let settings = Settings::new(Weighting::SI);
    let by_qr = identify(&arm, &tests, &settings).unwrap();
    assert!((8.0..35.0).contains(&by_qr.condition), "{}", by_qr.condition);
    assert!((1.2..3.0).contains(&by_qr.scaled_condition), "{}", by_qr.scaled_condition);
    let settings = Settings { method: Method::NormalEquations, ..settings };
    let by_normal = identify(&arm, &tests, &settings).unwrap();
    for (a, b) in by_qr.joints.iter().zip(&by_normal.joints) {
        near(a.compliance / b.compliance, 1.0, 1e-12);
    }
}

/// The displacements are those of the exact equilibrium, the model leaves K_C out: a bias of a
/// tenth of a percent.
#[test]
fn leaving_k_c_out_is_negligible() {
    let arm = with_tool();
    let rig = Rig::dumas();
    let plan = rig.plan(&arm, 23, 2).unwrap();
    let tests = carry_out(&arm, &rig, &plan, Errors::NONE, PoseFit::GramSchmidt, 0).unwrap();
    let found = identify(&arm, &tests, &Settings::new(Weighting::triangle(3e-5, 0.25))).unwrap();
    let biases: Vec<f64> = found
        .joints
        .iter()
        .zip(&arm.joints)
        .map(|(e, joint)| e.stiffness().unwrap() * joint.compliance - 1.0)
        .collect();
    assert!(biases.iter().all(|bias| bias.abs() < 3e-3), "{biases:?}");
    assert!(biases.iter().any(|bias| bias.abs() > 1e-5), "{biases:?}");
}

/// Ten tests identify, thirteen others check (section 5.3): without noise only the second order is
/// left, with the paper's noise a small part of the displacement.
#[test]
fn tests_that_were_not_used_are_predicted() {
    let arm = with_tool();
    let rig = Rig::dumas();
    let plan = rig.plan(&arm, 23, 8).unwrap();
    let settings = Settings::new(Weighting::triangle(3e-5, 0.25));
    let [exact, noisy] = [Errors::NONE, Errors::quoted()].map(|errors| {
        let tests = carry_out(&arm, &rig, &plan, errors, PoseFit::Kabsch, 1).unwrap();
        let found = identify(&arm, &tests[..10], &settings).unwrap();
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

/// The deviations that one experiment tells against the scatter of many.
#[test]
fn the_intervals_hold() {
    let arm = with_tool();
    let rig = Rig::dumas();
    let plan = rig.plan(&arm, 10, 4).unwrap();
    let errors = Errors { point: 3e-5, ..Errors::NONE };
    let points = Weighting::Points { points: rig.reflectors().into(), sigma: errors.point };
    let draws = 60;
    for settings in [Settings::known_noise(points.clone()), Settings::new(points)] {
        let mut inside = 0;
        let mut scatter = [0.0; 6];
        let mut told = [0.0; 6];
        let mut chi2 = 0.0;
        for draw in 0..draws {
            let tests = carry_out(&arm, &rig, &plan, errors, PoseFit::Kabsch, draw).unwrap();
            let found = identify(&arm, &tests, &settings).unwrap();
            chi2 += found.reduced_chi2.unwrap() / draws as f64;
            for (k, estimate) in found.joints.iter().enumerate() {
                let truth = arm.joints[k].compliance;
                let [low, high] = estimate.interval;
                inside += u32::from(low <= truth && truth <= high);
                scatter[k] += (estimate.compliance - truth).powi(2) / draws as f64;
                told[k] += estimate.deviation.powi(2) / draws as f64;
            }
        }
        let part = f64::from(inside) / (6 * draws) as f64;
        assert!((0.91..0.985).contains(&part), "{part}");
        near(chi2, 1.0, 0.1);
        for (scatter, told) in scatter.iter().zip(told) {
            near((scatter / told).sqrt(), 1.0, 0.3);
        }
    }
}

/// Whitened by the information of the three points = least squares over the nine coordinates of the
/// points themselves.
#[test]
fn weights_by_points_are_the_points_themselves() {
    let arm = with_tool();
    let rig = Rig::dumas();
    let plan = rig.plan(&arm, 5, 4).unwrap();
    let tests = carry_out(&arm, &rig, &plan, Errors::quoted(), PoseFit::Kabsch, 1).unwrap();
    let points = rig.reflectors();
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
    let found = identify(&arm, &tests, &Settings::known_noise(weighting)).unwrap();
    for (estimate, want) in found.joints.iter().zip(want.iter()) {
        near(estimate.compliance / want, 1.0, 1e-10);
    }
    let covariance = b.tr_mul(&b).try_inverse().unwrap() * (2.0 * sigma * sigma);
    for (k, estimate) in found.joints.iter().enumerate() {
        near(estimate.deviation / covariance[(k, k)].sqrt(), 1.0, 1e-8);
        let half = (estimate.interval[1] - estimate.interval[0]) / 2.0;
        near(half / estimate.deviation, 1.959964, 1e-6);
    }
}

#[test]
fn bad_input_is_refused() {
    let arm = with_tool();
    let tests = linear(&arm, 3);
    let settings = Settings::new(Weighting::SI);
    assert_eq!(identify(&arm, &[], &settings).unwrap_err(), IdentifyError::NoTests);
    let mut wrong = tests.clone();
    wrong[1].q.pop();
    let error = identify(&arm, &wrong, &settings).unwrap_err();
    assert_eq!(error.to_string(), "test 2 has 5 joint values, expected 6");
    let mut wrong = tests.clone();
    wrong[2].displacement[4] = f64::NAN;
    let error = identify(&arm, &wrong, &settings).unwrap_err();
    assert_eq!(error, IdentifyError::NotFinite { test: 3 });
    let mut wrong = tests.clone();
    wrong[1].wrench *= 1e305;
    let error = identify(&arm, &wrong, &settings).unwrap_err();
    assert_eq!(error, IdentifyError::NotFinite { test: 2 });
    let nothing = Settings::new(Weighting::Rows { translation: 0.0, rotation: 0.0 });
    assert!(matches!(identify(&arm, &tests, &nothing), Err(IdentifyError::Hidden(_))));
    let wild = Settings { confidence: 1.0, ..settings };
    assert!(matches!(identify(&arm, &tests, &wild), Err(IdentifyError::Setting { .. })));
    for weighting in [
        Weighting::Rows { translation: -1.0, rotation: 1.0 },
        Weighting::Points { points: vec![Default::default(); 3], sigma: 0.0 },
    ] {
        let settings = Settings::new(weighting);
        assert!(matches!(identify(&arm, &tests, &settings), Err(IdentifyError::Setting { .. })));
    }
    let line = Weighting::Points { points: vec![Default::default(); 3], sigma: 1e-5 };
    let error = identify(&arm, &tests, &Settings::new(line)).unwrap_err();
    assert_eq!(error, IdentifyError::Collinear);
}
