//! Targets at which a loaded arm stands, found again; and targets that no arm reaches.

use nalgebra::{UnitQuaternion, Vector3, Vector6};
use stiffarm_kernels::generic::Arm;

use super::{Ended, Reached, Search, Target, reach, reach_by_branches};
use crate::CompensateError;
use crate::rng::{Rng, Stream};
use crate::simulate::equilibrium;
use crate::whole::Situation;

fn kr240() -> Arm {
    let mut arm = crate::fixture::kr240([0.0; 3]);
    for joint in &mut arm.joints[1..4] {
        (joint.mass, joint.compliance) = (150.0, 3.0 * joint.compliance);
    }
    arm
}

fn target(arm: &Arm, q: &[f64], load: &Vector6<f64>) -> Target {
    let tool = equilibrium(arm, q, load).unwrap().tool;
    Target { position: tool.translation.vector, rotation: Some(tool.rotation) }
}

/// The error again, by the simulator and quaternions put together here.
fn missed(arm: &Arm, target: &Target, load: &Vector6<f64>, found: &Reached) -> [f64; 2] {
    let tool = equilibrium(arm, &found.q, load).unwrap().tool;
    let angle = target.rotation.map_or(0.0, |r| r.angle_to(&tool.rotation));
    [(tool.translation.vector - target.position).norm(), angle]
}

const LOAD: [f64; 6] = [500.0, -300.0, -2000.0, 100.0, 50.0, -80.0];

#[test]
fn the_loaded_arm_stands_at_the_target() {
    let load = Vector6::from(LOAD);
    let lin = crate::fixture::arm(include_str!("../../../robots/arms/lin_elbow.toml"));
    let panda = crate::fixture::arm(include_str!("../../../robots/arms/panda.toml"));
    for (arm, load) in [(kr240(), load), (lin, load / 50.0), (panda, load / 100.0)] {
        let mut rng = Rng::new(7, Stream::Starts);
        for _ in 0..5 {
            let of = |limits: Option<[f64; 2]>| limits.unwrap_or([-2.0, 2.0]);
            let q: Vec<f64> = arm.joints.iter().map(|j| rng.within(of(j.limits))).collect();
            let near: Vec<f64> = q.iter().map(|q| q + 0.02).collect();
            let target = target(&arm, &q, &load);
            let search = Search::default();
            let found =
                reach(&arm, &target, &Situation::under(load), Some(&near), &search).unwrap();
            assert_eq!(found.ended, Ended::Reached, "{found:?}");
            let [p, r] = missed(&arm, &target, &load, &found);
            assert!(p <= 1e-6 && r <= 1e-6, "{p} {r}");
            for (q, joint) in found.q.iter().zip(&arm.joints) {
                assert!(joint.limits.is_none_or(|[low, high]| (low..=high).contains(q)));
            }
        }
    }
}

/// Without a start, and with one that is far off.
#[test]
fn random_starts_find_the_target_too() {
    let (arm, load) = (kr240(), Vector6::from(LOAD));
    let target = target(&arm, &[0.4, 1.2, -1.9, 0.5, 0.8, -0.3], &load);
    let search = Search::default();
    let found = reach(&arm, &target, &Situation::under(load), None, &search).unwrap();
    assert_eq!(found.ended, Ended::Reached);
    let [p, r] = missed(&arm, &target, &load, &found);
    assert!(p <= 1e-6 && r <= 1e-6);
    assert_eq!(reach(&arm, &target, &Situation::under(load), None, &search).unwrap(), found);
    let far = [3.0, 0.1, -4.0, -3.0, -1.0, 3.0];
    let found = reach(&arm, &target, &Situation::under(load), Some(&far), &search).unwrap();
    assert_eq!(found.ended, Ended::Reached);
}

/// Branches that are known are where it begins; those that lead nowhere leave it to random starts.
#[test]
fn known_branches_come_before_random_starts() {
    let (arm, load) = (kr240(), Vector6::from(LOAD));
    let q = [0.4, 1.2, -1.9, 0.5, 0.8, -0.3];
    let (target, search) = (target(&arm, &q, &load), Search { starts: 0, ..Search::default() });
    let at = Situation::under(load);
    let near = || vec![q.map(|q| q + 0.01).to_vec()];
    let found = reach_by_branches(&arm, &target, &at, (None, &near), &search).unwrap();
    assert_eq!(found.ended, Ended::Reached);
    assert!(found.q.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-4), "{found:?}");
    let none = reach_by_branches(&arm, &target, &at, (None, &Vec::new), &search).unwrap();
    assert_eq!(none.ended, Ended::Unstable);
    let random = reach_by_branches(&arm, &target, &at, (None, &Vec::new), &Search::default());
    assert_eq!(random.unwrap().ended, Ended::Reached);
}

