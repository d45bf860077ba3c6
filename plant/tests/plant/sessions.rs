//! Several sessions in one file: each has a base of its own, and nothing reaches from one into another.

use nalgebra::{Isometry3, Vector3};
use stiffarm_gap::diagnose::{Diagnosed, Nuisance};
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::{Arm, Convention};
use stiffarm_plant::Noise;
use stiffarm_plant::design::{Design, Shape};

use crate::arms::{EXACT, POSE, SOFT, frames, loaded, plant, soft_joint_is_found, sprung};

const NOISE: Noise = Noise { position: 2e-5, rotation: 2e-5 };

/// Sessions of other poses each, in one file.
fn design(arm: &Arm, names: &[&str], poses: usize) -> Measurements {
    let of =
        |seed| Design { shape: Shape::Payload, poses, repeats: 1, payload: 20.0, kind: POSE, seed };
    let mut all: Option<Measurements> = None;
    for (seed, name) in (5..).zip(names) {
        let mut one = of(seed).rows(arm);
        let (rows, poses) = all.as_ref().map_or((0, 0), |all| (all.rows.len(), all.poses));
        for row in &mut one.rows {
            row.line += rows as u64;
            row.group += poses;
            row.session = Some((*name).to_owned());
        }
        match &mut all {
            Some(all) => {
                all.poses += one.poses;
                all.rows.append(&mut one.rows);
            }
            None => all = Some(one),
        }
    }
    all.expect("a session")
}

/// Where the tracker stood.
fn bases() -> Vec<Isometry3<f64>> {
    vec![
        Isometry3::new(Vector3::new(-1.3, 0.4, 0.2), Vector3::new(0.1, -0.2, 2.5)),
        Isometry3::new(Vector3::new(0.2, 2.0, -0.3), Vector3::new(-0.3, 0.1, -1.0)),
    ]
}

fn found(arm: &Arm, data: &Measurements, nuisances: Vec<Nuisance>) -> Diagnosed {
    let options = Options { nuisances, ..Options::default() };
    diagnose_with(arm, data, &options, &|_| {}).expect("a diagnosis")
}

#[test]
fn each_session_has_its_base_and_all_have_one_arm() {
    let arm = loaded(Convention::Standard);
    let first = frames(
        Isometry3::new(Vector3::new(1.0, -0.5, 0.1), Vector3::new(0.2, 0.3, 1.2)),
        Isometry3::translation(0.01, 0.02, -0.01),
    );
    let plant = plant(&arm, &[SOFT]).with_sessions(&first, bases());
    let data =
        plant.measure(&design(&arm, &["mon", "tue", "wed"], 14), NOISE, 1).expect("measured");
    let both = found(&arm, &data, Nuisance::ALL.to_vec());
    let d = &both.diagnosis;
    soft_joint_is_found(d);
    assert!(d.gap.after.position_rms < 1.2 * 3f64.sqrt() * NOISE.position, "{:?}", d.gap);
    // Three bases and one tool, each where it was: 42 rows of six numbers to 20 µm, the arm within 2 m.
    let stood = std::iter::once(first.base).chain(bases());
    let told = d.nuisances.iter().filter(|n| n.name == "base_frame");
    for ((told, stood), name) in told.zip(stood).zip(["mon", "tue", "wed"]) {
        assert_eq!(told.session.as_deref(), Some(name));
        let there = Isometry3::new(told.translation.into(), told.rotation.into());
        let off = stood.inverse() * there;
        assert!(off.translation.vector.norm().max(off.rotation.angle()) < 5e-5, "{name} {off}");
    }
    assert_eq!(d.nuisances.len(), 4);
    // The model predicts the same rows, and refuses those of a day on which nobody fitted a base.
    let same = both.explanation.predict(&data).expect("predicted");
    let same = Statistics::of(&same.after).position_rms / d.gap.after.position_rms;
    assert!((0.9..=1.0).contains(&same), "{same}");
    let mut other = data.clone();
    other.rows.iter_mut().for_each(|row| row.session = Some("thu".to_owned()));
    let refused = both.explanation.predict(&other).unwrap_err().to_string();
    assert!(
        refused.contains("found the session `thu`, expected one of the diagnosed data"),
        "{refused}"
    );
    // As one session they are metres apart.
    let mut one = data;
    one.rows.iter_mut().for_each(|row| row.session = None);
    let one = found(&arm, &one, Nuisance::ALL.to_vec());
    assert!(one.diagnosis.gap.before.position_rms > 0.1);
}

