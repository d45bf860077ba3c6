//! What the diagnosis' package computes of effects that are known, against this plant, which shares nothing with it.

use nalgebra::Vector6;
use stiffarm_compensate::reach::{Ended, Search, Target, reach};
use stiffarm_gap::effects::Known;
use stiffarm_gap::identify::measured::{Question, Unknown, identify_measured};
use stiffarm_gap::instrument::Seen;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::predicted::predicted;
use stiffarm_gap::simulate::{Reading, equilibrium};
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Plant, Truth};

use crate::fixture::{known, row, springy, table};

const LOAD: [f64; 6] = [500.0, -300.0, -2000.0, 100.0, 50.0, -80.0];

/// With weights, so that the unloaded arm is bent too.
fn kr240() -> Arm {
    let mut arm = crate::fixture::kr240([0.1, 0.05, 0.15]);
    for joint in &mut arm.joints[1..4] {
        (joint.mass, joint.compliance) = (150.0, 3.0 * joint.compliance);
    }
    arm
}

/// Against the plant, which shares nothing with it: an effect of each kind, and all that is measured.
#[test]
fn it_is_what_a_plant_shows_without_noise() {
    let arm = springy();
    let effects = [
        known("transmission_error", "joint 2", 2, &[3e-4, -1e-4]),
        known("joint_hardening", "joint 2", 0, &[1e-12]),
        known("backlash", "joint 3", 0, &[4e-4]),
        known("settling_lag", "joint 1", 0, &[2e-4]),
        known("drift", "base", 0, &[1e-8; 6]),
    ];
    let pose = Kind::Pose { orientation: true };
    for kind in [pose, Kind::Displacement { components: [true; 6] }, Kind::Distance] {
        let design =
            Design { shape: Shape::Force, poses: 6, repeats: 1, payload: 10.0, kind, seed: 2 };
        let rows = design.rows(&arm);
        let plant = Plant::beyond(&arm, &effects, &[]).unwrap().exact(&rows).unwrap();
        let found = predicted(Whole { arm: &arm, known: &effects }, &rows).unwrap();
        let bare = predicted(&arm, &rows).unwrap();
        for (k, (is, shown)) in found.rows.iter().zip(&plant.rows).enumerate() {
            let off = (is.measured - shown.measured).amax();
            assert!(off < 1e-10, "{kind:?} {k}: {off:e}");
        }
        let moved = |k: usize| (found.rows[k].measured - bare.rows[k].measured).amax();
        // Of a difference only what grows with the load is left.
        let least = if matches!(kind, Kind::Displacement { .. }) { 1e-6 } else { 1e-4 };
        assert!((0..rows.rows.len()).any(|k| moved(k) > least), "{kind:?}");
    }
}

/// What else the arm does is taken into account: the independent plant stands at the target too.
#[test]
fn effects_are_compensated() {
    let (arm, load) = (kr240(), Vector6::from(LOAD));
    let told = [
        "joint_ratio@joint 2=1e-3",
        "backlash@joint 1=0.6 mrad",
        "transmission_error@joint 3:cos 2=0.4 mrad",
        "settling_lag@joint 2=1e-3",
        "joint_compliance@joint 4=5e-7",
        "thermal_growth=20e-6",
        "base_frame:x=3mm,rz=4mrad",
    ];
    let truths: Vec<Truth> = told.iter().map(|text| Truth::parse(text, &arm).unwrap()).collect();
    let present = |truth: &Truth| {
        let spots = truth.effect.spots(&arm, truth.place, &truth.values);
        spots.into_iter().map(|(spot, values)| Known {
            effect: truth.effect,
            spot,
            values,
            session: None,
            at: Default::default(),
        })
    };
    let effects: Vec<Known> = truths.iter().flat_map(present).collect();
    let before = vec![0.1, 1.0, -1.5, 0.0, 0.5, 0.0];
    let situation = Situation {
        load,
        direction: Some(vec![1, 0, 0, 0, 0, 0]),
        warming: Some(12.0),
        before: Some(before.clone()),
    };
    let q = [0.4, 1.2, -1.9, 0.5, 0.8, -0.3];
    let tool = equilibrium(&arm, &q, &load).unwrap().tool;
    let target = Target { position: tool.translation.vector, rotation: Some(tool.rotation) };
    let real = Whole { arm: &arm, known: &effects };
    let found = reach(real, &target, &situation, Some(&q), &Search::default()).unwrap();
    assert_eq!(found.ended, Ended::Reached);
    assert!(found.uncompensated.unwrap().fixed_rows::<3>(0).norm() > 2e-3);
    let mut rows = [before, found.q].map(|q| row(&q, load)).to_vec();
    for (row, temperature) in rows.iter_mut().zip([20.0, 32.0]) {
        (row.direction, row.temperature) = (situation.direction.clone(), Some(temperature));
    }
    let session = table(rows, Kind::Pose { orientation: true });
    let shown = Plant::new(&arm, &truths).unwrap().exact(&session).unwrap().rows[1].measured;
    let is = Reading::from_vector(&shown);
    let off = (is.position - target.position).norm();
    // Both to the tolerance of the search.
    assert!(off < 2e-6 && is.rotation.angle_to(&target.rotation.unwrap()) < 2e-6, "{off}");
    for (k, missing) in ["side", "warm", "before"].into_iter().enumerate() {
        let mut at = situation.clone();
        match k {
            0 => at.direction = None,
            1 => at.warming = None,
            _ => at.before = None,
        }
        let error = reach(real, &target, &at, Some(&q), &Search::default()).unwrap_err();
        assert!(error.to_string().contains(missing), "{error}");
    }
}

