//! The numbers of arms, by what they are of.

use std::collections::BTreeMap;

use stiffarm_gap::pool::Estimate;

use super::campaigns::Campaign;
use stiffarm_gap::report::{Diagnosis, Parameter};

/// What a number is of: of arms of one model those with the same are compared.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct What {
    /// The arms' model.
    pub robot: String,
    /// The effect.
    pub effect: String,
    /// Its place.
    pub place: String,
    /// The number of it.
    pub number: String,
    /// Its unit.
    pub unit: String,
}

impl What {
    /// `joint compliance at joint 2`, with the number's name where the effect does not end in it.
    pub fn said(&self) -> String {
        let effect = self.effect.replace('_', " ");
        match effect.ends_with(&self.number) {
            true => format!("{effect} at {}", self.place),
            false => format!("{effect} at {}, {}", self.place, self.number),
        }
    }
}

/// The numbers of a campaign.
pub fn of<'a>(robot: &str, found: &'a Diagnosis) -> BTreeMap<What, &'a Parameter> {
    let each = found.findings.iter().flat_map(|finding| {
        finding.parameters.iter().map(|parameter| {
            let what = What {
                robot: robot.to_owned(),
                effect: finding.effect.to_string(),
                place: finding.place.clone(),
                number: parameter.name.to_string(),
                unit: parameter.unit.to_string(),
            };
            (what, parameter)
        })
    });
    each.collect()
}

/// The same as an estimate.
pub fn estimate(parameter: &Parameter) -> Option<Estimate> {
    Estimate::of(parameter.value, parameter.ci95)
}

/// The campaigns of each arm that have a diagnosis, earliest first.
pub fn by_arm(campaigns: &[Campaign]) -> BTreeMap<&str, Vec<(&Campaign, &Diagnosis)>> {
    let mut arms: BTreeMap<&str, Vec<_>> = BTreeMap::new();
    for campaign in campaigns {
        if let Ok(found) = &campaign.found {
            arms.entry(&campaign.arm).or_default().push((campaign, found));
        }
    }
    arms
}

/// A number with three digits.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = value.abs().log10().floor() as i32;
    match digits {
        -3..=3 => format!("{value:.*}", (2 - digits).max(0) as usize),
        _ => format!("{value:.2e}"),
    }
}
