//! The wrench recursion on the paper's arms: the printed error, and how far the recursion is from
//! the exact rod.

use crate::arms::*;
use crate::rod;

/// Wrench error of the straight arm for a set-point of 10 N along y and its moment, E = 210 GPa as
/// stated: not the printed one (1.1561, 0.067, 0.02506).
#[test]
fn the_stated_data_do_not_give_the_printed_error() {
    let arm = arm(3, STEEL);
    let loaded = settled(&arm, &[0.0; 3], 10.0, DEFORMED);
    let error = straight_task(&arm, DEFORMED).error(&[0.0; 3]).unwrap();
    assert_close(&[error[0], error[1], error[5]], &[0.87155, 0.03805, 0.013088], 5e-6);
    let (_, tip) = in_plane(&loaded);
    assert_close(&tip, &[2.993143, 0.194344, 0.0872656], 5e-7);
    let loads = loaded.joint_loads().unwrap();
    assert_close(&loads, &[29.98691, 19.99869, 10.00002], 6e-6);
}

/// No posture of the nominal direction 0 comes near the printed tip angle 0.1159 either.
#[test]
fn no_straight_direction_reaches_the_printed_angle() {
    let arm = arm(3, STEEL);
    let mut largest: f64 = 0.0;
    for i in 0..24 {
        for j in 0..24 {
            let (q1, q2) = (f64::from(15 * i), f64::from(15 * j));
            let q = degrees(&[q1, q2, -q1 - q2]);
            let (_, tip) = in_plane(&settled(&arm, &q, 10.0, DEFORMED));
            largest = largest.max(tip[2].abs());
        }
    }
    assert!((0.0872..0.09).contains(&largest), "{largest}");
}

/// Half the bending stiffness gives the printed error: to all digits with EJ = 804.87 N·m², and
/// within a unit of the fifth with E = 205 GPa.
#[test]
fn half_the_bending_stiffness_gives_the_printed_error() {
    let fitted = arm(3, 804.87);
    let error = straight_task(&fitted, DEFORMED).error(&[0.0; 3]).unwrap();
    assert_close(&[error[0]], &[1.1561], 5e-5);
    assert_close(&[error[1]], &[0.067], 5e-4);
    assert_close(&[error[5]], &[0.02506], 5e-6);
    let half = arm(3, HALF);
    let error = straight_task(&half, DEFORMED).error(&[0.0; 3]).unwrap();
    assert_close(&[error[0], error[1], error[5]], &[1.15599, 0.06704, 0.025056], 5e-6);
    let error = straight_task(&half, UNDEFORMED).error(&[0.0; 3]).unwrap();
    assert_close(&[error[0], error[1], error[5]], &[1.15582, 0.06702, 0.025052], 5e-6);
    let loaded = settled(&half, &[0.0; 3], 10.0, DEFORMED);
    let (_, tip) = in_plane(&loaded);
    assert_close(&tip, &[2.988479, 0.251304, 0.115858], 5e-7);
    let loads = loaded.joint_loads().unwrap();
    assert_close(&loads, &[29.97494, 19.99760, 10.00006], 6e-6);
}

/// The five-joint arm, whose printed error is missing from the text: what the recursion predicts.
#[test]
fn the_five_joint_arm() {
    for (ej, expected, angle) in
        [(STEEL, [2.2353, 0.2530, 0.18901], 0.225432), (HALF, [2.9973, 0.4598, 0.36571], 0.304412)]
    {
        let arm = arm(5, ej);
        let error = straight_task(&arm, DEFORMED).error(&[0.0; 5]).unwrap();
        assert_close(&[error[0], error[1]], &expected[..2], 5e-5);
        assert_close(&[error[5]], &expected[2..], 5e-6);
        let (_, tip) = in_plane(&settled(&arm, &[0.0; 5], 10.0, DEFORMED));
        assert_close(&tip[2..], &[angle], 5e-7);
    }
}