/// Springs are found on top of what the robot file says beyond its table, and without it they are others:
/// the measurements are a plant's, which shares nothing with the fit.
#[test]
fn springs_are_found_on_top_of_what_is_known() {
    let arm = kr240();
    let known = [
        known("joint_ratio", "joint 3", 0, &[0.02]),
        // About one axis: which of two turns comes first is a matter of definition.
        known("base_compliance", "base", 0, &[4e-8, 0.0, 0.0, 0.0]),
        known("joint_hardening", "joint 2", 0, &[2e-14]),
        known("wrench_scale", "tool", 0, &[0.05]),
    ];
    let kind = Kind::Displacement { components: [true, true, true, false, false, false] };
    let design =
        Design { shape: Shape::Force, poses: 10, repeats: 1, payload: 150.0, kind, seed: 5 };
    let rows = design.rows(&arm);
    let data = Plant::beyond(&arm, &known, &[]).unwrap().exact(&rows).unwrap();
    let mut rigid = arm.clone();
    rigid.joints.iter_mut().for_each(|joint| joint.compliance = 0.0);
    let worst = |known: &[Known]| {
        let question = Question { known: known.to_vec(), ..Question::default() };
        let found = identify_measured(&rigid, &data, &question, &|_| {}).unwrap();
        let off = |(j, joint): (usize, &stiffarm_kernels::generic::Joint)| {
            (found.value(Unknown::Joint(j + 1)).unwrap() / joint.compliance - 1.0).abs()
        };
        arm.joints.iter().enumerate().map(off).fold(0.0, f64::max)
    };
    assert!(worst(&known) < 1e-6, "{}", worst(&known));
    for left_out in 0..known.len() {
        let mut others = known.to_vec();
        others.remove(left_out);
        // A thousand times what the fit leaves with all of them.
        assert!(worst(&others) > 1e-3, "{left_out}: {}", worst(&others));
    }
}

/// Of instruments whose bench is unknown, each: all springs, to what a fifth of all deflections leaves of the second order.
#[test]
fn springs_are_found_on_a_bench() {
    let arm = kr240();
    let mut stiff = arm.clone();
    stiff.joints.iter_mut().for_each(|joint| joint.compliance *= 0.8);
    let all = [Seen::Point, Seen::Plane, Seen::Distance, Seen::Direction, Seen::Level];
    for seen in all.into_iter().step_by(stiffarm_draws::few_or_many(3, 1)) {
        let kind = Kind::Pose { orientation: true };
        let design =
            Design { shape: Shape::Force, poses: 60, repeats: 1, payload: 150.0, kind, seed: 5 };
        let data =
            Plant::beyond(&arm, &[], &[]).unwrap().exact(&design.read_by(&arm, seen)).unwrap();
        let found = identify_measured(&stiff, &data, &Question::default(), &|_| {}).unwrap();
        for (j, joint) in arm.joints.iter().enumerate() {
            let off = found.value(Unknown::Joint(j + 1)).unwrap() / joint.compliance - 1.0;
            // A level does not see a turn about the vertical.
            let is_seen = seen != Seen::Level || j > 0;
            assert!(!is_seen || off.abs() < 1e-4, "{seen:?}, joint {}: {off}", j + 1);
        }
    }
}
