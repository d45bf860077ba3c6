//! Every derivative against central differences.

use nalgebra::{Isometry3, Vector6};
use proptest::prelude::*;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_papers::chain::Load;
use stiffarm_papers::chain::elastic::{ElasticArm, Elasticity, Loaded};

use crate::random::{case, elasticity, reach};

const STEP: f64 = 6e-6;

fn twist(from: &Isometry3<f64>, to: &Isometry3<f64>) -> Vector6<f64> {
    let d = to.translation.vector - from.translation.vector;
    let r = (to.rotation * from.rotation.inverse()).scaled_axis();
    Vector6::new(d.x, d.y, d.z, r.x, r.y, r.z)
}

/// The largest errors of both Jacobians, relative to the size of wrench and reach.
fn errors(arm: &Arm, q: &[f64], load: &Load, e: Elasticity) -> (f64, f64) {
    let elastic = ElasticArm::new(arm, e);
    let loaded = elastic.settle(q, load).unwrap();
    let (wrench, tip) = (loaded.wrench_jacobian().unwrap(), loaded.tip_jacobian().unwrap());
    let mut worst: (f64, f64) = (0.0, 0.0);
    for k in 0..arm.dof() {
        let at = |h: f64| -> Loaded {
            let mut moved = q.to_vec();
            moved[k] += h;
            elastic.settle(&moved, load).unwrap()
        };
        let (low, high) = (at(-STEP), at(STEP));
        let change = (high.base_wrench() - low.base_wrench()) / (2.0 * STEP);
        worst.0 = worst.0.max((wrench.column(k) - change).amax());
        let moved = twist(&low.pose(), &high.pose()) / (2.0 * STEP);
        worst.1 = worst.1.max((tip.column(k) - moved).amax());
    }
    let reach = reach(arm, q);
    (worst.0 / (load.wrench().norm() * reach), worst.1 / reach)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// G and the tip's Jacobian with all deformations following: revolute and prismatic joints,
    /// both conventions, both loads, both axes, with and without foreshortening.
    #[test]
    fn jacobians((arm, q, w) in case(), e in elasticity(), dead in any::<bool>()) {
        // A link of no length has no direction, and no derivative either.
        let short = arm.joints.iter().zip(&q).any(|(joint, q)| {
            joint.motion == Motion::Prismatic && joint.beam.is_some()
                && (joint.d + q).hypot(joint.a) < 0.05
        });
        prop_assume!(!short);
        let load = if dead { Load::Dead(w) } else { Load::Follower(w) };
        let (wrench, tip) = errors(&arm, &q, &load, e);
        prop_assert!(wrench < 2e-8 && tip < 2e-8, "{wrench:e} {tip:e}");
    }

    /// The paper's gradient is exact in its first column (standard convention, revolute joint), and
    /// all of it is exact for a rigid arm.
    #[test]
    fn the_frozen_gradient((mut arm, q, w) in case(), e in elasticity()) {
        let load = Load::Follower(w);
        let scale = 1e-11 * w.norm() * reach(&arm, &q);
        if arm.convention == Convention::Standard && arm.joints[0].motion == Motion::Revolute {
            let loaded = ElasticArm::new(&arm, e).settle(&q, &load).unwrap();
            let (exact, frozen) =
                (loaded.wrench_jacobian().unwrap(), loaded.frozen_wrench_jacobian());
            prop_assert!((exact.column(0) - frozen.column(0)).amax() < scale);
        }
        for joint in &mut arm.joints {
            (joint.beam, joint.compliance) = (None, 0.0);
        }
        let rigid = ElasticArm::new(&arm, e).settle(&q, &load).unwrap();
        let apart = rigid.wrench_jacobian().unwrap() - rigid.frozen_wrench_jacobian();
        prop_assert!(apart.amax() < scale);
        let tip = rigid.tip_jacobian().unwrap() - arm.jacobian(&q);
        prop_assert!(tip.amax() < 1e-12 * reach(&arm, &q));
    }
}
