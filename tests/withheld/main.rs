//! The withheld check on arms of two, six and seven joints: effects are put into a plant, the
//! diagnosis is not told, and what it finds is held against what was put in.
//!
//! `cargo test -p stiffarm --release --test withheld -- --ignored --nocapture full` runs the full
//! form and prints its table; the quick one runs with all other tests. `realistic` and `logs`
//! have commands of their own.

mod arms;
mod goals;
mod logs;
mod realistic;
mod stream;
mod suite;

use goals::Goals;
use suite::{Setting, run, settings, strays};

/// A few dozen cases. So few cannot tell 90 % from 95 %: a rate must not be worse than its goal
/// beyond what chance does in one of forty runs.
#[test]
fn quick() {
    let quick: Vec<Setting> = settings().into_iter().filter(|s| s.quick).collect();
    let reports: Vec<_> = quick.iter().map(|setting| run(setting, 12)).collect();
    let goals = Goals::of(&reports);
    println!("{goals}");
    reports.iter().for_each(|report| print!("{}", strays(report)));
    assert_eq!(goals.missed_beyond_chance(), Vec::<String>::new(), "{goals}");
}

/// Forty cases of each arm with each design.
#[test]
#[ignore = "takes minutes: cargo test -p stiffarm --release --test withheld -- --ignored --nocapture full"]
fn full() {
    let mut reports = Vec::new();
    for setting in settings() {
        let report = run(&setting, 40);
        println!("{}\n{}", setting.name(), Goals::of(std::slice::from_ref(&report)));
        print!("{}", strays(&report));
        reports.push(report);
    }
    let goals = Goals::of(&reports);
    println!("all\n{goals}");
    assert!(goals.cases >= 400);
    assert_eq!(goals.missed(), Vec::<String>::new(), "{goals}");
}
