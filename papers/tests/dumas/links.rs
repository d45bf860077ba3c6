//! Links 2 and 3 as beams: what a fit of joints alone makes of them.

use nalgebra::{Matrix2, Vector6};
use stiffarm_kernels::generic::{Arm, Beam};
use stiffarm_papers::dumas::links::{identify_with_links, shares};
use stiffarm_papers::dumas::rig::{Errors, PoseFit, Rig, carry_out};
use stiffarm_papers::dumas::{IdentifyError, Settings, Weighting, identify, validate};

use crate::robot::{near, with_tool};

/// EI of links 2 and 3, N·m², with which 300 tests have largest shares of 21 % and 4.8 %.
const EI: [f64; 2] = [3.317e7, 4.428e7];

/// A box of side 0.3 m: GJ = 0.577 EI, EA = 6 EI/b².
fn beam(ei: f64) -> Beam {
    let (e, g) = (210e9, 80e9);
    Beam {
        youngs_modulus: e,
        shear_modulus: g,
        area: 6.0 * ei / (e * 0.09),
        iy: ei / e,
        iz: ei / e,
        j: 0.577 * ei / g,
        density: 0.0,
        shear_coefficient: None,
    }
}

/// Link 2 is the beam of row 3, from O2 to O3; link 3 that of row 4, from O3 to the wrist centre.
fn bending() -> Arm {
    let mut arm = with_tool();
    arm.joints[2].beam = Some(beam(EI[0]));
    arm.joints[3].beam = Some(beam(EI[1]));
    arm
}

fn without_beams(arm: &Arm) -> Arm {
    let mut rigid = arm.clone();
    rigid.joints.iter_mut().for_each(|joint| joint.beam = None);
    rigid
}

/// Bending of link 2 in its plane is the compliance block `L/6EI [[2, 1], [1, 2]]` on joints 2 and
/// 3, for any load in any posture.
#[test]
fn bending_in_the_plane_is_a_compliance_of_joints_2_and_3() {
    let mut arm = with_tool();
    arm.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    let stiff = 1e30;
    let in_plane = Beam { area: stiff, iy: stiff, j: stiff, ..beam(EI[0]) };
    arm.joints[2].beam = Some(in_plane);
    let block = 1.25 / (6.0 * EI[0]) * Matrix2::new(2.0, 1.0, 1.0, 2.0);
    near(block[(0, 1)], 6.28e-9, 5e-12);
    for test in Rig::dumas().plan(&arm, 20, 3).unwrap() {
        let got = arm.deflection_first_order(&test.q, &test.wrench);
        let j = arm.jacobian(&test.q).columns(1, 2).into_owned();
        let want = &j * block * j.tr_mul(&test.wrench);
        assert!((got - want).norm() < 1e-13 * want.norm(), "{got} {want}");
    }
}

/// "Maximum 21 %" and "maximum of 4.8 %", at most 25 % together: with these EI, on 300 tests.
#[test]
fn the_shares_of_links_2_and_3() {
    let arm = bending();
    let mut most = [0.0_f64; 2];
    let mut mean = [0.0; 2];
    for test in Rig::dumas().plan(&arm, 300, 6).unwrap() {
        let [two, three] = &shares(&arm, &test.q, &test.wrench).unwrap()[..] else {
            panic!("two links")
        };
        assert_eq!((two.row, three.row), (3, 4));
        for (k, share) in [two, three].into_iter().enumerate() {
            most[k] = most[k].max(share.part);
            mean[k] += share.part / 300.0;
        }
        let joints = without_beams(&arm).deflection_first_order(&test.q, &test.wrench);
        let whole = arm.deflection_first_order(&test.q, &test.wrench);
        assert!((joints + two.twist + three.twist - whole).norm() < 1e-12 * whole.norm());
    }
    assert!((0.15..0.27).contains(&most[0]) && (0.03..0.07).contains(&most[1]), "{most:?}");
    assert!((0.06..0.11).contains(&mean[0]) && (0.01..0.04).contains(&mean[1]), "{mean:?}");
    let nothing = shares(&arm, &[0.1; 6], &Vector6::zeros()).unwrap();
    assert_eq!(nothing[0].part, 0.0);
}

