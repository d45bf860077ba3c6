//! The wrench recursion on the paper's arms: the printed error, and how far the recursion is from
//! the exact rod.

use nalgebra::{Isometry3, Vector3, Vector6};
use stiffarm_draws::Draws;
use stiffarm_gap::simulate::equilibrium;
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::methods::bicchi::Loaded;
use stiffarm_papers::methods::transport::wrench_matrix;

use super::arms::*;
use super::rod;

/// No posture of the nominal direction 0 comes near the printed tip angle 0.1159 either.
#[test]
fn no_straight_direction_reaches_the_printed_angle() {
    let arm = arm(3, STEEL);
    let mut largest: f64 = 0.0;
    for i in 0..24 {
        for j in 0..24 {
            let (q1, q2) = (f64::from(15 * i), f64::from(15 * j));
            let q = degrees(&[q1, q2, -q1 - q2]);
            let (_, tip) = in_plane(&loaded(&arm, &q, 10.0));
            largest = largest.max(tip[2].abs());
        }
    }
    assert!((0.0872..0.09).contains(&largest), "{largest}");
}

/// The five-joint arm, whose printed error is missing from the text: what the recursion predicts.
#[test]
fn the_five_joint_arm() {
    for (ej, expected, angle) in
        [(STEEL, [2.2353, 0.2530, 0.18901], 0.225432), (HALF, [2.9973, 0.4598, 0.36571], 0.304412)]
    {
        let arm = arm(5, ej);
        let error = straight_task(&arm).error(&[0.0; 5]).unwrap();
        assert_close(&[error[0], error[1]], &expected[..2], 5e-5);
        assert_close(&[error[5]], &expected[2..], 5e-6);
        let (_, tip) = in_plane(&loaded(&arm, &[0.0; 5], 10.0));
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
    let (found, found_tip) = in_plane(&loaded(&steel, &[0.0; 3], 10.0));
    assert_close(&[found_tip[0] - tip[0]], &[6.1e-5], 5e-7);
    assert_close(&[found_tip[1] - tip[1]], &[7.2e-6], 5e-8);
    assert_close(&[found_tip[2] - tip[2]], &[1.7e-6], 5e-8);
    assert_close(&[found[2] - wrench[2]], &[6.1e-4], 5e-6);

    // A tenth of the printed moment error is the recursion's own.
    let half = arm(3, HALF);
    let (wrench, _) = rod::exact(&half, &[0.0; 3], tip_load, true);
    let (found, _) = in_plane(&loaded(&half, &[0.0; 3], 10.0));
    assert_close(&[found[2] - wrench[2]], &[2.55e-3], 5e-6);
    assert_close(&[30.0 - wrench[2]], &[0.0276], 5e-5);

    let q = degrees(&[60.0, -45.0, -30.0]);
    let (wrench, tip) = rod::exact(&steel, &q, tip_load, true);
    assert_close(&wrench, &[1.86164076, 9.8251867, 21.77780512], 1e-8);
    assert_close(&tip, &[2.40724549, 1.00654823, -0.18725652], 1e-8);
    let (found, found_tip) = in_plane(&loaded(&steel, &q, 10.0));
    assert_close(&found, &[1.86178408, 9.82515954, 21.77797445], 1e-8);
    assert_close(&found_tip, &[2.40728323, 1.00654385, -0.1872711], 1e-8);
}

#[test]
fn five_joints_against_the_exact_rod() {
    for (ej, moment, along) in [(STEEL, 0.19169, 2.6e-4), (HALF, 0.37678, 1.06e-3)] {
        let arm = arm(5, ej);
        let (wrench, tip) = rod::exact(&arm, &[0.0; 5], [0.0, 10.0, 0.0], true);
        assert_close(&[50.0 - wrench[2]], &[moment], 5e-6);
        let (_, found) = in_plane(&loaded(&arm, &[0.0; 5], 10.0));
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
        let (wrench, tip) = in_plane(&loaded(&cut, &values, 200.0));
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum();
        let wrench: f64 = apart(wrench, exact);
        let tip: f64 = apart(tip, exact_tip);
        (wrench.sqrt(), tip.sqrt())
    };
    let (coarse, fine) = (off(16), off(32));
    assert!(coarse.0 / fine.0 > 3.6, "{coarse:?} {fine:?}");
    assert!(coarse.1 / fine.1 > 3.9 && fine.1 < 2e-4, "{coarse:?} {fine:?}");
}

/// What a single link's small bending is worth, over its tip slope φ = F L²/2EJ.
#[test]
fn where_small_bending_stops_holding() {
    let mut cantilever = arm(3, STEEL);
    cantilever.joints.truncate(1);
    cantilever.joints[0].compliance = 0.0;
    let at = |phi: f64| {
        let force = 2.0 * STEEL * phi;
        let (_, exact) = rod::exact(&cantilever, &[0.0], [0.0, force, 0.0], false);
        let (_, found) = in_plane(&loaded(&cantilever, &[0.0], force));
        let moved = (exact[0] - 1.0).hypot(exact[1]);
        let apart = (found[0] - exact[0]).hypot(found[1] - exact[1]);
        (apart / moved, found[2] / exact[2] - 1.0)
    };
    for (phi, off) in [(0.01, 0.004), (0.025, 0.01), (0.1, 0.04), (0.25, 0.1), (0.3, 0.12)] {
        let (displacement, _) = at(phi);
        assert!((displacement / off - 1.0).abs() < 0.06, "{phi}: {displacement}");
    }
    assert!((at(1.0).0 - 0.40).abs() < 0.02);
    assert!((at(0.1).1 / (0.01 / 30.0) - 1.0).abs() < 0.02);
}

/// An arm in space with springs and beams, joint values and a wrench of the tool.
fn drawn(draws: &mut Draws) -> (Arm, Vec<f64>, Vector6<f64>) {
    let mut arm = arm(5, STEEL);
    for joint in &mut arm.joints {
        (joint.a, joint.d) = (draws.between(-0.8, 0.8), draws.between(-0.8, 0.8));
        (joint.theta, joint.alpha) = (draws.between(-3.0, 3.0), draws.between(-3.0, 3.0));
        joint.compliance = draws.between(1e-6, 1e-5);
    }
    let [at, turn] = [draws.array(-0.3, 0.3), draws.array(-1.5, 1.5)];
    arm.tool = Isometry3::new(at.into(), turn.into());
    arm.gravity = Vector3::zeros();
    let w = draws.array::<6>(-500.0, 500.0);
    (arm, draws.array::<5>(-3.0, 3.0).into(), w.into())
}

/// The simulation finds the same rest by iteration: of springs the very same, of beams, which it
/// loads in the axes of their undisplaced tips, to first order in the load.
#[test]
fn the_recursion_is_the_simulation() {
    let mut draws = Draws::from_state(7);
    for _ in 0..100 {
        let (bent, q, w) = drawn(&mut draws);
        let mut springs = bent.clone();
        springs.joints.iter_mut().for_each(|joint| joint.beam = None);
        let apart = |arm: &Arm, w: &Vector6<f64>| {
            let found = Loaded::new(arm, &q, w).unwrap();
            let mut turn = found.pose();
            turn.translation.vector = Vector3::zeros();
            let state = equilibrium(arm, &q, &(wrench_matrix(&turn) * w)).unwrap();
            let tool = (found.pose().to_homogeneous() - state.tool.to_homogeneous()).amax();
            let loads = found.joint_loads.iter().zip(state.torque.iter());
            (tool, loads.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
        };
        let (tool, loads) = apart(&springs, &w);
        assert!(tool < 1e-10 && loads < 1e-8 * w.norm(), "{tool:e} {loads:e}");
        // Half the load, a quarter of the distance; below that rounding.
        let (small, half) = (apart(&bent, &(w * 1e-2)).0, apart(&bent, &(w * 5e-3)).0);
        assert!(half < 0.3 * small + 1e-12, "{small:e} {half:e}");
    }
}

/// Every frame carries what acts on the tool, in equilibrium; a rigid arm is the table.
#[test]
fn every_section_is_in_equilibrium() {
    let mut draws = Draws::from_state(8);
    for _ in 0..50 {
        let (mut arm, q, w) = drawn(&mut draws);
        let found = Loaded::new(&arm, &q, &w).unwrap();
        for (frame, section) in found.frames.iter().zip(&found.wrenches) {
            let apart = wrench_matrix(frame) * section - found.base_wrench();
            assert!(apart.amax() < 1e-10 * w.norm());
        }
        for joint in &mut arm.joints {
            (joint.compliance, joint.beam) = (0.0, None);
        }
        let rigid = Loaded::new(&arm, &q, &w).unwrap();
        let apart = rigid.pose().to_homogeneous() - arm.pose(&q).to_homogeneous();
        assert!(apart.amax() < 1e-13);
    }
}
