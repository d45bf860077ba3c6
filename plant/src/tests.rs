use nalgebra::{Matrix4, Vector3, Vector6};
use stiffarm_kernels::generic::{Arm, Convention};

use super::assemble::Situation;
use super::balance::rest;
use super::chain::{Chain, Part};
use super::reality::Reality;
use super::transform::{carried, rotation, rotation_vector};
use super::{Truth, TruthError, effects};
use crate::effects::{Backlash, Effect, Place};
use crate::fixture;
use crate::rng::{Rng, Stream};

fn truth(text: &str, arm: &Arm) -> Truth {
    Truth::parse(text, arm).unwrap()
}

/// An arm in which everything that can yields does, in either convention.
fn yielding(convention: Convention) -> (Arm, Reality) {
    let mut arm = fixture::bent();
    arm.convention = convention;
    arm.joints[2].motion = stiffarm_kernels::Motion::Prismatic;
    let truths = [
        "base_compliance:rock_x=2e-6,rock_y=3e-6,give=4e-7,rock=1e-6",
        "bearing_compliance@joint 1:tilt_x=2e-6,tilt_y=1e-6",
        "bearing_compliance@joint 3:tilt_x=3e-6,tilt_y=2e-6",
        "link_compliance@link 1:bending=3e-6,torsion=4e-6",
        "joint_hardening@joint 2=1e-13",
        "friction_hysteresis@joint 1=2e-7",
        "payload_com:x=0.04,y=-0.03,z=0.1",
        "link_weight@link 2=3",
    ];
    let truths: Vec<Truth> = truths.iter().map(|text| truth(text, &arm)).collect();
    let reality = Reality::new(&arm, &truths).unwrap();
    (arm, reality)
}

fn chain(reality: &Reality) -> Chain {
    let situation = Situation {
        values: vec![0.4, -0.7, 0.3],
        directions: vec![1.0, -1.0, 1.0],
        growth: 1.0003,
        tool_frame: Vector6::new(1e-3, 0.0, 2e-3, 0.01, 0.0, -0.02),
        wrench: Vector6::new(120.0, -80.0, -300.0, 15.0, -20.0, 30.0),
    };
    reality.chain(&situation, &Matrix4::identity())
}

/// Forces and where they act, and the tool.
type Loaded = (Vec<(Vector3<f64>, Vector3<f64>)>, Matrix4<f64>);

/// Positions of all loaded points and the tool's rotation, by multiplying out.
fn loaded_points(chain: &Chain, u: &[f64]) -> Loaded {
    let shape = chain.shape(u);
    let mut points = vec![(carried(&shape.tool, &chain.payload), chain.force)];
    // The chain up to each weight is a chain of its own.
    for (k, part) in chain.parts.iter().enumerate() {
        if let Part::Weight { point, force } = part {
            let stub = Chain { parts: chain.parts[..k].to_vec(), ..chain.clone() };
            points.push((carried(&stub.shape(u).tool, point), *force));
        }
    }
    (points, shape.tool)
}

