//! What the page says, from the campaigns alone.

use std::collections::BTreeMap;

use stiffarm_gap::report::Diagnosis;

use super::campaigns::Campaign;
use super::numbers::by_arm;
use super::pooled::{Outlier, Pooled, outliers, pooled};
use super::time::{Change, changes};

/// What is known of a fleet.
#[derive(Clone, Debug)]
pub struct Fleet {
    /// Number of campaigns.
    pub campaigns: usize,
    /// The last campaign of each arm that has a diagnosis, what is left largest first.
    pub arms: Vec<Line>,
    /// How often an effect is found at a place, in the last campaigns.
    pub effects: Vec<Frequency>,
    /// Numbers that several arms have.
    pub pooled: Vec<Pooled>,
    /// Arms that stand out.
    pub outliers: Vec<Outlier>,
    /// What changed since the last campaign.
    pub changes: Vec<Change>,
    /// How many numbers two campaigns of an arm have.
    pub compared: usize,
    /// Campaigns without a diagnosis: arm, campaign, why.
    pub without: Vec<[String; 3]>,
}

/// An arm as it is now.
#[derive(Clone, Debug)]
pub struct Line {
    /// The arm.
    pub arm: String,
    /// Its model.
    pub robot: String,
    /// The campaign.
    pub campaign: String,
    /// The gap of the robot file, with the findings, and the noise: m, or rad where no position is measured.
    pub gap: [f64; 3],
    /// Whether positions are measured.
    pub is_length: bool,
    /// The effects.
    pub findings: Vec<String>,
}

/// How often an effect is found.
#[derive(Clone, Debug)]
pub struct Frequency {
    /// The model.
    pub robot: String,
    /// `joint compliance at joint 2`.
    pub finding: String,
    /// Arms with it.
    pub arms: usize,
    /// Arms of the model.
    pub of: usize,
}

impl Fleet {
    /// Of these campaigns, those of an arm earliest first.
    pub fn of(campaigns: &[Campaign]) -> Fleet {
        let mut arms: Vec<Line> = by_arm(campaigns).into_iter().filter_map(line).collect();
        let effects = effects(&arms);
        arms.sort_by(|a, b| b.gap[1].total_cmp(&a.gap[1]).then_with(|| a.arm.cmp(&b.arm)));
        let pooled = pooled(campaigns);
        let (changes, compared) = changes(campaigns);
        let why = |campaign: &Campaign| {
            let said = campaign.found.as_ref().err()?;
            Some([campaign.arm.clone(), campaign.name.clone(), said.clone()])
        };
        Fleet {
            campaigns: campaigns.len(),
            arms,
            effects,
            outliers: outliers(&pooled),
            pooled,
            changes,
            compared,
            without: campaigns.iter().filter_map(why).collect(),
        }
    }
}

fn line((arm, diagnosed): (&str, Vec<(&Campaign, &Diagnosis)>)) -> Option<Line> {
    let (campaign, found) = diagnosed.last()?;
    let noise = &found.gap.noise;
    let is_length = noise.position_rms > 0.0;
    let noise = if is_length { noise.position_rms } else { noise.rotation_rms };
    let said = |effect: &str, place: &str| format!("{} at {place}", effect.replace('_', " "));
    Some(Line {
        arm: arm.to_owned(),
        robot: campaign.robot.clone(),
        campaign: campaign.name.clone(),
        gap: [found.gap.shrink.before, found.gap.shrink.after, noise],
        is_length,
        findings: found.findings.iter().map(|f| said(&f.effect, &f.place)).collect(),
    })
}

/// The most frequent first.
fn effects(arms: &[Line]) -> Vec<Frequency> {
    let mut models: BTreeMap<&str, usize> = BTreeMap::new();
    let mut found: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for line in arms {
        *models.entry(&line.robot).or_default() += 1;
        for finding in &line.findings {
            *found.entry((&line.robot, finding)).or_default() += 1;
        }
    }
    let frequency = |((robot, finding), arms): ((&str, &str), usize)| Frequency {
        robot: robot.to_owned(),
        finding: finding.to_owned(),
        arms,
        of: models[robot],
    };
    let mut effects: Vec<Frequency> = found.into_iter().map(frequency).collect();
    effects.sort_by(|a, b| (b.arms * a.of).cmp(&(a.arms * b.of)));
    effects
}
