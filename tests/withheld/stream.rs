//! A tracker that follows a moving arm: positions that are older or younger than the readings beside
//! them, which no design of poses at rest can show.

use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::measurement::{Kind, Measurements, Row};
use stiffarm_gap::{Options, diagnose};
use stiffarm_plant::{Frames, Noise, Plant, Truth};

use crate::arms::arm;

/// Rows a second.
const PACE: f64 = 25.0;
const ROWS: usize = 400;
const NOISE: Noise = Noise { position: 30e-6, rotation: 0.1e-3 };

/// Every joint swings by two sines of its own; a joint comes from where it was a row before.
fn path(joints: usize) -> Measurements {
    let at = |time: f64, joint: usize| {
        let j = joint as f64;
        let (slow, fast) = (0.5 + 0.13 * j, 1.1 + 0.07 * j);
        0.2 * j - 0.5 + 0.5 * (slow * time + j).sin() + 0.2 * (fast * time - 2.0 * j).cos()
    };
    let row = |k: usize| {
        let time = k as f64 / PACE;
        let q: Vec<f64> = (0..joints).map(|joint| at(time, joint)).collect();
        let sides = (0..joints).map(|joint| if at(time - 1e-3, joint) < q[joint] { 1 } else { -1 });
        let direction = Some(sides.collect());
        Row { time: Some(time), group: k, direction, ..Row::new(k as u64 + 2, q) }
    };
    Measurements::new("the path", Kind::Pose { orientation: true }, (0..ROWS).map(row).collect())
}

#[test]
fn positions_that_are_late_are_named_first() {
    let arm = arm("iiwa14", 1.5e4);
    let path = path(arm.dof());
    let frames = Frames::unknown(3);
    let cases = [(0.2, false), (-0.03, false), (0.01, true), (0.0, true)];
    for (seed, (delay, unknown)) in (0..).zip(cases).skip(stiffarm_draws::few_or_many(2, 0)) {
        let told = (delay != 0.0).then(|| format!("latency={delay}"));
        let truths = told.iter().map(|text| Truth::parse(text, &arm).expect("a truth of this arm"));
        let mut plant = Plant::new(&arm, &truths.collect::<Vec<_>>()).expect("a plant");
        let mut options = Options { version: "test".to_owned(), ..Options::default() };
        if unknown {
            plant = plant.with_frames(frames.clone());
            options.nuisances = vec![Nuisance::BaseFrame, Nuisance::ToolFrame];
        }
        let data = plant.measure(&path, NOISE, seed).expect("an arm that carries its weight");
        let found = diagnose(&arm, &data, &options).expect("data of this arm");
        let named: Vec<_> = found.findings.iter().map(|f| &*f.effect).collect();
        assert!(!found.unexplained.present, "{delay}: {named:?}");
        if delay == 0.0 {
            assert!(named.is_empty(), "{named:?}");
            continue;
        }
        assert_eq!(named, ["latency"], "{delay}");
        // Six standard errors, which the interval has four of.
        let number = &found.findings[0].parameters[0];
        let width = number.ci95[1] - number.ci95[0];
        assert!((number.value - delay).abs() < 1.5 * width, "{delay}: {number:?}");
        assert!(width < 0.02 * delay.abs(), "{delay}: {number:?}");
        // Three coordinates, each of the noise's size, over 400 rows: 4 % are three standard errors.
        let (after, noise) = (found.gap.after.position_rms, 3.0_f64.sqrt() * NOISE.position);
        assert!((after / noise - 1.0).abs() < 0.1, "{delay}: {after:e}");
    }
}