#[test]
fn generalised_forces_are_the_work_per_displacement() {
    for convention in [Convention::Standard, Convention::Modified] {
        let (_, reality) = yielding(convention);
        let chain = chain(&reality);
        let mut rng = Rng::new(5, Stream::Poses);
        let u: Vec<f64> = (0..chain.unknowns).map(|_| rng.between(-0.05, 0.05)).collect();
        let forces = chain.forces(&u);
        assert!(chain.unknowns >= 5 + 3 + 2 + 2 + 18 && forces.len() == chain.unknowns);
        let scale = forces.iter().fold(0.0_f64, |s, f| s.max(f.abs()));
        for k in 0..chain.unknowns {
            // Five-point formula: its error is h⁴ = 1e-12 of the fifth derivative's size.
            let h = 1e-3;
            let work = |step: f64| {
                let mut moved = u.clone();
                moved[k] += step;
                let (points, tool) = loaded_points(&chain, &moved);
                let (_, still) = loaded_points(&chain, &u);
                let turned = rotation_vector(&(rotation(&tool) * rotation(&still).transpose()));
                let of_forces: f64 = points.iter().map(|(at, f)| f.dot(at)).sum();
                (of_forces, turned)
            };
            let [far_back, back, on, far_on] = [-2.0 * h, -h, h, 2.0 * h].map(work);
            let slope = |a: f64, b: f64, c: f64, d: f64| (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
            let turning =
                Vector3::from_fn(|i, _| slope(far_back.1[i], back.1[i], on.1[i], far_on.1[i]));
            let power = slope(far_back.0, back.0, on.0, far_on.0) + chain.couple.dot(&turning);
            let error = (power - forces[k]).abs();
            assert!(error < 1e-10 * scale, "{convention:?} {k}: {power} {}", forces[k]);
        }
    }
}

#[test]
fn at_rest_every_displacement_is_its_laws() {
    for convention in [Convention::Standard, Convention::Modified] {
        let (_, reality) = yielding(convention);
        let chain = chain(&reality);
        let u = rest(&chain).unwrap();
        let wanted = chain.wanted(&u);
        let scale = u.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
        assert!(scale > 1e-4, "{scale}");
        for (k, (is, should)) in u.iter().zip(&wanted).enumerate() {
            assert!((is - should).abs() < 1e-12 * scale, "{convention:?} {k}: {is} {should}");
        }
    }
}

#[test]
fn elastic_energy_less_work_is_least_at_rest() {
    // Without a couple, friction and hardening there is a potential.
    let mut arm = fixture::bent();
    arm.joints.iter_mut().for_each(|j| j.beam.iter_mut().for_each(|b| b.density = 0.0));
    let reality = Reality::new(&arm, &[]).unwrap();
    let mut chain = chain(&reality);
    chain.couple = Vector3::zeros();
    let potential = |u: &[f64]| {
        let (points, _) = loaded_points(&chain, u);
        let work: f64 = points.iter().map(|(at, f)| f.dot(at)).sum();
        let elastic: f64 = chain
            .sites()
            .map(|site| {
                let k = site.components.len();
                let own = nalgebra::DVector::from_row_slice(&u[site.first..site.first + k]);
                let stiffness = site.law.flexibility().try_inverse().unwrap();
                0.5 * own.dot(&(stiffness * &own))
            })
            .sum();
        elastic - work
    };
    let u = rest(&chain).unwrap();
    let least = potential(&u);
    let mut rng = Rng::new(9, Stream::Poses);
    for _ in 0..200 {
        let near: Vec<f64> = u.iter().map(|x| x + 1e-4 * rng.normal()).collect();
        assert!(potential(&near) > least);
    }
}

fn refused(text: &str) -> String {
    let error: TruthError = Truth::parse(text, &fixture::springy()).unwrap_err();
    error.to_string()
}

#[test]
fn truths_are_read() {
    let arm = fixture::springy();
    let one = truth("backlash@joint 2=0.3 mrad", &arm);
    assert_eq!((one.effect, one.place), (&Backlash as &dyn Effect, Place::Joint(2)));
    assert_eq!(one.values, [("width".to_owned(), 0.3e-3)]);
    let two = truth("tool_frame@tool:x=1mm, rz=0.5mrad", &arm);
    assert_eq!((two.value("x"), two.value("rz"), two.value("y")), (1e-3, 0.5e-3, 0.0));
    let periodic = truth("transmission_error@joint3:cos  2=0.1mrad,sin 14=0.05mrad", &arm);
    assert_eq!(periodic.place, Place::Joint(3));
    assert_eq!((periodic.value("cos 2"), periodic.value("sin 14")), (1e-4, 0.5e-4));
    assert_eq!(truth("thermal_growth=12ppm/K", &arm).place, Place::Arm);
    assert_eq!(truth("slip@tool:after=40,x=0.3mm", &arm).value("after"), 40.0);
    assert_eq!(truth("joint_coupling@joint 3:joint 2=0.1%", &arm).value("joint 2"), 1e-3);
    assert_eq!(two.to_string(), "tool_frame@tool:x=1e-3,rz=5e-4");
    assert_eq!(truth(&periodic.to_string(), &arm), periodic);
}

#[test]
fn mistakes_say_what_was_found_and_expected() {
    let cases = [
        ("backlsh@joint 2=1mrad", "found the unknown effect `backlsh`; did you mean `backlash`?"),
        ("backlash@joint 4=1mrad", "found the place `joint 4`, expected one of joint 1, joint 2"),
        ("backlash@link 2=1mrad", "found the place `link 2`, expected one of joint 1"),
        ("backlash=1mrad", "found no place, expected one of joint 1, joint 2, joint 3"),
        ("backlash@joint 2", "found no `=`, expected a size for `width`: `backlash@joint 2:NAME"),
        ("motor_error@joint 2", "has no place for motor_error, which acts at joints that turn and"),
        ("motor_error@joint 2:order=120,cos=1mrad", "whose `gear`, ten or more, is in the robot"),
        ("backlash@joint 2=1mm", "`width`: found `1mm`, expected a number and its unit: rad, mrad"),
        ("backlash@joint 2:widht=1mrad", "found the parameter `widht`, expected `width`"),
        ("backlash@joint 2=0", "found nothing but zeros, expected a size for `width`"),
        ("tool_frame:x=0,3mm", "found `3mm`, expected name=value (numbers have a point"),
        ("tool_frame:x=1mm,x=2mm", "found `x` twice"),
        ("slip@base:x=1mm", "found no `after`"),
        ("slip@base:after=0,x=1mm", "`after`: found `0`, expected a number and its unit: no unit"),
        ("joint_coupling@joint 2=0.1", "found a size without a name, expected one of `joint 1`"),
        ("joint_coupling@joint 2:joint 2=0.1", "found the parameter `joint 2`"),
        ("transmission_error@joint 1:tan 2=1mrad", "expected `cos k` or `sin k` with an order"),
    ];
    for (text, expected) in cases {
        let found = refused(text);
        assert!(found.starts_with(&format!("effect `{text}`: ")), "{found}");
        assert!(found.contains(expected), "{found}");
    }
    assert!(refused("backlash@joint 2:widht=1mrad").ends_with("did you mean `width`?"));
}

#[test]
fn every_effect_has_its_parameters_everywhere() {
    for arm in [fixture::bent(), fixture::springy()] {
        for effect in effects() {
            for place in effect.places(&arm) {
                for number in effect.numbers(&arm, place) {
                    let found = effect.number(&arm, place, &number.name);
                    assert_eq!(found.map(|(_, found)| found), Some(number));
                }
            }
        }
    }
}

#[test]
fn totals_cannot_be_negative() {
    let arm = fixture::springy();
    let wrong =
        ["joint_compliance@joint 1=-1e-5", "link_weight@link 1=-100", "base_compliance=-1e-9"];
    for text in wrong {
        let error = super::Plant::new(&arm, &[truth(text, &arm)]).unwrap_err().to_string();
        assert!(error.contains("expected at least 0"), "{error}");
    }
    assert!(super::Plant::new(&arm, &[truth("joint_compliance@joint 1=-1e-6", &arm)]).is_ok());
}
