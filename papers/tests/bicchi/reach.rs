//! What cannot be reached is reported.

use crate::arms::*;
use stiffarm_papers::bicchi::{
    Ended, ForceError, Gradient, Method, Outcome, Stop, Task, Weights, compensate,
};
use stiffarm_papers::chain::Load;
use stiffarm_papers::chain::elastic::ElasticArm;

fn search(task: &Task<'_>, q: &[f64]) -> Outcome {
    let stop = Stop { value: 1e-14, ..Stop::default() };
    compensate(task, q, Method::default(), Gradient::Exact, stop).unwrap()
}

/// The straight set-point asks for the full length, which inextensible links that bend do not have.
/// Without foreshortening the bent link's chord is longer than the link, and V = 0 is found.
#[test]
fn the_straight_set_point_is_out_of_reach() {
    for (n, ej, floor) in
        [(3, STEEL, 9.8e-9), (3, HALF, 1.7e-7), (5, STEEL, 2.0e-7), (5, HALF, 3.6e-6)]
    {
        let arm = arm(n, ej);
        let longer = search(&straight_task(&arm, DEFORMED), &vec![0.0; n]);
        assert_eq!(longer.ended, Ended::Reached);
        let true_length = search(&straight_task(&arm, SHORTENED), &vec![0.0; n]);
        assert_eq!(true_length.ended, Ended::Stationary, "{n} {ej}");
        let found = true_length.value;
        assert!((found / floor - 1.0).abs() < 0.1, "{n} {ej}: {found:e}");
    }
}

/// A force that turns with the tip keeps its size.
#[test]
fn another_size_of_the_force_is_out_of_reach() {
    let arm = arm(3, STEEL);
    let q = degrees(&[60.0, -45.0, -30.0]);
    let task = Task { target: planar(0.0, 12.0, 20.0), ..straight_task(&arm, DEFORMED) };
    let found = search(&task, &q);
    assert_eq!(found.ended, Ended::Stationary);
    assert!((found.value - 2.0).abs() < 1e-6, "{}", found.value);
    assert!((found.error[1] - 2.0).abs() < 1e-6 && found.error[5].abs() < 1e-6);
}

/// One joint cannot do two things: what remains is stationary, and the rank says why.
#[test]
fn a_defective_arm_goes_as_far_as_it_can() {
    let mut one = arm(3, STEEL);
    one.joints.truncate(1);
    let task = Task { target: planar(1.0, 9.0, 11.0), ..straight_task(&one, DEFORMED) };
    let found = search(&task, &[0.3]);
    assert_eq!((found.ended, found.rank), (Ended::Stationary, 1));
    assert!(found.value > 0.5 && found.value < found.initial_value);
    for nearby in [-1e-3, 1e-3] {
        let error = task.error(&[found.q[0] + nearby]).unwrap();
        assert!(Weights::UNIT.value(&error) > found.value);
    }
}

/// Without joints nothing can be done, and that is no mistake.
#[test]
fn an_arm_without_joints() {
    let mut none = arm(3, STEEL);
    none.joints.clear();
    let task = Task { target: planar(1.0, 10.0, 0.0), ..straight_task(&none, DEFORMED) };
    let found = search(&task, &[]);
    assert_eq!((found.ended, found.rank, found.value), (Ended::Stationary, 0, 0.5));
}

/// Under a load fixed in the base only the moment can be set.
#[test]
fn a_dead_load_leaves_the_moment() {
    let arm = arm(3, STEEL);
    let q = degrees(&[60.0, -45.0, -30.0]);
    let load = Load::Dead(planar(0.0, 10.0, 0.0));
    let task = Task { load, target: planar(0.0, 10.0, 20.0), ..straight_task(&arm, DEFORMED) };
    let found = search(&task, &q);
    assert_eq!((found.ended, found.rank), (Ended::Reached, 1));
    let loaded = ElasticArm::new(&arm, DEFORMED).settle(&found.q, &load).unwrap();
    assert!((loaded.base_wrench()[5] - 20.0).abs() < 1e-6);
    let sideways = Task { target: planar(1.0, 10.0, 20.0), ..task };
    let found = search(&sideways, &q);
    assert_eq!(found.ended, Ended::Stationary);
    assert!((found.error[0] - 1.0).abs() < 1e-9 && found.error[5].abs() < 1e-5);
}

#[test]
fn mistakes_are_told() {
    let arm = arm(3, STEEL);
    let task = straight_task(&arm, DEFORMED);
    let run = |task: &Task<'_>, q: &[f64]| {
        compensate(task, q, Method::default(), Gradient::Exact, Stop::default()).unwrap_err()
    };
    let text = run(&task, &[0.0; 2]).to_string();
    assert!(text.contains("found 2 joint values, expected 3"), "{text}");
    let nowhere = Task { target: planar(f64::NAN, 0.0, 0.0), ..task };
    assert!(matches!(run(&nowhere, &[0.0; 3]), ForceError::NotFinite { .. }));
    let endless = Task { load: Load::Dead(planar(f64::INFINITY, 0.0, 0.0)), ..task };
    assert!(matches!(run(&endless, &[0.0; 3]), ForceError::Start(_)));
}
