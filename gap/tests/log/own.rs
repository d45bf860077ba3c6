//! An effect of a program's own, asked for beside those of the catalogue.

use std::cell::Cell;

use stiffarm_gap::effects::{Facts, InMotion, Law, Laws, Parameter, Quantity, Spot};
use stiffarm_gap::log::scene::{Column, Scene};
use stiffarm_gap::log::{Log, LogOptions, Refused, diagnose, diagnosed_with};

use super::plant::{Recorder, arm};

/// What the brake of joint 2 holds by, N·m/rad.
const BRAKE: f64 = 6.0;

/// A brake that holds the more the farther the joint is from zero, `brake · |q| sign(q̇)`.
struct WideningBrake;

impl Law for WideningBrake {
    fn facts(&self) -> &'static Facts {
        const FACTS: &Facts = &Facts {
            identifier: "widening_brake",
            parameters: &[Parameter::free("brake", Quantity::In("N·m/rad"))],
            ..Facts::TORQUE
        };
        FACTS
    }
}

impl InMotion for WideningBrake {
    fn columns(&self, scene: &Scene<'_>, spot: Spot, _: &[f64]) -> Vec<Column> {
        let joint = spot.row();
        vec![scene.column(joint, |k| scene.signals.q[joint][k].abs() * scene.sign(joint, k))]
    }
}

fn recorded(seed: u64) -> Log {
    Recorder::new(seed, 8000, 0.1).torques(|now| {
        let brake = BRAKE * now.q[1].abs() * now.v[1].signum();
        (now.rigid_and([0.0, brake]), [0.0; 2])
    })
}

fn options() -> LogOptions {
    let catalogue = Laws::<dyn InMotion>::default().with(&WideningBrake);
    LogOptions { band: Some(10.0), catalogue, ..LogOptions::default() }
}

#[test]
fn it_is_found_before_those_that_do_some_of_it() {
    let (log, said) = (recorded(31), Cell::new(0));
    let (found, model) =
        diagnosed_with(&arm(), &log, &options(), &|found| said.set(said.get().max(found))).unwrap();
    let first = &found.findings[0];
    assert_eq!((&*first.effect, first.place.as_str()), ("widening_brake", "joint 2"), "{found:#?}");
    let [low, high] = first.parameters[0].ci95;
    // Twice the interval, as of all that are planted.
    assert!((first.parameters[0].value - BRAKE).abs() < high - low, "{first:#?}");
    assert!(said.get() >= found.findings.len());
    // The model knows it elsewhere too, and what was measured is what it says and what it leaves.
    let other = recorded(32);
    let explained = model.explain(&arm(), &other).unwrap();
    let joint = &explained.joints[1];
    assert!(joint.rms(|k| joint.left(k)) < 0.5 * joint.rms(|k| joint.without(k)));
    for k in 0..joint.measured.len() {
        // The table has no friction: all that was measured was to be explained.
        assert!(
            (joint.measured[k] - joint.target[k]).abs() < 1e-12 * joint.rms(|k| joint.target[k])
        );
    }
}

#[test]
fn it_is_asked_for_by_its_name() {
    let log = recorded(33);
    let only = |name: &str| LogOptions { effects: Some(vec![name.to_owned()]), ..options() };
    let found = diagnose(&arm(), &log, &only("widening_brake")).unwrap();
    assert_eq!(found.findings.len(), 1, "{found:#?}");
    let unknown = diagnose(&arm(), &log, &only("widening_break")).unwrap_err();
    let Refused::Effect { suggestion, known, .. } = unknown else { panic!("{unknown}") };
    assert_eq!((suggestion, known.last()), (Some("widening_brake"), Some(&"widening_brake")));
}