/// The exact rod, straight and bent, and the recursion's distance from it.
#[test]
fn distance_from_the_exact_rod() {
    let steel = arm(3, STEEL);
    let tip_load = [0.0, 10.0, 0.0];
    let (wrench, tip) = rod::exact(&steel, &[0.0; 3], tip_load, true);
    assert_close(&wrench, &[-0.87153179, 9.96194922, 29.98630379], 1e-8);
    assert_close(&tip, &[2.99308219, 0.19433712, 0.08726389], 1e-8);
    let (found, found_tip) = in_plane(&settled(&steel, &[0.0; 3], 10.0, DEFORMED));
    assert_close(&[found_tip[0] - tip[0]], &[6.1e-5], 5e-7);
    assert_close(&[found_tip[1] - tip[1]], &[7.2e-6], 5e-8);
    assert_close(&[found_tip[2] - tip[2]], &[1.7e-6], 5e-8);
    assert_close(&[found[2] - wrench[2]], &[6.1e-4], 5e-6);

    // A tenth of the printed moment error is the recursion's own, and foreshortening takes it away.
    let half = arm(3, HALF);
    let (wrench, _) = rod::exact(&half, &[0.0; 3], tip_load, true);
    let (found, _) = in_plane(&settled(&half, &[0.0; 3], 10.0, DEFORMED));
    assert_close(&[found[2] - wrench[2]], &[2.55e-3], 5e-6);
    assert_close(&[30.0 - wrench[2]], &[0.0276], 5e-5);
    let (found, _) = in_plane(&settled(&half, &[0.0; 3], 10.0, SHORTENED));
    assert!((found[2] - wrench[2]).abs() < 2e-7);

    let q = degrees(&[60.0, -45.0, -30.0]);
    let (wrench, tip) = rod::exact(&steel, &q, tip_load, true);
    assert_close(&wrench, &[1.86164076, 9.8251867, 21.77780512], 1e-8);
    assert_close(&tip, &[2.40724549, 1.00654823, -0.18725652], 1e-8);
    let (found, found_tip) = in_plane(&settled(&steel, &q, 10.0, DEFORMED));
    assert_close(&found, &[1.86178408, 9.82515954, 21.77797445], 1e-8);
    assert_close(&found_tip, &[2.40728323, 1.00654385, -0.1872711], 1e-8);
    let (found, _) = in_plane(&settled(&steel, &q, 10.0, UNDEFORMED));
    assert_close(&found, &[1.86130591, 9.82525014, 21.77823118], 1e-8);
}

#[test]
fn five_joints_against_the_exact_rod() {
    for (ej, moment, along) in [(STEEL, 0.19169, 2.6e-4), (HALF, 0.37678, 1.06e-3)] {
        let arm = arm(5, ej);
        let (wrench, tip) = rod::exact(&arm, &[0.0; 5], [0.0, 10.0, 0.0], true);
        assert_close(&[50.0 - wrench[2]], &[moment], 5e-6);
        let (_, found) = in_plane(&settled(&arm, &[0.0; 5], 10.0, DEFORMED));
        assert_close(&[found[0] - tip[0]], &[along], 5e-3 * along);
    }
}

/// Each link cut into rigidly joined parts: the recursion goes to the exact rod, stretching and
/// all, with the square of the parts' number. Its definitions are the right ones.
#[test]
fn cut_links_converge_to_the_exact_rod() {
    let whole = arm(3, HALF);
    let q = degrees(&[60.0, -45.0, -30.0]);
    let (exact, exact_tip) = rod::exact(&whole, &q, [0.0, 200.0, 0.0], true);
    for elasticity in [DEFORMED, UNDEFORMED, SHORTENED] {
        let off = |parts: usize| {
            let mut cut = whole.clone();
            cut.joints.clear();
            let mut values = Vec::new();
            for (joint, &value) in whole.joints.iter().zip(&q) {
                for part in 0..parts {
                    let mut piece = joint.clone();
                    piece.a /= parts as f64;
                    if part > 0 {
                        piece.compliance = 0.0;
                    }
                    values.push(if part == 0 { value } else { 0.0 });
                    cut.joints.push(piece);
                }
            }
            let (wrench, tip) = in_plane(&settled(&cut, &values, 200.0, elasticity));
            let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum();
            let wrench: f64 = apart(wrench, exact);
            let tip: f64 = apart(tip, exact_tip);
            (wrench.sqrt(), tip.sqrt())
        };
        let (coarse, fine) = (off(16), off(32));
        assert!(coarse.0 / fine.0 > 3.6, "{elasticity:?} {coarse:?} {fine:?}");
        assert!(coarse.1 / fine.1 > 3.9, "{elasticity:?} {coarse:?} {fine:?}");
        assert!(fine.1 < 2e-4, "{elasticity:?} {fine:?}");
    }
}

