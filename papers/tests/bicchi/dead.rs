//! Loads that stay fixed in the base.

use crate::arms::*;
use stiffarm_papers::chain::Load;
use stiffarm_papers::chain::elastic::ElasticArm;

const POSTURES: [[f64; 3]; 3] = [[60.0, -45.0, -30.0], [90.0, -90.0, 0.0], [30.0, 45.0, 60.0]];

/// Steps of the plain fixed point `ᴱw = R(ᴱw)ᵀ F` to 1e-10, none if it does not arrive in 500.
fn fixed_point(q: &[f64], size: f64) -> Option<usize> {
    let arm = arm(3, STEEL);
    let elastic = ElasticArm::new(&arm, DEFORMED);
    let load = planar(0.0, size, 0.0);
    let mut tip = load;
    for step in 0..500 {
        let pose = elastic.settle(q, &Load::Follower(tip)).ok()?.pose();
        let force = pose.rotation.inverse() * load.fixed_rows::<3>(0);
        let next = planar(force.x, force.y, 0.0);
        if (next - tip).norm() < 1e-10 * size {
            return Some(step);
        }
        tip = next;
    }
    None
}

#[test]
fn newton_arrives_where_the_fixed_point_does_not() {
    let arm = arm(3, STEEL);
    let elastic = ElasticArm::new(&arm, DEFORMED);
    for posture in POSTURES {
        let q = degrees(&posture);
        assert!(fixed_point(&q, 10.0).unwrap() < 10);
        assert_eq!(fixed_point(&q, 200.0), None, "{posture:?}");
        for size in [0.0, 10.0, 100.0, 200.0, 400.0] {
            let load = planar(0.0, size, 0.0);
            let loaded = elastic.settle(&q, &Load::Dead(load)).unwrap();
            let w = loaded.base_wrench();
            // The force arrives as it was given, its moment with the displaced lever.
            assert!((w.fixed_rows::<3>(0) - load.fixed_rows::<3>(0)).amax() < 1e-9);
            let lever = loaded.pose().translation.vector.x;
            assert!((w[5] - lever * size).abs() < 1e-8);
        }
    }
}

/// A push along the straight arm: below the buckling load it stays straight.
#[test]
fn a_push_below_the_buckling_load() {
    let arm = arm(3, STEEL);
    let elastic = ElasticArm::new(&arm, DEFORMED);
    let push = Load::Dead(planar(-20.0, 1e-3, 0.0));
    let loaded = elastic.settle(&[0.0; 3], &push).unwrap();
    let (_, tip) = in_plane(&loaded);
    assert!(tip[0] > 2.999 && tip[1] > 0.0 && tip[1] < 1e-3, "{tip:?}");
}