/// Joints alone come out too soft, k₁ most; what they cannot take is a few percent of the
/// displacements of other tests. With the links among the unknowns the joints come out right.
#[test]
fn joints_alone_come_out_too_soft() {
    let arm = bending();
    let rig = Rig::dumas();
    let plan = rig.plan(&arm, 83, 12).unwrap();
    let tests = carry_out(&arm, &rig, &plan, Errors::NONE, PoseFit::Kabsch, 0).unwrap();
    let (used, held_out) = tests.split_at(23);
    let weighting = Weighting::triangle(1e-5, rig.side);
    let joints_only = without_beams(&arm);
    let found = identify(&joints_only, used, &Settings::known_noise(weighting.clone())).unwrap();
    let truth: Vec<f64> = arm.joints.iter().map(|joint| joint.compliance).collect();
    let bias: Vec<f64> = found
        .joints
        .iter()
        .zip(&truth)
        .map(|(e, c)| 100.0 * (e.stiffness().unwrap() * c - 1.0))
        .collect();
    assert!(bias.iter().all(|b| *b < 0.5), "{bias:?}");
    assert!((-25.0..-10.0).contains(&bias[0]), "{bias:?}");
    assert!((-15.0..-6.0).contains(&bias[1]) && (-15.0..-6.0).contains(&bias[2]), "{bias:?}");
    assert!(bias[1..].iter().all(|b| *b > bias[0]), "{bias:?}");
    // Of a tracker of 0.01 mm; noise would add 1.
    let chi2 = found.reduced_chi2.unwrap();
    assert!((0.5..3.0).contains(&chi2), "{chi2}");

    let absorbed = validate(&found.applied_to(&joints_only), held_out).unwrap();
    assert!((0.02..0.08).contains(&absorbed.mean_unexplained), "{}", absorbed.mean_unexplained);
    let truth_alone = validate(&joints_only, held_out).unwrap();
    assert!((0.07..0.15).contains(&truth_alone.mean_unexplained));

    let both = identify_with_links(&arm, used, &weighting, &[3, 4], true).unwrap();
    for (value, truth) in both.joints.iter().zip(&truth) {
        near(value.value / truth, 1.0, 0.015);
    }
    near(both.links[0].value, 1.0, 0.05);
    near(both.links[1].value, 1.0, 0.5);
    assert!(both.links[1].deviation > 2.0 * both.links[0].deviation);
    assert!(both.reduced_chi2.unwrap() < 0.1 * found.reduced_chi2.unwrap());
    // k₂ and link 2 are nearly one, the price of the identity above.
    assert!((-0.98..-0.75).contains(&both.correlation[(1, 6)]), "{}", both.correlation[(1, 6)]);
    assert!((6.0..40.0).contains(&both.scaled_condition), "{}", both.scaled_condition);
}

/// With linear displacements the fit of joints and links is exact, by whatever shape of
/// flexibility the model has.
#[test]
fn exact_displacements_give_the_links_back() {
    let arm = bending();
    let mut soft = arm.clone();
    let beam = soft.joints[2].beam.as_mut().unwrap();
    beam.youngs_modulus /= 2.0;
    beam.shear_modulus /= 2.0;
    let mut tests = Rig::dumas().plan(&arm, 12, 1).unwrap();
    for test in &mut tests {
        test.displacement = soft.deflection_first_order(&test.q, &test.wrench);
    }
    let both = identify_with_links(&arm, &tests, &Weighting::SI, &[3, 4], false).unwrap();
    near(both.links[0].value, 2.0, 1e-9);
    near(both.links[1].value, 1.0, 1e-8);
    // A beam that is not among the unknowns is known: subtracted.
    let one = identify_with_links(&arm, &tests, &Weighting::SI, &[3], false).unwrap();
    near(one.links[0].value, 2.0, 1e-9);
    let known = identify(&soft, &tests, &Settings::new(Weighting::SI)).unwrap();
    near(known.joints[1].stiffness().unwrap() / 6.6e6, 1.0, 1e-9);
}

#[test]
fn links_that_are_not_there_or_not_shown_are_refused() {
    let arm = bending();
    let mut tests = Rig::dumas().plan(&arm, 1, 1).unwrap();
    for rows in [[0], [2], [7]] {
        let error = identify_with_links(&arm, &tests, &Weighting::SI, &rows, false).unwrap_err();
        assert!(matches!(error, IdentifyError::Setting { .. }), "{error}");
    }
    tests[0].displacement[0] = 1e-3;
    let error = identify_with_links(&arm, &tests, &Weighting::SI, &[3, 4], false).unwrap_err();
    assert!(error.to_string().starts_with("found 6 as the number of joints and links"), "{error}");
}
