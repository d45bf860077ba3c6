//! From cases to rates.

use std::collections::BTreeMap;

use statrs::statistics::{Data, Median};
use stiffarm_kernels::generic::{Arm, Convention};

use super::report::{
    After, Case, Confusion, Facts, Pairs, Rate, Removed, Report, Residual, Shrunk, Single,
};
use super::{Experiment, Kind, Plan};

/// The result of some cases.
pub(super) fn report(plan: &Plan<'_>, cases: Vec<Case>, cannot_plant: Vec<String>) -> Report {
    let of = |kind: Kind| cases.iter().filter(move |case| case.kind == kind);
    let at_rest = matches!(plan.experiment, Experiment::Campaign(_));
    // Of a log nothing says where an effect is that the diagnosis does not know, and how much noise
    // there is in what is left.
    let known = || of(Kind::Single).chain(of(Kind::Pair)).filter(|_| at_rest);
    let flagged = || of(Kind::Removed).filter(|case| at_rest && case.is_unexplained());
    let sizes: Vec<usize> =
        of(Kind::Single).filter_map(|case| Some(case.sets().first()?.len())).collect();
    let mean = sizes.iter().sum::<usize>() as f64 / sizes.len() as f64;
    let (version, experiment) = facts(plan);
    Report {
        stiffarm: version,
        robot: plan.arm.name.clone(),
        experiment,
        multiple: plan.multiple,
        seed: plan.seed,
        false_alarms: Rate::of(of(Kind::None).map(|case| !case.sets().is_empty())),
        false_unexplained: Rate::of(of(Kind::None).map(Case::is_unexplained)),
        single: Single {
            first_named: Rate::of(of(Kind::Single).map(Case::is_right)),
            in_set: Rate::of(of(Kind::Single).map(Case::in_first_set)),
            mean_set_size: (!sizes.is_empty()).then_some(mean),
            more_than_one: Rate::of(of(Kind::Single).map(|case| case.sets().len() > 1)),
        },
        pairs: Pairs { both_in_sets: Rate::of(of(Kind::Pair).map(Case::both_in_sets)) },
        removed: Removed {
            flagged: Rate::of(of(Kind::Removed).map(Case::is_unexplained)),
            flagged_of_open: Rate::of(
                of(Kind::Removed).filter(|case| case.is_open()).map(Case::is_unexplained),
            ),
            right_joint: Rate::of(flagged().filter_map(|case| right_joint(plan.arm, case))),
        },
        after: After {
            within_1_2_of_noise: Rate::of(known().map(Case::is_closed)),
            median: median(known().filter_map(|case| case.after).collect()),
        },
        shrink: shrunk(&cases),
        confusion: confusion(of(Kind::Single)),
        cannot_plant,
        failed: cases.iter().filter(|case| case.verdict.is_none()).count(),
        cases,
    }
}

/// The diagnosis' version, and what is measured.
fn facts(plan: &Plan<'_>) -> (String, Facts) {
    match &plan.experiment {
        Experiment::Campaign(own) => {
            let facts = Facts::Campaign {
                design: own.design.file.clone(),
                measurements: own.design.rows.len(),
                poses: own.design.poses,
                noise_position: own.noise.position,
                noise_rotation: own.noise.rotation,
            };
            (own.options.version.clone(), facts)
        }
        Experiment::Log(own) => {
            let facts = Facts::Log {
                duration: own.stages.iter().map(|stage| stage.course.duration()).sum(),
                runs: own.stages.len(),
                rate: own.recording.rate,
                noise_torque: own.recording.torque,
                noise_reading: own.recording.reading,
            };
            (own.options.version.clone(), facts)
        }
    }
}

/// Where along the arm a place is, and the number that it bears; `None` for those that are
/// everywhere.
fn station(arm: &Arm, place: &str) -> Option<(usize, usize)> {
    let number = |prefix: &str| place.strip_prefix(prefix)?.trim().parse::<usize>().ok();
    let before_joint = |i: usize| match arm.convention {
        // The frame behind row i − 1 is the one in which joint i tilts.
        Convention::Standard => i - 1,
        Convention::Modified => i,
    };
    match place {
        "base" => Some((0, 0)),
        "tool" => Some((arm.dof(), arm.dof())),
        _ => number("joint ")
            .map(|i| (before_joint(i), i))
            .or_else(|| number("link ").map(|i| (i, i))),
    }
}

/// Whether what is unexplained lies first at the joint of the truth; `None` where the truth is at
/// none.
fn right_joint(arm: &Arm, case: &Case) -> Option<bool> {
    let truth = station(arm, &case.labels.first()?.place)?;
    let place = case.verdict.as_ref()?.unexplained_places.first();
    let named = place.and_then(|place| station(arm, place));
    Some(named.is_some_and(|named| named.0 == truth.0 || named.1 == truth.1))
}

