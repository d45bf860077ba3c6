//! What every suite is: settings, each a configuration of the bench with an arm of its own.

use stiffarm_kernels::generic::Arm;
use stiffarm_study::withhold::{Case, Experiment, Kind, Named, Plan, Report, withhold};

/// Tries so many cases.
pub fn tried(
    arm: &Arm,
    experiment: Experiment<'_>,
    cases: usize,
    multiple: [f64; 2],
    seed: u64,
) -> Report {
    let plan = Plan { arm, experiment, cases, multiple, seed, threads: 2 };
    let report = withhold(&plan, &|_, _| {}).expect("a plan that can be carried out");
    assert_eq!(report.cases.len(), cases);
    assert_eq!(report.failed, 0, "{:?}", report.cases.iter().find(|c| c.error.is_some()));
    report
}

/// The cases in which what was put in is not what was named: one line each.
pub fn strays(report: &Report) -> String {
    report.cases.iter().filter(|case| is_stray(case)).map(line).collect()
}

fn is_stray(case: &Case) -> bool {
    match case.kind {
        Kind::Removed => !case.is_unexplained(),
        _ => !case.sets().iter().filter_map(|set| set.first()).eq(&case.labels),
    }
}

fn line(case: &Case) -> String {
    let name = |named: &Named| format!("{}@{}", named.effect, named.place);
    let set = |set: &Vec<Named>| set.iter().map(name).collect::<Vec<_>>().join(" or ");
    let named: Vec<String> = case.sets().iter().map(set).collect();
    let put = case.truths.iter().zip(&case.multiples);
    let put: Vec<String> =
        put.map(|(truth, multiple)| format!("{truth} (×{multiple:.1})")).collect();
    let closed = if case.kind == Kind::Removed && !case.is_open() { ", closed," } else { "" };
    let left = match case.verdict.as_ref().filter(|verdict| verdict.unexplained) {
        Some(verdict) => format!("; unexplained: {}", verdict.unexplained_places.join(", ")),
        None => String::new(),
    };
    format!("  {:?}{closed} {} → {}{left}\n", case.kind, put.join(" "), named.join(", "))
}
