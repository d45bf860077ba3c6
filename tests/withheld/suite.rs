//! Arms and designs, fixed seeds.

use stiffarm_gap::Options;
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::plant::design::{Design, Shape};
use stiffarm_gap::plant::{Noise, effects};
use stiffarm_gap::withhold::{Case, Plan, Report, with_findings, withhold};

use crate::arms::arm;

/// One arm with one design.
pub struct Setting {
    pub robot: &'static str,
    /// Of joints that the file leaves rigid, N·m/rad.
    pub stiffness: f64,
    /// kg.
    pub payload: f64,
    pub shape: Shape,
    pub seed: u64,
    /// Part of the quick form.
    pub quick: bool,
}

impl Setting {
    pub fn name(&self) -> String {
        format!("{}, {}", self.robot, self.shape.name())
    }
}

/// Two, six and seven joints; every design.
pub fn settings() -> Vec<Setting> {
    // Payloads of the makers' data sheets; Lin's arm carries a few kilograms.
    let robots = [("lin_planar", 2e4, 5.0), ("kuka_kr240", 1e6, 240.0), ("iiwa14", 1.5e4, 14.0)];
    let of_robot = |(k, (robot, stiffness, payload)): (usize, (&'static str, f64, f64))| {
        Shape::ALL.into_iter().enumerate().map(move |(s, shape)| {
            // One design of each arm, and not the same.
            let quick = s == [1, 0, 3][k];
            Setting { robot, stiffness, payload, shape, seed: (10 * k + s) as u64, quick }
        })
    };
    robots.into_iter().enumerate().flat_map(of_robot).collect()
}

/// Forty poses and their loads, every effect, so many cases.
pub fn run(setting: &Setting, cases: usize) -> Report {
    let arm = arm(setting.robot, setting.stiffness);
    let design = |seed| Design {
        shape: setting.shape,
        poses: 40,
        repeats: 1,
        payload: setting.payload,
        kind: Kind::Pose { orientation: true },
        seed,
    };
    let rows = design(setting.seed).rows(&arm);
    let fresh = [1000, 2000, 3000, 4000].map(|more| design(setting.seed + more).rows(&arm));
    let options = Options { version: "test".to_owned(), ..Options::default() };
    let predict = with_findings(&arm, &options.catalogue);
    let plan = Plan {
        arm: &arm,
        design: &rows,
        fresh: &fresh,
        predict: Some(&predict),
        noise: Noise { position: 30e-6, rotation: 0.1e-3 },
        frames: None,
        effects: &effects(),
        cases,
        multiple: [8.0, 20.0],
        seed: setting.seed,
        options: &options,
        threads: 2,
    };
    let report = withhold(&plan, &|_, _| {}).expect("a plan that can be carried out");
    assert_eq!(report.cases.len(), cases);
    assert_eq!(report.failed, 0, "{:?}", report.cases.iter().find(|c| c.error.is_some()));
    report
}

/// The cases in which what was put in is not what was named: one line each.
pub fn strays(report: &Report) -> String {
    let named = |case: &Case| -> Vec<String> {
        let sets = case.verdict.iter().flat_map(|v| &v.sets);
        sets.filter_map(|set| set.first()).map(|n| format!("{}@{}", n.effect, n.place)).collect()
    };
    let labels = |case: &Case| -> Vec<String> {
        case.labels.iter().map(|n| format!("{}@{}", n.effect, n.place)).collect()
    };
    let line = |case: &Case| {
        let verdict = case.verdict.as_ref();
        let left = verdict.filter(|v| v.unexplained).map(|v| v.unexplained_places.join(", "));
        let left = left.map_or_else(String::new, |places| format!("; unexplained: {places}"));
        format!("  {:?} {} → {}{left}\n", case.kind, case.truths.join(" "), named(case).join(", "))
    };
    report.cases.iter().filter(|case| named(case) != labels(case)).map(line).collect()
}
