//! The example of an effect of one's own, run: planted, found, named, written as JSON, withheld.

#[allow(dead_code, reason = "its main is for those who read it")]
#[path = "../../examples/own_effect.rs"]
mod example;

use example::{arm, catalogue, diagnosed, measured};
use stiffarm_gap::Options;
use stiffarm_gap::effects::{Over, Told};
use stiffarm_gap::measurement::Kind;
use stiffarm_plant::Noise;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_study::withhold::{self, Campaign, Experiment, Plan, with_findings, withhold};

#[test]
fn an_effect_of_ones_own_is_found_and_told() {
    let arm = arm();
    let found = diagnosed(&arm, &measured(&arm));
    let [finding] = &found.findings[..] else { panic!("{:?}", found.findings) };
    assert_eq!((&*finding.effect, finding.place.as_str()), ("taut_hose", "joint 2"));
    let number = &finding.parameters[0];
    assert_eq!((&*number.name, &*number.unit), ("lag beyond 80°", "1"));
    assert!((number.ci95[0]..=number.ci95[1]).contains(&4e-4), "{number:?}");
    let rivals = finding.indistinguishable();
    assert!(
        finding.indistinguishable().all(|a| a.effect == "taut_hose"),
        "{:?}",
        rivals.collect::<Vec<_>>()
    );
    assert!(serde_json::to_string(&found).unwrap().contains(r#""effect":"taut_hose""#));
    let effect = catalogue().named(&finding.effect).unwrap();
    let told = effect.sentence(&Told::plain(&finding.place, &finding.parameters));
    assert!(told.starts_with("the hose at joint 2 makes it lag beyond 80° by 4.0"), "{told}");
    let curve = effect.curve(&finding.parameters).unwrap();
    let beyond = 2.0 - 80_f64.to_radians();
    assert_eq!((curve.over, (curve.value)(2.0)), (Over::Reading, -number.value * beyond));
}

#[test]
fn an_effect_of_ones_own_is_withheld() {
    let arm = arm();
    let kind = Kind::Pose { orientation: true };
    let design =
        Design { shape: Shape::Force, poses: 30, repeats: 1, payload: 12.0, kind, seed: 3 };
    let rows = design.rows(&arm);
    let (catalogue, options) =
        (catalogue(), Options { catalogue: catalogue(), ..Options::default() });
    let predict = with_findings(&arm, &catalogue);
    let effects = ["taut_hose", "backlash"].map(|name| catalogue.named(name).unwrap());
    let fresh = [Design { seed: 4, ..design }.rows(&arm)];
    let experiment = Experiment::Campaign(Campaign {
        design: &rows,
        fresh: &fresh,
        predict: Some(&predict),
        noise: Noise { position: 20e-6, rotation: 40e-6 },
        frames: None,
        effects: &effects,
        options: &options,
    });
    let (arm, multiple) = (&arm, [10.0, 20.0]);
    let plan = Plan { arm, experiment, cases: 8, multiple, seed: 5, threads: 2 };
    let report = withhold(&plan, &|_, _| {}).unwrap();
    assert!(report.cannot_plant.is_empty());
    let own = |case: &&withhold::Case| case.labels.iter().any(|l| l.effect == "taut_hose");
    let cases: Vec<_> = report.cases.iter().filter(own).collect();
    assert!(cases.len() >= 2, "{report:?}");
    for case in cases.into_iter().filter(|case| case.kind == withhold::Kind::Single) {
        let set = case.verdict.as_ref().unwrap().sets.first();
        assert!(set.into_iter().flatten().any(|named| *named == case.labels[0]), "{case:?}");
        assert!(case.realised.unwrap() > 0.5, "{case:?}");
    }
}
