use super::*;
use crate::effects::{
    Backlash, BaseFrame, Catalogue, JointCompliance, JointOffset, JointRatio, WrenchScale,
};
use crate::fixture;
use crate::measurement;
use crate::plant::Truth;
use crate::plant::design::{Design, Shape};
use crate::whole::Whole;

fn design(seed: u64) -> Measurements {
    let kind = measurement::Kind::Pose { orientation: true };
    let shape = Shape::Payload;
    Design { shape, poses: 8, repeats: 1, payload: 20.0, kind, seed }.rows(&fixture::springy())
}

fn campaign<'a>(
    design: &'a Measurements,
    effects: &'a [&'static dyn Effect],
    options: &'a Options,
) -> Campaign<'a> {
    let noise = Noise { position: 3e-5, rotation: 1e-4 };
    Campaign { design, fresh: &[], predict: None, noise, frames: None, effects, options }
}

fn plan<'a>(arm: &'a Arm, campaign: Campaign<'a>, cases: usize) -> Plan<'a> {
    let experiment = Experiment::Campaign(campaign);
    Plan { arm, experiment, cases, multiple: [8.0, 20.0], seed: 4, threads: 2 }
}

fn check(change: impl Fn(&mut Plan<'_>)) -> Result<Report, WithholdError> {
    let effects = Some(vec!["joint_compliance".to_owned()]);
    checked(&Options { effects, ..Options::default() }, change)
}

fn checked(options: &Options, change: impl Fn(&mut Plan<'_>)) -> Result<Report, WithholdError> {
    let catalogue = Catalogue::default();
    let (arm, design, fresh) = (fixture::springy(), design(1), [design(2), design(3)]);
    let predict = with_findings(Whole { arm: &arm, known: &options.known }, &catalogue);
    let campaign = Campaign {
        fresh: &fresh,
        predict: Some(&predict),
        ..campaign(&design, &[&JointCompliance], options)
    };
    let mut plan = plan(&arm, campaign, 20);
    change(&mut plan);
    withhold(&plan, &|_, _| {})
}

/// With springs alone in plant and catalogue, every spring is found.
#[test]
fn springs_are_found_where_they_are() {
    let report = check(|_| {}).unwrap();
    assert_eq!((report.cases.len(), report.failed), (20, 0));
    assert_eq!(report.single.first_named.rate, Some(1.0), "{report:#?}");
    assert_eq!(report.single.in_set.rate, Some(1.0));
    assert!(report.after.median.unwrap() < 1.2);
    assert!(report.cannot_plant.is_empty());
    let read: Report = serde_json::from_str(&serde_json::to_string(&report).unwrap()).unwrap();
    assert_eq!((read.single, &read.confusion), (report.single, &report.confusion));
    let first = |report: &Report| report.cases[0].clone();
    assert_eq!(first(&read).labels, first(&report).labels);
    for case in report.cases.iter().filter(|case| case.kind == Kind::Single) {
        assert!((7.2..22.0).contains(&case.multiples[0]), "{case:?}");
        let realised = case.realised.unwrap();
        assert!(realised > 0.7 && realised < 1.0, "{case:?}");
    }
    assert!(report.shrink.unwrap().median_off.abs() < 0.05);
}

/// How many threads work makes no difference, and neither does a second run; the seed does.
#[test]
fn the_seed_decides() {
    let one = check(|plan| plan.threads = 1).unwrap();
    assert_eq!(one, check(|_| {}).unwrap());
    assert_ne!(one, check(|plan| plan.seed = 5).unwrap());
}

#[test]
fn what_does_not_show_is_said() {
    let (arm, mut unloaded) = (fixture::rigid(), design(1));
    unloaded.rows.iter_mut().for_each(|row| row.wrench.fill(0.0));
    let options = Options::default();
    let campaign = campaign(&unloaded, &[&WrenchScale, &JointOffset], &options);
    let plan = plan(&arm, campaign, 4);
    let report = withhold(&plan, &|_, _| {}).unwrap();
    assert_eq!(report.cannot_plant, ["wrench_scale"]);
    assert_eq!(report.shrink, None);
}

#[test]
fn plans_that_make_no_sense_are_refused() {
    assert_eq!(check(|plan| plan.cases = 0), Err(WithholdError::NoCases));
    let wrong = check(|plan| plan.multiple = [20.0, 8.0]);
    assert_eq!(wrong, Err(WithholdError::Multiple { from: 20.0, to: 8.0 }));
    let silent = check(|plan| {
        let Experiment::Campaign(own) = &mut plan.experiment else { unreachable!() };
        own.noise.rotation = 0.0;
    });
    assert_eq!(silent, Err(WithholdError::NoNoise { what: "rotation" }));
}

/// The gap that an effect is given is in multiples of the noise, whatever unknown frames could do.
#[test]
fn frames_that_are_unknown_hide_what_moves_them() {
    use super::campaign::Bench;
    use super::run::{Bench as _, shown};
    use crate::rng::{Rng, Stream};
    let (arm, design) = (fixture::springy(), design(1));
    let options = Options::default();
    let effects = crate::plant::effects();
    let campaign =
        Campaign { frames: Some(Frames::unknown(3)), ..campaign(&design, &effects, &options) };
    let plan = plan(&arm, campaign, 1);
    let Experiment::Campaign(own) = &plan.experiment else { unreachable!() };
    let bench = Bench::new(&plan, own).unwrap();
    let mut rng = Rng::new(1, Stream::Truths);
    // The first joint's zero is a turn of the base, its ratio is not.
    let first = bench.plant(&JointRatio, 10.0, &mut rng).unwrap();
    assert!((first.multiple - 10.0).abs() < 0.5);
    let (shows, _) = shown(&plan, &bench);
    assert!(
        !shows.contains(&(&BaseFrame as &dyn Effect))
            && shows.contains(&(&Backlash as &dyn Effect))
    );
}

/// What the robot file says beyond its table is in plant and diagnosis alike: with nothing put in there is
/// no alarm, and springs are found on top of it.
#[test]
fn a_corrected_arm_is_measured_with_what_its_file_says() {
    let design = design(1);
    let known = vec![
        fixture::known("joint_ratio", "joint 2", 0, &[0.01]),
        fixture::known("base_compliance", "base", 0, &[4e-6, 3e-6, 1e-8, 0.0]),
    ];
    let options = Options {
        known: known.clone(),
        effects: Some(vec!["joint_compliance".to_owned(), "joint_ratio".to_owned()]),
        ..Options::default()
    };
    let report = checked(&options, |_| {}).unwrap();
    assert_eq!(report.false_alarms.hits, 0, "{report:#?}");
    assert_eq!(report.single.first_named.rate, Some(1.0), "{report:#?}");
    assert!(report.shrink.unwrap().median_off.abs() < 0.05);
    let arm = fixture::springy();
    let shown = |known: &[crate::effects::Known]| {
        exact(Whole { arm: &arm, known }, &[], None, &design).unwrap().rows[0].measured
    };
    assert!((shown(&known) - shown(&[])).norm() > 1e-4);
    let own = Truth::parse("joint_ratio@joint 2=0.01", &arm).unwrap();
    let by_plant = exact(&arm, &[own], None, &design).unwrap();
    let by_file = exact(Whole { arm: &arm, known: &known[..1] }, &[], None, &design).unwrap();
    for (a, b) in by_plant.rows.iter().zip(&by_file.rows) {
        assert!((a.measured - b.measured).norm() < 1e-13);
    }
}
