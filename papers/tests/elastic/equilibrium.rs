//! Statics and kinematics of the settled chain.

use nalgebra::{Isometry3, Vector3, Vector6};
use proptest::prelude::*;
use stiffarm_kernels::Motion;
use stiffarm_kernels::generic::Convention;
use stiffarm_papers::chain::elastic::ElasticArm;
use stiffarm_papers::chain::{Chain, Load, wrench_in};

use crate::random::{case, elasticity, reach};

fn part(v: &Vector6<f64>, from: usize) -> Vector3<f64> {
    v.fixed_rows::<3>(from).into_owned()
}

proptest! {
    #[test]
    fn without_load_it_is_the_forward_kinematics((arm, q, _) in case(), e in elasticity()) {
        let none = Load::Follower(Vector6::zeros());
        let loaded = ElasticArm::new(&arm, e).settle(&q, &none).unwrap();
        let apart = loaded.pose().to_homogeneous() - arm.pose(&q).to_homogeneous();
        prop_assert!(apart.amax() < 1e-14 * reach(&arm, &q));
        let rounding = 1e-15 * reach(&arm, &q);
        prop_assert!(loaded.errors().iter().all(|error| error.vector().amax() < rounding));
        prop_assert!(loaded.largest_turn() < rounding);
    }

    #[test]
    fn every_section_is_in_equilibrium((arm, q, w) in case(), e in elasticity()) {
        let loaded = ElasticArm::new(&arm, e).settle(&q, &Load::Follower(w)).unwrap();
        let scale = 1e-11 * w.norm() * reach(&arm, &q);
        // The errors put into the chain give the same displaced arm.
        let errors = loaded.errors();
        let chain = Chain::new(&arm, &errors).unwrap();
        let frames = chain.frames(&q).unwrap();
        let pose = chain.pose(&q).unwrap().to_homogeneous();
        prop_assert!((pose - loaded.pose().to_homogeneous()).amax() < 1e-12 * reach(&arm, &q));
        // Seen from the base, every section carries what acts on the tip.
        let base = loaded.base_wrench();
        for (place, frame) in frames.iter().enumerate() {
            let section = loaded.chain().wrench(place).unwrap();
            prop_assert!((wrench_in(frame, section) - base).amax() < scale);
        }
        // Forces sum to zero, moments about the tip too.
        let tip = loaded.pose();
        let (force, moment) = (tip.rotation * part(&w, 0), tip.rotation * part(&w, 3));
        prop_assert!((part(&base, 0) - force).amax() < scale);
        let about_tip = part(&base, 3) - tip.translation.vector.cross(&force);
        prop_assert!((about_tip - moment).amax() < scale);
    }

    /// A joint carries the moment about, or the force along, its displaced axis.
    #[test]
    fn joints_carry_the_load_on_their_axes((arm, q, w) in case(), e in elasticity()) {
        let loaded = ElasticArm::new(&arm, e).settle(&q, &Load::Follower(w)).unwrap();
        let (base, frames) = (loaded.base_wrench(), loaded.chain().frames());
        let loads = loaded.joint_loads().unwrap();
        for (i, joint) in arm.joints.iter().enumerate() {
            // z of the displaced frame before (standard) or behind (modified) the row.
            let frame: &Isometry3<f64> = match arm.convention {
                Convention::Standard => &frames[i],
                Convention::Modified => &frames[i + 1],
            };
            let axis = frame.rotation * Vector3::z();
            let lever = frame.translation.vector;
            let expected = match joint.motion {
                Motion::Revolute => {
                    axis.dot(&(part(&base, 3) - lever.cross(&part(&base, 0))))
                }
                Motion::Prismatic => axis.dot(&part(&base, 0)),
            };
            prop_assert!((loads[i] - expected).abs() < 1e-10 * w.norm() * reach(&arm, &q));
        }
    }

    /// The base sees a dead load as it was given, at the displaced tip.
    #[test]
    fn a_dead_load_keeps_its_direction((arm, q, w) in case(), e in elasticity()) {
        let loaded = ElasticArm::new(&arm, e).settle(&q, &Load::Dead(w)).unwrap();
        let scale = 1e-9 * w.norm() * reach(&arm, &q);
        let (base, tip) = (loaded.base_wrench(), loaded.pose().translation.vector);
        prop_assert!((part(&base, 0) - part(&w, 0)).amax() < scale);
        let moment = part(&w, 3) + tip.cross(&part(&w, 0));
        prop_assert!((part(&base, 3) - moment).amax() < scale);
    }
}
