//! How far a gap shrinks, and its interval, against what the same model makes of a log that it has not seen.

use stiffarm_gap::gap::percentile;
use stiffarm_gap::log::{Log, LogOptions, diagnose, diagnosed};

use super::plant::{Path, Recorder, arm};

const STEP: f64 = 0.02;
const COUNT: usize = 2500;

/// By which nothing was chosen.
const SEEDS: core::ops::Range<u64> = 700..740;

/// Another stretch of one motion for each seed; the noise is as slow as the arm, so that a log has few blocks.
fn recorded(seed: u64, friction: [f64; 2]) -> Log {
    let path = Path::new(31, 0.6);
    let from = STEP * (COUNT * seed as usize) as f64;
    let recorder = Recorder { seed, path, from, step: STEP, count: COUNT, noise: [0.3, 1.0] };
    recorder.torques(|now| {
        let brakes = [0, 1].map(|j| friction[j] * now.v[j].signum());
        (now.rigid_and(brakes), [0.0; 2])
    })
}

fn options() -> LogOptions {
    let effects = ["coulomb_friction", "viscous_friction"].map(str::to_owned).to_vec();
    LogOptions { band: Some(4.0), effects: Some(effects), ..LogOptions::default() }
}

/// Each log's interval holds what its model makes of the next, and is not wider than that scatters for long.
#[test]
fn the_interval_holds_what_the_next_log_shows() {
    let friction = [6.0, 1.5];
    let one = |seed: u64| {
        let (found, model) = diagnosed(&arm(), &recorded(seed, friction), &options()).unwrap();
        let explained = model.explain(&arm(), &recorded(seed + 1, friction)).unwrap();
        let gap = explained.gap(model.rows, &found.gap);
        let left = |of: fn(&stiffarm_gap::log::report::JointGap) -> f64| {
            gap.iter().map(|gap| of(gap) / gap.size).sum::<f64>()
        };
        let real = 1.0 - left(|gap| gap.after) / left(|gap| gap.before);
        // What the joints' own figures say.
        let told = |of: fn(&stiffarm_gap::log::report::JointGap) -> f64| {
            found.gap.iter().map(|gap| of(gap) / gap.size).sum::<f64>() / 2.0
        };
        let shrink = found.shrink;
        assert!((shrink.before - told(|gap| gap.before)).abs() < 1e-12);
        assert!((shrink.after - told(|gap| gap.after)).abs() < 1e-12);
        assert!((shrink.shrink - (1.0 - shrink.after / shrink.before)).abs() < 1e-12);
        (shrink.shrink, shrink.shrink_ci95, real)
    };
    let all: Vec<_> = SEEDS.take(stiffarm_draws::few_or_many(12, 40)).map(one).collect();
    let inside = all.iter().filter(|(_, [low, high], real)| (*low..=*high).contains(real)).count();
    let sorted = |mut x: Vec<f64>| {
        x.sort_by(f64::total_cmp);
        x
    };
    let widths = sorted(all.iter().map(|(_, [low, high], _)| high - low).collect());
    let off = sorted(all.iter().map(|(told, _, real)| real - told).collect());
    let scatters = percentile(&off, 0.975) - percentile(&off, 0.025);
    let width = percentile(&widths, 0.5);
    println!("{inside} of {}; {width:.3} wide, {scatters:.3} of 95 %", all.len());
    // 95 % of 40, or of 12, less two standard errors.
    assert!(inside >= stiffarm_draws::few_or_many(9, 35), "{inside}: {all:#?}");
    assert!(width < 2.0 * scatters, "{width} {scatters}: {all:#?}");
}

#[test]
fn nothing_found_shrinks_nothing() {
    let found = diagnose(&arm(), &recorded(1, [0.0; 2]), &options()).unwrap();
    assert!(found.findings.is_empty(), "{found:#?}");
    let shrink = found.shrink;
    assert_eq!((shrink.before, shrink.shrink, shrink.shrink_ci95), (shrink.after, 0.0, [0.0; 2]));
}
