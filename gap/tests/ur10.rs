//! A real arm: a UR10 under a laser tracker, two campaigns (Landgraf et al., IEEE CASE 2021; MIT
//! licence, <https://github.com/christianlandgraf/ipa-robot-accuracy>).
//!
//! The data are not part of this repository. The tests look for `ur10/robot.toml`,
//! `ur10/campaign_c.csv` and `ur10/campaign_a_sixth.csv` in the directory that `STIFFARM_DATA`
//! names, or in `shared/data` beside the checkout; they are ignored unless `-- --ignored` asks for them.

use std::path::PathBuf;

use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::Arm;
use stiffarm_table::robot::Robot;

const MM: f64 = 1e-3;

struct Data {
    arm: Arm,
    /// Series C: random poses.
    random: Measurements,
    /// Series A: a grid, another day, mostly other angles of joint 1.
    grid: Measurements,
}

fn data() -> Data {
    let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let directory = std::env::var_os("STIFFARM_DATA").map_or_else(beside, PathBuf::from);
    let directory = directory.join("ur10");
    let path = directory.join("robot.toml");
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}: set STIFFARM_DATA", path.display()));
    let (robot, _) = Robot::from_toml(&text, "robot.toml").expect("a robot file");
    let layout = stiffarm_gap::robot::layout(&robot).expect("a layout");
    let read = |name: &str| Measurements::read(&directory.join(name), &layout).expect("a file");
    Data {
        arm: stiffarm_gap::robot::arm(&robot).expect("an arm"),
        random: read("campaign_c.csv"),
        grid: read("campaign_a_sixth.csv"),
    }
}

/// Every `every`-th row from `first` on.
fn thinned(data: &Measurements, first: usize, every: usize) -> Measurements {
    let mut thin = data.clone();
    thin.rows = data.rows.iter().skip(first).step_by(every).cloned().collect();
    for (group, row) in thin.rows.iter_mut().enumerate() {
        row.group = group;
    }
    thin.poses = thin.rows.len();
    thin
}

fn options() -> Options {
    let nuisances = vec![Nuisance::BaseFrame, Nuisance::ToolFrame];
    Options { nuisances, ..Options::default() }
}

#[test]
#[ignore = "reads campaigns that are not part of the repository: STIFFARM_DATA"]
fn frames_alone_leave_what_the_provenance_says() {
    let Data { arm, random, .. } = data();
    let effects = Some(Vec::new());
    let found = diagnose_with(&arm, &random, &Options { effects, ..options() }, &|_| {});
    let d = found.expect("a diagnosis").diagnosis;
    // Position only 0.987 mm; with the rotation fitted along it is a little more.
    let rms = d.gap.before.position_rms / MM;
    assert!((0.98..1.05).contains(&rms), "{rms}");
    let tool = &d.nuisances[1];
    assert!((tool.translation[2] - 0.093).abs() < 1e-3, "{tool:?}");
}

#[test]
#[ignore = "reads campaigns that are not part of the repository: STIFFARM_DATA"]
fn the_gap_shrinks_to_a_quarter_and_holds_on_rows_that_were_not_used() {
    let Data { arm, random, .. } = data();
    // Every twelfth row is diagnosed, others of the same campaign are predicted.
    let found = diagnose_with(&arm, &thinned(&random, 0, 12), &options(), &|_| {}).expect("found");
    let d = &found.diagnosis;
    let (before, after) = (d.gap.before.position_rms / MM, d.gap.after.position_rms / MM);
    assert!(after < 0.25 * before, "{before} {after}");
    // Geometry alone leaves 0.49 mm on rows that were not fitted; the joints' gears are seen as
    // well.
    let gears = |f: &&stiffarm_gap::diagnose::Finding| f.effect == "transmission_error";
    let places: Vec<&str> = d.findings.iter().filter(gears).map(|f| f.place.as_str()).collect();
    assert!(places.contains(&"joint 1") && places.contains(&"joint 2"), "{places:?}");
    // Rows that are off by more than makers tolerate may stand out of the calibration.
    assert!(d.findings.iter().any(|f| ["geometry", "link_geometry"].contains(&&*f.effect)));
    // Gravity is the only load: what bends first is not told from what bends beside it.
    let load = ["link_compliance", "bearing_compliance", "base_compliance", "joint_compliance"];
    let loaded = d.findings.iter().filter(|f| load.contains(&&*f.effect));
    assert!(loaded.clone().count() > 0 && loaded.clone().any(|f| !f.alternatives.is_empty()));
    let unseen = |effect: &str| d.cannot_see.iter().any(|c| c.effect == effect);
    assert!(unseen("wrench_scale") && unseen("payload_com") && unseen("joint_offset"));

    let rest = thinned(&random, 5, 12);
    let predicted = found.explanation.predict(&rest).expect("a prediction");
    let inside = |gaps: &[nalgebra::Vector6<f64>]| {
        let kept = gaps.iter().zip(&predicted.inside).filter(|(_, inside)| **inside);
        Statistics::of(kept.map(|(g, _)| g)).position_rms / MM
    };
    let (before, after) = (inside(&predicted.before), inside(&predicted.after));
    println!("rows not used: {before:.3} mm before, {after:.3} mm after");
    assert!(after < 0.25 * before, "{before} {after}");
}

#[test]
#[ignore = "reads campaigns that are not part of the repository: STIFFARM_DATA"]
fn another_campaign_is_mostly_outside_the_joint_ranges_seen() {
    let Data { arm, random, grid } = data();
    let options = Options { effects: Some(Vec::new()), ..options() };
    let found = diagnose_with(&arm, &thinned(&random, 0, 12), &options, &|_| {}).expect("found");
    let predicted = found.explanation.predict(&grid).expect("a prediction");
    let inside = predicted.inside.iter().filter(|inside| **inside).count();
    println!(
        "{inside} of {} rows of the grid lie inside the ranges of the random poses",
        grid.rows.len()
    );
    assert!(inside < grid.rows.len() / 2, "{inside}");
}
