//! Arms as they are: every offset and row of the table a little wrong, frames and noise unknown,
//! tails that are heavy, visits that scatter, readings that never repeat, and on top of that up to
//! three physical effects or none. The diagnosis gets the robot file as designed, the measurement
//! file, and `--nuisance base_frame,tool_frame`.
//!
//! ```text
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture realistic::tuning
//! cargo test -p stiffarm --release --test withheld -- --ignored --nocapture realistic::kept_apart
//! ```
//!
//! The first draws the arms of seeds 1 to 100, to work with; the second those of 1001 to 1100, which
//! nobody tunes by. Both take many minutes, print a line for each arm and the sum, and assert the
//! goals. `REALISTIC_SEEDS=7-12,101-150` draws these instead: of the first any up to 1000, of the second
//! some of its own. `REALISTIC_OUT=FOLDER` writes every arm's measurement file and truth, and
//! `cases.json`, by which two states of the diagnosis can be compared case by case.

mod case;
mod draw;
mod floor;
mod models;
mod score;
mod session;
mod size;

use std::io::Write as _;
use std::path::Path;

use case::{Case, run};
use draw::{Drawn, EVIDENCE, INSTRUMENT, RATIO, draw};
use score::Score;

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn tuning() {
    full(1..=1000, "1-100");
}

#[test]
#[ignore = "takes minutes: see the head of this file"]
fn kept_apart() {
    full(1001..=1100, "1001-1100");
}

fn full(seeds: core::ops::RangeInclusive<u64>, usual: &str) {
    let chosen = std::env::var("REALISTIC_SEEDS").unwrap_or_else(|_| usual.to_owned());
    let out = std::env::var_os("REALISTIC_OUT");
    let mut cases: Vec<Case> = Vec::new();
    for seed in seeds.filter(|seed| in_list(&chosen, *seed)) {
        let drawn = draw(seed);
        cases.push(run(&drawn));
        println!("{}", cases[cases.len() - 1]);
        let _ = std::io::stdout().flush();
        if let Some(out) = &out {
            write(Path::new(out), &drawn, &cases).expect("a folder that can be written to");
        }
    }
    let score = Score::of(&cases);
    println!("{score}");
    assert!(score.missed().is_empty(), "{score}");
}

/// `7-12,31`.
fn in_list(list: &str, seed: u64) -> bool {
    list.split(',').any(|part| {
        let (from, to) = part.split_once('-').unwrap_or((part, part));
        let number = |text: &str| text.trim().parse::<u64>().expect("seeds as 7-12,31");
        (number(from)..=number(to)).contains(&seed)
    })
}

fn write(out: &Path, drawn: &Drawn, cases: &[Case]) -> std::io::Result<()> {
    std::fs::create_dir_all(out)?;
    let seed = drawn.seed;
    std::fs::write(out.join(format!("{seed}.csv")), &drawn.text)?;
    let truths = drawn.geometry.iter().chain(drawn.planted.iter().map(|p| &p.truth));
    let truths: String = truths.map(|truth| format!("{truth}\n")).collect();
    std::fs::write(out.join(format!("{seed}.truth")), truths)?;
    let all = serde_json::json!({ "score": Score::of(cases), "cases": cases });
    std::fs::write(out.join("cases.json"), format!("{all:#}\n"))
}

/// The harness itself: on an arm with effects, and on one with none, the one with orientation, the other without.
#[test]
fn quick() {
    for seed in stiffarm_draws::few_or_many(6, 5)..=6 {
        let (drawn, again) = (draw(seed), draw(seed));
        assert_eq!(drawn.text, again.text, "the same seed, the same bytes");
        sizes_are_right(&drawn);
        floor_is_right(&drawn);
        let case = run(&drawn);
        println!("{case}");
        truth_is_known(&drawn, &case);
    }
    assert_ne!(draw(2).text, draw(22).text);
}

/// The ratio by the noiseless rows of the arm with an effect and without, geometry in place.
fn sizes_are_right(drawn: &Drawn) {
    assert_eq!(drawn.planted.is_empty(), drawn.seed.is_multiple_of(5));
    for (own, planted) in drawn.planted.iter().enumerate() {
        let with = |skipped: Option<usize>| {
            let kept = drawn.planted.iter().enumerate().filter(|(k, _)| Some(*k) != skipped);
            let truths: Vec<_> =
                drawn.geometry.iter().chain(kept.map(|(_, p)| &p.truth)).cloned().collect();
            size::exact(&drawn.arm, &drawn.data, &drawn.frames, &truths)
                .expect("an arm that stands")
        };
        let (all, without) = (with(None), with(Some(own)));
        let rows = all.rows.iter().zip(&without.rows);
        let squares: f64 =
            rows.map(|(a, b)| (a.measured - b.measured).fixed_rows::<3>(0).norm_squared()).sum();
        let scale = 3.0 * INSTRUMENT.scale.position.powi(2) * drawn.data.rows.len() as f64;
        let ratio = (squares / scale).sqrt();
        // The effects and the geometry change one another by less than this.
        assert!((ratio / planted.ratio - 1.0).abs() < 0.05, "{ratio} {}", planted.ratio);
        assert!((RATIO[0] * 0.98..=RATIO[1] * 1.02).contains(&planted.ratio));
        assert!(planted.evidence >= EVIDENCE);
    }
}

/// The floor of the plant is that of the diagnosis' own simulator with the true values, and no
/// better than the instrument.
fn floor_is_right(drawn: &Drawn) {
    let (plant, simulator) = (drawn.floor(&[]), drawn.floor_of_the_simulator());
    // Numbers that were rounded to 0.1 µm and 0.01 µrad: a part in a thousand of the noise.
    assert!(
        (plant.position_rms / simulator.position_rms - 1.0).abs() < 2e-3,
        "{plant:?} {simulator:?}"
    );
    assert!(plant.position_rms > 3_f64.sqrt() * INSTRUMENT.scale.position);
    assert_eq!(plant.rotation_rms > 0.0, drawn.orientation);
    if drawn.orientation {
        assert!((plant.rotation_rms / simulator.rotation_rms - 1.0).abs() < 2e-3);
    }
}

/// What is held against the diagnosis is what was put in.
fn truth_is_known(drawn: &Drawn, case: &Case) {
    assert_eq!(case.error, None);
    let kept: Vec<String> = case.truths.iter().map(|t| t.text.clone()).collect();
    let put: Vec<String> = drawn.planted.iter().map(|p| p.truth.to_string()).collect();
    assert_eq!(kept, put);
    assert!(case.truths.iter().all(|t| t.in_set || !t.named));
    assert_eq!(case.first.is_some(), !put.is_empty());
    let physical = case.found.iter().filter(|f| f.physical).count();
    assert_eq!(physical, case.spurious + case.truths.iter().filter(|t| t.named).count());
    assert!(case.over_floor() > 0.5 && case.before > case.floor);
}

#[test]
fn seeds_are_chosen_by_a_list() {
    let chosen: Vec<u64> = (1..40).filter(|seed| in_list("7-9, 31", *seed)).collect();
    assert_eq!(chosen, [7, 8, 9, 31]);
}