fn shrunk(cases: &[Case]) -> Option<Shrunk> {
    let pairs: Vec<(f64, [f64; 3])> =
        cases.iter().filter_map(|case| case.realised.zip(predicted(case))).collect();
    let off = pairs.iter().map(|(real, [predicted, ..])| real - predicted).collect();
    let inside = |(real, [_, low, high]): &(f64, [f64; 3])| (low..=high).contains(&real);
    Some(Shrunk { median_off: median(off)?, inside: Rate::of(pairs.iter().map(inside)) })
}

fn predicted(case: &Case) -> Option<[f64; 3]> {
    match case.verdict.as_ref()?.residual {
        Residual::Campaign { shrink, .. } => shrink,
        Residual::Log { .. } => None,
    }
}

/// What was named first how often, of cases with one effect.
fn confusion<'a>(cases: impl Iterator<Item = &'a Case>) -> Vec<Confusion> {
    let mut counts: BTreeMap<(String, Option<String>, bool), usize> = BTreeMap::new();
    for case in cases {
        let Some(label) = case.labels.first() else { continue };
        let at_its_place = case.first().is_some_and(|named| named.place == label.place);
        let named = case.first().map(|named| named.effect.clone());
        *counts.entry((label.effect.clone(), named, at_its_place)).or_default() += 1;
    }
    let row =
        |((truth, named, at_its_place), cases)| Confusion { truth, named, at_its_place, cases };
    let mut rows: Vec<Confusion> = counts.into_iter().map(row).collect();
    rows.sort_by_key(|row| core::cmp::Reverse(row.cases));
    rows
}

fn median(values: Vec<f64>) -> Option<f64> {
    (!values.is_empty()).then(|| Data::new(values).median())
}

#[cfg(test)]
mod tests {
    use super::super::report::{Named, Verdict};
    use super::*;
    use crate::fixture;

    fn named(text: &str) -> Named {
        let (effect, place) = text.split_once('@').unwrap();
        Named::new(effect, &place)
    }

    fn case(labels: &[&str], sets: &[&[&str]], unexplained: Option<&str>) -> Case {
        Case {
            kind: Kind::Single,
            truths: Vec::new(),
            labels: labels.iter().map(|l| named(l)).collect(),
            multiples: Vec::new(),
            verdict: Some(Verdict {
                sets: sets.iter().map(|s| s.iter().map(|l| named(l)).collect()).collect(),
                unexplained: unexplained.is_some(),
                unexplained_places: unexplained.map(str::to_owned).into_iter().collect(),
                residual: Residual::Log { left: 0.0, after: Vec::new() },
            }),
            without: None,
            error: None,
            after: None,
            realised: None,
        }
    }

    #[test]
    fn a_set_holds_the_finding_and_what_cannot_be_told_from_it() {
        let right = case(&["a@joint 1"], &[&["a@joint 1", "b@base"]], None);
        let second = case(&["b@base"], &[&["a@joint 1", "b@base"]], None);
        let elsewhere = case(&["a@joint 2"], &[&["a@joint 1", "b@base"], &["a@joint 2"]], None);
        assert_eq!(right.first(), right.labels.first());
        assert_ne!(second.first(), second.labels.first());
        assert_eq!([&right, &second, &elsewhere].map(Case::in_first_set), [true, true, false]);
    }

    #[test]
    fn each_of_a_pair_has_a_finding_of_its_own() {
        let pair = ["a@joint 1", "b@joint 2"];
        let own = case(&pair, &[&["c@arm", "b@joint 2"], &["a@joint 1"]], None);
        let shared = case(&pair, &[&["a@joint 1", "b@joint 2"], &["c@arm"]], None);
        let one = case(&pair, &[&["a@joint 1"]], None);
        assert_eq!([own, shared, one].each_ref().map(Case::both_in_sets), [true, false, false]);
    }

    #[test]
    fn the_right_joint_is_the_same_place_or_number() {
        let arm = fixture::springy();
        let verdict = |truth: &str, at: &str| {
            right_joint(&arm, &case(&[&format!("a@{truth}")], &[], Some(at)))
        };
        assert_eq!(verdict("joint 2", "joint 2"), Some(true));
        assert_eq!(verdict("joint 2", "link 2"), Some(true));
        assert_eq!(verdict("joint 2", "link 1"), Some(true));
        assert_eq!(verdict("joint 2", "joint 3"), Some(false));
        assert_eq!(verdict("link 3", "tool"), Some(true));
        assert_eq!(verdict("base", "joint 1"), Some(true));
        assert_eq!(verdict("arm", "joint 1"), None);
    }

    #[test]
    fn rates_have_intervals() {
        let rate = Rate::of((0..100).map(|k| k < 95));
        assert_eq!((rate.hits, rate.of, rate.rate), (95, 100, Some(0.95)));
        // Wilson's interval of 95 in 100, as tabulated: 0.8882 to 0.9785.
        let [low, high] = rate.ci95.unwrap();
        assert!((low - 0.8882).abs() < 1e-4 && (high - 0.9785).abs() < 1e-4);
        assert_eq!(Rate::of([]).rate, None);
        assert_eq!(median(vec![3.0, 1.0, 2.0, 10.0]), Some(2.5));
    }
}
