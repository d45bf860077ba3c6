//! Arms of one model together: what is usual of a number, which arms stand out, and what the others' numbers gain.

use std::collections::BTreeMap;

use stiffarm_gap::pool::{Estimate, Gain, Pool, gain};

use super::campaigns::Campaign;
use super::numbers::{What, by_arm, estimate, of};

/// Chance findings that are allowed among all arms and numbers of a page.
const CHANCE: f64 = 0.05;

/// A number of all arms that have it.
#[derive(Clone, Debug)]
pub struct Pooled {
    /// What it is of.
    pub what: What,
    /// What is usual.
    pub pool: Pool,
    /// What the others gain on arms that they have not seen; `None` of fewer than four arms with two campaigns.
    pub gain: Option<Gain>,
    /// Arms, each with its own number and the same drawn towards the others'.
    pub arms: Vec<(String, [Estimate; 2])>,
}

/// An arm that is not like the others of its model.
#[derive(Clone, Debug)]
pub struct Outlier {
    /// The arm.
    pub arm: String,
    /// In what.
    pub what: What,
    /// Its number.
    pub own: Estimate,
    /// The others'.
    pub others: Pool,
    /// How often chance does that, among all that was looked at.
    pub p_value: f64,
}

/// The numbers of at least three arms, each of an arm's last campaign that has it.
pub fn pooled(campaigns: &[Campaign]) -> Vec<Pooled> {
    let each = histories(campaigns).into_iter().filter_map(|(what, arms)| {
        let own: Vec<Estimate> = arms.iter().filter_map(|(_, all)| all.last().copied()).collect();
        let pool = Pool::of(&own)?;
        let pairs: Vec<[Estimate; 2]> = arms.iter().filter_map(|(_, all)| last_two(all)).collect();
        let drawn = arms.iter().zip(&own).enumerate().map(|(k, ((arm, _), own_one))| {
            let others = without(&own, k);
            let others = Pool::of(&others).unwrap_or(pool);
            (arm.clone(), [*own_one, others.drawn(*own_one)])
        });
        let arms = drawn.collect();
        Some(Pooled { what, pool, gain: gain(&pairs), arms })
    });
    each.collect()
}

/// The arms that stand out, the clearest first.
pub fn outliers(pooled: &[Pooled]) -> Vec<Outlier> {
    let looked_at: usize = pooled.iter().map(|number| number.arms.len()).sum();
    let mut found = Vec::new();
    for Pooled { what, arms, .. } in pooled {
        let own: Vec<Estimate> = arms.iter().map(|(_, [own, _])| *own).collect();
        for (k, (arm, [own_one, _])) in arms.iter().enumerate() {
            let Some(others) = Pool::of(&without(&own, k)) else { continue };
            let p_value = (others.p_value(*own_one) * looked_at as f64).min(1.0);
            if p_value < CHANCE {
                let (arm, what, own) = (arm.clone(), what.clone(), *own_one);
                found.push(Outlier { arm, what, own, others, p_value });
            }
        }
    }
    found.sort_by(|a, b| a.p_value.total_cmp(&b.p_value));
    found
}

/// By number the arms that have it, with an estimate for each of their campaigns that has it.
fn histories(campaigns: &[Campaign]) -> BTreeMap<What, Vec<(String, Vec<Estimate>)>> {
    let mut histories: BTreeMap<What, Vec<(String, Vec<Estimate>)>> = BTreeMap::new();
    for (arm, diagnosed) in by_arm(campaigns) {
        let mut own: BTreeMap<What, Vec<Estimate>> = BTreeMap::new();
        for (campaign, found) in diagnosed {
            for (what, parameter) in of(&campaign.robot, found) {
                own.entry(what).or_default().extend(estimate(parameter));
            }
        }
        for (what, all) in own.into_iter().filter(|(_, all)| !all.is_empty()) {
            histories.entry(what).or_default().push((arm.to_owned(), all));
        }
    }
    histories
}

fn last_two(all: &[Estimate]) -> Option<[Estimate; 2]> {
    all.last_chunk().copied()
}

fn without(all: &[Estimate], k: usize) -> Vec<Estimate> {
    let others = all.iter().enumerate().filter(|(j, _)| *j != k);
    others.map(|(_, estimate)| *estimate).collect()
}