/// What a single link's small bending is worth, over its tip slope φ = F L²/2EJ.
#[test]
fn where_small_bending_stops_holding() {
    let mut cantilever = arm(3, STEEL);
    cantilever.joints.truncate(1);
    cantilever.joints[0].compliance = 0.0;
    let at = |phi: f64, elasticity| {
        let force = 2.0 * STEEL * phi;
        let (_, exact) = rod::exact(&cantilever, &[0.0], [0.0, force, 0.0], false);
        let (_, found) = in_plane(&settled(&cantilever, &[0.0], force, elasticity));
        let moved = (exact[0] - 1.0).hypot(exact[1]);
        let apart = (found[0] - exact[0]).hypot(found[1] - exact[1]);
        (apart / moved, found[2] / exact[2] - 1.0)
    };
    for (phi, off) in [(0.01, 0.004), (0.025, 0.01), (0.1, 0.04), (0.25, 0.1), (0.3, 0.12)] {
        let (displacement, _) = at(phi, DEFORMED);
        assert!((displacement / off - 1.0).abs() < 0.06, "{phi}: {displacement}");
    }
    assert!((at(1.0, DEFORMED).0 - 0.40).abs() < 0.02);
    let (_, deformed) = at(0.1, DEFORMED);
    let (_, undeformed) = at(0.1, UNDEFORMED);
    assert!((deformed / (0.01 / 30.0) - 1.0).abs() < 0.02, "{deformed}");
    assert!((undeformed / (-0.07 / 15.0) - 1.0).abs() < 0.02, "{undeformed}");
    assert!((at(0.1, SHORTENED).0 - 1.6e-3).abs() < 1e-4);
    let both = stiffarm_papers::chain::elastic::Elasticity { foreshortening: true, ..UNDEFORMED };
    assert!((at(0.1, both).0 - 3.4e-3).abs() < 1e-4);
}

/// The tip's relative error over the load, 10 N to 400 N, in a bent posture.
#[test]
fn the_error_over_the_load() {
    let arm = arm(3, STEEL);
    let q = degrees(&[60.0, -45.0, -30.0]);
    let rigid = pose_in_plane(&arm.pose(&q));
    let off = |size: f64, elasticity| {
        let (wrench, tip) = rod::exact(&arm, &q, [0.0, size, 0.0], false);
        let (found, found_tip) = in_plane(&settled(&arm, &q, size, elasticity));
        let apart = |a: [f64; 3], b: [f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let largest = (0..3).map(|k| (found[k] - wrench[k]).abs()).fold(0.0, f64::max);
        (apart(found_tip, tip) / apart(rigid, tip), largest / size)
    };
    for (size, deformed, undeformed, wrench) in [
        (10.0, 2.7e-4, 6.9e-4, 1.7e-5),
        (30.0, 8.1e-4, 2.1e-3, 1.9e-4),
        (100.0, 2.9e-3, 7.0e-3, 3.8e-3),
        (200.0, 8.1e-3, 1.2e-2, 2.3e-2),
        (400.0, 2.6e-2, 1.5e-2, 6.0e-2),
    ] {
        let (tip, base) = off(size, DEFORMED);
        assert!((tip / deformed - 1.0).abs() < 0.03, "{size}: {tip}");
        assert!((base / wrench - 1.0).abs() < 0.04, "{size}: {base}");
        let (tip, _) = off(size, UNDEFORMED);
        assert!((tip / undeformed - 1.0).abs() < 0.04, "{size}: {tip}");
    }
}
