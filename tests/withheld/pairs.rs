//! Simple pairs under the arm's own weight: two springs, or a spring and a zero, with nothing else amiss. An exotic
//! effect can do nearly the same as the two together.

use stiffarm_gap::Options;
use stiffarm_gap::diagnose::{Diagnosis, diagnose};
use stiffarm_gap::measurement::Kind;
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Noise, Plant, Truth};

use crate::arms::arm;

/// Robots whose file has masses, and the spring that turns a joint of theirs by some tenths of a milliradian,
/// rad/(N·m).
const ARMS: [(&str, f64); 3] = [("irb120", 4e-5), ("ur10", 8e-6), ("iiwa14", 8e-6)];

/// What is put in, each spring in multiples of its arm's.
const PAIRS: [[(&str, f64); 2]; 4] = [
    [("joint_compliance@joint 2", 2.0), ("joint_compliance@joint 3", 2.0)],
    [("joint_compliance@joint 2", 3.0), ("joint_compliance@joint 3", 1.0)],
    [("joint_compliance@joint 2", 1.5), ("joint_offset@joint 4", 4e-4)],
    [("joint_compliance@joint 3", 3.0), ("joint_offset@joint 2", 3e-4)],
];

fn truths(arm: &Arm, spring: f64, pair: &[(&str, f64); 2]) -> Vec<Truth> {
    let truth = |(what, size): &(&str, f64)| {
        let size = if what.starts_with("joint_compliance") { size * spring } else { *size };
        Truth::parse(&format!("{what}={size:e}"), arm).expect("a truth")
    };
    pair.iter().map(truth).collect()
}

/// Whether a truth is a finding, or in the set of one.
fn is_named(truth: &Truth, diagnosis: &Diagnosis) -> bool {
    let (effect, place) = (truth.effect.identifier(), truth.place.to_string());
    diagnosis.findings.iter().any(|finding| {
        let alternatives = finding.alternatives.iter();
        (finding.effect == effect && finding.place == place)
            || alternatives.into_iter().any(|a| a.effect == effect && a.place == place)
    })
}

/// Truths that are named of so many arms, of how many.
fn named(arms: usize, poses: usize, seeds: core::ops::Range<u64>) -> [usize; 2] {
    let (mut right, mut all) = (0, 0);
    for (id, spring) in ARMS.into_iter().take(arms) {
        let arm = arm(id, f64::INFINITY);
        for (seed, pair) in seeds.clone().flat_map(|s| PAIRS.iter().map(move |p| (s, p))) {
            let truths = truths(&arm, spring, pair);
            let plant = Plant::new(&arm, &truths).expect("an arm that stands");
            let kind = Kind::Pose { orientation: false };
            let design =
                Design { shape: Shape::Payload, poses, repeats: 1, payload: 0.0, kind, seed };
            let noise = Noise { position: 2e-5, rotation: 0.0 };
            let mut rows = design.rows(&arm);
            // One row a pose: there is one load.
            rows.rows.dedup_by_key(|row| row.group);
            let data = plant.measure(&rows, noise, seed).expect("measured");
            let diagnosis = diagnose(&arm, &data, &Options::default()).expect("diagnosed");
            let of = truths.iter().filter(|truth| is_named(truth, &diagnosis)).count();
            if of < truths.len() {
                let put: Vec<String> = truths.iter().map(Truth::to_string).collect();
                let found = diagnosis.findings.iter().map(|f| format!("{}@{}", f.effect, f.place));
                let found: Vec<String> = found.collect();
                println!(
                    "{id}, {poses} poses, seed {seed}: {} → {}",
                    put.join(" "),
                    found.join(" ")
                );
            }
            (right, all) = (right + of, all + truths.len());
        }
    }
    [right, all]
}

#[test]
fn quick() {
    let [right, all] = named(stiffarm_draws::few_or_many(1, 3), 60, 1..2);
    assert!(right + 1 >= all, "{right} of {all}");
}

#[test]
#[ignore = "takes minutes: cargo test -p stiffarm --release --test withheld -- --ignored --nocapture pairs"]
fn pairs() {
    let counts = [60, 300, 1000].map(|poses| named(3, poses, 100..105));
    let [right, all] = [0, 1].map(|k| counts.iter().map(|count| count[k]).sum::<usize>());
    println!("{right} of {all}");
    assert!(right as f64 >= 0.97 * all as f64, "{right} of {all}");
}
