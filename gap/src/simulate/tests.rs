//! Equilibrium against the textbook and against itself.

use super::*;
use crate::fixture::{bent, row, springy, table};

#[test]
fn the_springs_balance_the_loads_in_the_loaded_geometry() {
    let arm = springy();
    let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(300.0, -200.0, -800.0, 20.0, -30.0, 10.0));
    let state = equilibrium(&arm, &q, &w).unwrap();
    let torque = arm.joint_torque(&state.joints, &w) + arm.weight_torque(&state.joints);
    for j in 0..3 {
        let twist = state.joints[j] - q[j];
        assert!(twist.abs() > 1e-4);
        assert!((twist - arm.joints[j].compliance * torque[j]).abs() < 1e-15);
    }
}

#[test]
fn a_small_load_gives_the_textbook_deflection() {
    let arm = bent();
    let (q, w) = ([0.3, -0.7, 0.4], Vector6::new(3e-3, -2e-3, -8e-3, 2e-4, -3e-4, 1e-4));
    let mut light = arm.clone();
    light.gravity = Vector3::zeros();
    let state = equilibrium(&light, &q, &w).unwrap();
    let moved = state.tool.translation.vector - light.pose(&q).translation.vector;
    let want = translation(&light.deflection(&q, &w).unwrap());
    assert!((moved - want).norm() < 1e-6 * want.norm() + 1e-15, "{moved} {want}");
}

#[test]
fn a_buckling_load_is_refused() {
    let arm = springy();
    let push = Vector6::new(-1e9, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert_eq!(equilibrium(&arm, &[0.0; 3], &push).unwrap_err(), Unstable);
    let nan = Vector6::repeat(f64::MAX);
    assert_eq!(equilibrium(&arm, &[0.0; 3], &nan).unwrap_err(), Unstable);
}

/// Perpendicular axes under a moment about the third direction, which no joint feels: the arm rests where
/// it is, whatever the moment, and is stable up to twice the root of the springs' product.
#[test]
fn a_moment_is_borne_up_to_the_springs() {
    let mut arm = springy();
    arm.gravity = Vector3::zeros();
    arm.joints.truncate(2);
    let limit = 2.0 / (arm.joints[0].compliance * arm.joints[1].compliance).sqrt();
    for (share, borne) in [(0.5, true), (0.999_999, true), (1.000_001, false), (3.0, false)] {
        for sign in [-1.0, 1.0] {
            let w = Vector6::new(0.0, 0.0, 0.0, sign * share * limit, 0.0, 0.0);
            assert_eq!(equilibrium(&arm, &[0.0; 2], &w).is_ok(), borne, "{share}");
            assert_eq!(arm.deflection(&[0.0; 2], &w).is_ok(), borne, "{share}");
        }
    }
}

/// Where the arm comes to rest under a load of any size, the textbook finds it stable.
#[test]
fn what_is_at_rest_is_stable() {
    let arm = springy();
    let (mut borne, mut refused) = (0, 0);
    for k in 0..200 {
        let angle = |factor: f64| (f64::from(k) * factor).sin();
        let q = [3.0 * angle(1.1), 3.0 * angle(2.3), 3.0 * angle(3.7)];
        let size = 1e4 * 1.06_f64.powi(k % 100);
        let w = Vector6::from_fn(|i, _| size * (f64::from(k) * 1.7 + 2.0 * i as f64).sin());
        match equilibrium(&arm, &q, &w) {
            Ok(state) => {
                borne += 1;
                let there = arm.deflection_with_gravity(&state.joints, &w);
                assert!(there.is_ok(), "{k}: at rest at {:?}", state.joints);
            }
            Err(Unstable) => refused += 1,
        }
    }
    assert!(borne > 50 && refused > 20, "{borne} {refused}");
}

/// Beams alone, pushed along: a cantilever tilts by what its tip turns.
#[test]
fn a_beam_that_buckles_is_refused() {
    let mut arm = bent();
    arm.gravity = Vector3::zeros();
    arm.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    let push =
        |force: f64| equilibrium(&arm, &[0.0; 3], &Vector6::new(-force, 0.0, 0.0, 0.0, 0.0, 0.0));
    assert!(push(1e4).is_ok() && push(1e9).is_err());
}

#[test]
fn an_arm_without_joints_stands_still() {
    let mut arm = springy();
    arm.joints.clear();
    let state = equilibrium(&arm, &[], &Vector6::repeat(10.0)).unwrap();
    assert_eq!(state.tool, arm.tool);
}

#[test]
fn a_marker_turns_with_the_tool() {
    let arm = springy();
    let mut row = crate::fixture::row(&[0.3, -0.7, 0.4], Vector6::zeros());
    row.offset = Some([0.0, 0.1, 0.2]);
    let kind = Kind::Pose { orientation: true };
    let sim = simulate(&arm, &row, kind).unwrap();
    let want = sim.loaded.tool * nalgebra::Point3::new(0.0, 0.1, 0.2);
    assert_eq!(sim.reading().position, want.coords);
}

/// An arm that stands somewhere, seen from its base, is the arm that stands nowhere.
#[test]
fn an_arm_is_seen_from_its_base() {
    let arm = springy();
    let mut there = arm.clone();
    there.base = Isometry3::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, -0.2, 1.4));
    for kind in [
        Kind::Pose { orientation: true },
        Kind::Pose { orientation: false },
        Kind::Displacement { components: [true; 6] },
        Kind::Displacement { components: [true, true, true, false, false, false] },
    ] {
        let load = Vector6::new(50.0, -20.0, -90.0, 4.0, 5.0, -6.0);
        let mask = Vector6::from_iterator(kind.components().map(f64::from));
        let measured = |arm| {
            let mut row = row(&[0.3, -0.8, 0.6], load);
            row.measured = simulate(arm, &row, kind).unwrap().reading().vector();
            row.measured.component_mul_assign(&mask);
            table(vec![row], kind)
        };
        let seen = measured(&there).seen_from(&there.base).unwrap();
        let off = seen.rows[0].measured - measured(&arm).rows[0].measured;
        assert!(off.amax() < 1e-14, "{kind:?} {off}");
    }
    let one = Kind::Displacement { components: [false, true, false, false, false, false] };
    let data = table(vec![row(&[0.0; 3], Vector6::zeros())], one);
    assert!(data.seen_from(&there.base).is_none());
    assert!(data.seen_from(&Isometry3::translation(1.0, 0.0, 0.0)).is_some());
}