/// What the load does without compensation is the deflection at a rigid arm's set-points.
#[test]
fn the_gap_without_compensation_is_the_deflection() {
    let (arm, load) = (kr240(), Vector6::from(LOAD));
    let q = [0.4, 1.2, -1.9, 0.5, 0.8, -0.3];
    let ideal = arm.pose(&q);
    let target = Target { position: ideal.translation.vector, rotation: Some(ideal.rotation) };
    let found =
        reach(&arm, &target, &Situation::under(load), Some(&q), &Search::default()).unwrap();
    let tool = equilibrium(&arm, &q, &load).unwrap().tool;
    let sag = ideal.translation.vector - tool.translation.vector;
    let without: Vector3<f64> = found.uncompensated.unwrap().fixed_rows::<3>(0).into_owned();
    // Both to the tolerance of the search.
    assert!((without - sag).norm() < 2e-6, "{without} {sag}");
    assert!(sag.norm() > 1e-3);
}

#[test]
fn a_position_alone_leaves_the_wrist_free() {
    let (arm, load) = (kr240(), Vector6::from(LOAD));
    let position = Vector3::new(1.6, 0.4, 0.7);
    let target = Target { position, rotation: None };
    let found = reach(&arm, &target, &Situation::under(load), None, &Search::default()).unwrap();
    assert_eq!(found.ended, Ended::Reached);
    assert_eq!(found.error.fixed_rows::<3>(3).norm(), 0.0);
    assert!(missed(&arm, &target, &load, &found)[0] <= 1e-6);
}

#[test]
fn what_cannot_be_reached_is_said() {
    let (arm, load) = (kr240(), Vector6::from(LOAD));
    let far = Target { position: Vector3::new(9.0, 0.0, 0.0), rotation: None };
    let found = reach(&arm, &far, &Situation::under(load), None, &Search::default()).unwrap();
    assert!(matches!(&found.ended, Ended::Nearest(_)), "{found:?}");
    // Stretched out toward it: 0.35 + 1.25 + 1.101 + 0.23 m.
    assert!((found.error.fixed_rows::<3>(0).norm() - (9.0 - 2.93)).abs() < 0.02, "{found:?}");
    // Behind a limit: joint 1 ends at 20°, the target stands at 90°.
    let mut narrow = arm.clone();
    narrow.joints[0].limits = Some([-0.35, 0.35]);
    narrow.joints[1].limits = Some([0.0, 1.0]);
    let aside = Target { position: Vector3::new(0.0, 2.2, 0.3), rotation: None };
    let found = reach(&narrow, &aside, &Situation::under(load), None, &Search::default()).unwrap();
    assert!(matches!(&found.ended, Ended::Nearest(joints) if joints.contains(&1)), "{found:?}");
    let crush = Vector6::new(0.0, 0.0, -1e12, 0.0, 0.0, 0.0);
    let found = reach(&arm, &aside, &Situation::under(crush), None, &Search::default()).unwrap();
    assert_eq!(found.ended, Ended::Unstable);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (mut arm, load) = (kr240(), Vector6::from(LOAD));
    let target = Target { position: Vector3::x(), rotation: Some(UnitQuaternion::identity()) };
    let search = Search::default();
    let lost = Target { position: Vector3::repeat(f64::NAN), rotation: None };
    let error = reach(&arm, &lost, &Situation::under(load), None, &search).unwrap_err();
    assert!(matches!(error, CompensateError::NotFinite { .. }));
    let error =
        reach(&arm, &target, &Situation::under(load), Some(&[0.0; 5]), &search).unwrap_err();
    assert!(matches!(error, CompensateError::JointValues { .. }));
    let strict = Search { translation: 0.0, ..search };
    let error = reach(&arm, &target, &Situation::under(load), None, &strict).unwrap_err();
    assert!(matches!(error, CompensateError::NotPositive { .. }));
    arm.joints[2].motion = stiffarm_kernels::Motion::Prismatic;
    arm.joints[2].limits = None;
    let error = reach(&arm, &target, &Situation::under(load), None, &search).unwrap_err();
    assert_eq!(error, CompensateError::Unlimited { joint: 3 });
}