/// Between the sessions the target was taken off and put on in another way.
#[test]
fn a_target_that_was_put_on_anew_is_a_jump_between_sessions() {
    let arm = loaded(Convention::Standard);
    let design = design(&arm, &["mon", "tue"], 14);
    let after = design.rows.len() / 2;
    let jump = format!("slip@tool:after={after},x=0.12,y=-0.11,z=0.03,rx=1.05,ry=1.1,rz=-0.3");
    let first = frames(bases()[0], Isometry3::translation(0.01, 0.02, -0.01));
    let plant = plant(&arm, &[&jump, SOFT]);
    let plant = plant.with_sessions(&first, bases()[1..].to_vec());
    let data = plant.measure(&design, NOISE, 1).expect("measured");
    let d = found(&arm, &data, Nuisance::ALL.to_vec()).diagnosis;
    let names: Vec<_> = d.findings.iter().map(|f| (&*f.effect, f.place.as_str())).collect();
    assert_eq!(names, [("slip", "tool"), ("joint_compliance", "joint 2")]);
    let values: Vec<f64> = d.findings[0].parameters.iter().map(|p| p.value).collect();
    // 42 rows a side, of six numbers to 20 µm each, and the arm within 2 m.
    let told = [after as f64, 0.12, -0.11, 0.03, 1.05, 1.1, -0.3];
    assert!(values.iter().zip(told).all(|(v, t)| (v - t).abs() < 1e-4), "{values:?}");
    let held_out = d.gap.after.position_rms;
    assert!(held_out < 1.2 * 3f64.sqrt() * NOISE.position, "{:?}", d.gap);
    assert!((0.9..=1.0).contains(&(d.gap.fitted.position_rms / held_out)), "{:?}", d.gap);
}

#[test]
fn a_session_of_few_poses_is_refused_by_name() {
    let arm = loaded(Convention::Standard);
    let mut data = plant(&arm, &[]).measure(&design(&arm, &["a", "b"], 4), NOISE, 1).expect("rows");
    data.rows.retain(|row| row.group < 7);
    data.poses = 7;
    let options = Options { nuisances: Nuisance::ALL.to_vec(), ..Options::default() };
    let refused = diagnose_with(&arm, &data, &options, &|_| {}).err().map(|e| e.to_string());
    assert!(refused.as_ref().is_some_and(|e| e.contains("session `b` has 2 poses")), "{refused:?}");
}

/// In the second of two sessions the plant is where a plant of that session alone is.
#[test]
fn nothing_that_happens_in_time_reaches_into_the_next_session() {
    let arm = sprung(Convention::Standard);
    let both = design(&arm, &["a", "b"], 8);
    let truths = [
        "drift@base:x=0.1 um/s,z=-0.2 um/s",
        "slip@base:after=9,y=0.3 mm",
        "slip@tool:after=30,z=0.2 mm",
        "settling_lag@joint 2=0.02",
    ];
    let second = both.rows.iter().filter(|row| row.session.as_deref() == Some("b"));
    let second: Vec<_> = second.cloned().collect();
    let before = both.rows.len() - second.len();
    let alone = Measurements { rows: second, ..both.clone() };
    // Counted from its own beginning the second session's slip comes after fewer rows.
    let own = format!("slip@tool:after={},z=0.2 mm", 30 - before);
    let of_second = [truths[0], own.as_str(), truths[3]];
    let whole = plant(&arm, &truths).measure(&both, EXACT, 0).expect("measured");
    let part = plant(&arm, &of_second).measure(&alone, EXACT, 0).expect("measured");
    for (a, b) in whole.rows[before..].iter().zip(&part.rows) {
        assert!((a.measured - b.measured).amax() < 1e-13, "line {}", a.line);
    }
    // And the diagnosis' own effects do the same: told what is there, it leaves nothing.
    let toml = |truth: &str| {
        let read = stiffarm_plant::Truth::parse(truth, &arm).expect("a truth");
        read.spots(&arm).into_iter().map(move |(spot, values)| stiffarm_gap::effects::Known {
            effect: read.effect,
            spot,
            values,
            session: None,
            at: Default::default(),
        })
    };
    let known: Vec<_> = truths.iter().flat_map(|t| toml(t)).collect();
    let options = Options { known, effects: Some(Vec::new()), ..Options::default() };
    let told = diagnose_with(&arm, &whole, &options, &|_| {}).expect("a diagnosis").diagnosis;
    // Two programs agree to the rounding of their equilibria.
    assert!(told.gap.before.position_max < 1e-11, "{:?}", told.gap.before);
}
