//! Intervals of what a log says against the truth, in logs of the independent plant: of the rigid links' base
//! parameters, and of friction that the file has too little of.
//!
//! ```text
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture links::full
//! ```
//!
//! Logs of a UR10 and a Panda (43 parameters) whose files have wrong masses, or 0.7 of each joint's friction: how many
//! intervals of 95 % hold the truth. `LINKS_SEEDS=n` tries so many of each.

use stiffarm_gap::log::report::LogDiagnosis;
use stiffarm_gap::log::{Log, LogOptions, diagnose};
use stiffarm_gap::rng::{Rng, Stream};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::course::{Fourier, Limits};
use stiffarm_plant::motion::{Logged, MovingPlant, Recording, Side, Stage};

use crate::logs::arm;

/// What three runs of an arm say to one who has another file of it.
fn diagnosed(real: &Arm, file: &Arm, seed: u64) -> LogDiagnosis {
    let limits = Limits::of(real, &[1.5], &[5.0]).expect("joints with limits");
    let course =
        |k: u64| Fourier::draw(&limits, 30.0, 12, &mut Rng::new(100 * seed + k, Stream::Poses));
    let courses: Vec<Fourier> = (0..3).map(course).collect();
    let stages: Vec<Stage<'_>> =
        courses.iter().map(|course| Stage { course, payload: None }).collect();
    let plant = MovingPlant::new(real, &[], Logged::Torque(Side::Motor), Recording::default());
    let text = plant.text(&stages, seed).expect("an arm that moves");
    let log = Log::of_arm(real, "links", &text).expect("a right log");
    diagnose(file, &log, &LogOptions::default()).expect("a log that is diagnosed")
}

/// Sums of what is counted with seeds from the first.
fn summed(first: u64, counted: impl Fn(u64) -> [usize; 3]) -> [usize; 3] {
    let seeds = std::env::var("LINKS_SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(4);
    let sum = |sum: [usize; 3], own: [usize; 3]| core::array::from_fn(|k| sum[k] + own[k]);
    (first..first + seeds).map(counted).fold([0; 3], sum)
}

/// Parameters of all logs, those that the motion determines, and those whose interval holds the truth.
fn counted(robot: &str, seed: u64) -> [usize; 3] {
    let real = arm(robot);
    let mut file = real.clone();
    file.joints.iter_mut().for_each(|joint| {
        joint.mass *= 0.5;
        joint.inertia *= 0.5;
    });
    let found = diagnosed(&real, &file, seed);
    let rigid = found.rigid.expect("torques of the motors");
    let (sums, moments) = (real.base_parameters(), real.moments());
    assert_eq!(rigid.parameters.len(), sums.len());
    let mut counts = [sums.len(), 0, 0];
    for (told, sum) in rigid.parameters.iter().zip(&sums) {
        assert_eq!(told.name, sum.to_string());
        let (truth, Some([low, high])) = (sum.of(&moments), told.ci95) else { continue };
        let holds = (low..=high).contains(&truth);
        counts[1] += 1;
        counts[2] += usize::from(holds);
        if !holds {
            println!(
                "  {robot} {seed} {}: {:.4e} [{low:.4e} to {high:.4e}], in truth {truth:.4e}",
                told.name, told.value
            );
        }
    }
    counts
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn full() {
    for robot in ["ur10", "panda"] {
        let [all, told, held] = summed(700, |seed| counted(robot, seed));
        println!(
            "{robot}: {all} base parameters, {told} determined, the interval of {held} holds the truth"
        );
        assert!(10 * held >= 9 * told, "{robot}: {held} of {told}");
    }
}

/// Numbers of friction that the file has too little of, those that are found, and those whose interval holds the truth.
fn friction(robot: &str, seed: u64) -> [usize; 3] {
    let real = arm(robot);
    let mut file = real.clone();
    file.joints.iter_mut().for_each(|joint| {
        joint.drive.coulomb *= 0.7;
        joint.drive.viscous *= 0.7;
    });
    let mut counts = [0; 3];
    let found = diagnosed(&real, &file, seed);
    for (joint, (real, file)) in real.joints.iter().zip(&file.joints).enumerate() {
        let coulomb = ("coulomb_friction", real.drive.coulomb - file.drive.coulomb);
        let viscous = ("viscous_friction", real.drive.viscous - file.drive.viscous);
        for (effect, truth) in [coulomb, viscous] {
            let place = format!("joint {}", joint + 1);
            let finding = found.findings.iter().find(|f| f.effect == effect && f.place == place);
            counts[0] += 1;
            let Some(finding) = finding else { continue };
            let [low, high] = finding.parameters[0].ci95;
            let holds = (low..=high).contains(&truth);
            counts[1] += 1;
            counts[2] += usize::from(holds);
            if !holds {
                println!("  {robot} {seed} {effect} {place}: {low:.5e} to {high:.5e}, {truth:.5e}");
            }
        }
    }
    counts
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn of_findings() {
    for robot in ["ur10", "panda"] {
        let [all, told, held] = summed(800, |seed| friction(robot, seed));
        println!("{robot}: {all} numbers, {told} found, the interval of {held} holds the truth");
        assert!(10 * held >= 9 * told && 10 * told >= 9 * all, "{robot}: {held} of {told}");
    }
}
