//! From cases to rates.

use std::collections::BTreeMap;

use statrs::statistics::{Data, Median};
use stiffarm_kernels::generic::{Arm, Convention};

use super::report::{After, Case, Confusion, Named, Pairs, Rate, Removed, Report, Shrunk, Single};
use super::{Kind, Plan};
use crate::effects::Effect;

/// Up to this many times the noise a gap counts as closed.
pub(super) const CLOSED: f64 = 1.2;

/// The result of some cases.
pub(super) fn report(
    plan: &Plan<'_>,
    cases: Vec<Case>,
    hidden: Vec<&'static dyn Effect>,
) -> Report {
    let of = |kind: Kind| cases.iter().filter(move |case| case.kind == kind);
    let known = || of(Kind::Single).chain(of(Kind::Pair));
    let open = |case: &&Case| is_unexplained(case) || !case.after.is_some_and(|x| x <= CLOSED);
    Report {
        stiffarm: plan.options.version.clone(),
        robot: plan.arm.name.clone(),
        design: plan.design.file.clone(),
        measurements: plan.design.rows.len(),
        poses: plan.design.poses,
        noise_position: plan.noise.position,
        noise_rotation: plan.noise.rotation,
        multiple: plan.multiple,
        seed: plan.seed,
        false_alarms: Rate::of(of(Kind::None).map(|case| !sets(case).is_empty())),
        false_unexplained: Rate::of(of(Kind::None).map(is_unexplained)),
        single: Single {
            first_named: Rate::of(of(Kind::Single).map(|case| first(case) == case.labels.first())),
            in_set: Rate::of(of(Kind::Single).map(in_first_set)),
            mean_set_size: mean(of(Kind::Single).filter_map(|c| sets(c).first()).map(Vec::len)),
            more_than_one: Rate::of(of(Kind::Single).map(|case| sets(case).len() > 1)),
        },
        pairs: Pairs { both_in_sets: Rate::of(of(Kind::Pair).map(both_in_sets)) },
        removed: Removed {
            flagged: Rate::of(of(Kind::Removed).map(is_unexplained)),
            flagged_of_open: Rate::of(of(Kind::Removed).filter(open).map(is_unexplained)),
            right_joint: Rate::of(
                of(Kind::Removed)
                    .filter(|case| is_unexplained(case))
                    .filter_map(|case| right_joint(plan.arm, case)),
            ),
        },
        after: After {
            within_1_2_of_noise: Rate::of(known().map(|c| c.after.is_some_and(|x| x <= CLOSED))),
            median: median(known().filter_map(|case| case.after).collect()),
        },
        shrink: shrunk(&cases),
        confusion: confusion(of(Kind::Single).filter_map(|case| {
            let label = case.labels.first()?;
            let truth = plan.effects.iter().find(|e| e.identifier() == label.effect)?;
            Some((truth.identifier(), label, first(case)))
        })),
        cannot_plant: hidden.into_iter().map(|effect| effect.identifier()).collect(),
        failed: cases.iter().filter(|case| case.verdict.is_none()).count(),
        cases,
    }
}

fn sets(case: &Case) -> &[Vec<Named>] {
    case.verdict.as_ref().map_or(&[], |verdict| &verdict.sets)
}

fn first(case: &Case) -> Option<&Named> {
    sets(case).first()?.first()
}

fn is_unexplained(case: &Case) -> bool {
    case.verdict.as_ref().is_some_and(|verdict| verdict.unexplained)
}

fn in_first_set(case: &Case) -> bool {
    let set = sets(case).first();
    set.zip(case.labels.first()).is_some_and(|(set, truth)| set.contains(truth))
}

/// Whether two findings can be told off, one for each effect.
fn both_in_sets(case: &Case) -> bool {
    let [a, b] = case.labels.as_slice() else { return false };
    let holding = |truth: &Named| -> Vec<usize> {
        sets(case).iter().enumerate().filter(|(_, s)| s.contains(truth)).map(|(k, _)| k).collect()
    };
    let (of_a, of_b) = (holding(a), holding(b));
    of_a.iter().any(|k| of_b.iter().any(|l| k != l))
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
    let pairs: Vec<(f64, [f64; 3])> = cases
        .iter()
        .filter_map(|case| case.realised.zip(case.verdict.as_ref().and_then(|v| v.shrink)))
        .collect();
    let off = pairs.iter().map(|(real, [predicted, ..])| real - predicted).collect();
    let inside = |(real, [_, low, high]): &(f64, [f64; 3])| (low..=high).contains(&real);
    Some(Shrunk { median_off: median(off)?, inside: Rate::of(pairs.iter().map(inside)) })
}

/// What was named first how often: of each case the truth's identifier, its label, and the finding.
pub(super) fn confusion<'a>(
    cases: impl Iterator<Item = (&'static str, &'a Named, Option<&'a Named>)>,
) -> Vec<Confusion> {
    let mut counts: BTreeMap<(&'static str, Option<String>, bool), usize> = BTreeMap::new();
    for (truth, label, named) in cases {
        let at_its_place = named.is_some_and(|named| named.place == label.place);
        let key = (truth, named.map(|n| n.effect.clone()), at_its_place);
        *counts.entry(key).or_default() += 1;
    }
    let mut rows: Vec<Confusion> = counts
        .into_iter()
        .map(|((truth, named, at_its_place), cases)| Confusion {
            truth,
            named,
            at_its_place,
            cases,
        })
        .collect();
    rows.sort_by_key(|row| core::cmp::Reverse(row.cases));
    rows
}

fn mean(sizes: impl Iterator<Item = usize>) -> Option<f64> {
    let (sum, count) = sizes.fold((0, 0), |(sum, count), size| (sum + size, count + 1));
    (count > 0).then(|| sum as f64 / f64::from(count))
}

fn median(values: Vec<f64>) -> Option<f64> {
    (!values.is_empty()).then(|| Data::new(values).median())
}

#[cfg(test)]
mod tests {
    use super::super::verdict::Verdict;
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
                after_position: 0.0,
                after_rotation: 0.0,
                shrink: None,
            }),
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
        assert_eq!(first(&right), right.labels.first());
        assert_ne!(first(&second), second.labels.first());
        assert_eq!([&right, &second, &elsewhere].map(in_first_set), [true, true, false]);
    }

    #[test]
    fn each_of_a_pair_has_a_finding_of_its_own() {
        let pair = ["a@joint 1", "b@joint 2"];
        let own = case(&pair, &[&["c@arm", "b@joint 2"], &["a@joint 1"]], None);
        let shared = case(&pair, &[&["a@joint 1", "b@joint 2"], &["c@arm"]], None);
        let one = case(&pair, &[&["a@joint 1"]], None);
        assert_eq!([own, shared, one].each_ref().map(both_in_sets), [true, false, false]);
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
