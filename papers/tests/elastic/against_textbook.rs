//! The chain against the textbook runtime of the kernels, and against the simulator.

use nalgebra::{Matrix6, Vector6};
use proptest::prelude::*;
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::simulate::equilibrium;
use stiffarm_kernels::generic::Arm;
use stiffarm_papers::chain::Load;
use stiffarm_papers::chain::elastic::{ElasticArm, Elasticity};

use crate::random::{case, elasticity, reach};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// At rest without load the chain's compliance is the textbook's: springs and beams of any
    /// table, in space.
    #[test]
    fn compliance_without_load((arm, q, _) in case(), e in elasticity()) {
        let none = Load::Follower(Vector6::zeros());
        let loaded = ElasticArm::new(&arm, e).settle(&q, &none).unwrap();
        let turn = *arm.pose(&q).rotation.to_rotation_matrix().matrix();
        let mut to_tool = Matrix6::zeros();
        to_tool.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn.transpose());
        to_tool.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn.transpose());
        let found = loaded.chain().tip_rate() * to_tool;
        let expected = arm.compliance(&q);
        let scale = 1e-11 * expected.amax().max(1e-9) * reach(&arm, &q).powi(2);
        prop_assert!((found - expected).amax() < scale);
    }

    /// Half the load, a quarter of the distance to first order: both kinds of load, all axes.
    #[test]
    fn small_loads_deflect_to_first_order((arm, q, w) in case(), e in elasticity()) {
        let first = arm.deflection_first_order(&q, &w);
        prop_assume!(first.norm() > 1e-6);
        let turn = arm.pose(&q).rotation.inverse();
        let (f, m) = (turn * w.fixed_rows::<3>(0), turn * w.fixed_rows::<3>(3));
        let in_tool = Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z);
        let off = |part: f64| {
            let elastic = ElasticArm::new(&arm, e);
            [Load::Dead(w * part), Load::Follower(in_tool * part)].map(|load| {
                (elastic.settle(&q, &load).unwrap().deflection() - first * part).norm()
            })
        };
        let (small, half) = (off(1e-2), off(5e-3));
        for k in 0..2 {
            let rounding = 1e-13 * reach(&arm, &q).powi(2);
            prop_assert!(half[k] < 0.3 * small[k] + rounding, "{small:?} {half:?}");
            prop_assert!(small[k] < 5e-2 * first.norm() * 1e-2 + rounding);
        }
    }

    /// Without beams the springs are all there is, and the simulator solves the same arm by other
    /// means.
    #[test]
    fn springs_alone_are_the_simulators((mut arm, q, w) in case(), e in elasticity()) {
        for joint in &mut arm.joints {
            joint.beam = None;
        }
        let state = equilibrium(&arm, &q, &w).unwrap();
        let loaded = ElasticArm::new(&arm, e).settle(&q, &Load::Dead(w)).unwrap();
        let apart = loaded.pose().to_homogeneous() - state.tool.to_homogeneous();
        prop_assert!(apart.amax() < 1e-11 * reach(&arm, &q));
        for (found, expected) in loaded.joint_loads().unwrap().iter().zip(state.torque.iter()) {
            prop_assert!((found - expected).abs() < 1e-9 * w.norm() * reach(&arm, &q));
        }
    }
}

/// The deflection with the loaded geometry's stiffness is right to the second order in the load
/// where springs alone give way.
#[test]
fn the_textbooks_deflection_is_the_second_order() {
    let text = include_str!("../../../robots/arms/kuka_kr240.toml");
    let robot = Robot::from_toml(text, "kuka_kr240.toml").unwrap().0;
    let arm: Arm = stiffarm_gap::robot::arm(&robot).unwrap();
    let q = [0.3, -1.2, 0.4, 0.7, -0.8, 0.2];
    let w = Vector6::new(500.0, -900.0, -2000.0, 100.0, 50.0, -200.0);
    let elastic = ElasticArm::new(&arm, Elasticity::default());
    let exact = |part: f64| elastic.settle(&q, &Load::Dead(w * part)).unwrap().deflection();
    let textbook = |part: f64| arm.deflection(&q, &(w * part)).unwrap();
    let relative = (exact(1.0) - textbook(1.0)).norm() / exact(1.0).norm();
    assert!(relative < 5e-3, "{relative}");
    let first = (exact(1.0) - arm.deflection_first_order(&q, &w)).norm() / exact(1.0).norm();
    assert!(relative < first, "{relative} {first}");
}
