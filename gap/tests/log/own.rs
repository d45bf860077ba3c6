//! An effect of a program's own, asked for beside those of the catalogue.

use std::cell::Cell;
use std::collections::BTreeMap;

use stiffarm_gap::effects::{Facts, InMotion, Law, Laws, Parameter, Quantity, Spot};
use stiffarm_gap::log::scene::{Column, Scene};
use stiffarm_gap::log::{Log, LogOptions, Refused, Signal, diagnose, diagnosed_with};
use stiffarm_gap::rng::{Rng, Stream};

use super::plant::{Path, arm, log, noise, rigid};

const STEP: f64 = 0.01;
const COUNT: usize = 8000;

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
    let path = Path::new(seed, 0.6);
    let mut rng = Rng::new(seed, Stream::Noise);
    let [first, second] = [(); 2].map(|()| noise(&mut rng, COUNT, STEP, 0.05, 0.1));
    let (mut q, mut torque) = (vec![Vec::new(); 2], vec![Vec::new(); 2]);
    for (k, noise) in first.into_iter().zip(second).map(|(a, b)| [a, b]).enumerate() {
        let [at, v, a] = path.at(STEP * k as f64);
        let brake = [0.0, BRAKE * at[1].abs() * v[1].signum()];
        for j in 0..2 {
            q[j].push(at[j] + 1e-6 * rng.normal());
            torque[j].push(rigid(at, v, a)[j] + brake[j] + noise[j]);
        }
    }
    log(STEP, BTreeMap::from([(Signal::Q, q), (Signal::Torque, torque)]))
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
