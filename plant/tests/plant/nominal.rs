//! No truth at all: the textbook to first order, and the model that the diagnosis simulates.

use nalgebra::{Vector3, Vector6};
use stiffarm_gap::simulate::simulate;
use stiffarm_kernels::generic::{Arm, Convention};

use crate::arms::{
    EXACT, MOVED, POSE, apart, isometry, loaded, measured, one, plant, reading, rows,
};

const BOTH: [Convention; 2] = [Convention::Standard, Convention::Modified];
const POSTURES: [[f64; 5]; 3] =
    [[0.7, -0.5, 0.2, 1.1, -0.4], [-2.0, 1.3, 0.4, -0.8, 2.5], [0.1, 2.2, 0.1, 0.3, 1.9]];
const WRENCH: [f64; 6] = [90.0, -60.0, -250.0, 12.0, -8.0, 20.0];

/// The gap to first order in the compliance: what is left shrinks with its square.
#[test]
fn it_is_the_textbooks_to_first_order() {
    shrinks(0.01, |arm, q, w| {
        let found = measured(arm, &[], &rows(MOVED, vec![reading(q, WRENCH)]))[0];
        (found - arm.deflection_first_order(q, w)).norm()
    });
}

/// What is left of the compliance by an arm ten times as stiff is a tenth, but for so much.
fn shrinks(by: f64, left: impl Fn(&Arm, &[f64; 5], &Vector6<f64>) -> f64) {
    for convention in BOTH {
        for q in POSTURES {
            let [one, tenth] = [1.0, 0.1].map(|softness| {
                let arm = softened(&loaded(convention), softness);
                left(&arm, &q, &Vector6::from_row_slice(&WRENCH)) / softness
            });
            assert!(one > 1e-8, "{one:e}");
            assert!((tenth / one - 0.1).abs() < by, "{convention:?} {q:?}: {one:e} {tenth:e}");
        }
    }
}

fn softened(arm: &Arm, by: f64) -> Arm {
    let mut arm = arm.clone();
    for joint in &mut arm.joints {
        joint.compliance *= by;
        if let Some(beam) = &mut joint.beam {
            // Stiffer, not heavier.
            beam.youngs_modulus /= by;
            beam.shear_modulus /= by;
        }
    }
    arm
}

/// The weights too, against `J C Jᵀ w` and the links' sag. In the pose, not in a difference.
#[test]
fn weights_are_the_textbooks_to_first_order() {
    shrinks(0.02, |arm, q, w| {
        let twist = arm.deflection_with_gravity(q, w).unwrap();
        let found = isometry(&one(arm, &[], reading(q, WRENCH)));
        let rigid = arm.pose(q);
        let moved = found.translation.vector - rigid.translation.vector;
        let turned = (found.rotation * rigid.rotation.inverse()).scaled_axis();
        let move_off = moved - Vector3::new(twist[0], twist[1], twist[2]);
        let turn_off = turned - Vector3::new(twist[3], twist[4], twist[5]);
        move_off.norm().max(turn_off.norm())
    });
}

/// Springs and weights on the loaded geometry, by the simulator of the diagnosis.
#[test]
fn springs_and_weights_are_the_simulators() {
    for convention in BOTH {
        let mut arm = loaded(convention);
        arm.joints.iter_mut().for_each(|joint| joint.beam = None);
        for q in POSTURES {
            let row = reading(&q, WRENCH);
            let expected = simulate(&arm, &row, POSE).unwrap().reading().vector();
            let error = apart(&isometry(&one(&arm, &[], row)), &isometry(&expected));
            assert!(error < 1e-13, "{convention:?} {q:?}: {error:e}");
        }
    }
}

/// What a first-order sim predicts is the textbook's, columns and all.
#[test]
fn the_sim_of_first_order_is_the_textbooks() {
    for convention in BOTH {
        let arm = loaded(convention);
        let q = POSTURES[0];
        let w = Vector6::from_row_slice(&WRENCH);
        let design = rows(MOVED, vec![reading(&q, WRENCH)]);
        let data = plant(&arm, &["geometric_stiffness=1"]).measure(&design, EXACT, 0).unwrap();
        assert_eq!(data.sim_given, [true; 6]);
        let sim = **data.rows[0].sim.as_ref().unwrap();
        // As a difference of poses: the rotations do not add up beyond first order.
        assert!((sim - arm.deflection_first_order(&q, &w)).fixed_rows::<3>(0).amax() < 1e-14);
        assert!((sim - arm.deflection_first_order(&q, &w)).amax() < 1e-5);
        assert!((sim - data.rows[0].measured).amax() > 1e-7);
        // Half of it is half way.
        let half = plant(&arm, &["geometric_stiffness=0.5"]).measure(&design, EXACT, 0).unwrap();
        let middle = (data.rows[0].measured + sim) / 2.0;
        assert!((**half.rows[0].sim.as_ref().unwrap() - middle).fixed_rows::<3>(0).amax() < 1e-14);
        let asked = plant(&arm, &[]).with_first_order_sim().measure(&design, EXACT, 0).unwrap();
        assert_eq!(asked, data);
    }
}
