//! One arm diagnosed as a user would, and held against the truth.

use std::error::Error;
use std::time::Instant;

use nalgebra::Vector6;
use serde::Serialize;
use stiffarm_codegen::robot::Robot;
use stiffarm_gap::corrected::corrected;
use stiffarm_gap::diagnose::{Diagnosed, Finding, Nuisance};
use stiffarm_gap::effects::{Catalogue, Known};
use stiffarm_gap::gap::{Statistics, rms};
use stiffarm_gap::{Options, diagnose_with};
use stiffarm_study::withhold::Named;

use super::draw::{Drawn, lasts};

/// Findings of ordinary calibration; every other is physical.
pub const GEOMETRY: [&str; 5] =
    ["geometry", "joint_offset", "link_geometry", "base_frame", "tool_frame"];

/// A physical effect that the arm has, and what the diagnosis made of it.
#[derive(Clone, Debug, Serialize)]
pub struct Truth {
    #[serde(flatten)]
    pub what: Named,
    pub text: String,
    pub ratio: f64,
    pub evidence: f64,
    /// Named at its place.
    pub named: bool,
    /// Named as its twin: what moves the arm alike, whatever is measured.
    pub as_twin: bool,
    /// Named, or in the set of what the data does not tell from a finding.
    pub in_set: bool,
    /// Of each of its values, if it is named: whether the interval covers it.
    pub covered: Vec<bool>,
}

/// A finding.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    #[serde(flatten)]
    pub what: Named,
    pub physical: bool,
    pub p_value: f64,
    /// How often it is found again on half of the poses.
    pub stability: Option<f64>,
    /// What the data does not tell from it.
    pub inseparable: Vec<Named>,
    /// Name, value and interval of each parameter.
    pub parameters: Vec<(String, f64, [f64; 2])>,
}

/// What is predicted of other poses, and what is so.
#[derive(Clone, Debug, Serialize)]
pub struct Shrink {
    pub predicted: f64,
    pub ci95: [f64; 2],
    pub realised: f64,
}

/// One arm.
#[derive(Clone, Debug, Serialize)]
pub struct Case {
    pub seed: u64,
    pub robot: &'static str,
    pub orientation: bool,
    pub loads: bool,
    pub rows: usize,
    /// Rows that the diagnosis leaves out.
    pub left_out: usize,
    pub truths: Vec<Truth>,
    pub found: Vec<Found>,
    /// Whether the first physical finding is a truth; `None` where there is none to be found.
    pub first: Option<bool>,
    /// Physical findings that are no truth.
    pub spurious: usize,
    /// Position rms over the rows that are not left out, m: of the robot file, held out with the
    /// findings, and of the noise as it was drawn.
    pub before: f64,
    pub after: f64,
    pub floor: f64,
    /// The same of the rotation, rad; 0 where it is not measured.
    pub after_rotation: f64,
    pub floor_rotation: f64,
    /// What the diagnosis takes the noise to be, rms, and from what.
    pub noise: f64,
    pub noise_rotation: f64,
    pub noise_from: String,
    pub unexplained: bool,
    /// `None` without findings, and where something happened in the first session alone.
    pub shrink: Option<Shrink>,
    pub seconds: f64,
    /// Over the gap that the diagnosis says its model leaves on these rows: held out, by the model that
    /// predicts, and by a diagnosis of the written arm, whose frames are fitted again.
    pub again: Option<[f64; 3]>,
    /// Why there is no diagnosis, or none of the written arm.
    pub error: Option<String>,
}

impl Case {
    /// Gap that is left over that of the noise.
    pub fn over_floor(&self) -> f64 {
        self.after / self.floor
    }
}

/// The frames are unknown.
fn options() -> Options {
    let nuisances = vec![Nuisance::BaseFrame, Nuisance::ToolFrame];
    Options { version: "test".to_owned(), nuisances, ..Options::default() }
}

/// Diagnoses an arm whose frames and noise nobody knows.
pub fn run(drawn: &Drawn) -> Case {
    let start = Instant::now();
    let outcome = diagnose_with(&drawn.arm, &drawn.data, &options(), &|_| {});
    let seconds = start.elapsed().as_secs_f64();
    let floor = drawn.floor(&[]);
    let truths = drawn.planted.iter().map(|planted| Truth {
        what: Named::new(planted.truth.effect.identifier(), &planted.truth.place),
        text: planted.truth.to_string(),
        ratio: planted.ratio,
        evidence: planted.evidence,
        named: false,
        as_twin: false,
        in_set: false,
        covered: Vec::new(),
    });
    let mut case = Case {
        seed: drawn.seed,
        robot: drawn.robot,
        orientation: drawn.orientation,
        loads: drawn.loads,
        rows: drawn.data.rows.len(),
        left_out: 0,
        first: (!drawn.planted.is_empty()).then_some(false),
        truths: truths.collect(),
        found: Vec::new(),
        spurious: 0,
        before: 0.0,
        after: f64::INFINITY,
        floor: floor.position_rms,
        after_rotation: 0.0,
        floor_rotation: floor.rotation_rms,
        noise: 0.0,
        noise_rotation: 0.0,
        noise_from: String::new(),
        unexplained: false,
        shrink: None,
        again: None,
        seconds,
        error: None,
    };
    match outcome {
        Ok(diagnosed) => case.hold(drawn, &diagnosed),
        Err(error) => case.error = Some(error.to_string()),
    }
    case
}

impl Found {
    /// Whether it does what a truth does, whatever is measured: a counterbalance turns a joint that gives
    /// in proportion to its torque as the first order of the joint's transmission does.
    fn is_twin_of(&self, truth: &Named) -> bool {
        let is_first = |(name, ..): &(String, f64, [f64; 2])| name.ends_with(" 1");
        truth.effect == "counterbalance"
            && self.what == Named::new("transmission_error", &truth.place)
            && self.parameters.iter().all(is_first)
    }
}

impl Case {
    /// Whether a finding is a truth, or the twin of one.
    pub fn is_true(&self, found: &Found) -> bool {
        self.truths.iter().any(|t| t.what == found.what || found.is_twin_of(&t.what))
    }

    fn hold(&mut self, drawn: &Drawn, diagnosed: &Diagnosed) {
        let found = &diagnosed.diagnosis;
        self.found = found.findings.iter().map(as_found).collect();
        for (truth, planted) in self.truths.iter_mut().zip(&drawn.planted) {
            let own = self.found.iter().find(|f| f.what == truth.what);
            truth.as_twin = self.found.iter().any(|f| f.is_twin_of(&truth.what));
            truth.named = own.is_some() || truth.as_twin;
            let in_set = |f: &Found| f.inseparable.contains(&truth.what);
            truth.in_set = truth.named || self.found.iter().any(in_set);
            truth.covered = own.map_or_else(Vec::new, |own| covered(&planted.truth, own));
        }
        let physical = self.found.iter().filter(|f| f.physical);
        let true_ones: Vec<bool> = physical.map(|f| self.is_true(f)).collect();
        self.first = self.first.map(|_| true_ones.first() == Some(&true));
        self.spurious = true_ones.iter().filter(|is_true| !**is_true).count();
        let left_out: Vec<u64> = found.left_out.iter().map(|row| row.line).collect();
        let floor = drawn.floor(&left_out);
        (self.floor, self.floor_rotation) = (floor.position_rms, floor.rotation_rms);
        self.left_out = left_out.len();
        self.before = found.gap.before.position_rms;
        self.after = found.gap.after.position_rms;
        self.after_rotation = found.gap.after.rotation_rms;
        self.noise = found.gap.noise.position_rms;
        self.noise_rotation = found.gap.noise.rotation_rms;
        self.noise_from = found.gap.noise.from.to_string();
        self.unexplained = found.unexplained.present;
        match again(drawn, diagnosed, &left_out) {
            Ok(again) => self.again = Some(again),
            Err(error) => self.error = Some(format!("the written arm: {error}")),
        }
        let happened = drawn.planted.iter().any(|p| !lasts(p.truth.effect))
            || self.found.iter().any(|f| matches!(f.what.effect.as_str(), "slip" | "drift"));
        let is_promised = !found.findings.is_empty() && !happened;
        self.shrink = is_promised.then(|| realised(drawn, diagnosed)).flatten().map(|realised| {
            let promised = &found.gap.shrink;
            Shrink { predicted: promised.shrink, ci95: promised.shrink_ci95, realised }
        });
    }
}

fn as_found(finding: &Finding) -> Found {
    let parameters = finding.parameters.iter();
    Found {
        what: Named::new(&finding.effect, &finding.place),
        physical: !GEOMETRY.contains(&&*finding.effect),
        p_value: finding.p_value,
        stability: finding.stability,
        inseparable: finding.indistinguishable().map(|a| Named::new(&a.effect, &a.place)).collect(),
        parameters: parameters.map(|p| (p.name.to_string(), p.value, p.ci95)).collect(),
    }
}

/// Of each value of the truth whether the finding's interval covers it; a value that the finding
/// does not have is 0 without doubt. The row of a jump is a number without an interval.
fn covered(truth: &stiffarm_plant::Truth, found: &Found) -> Vec<bool> {
    let values = truth.values.iter().filter(|(name, _)| name != "after");
    let is_covered = |(name, value): &(String, f64)| {
        let own = found.parameters.iter().find(|(own, _, _)| own == name);
        own.is_some_and(|(_, _, [low, high])| (*low..=*high).contains(value))
    };
    values.map(is_covered).collect()
}

/// What the same rows are left with, by other ways than that which the diagnosis announces.
fn again(
    drawn: &Drawn,
    diagnosed: &Diagnosed,
    left_out: &[u64],
) -> Result<[f64; 3], Box<dyn Error>> {
    let gap = &diagnosed.diagnosis.gap;
    let rows = diagnosed.explanation.predict(&drawn.data)?.after.into_iter();
    let kept = rows.zip(&drawn.data.rows).filter(|(_, row)| !left_out.contains(&row.line));
    let predicted = Statistics::of(&kept.map(|(gap, _)| gap).collect::<Vec<_>>());
    let written = corrected(&drawn.file, diagnosed).robot.to_toml();
    let (robot, _) = Robot::from_toml(&written, "corrected.toml")?;
    let arm = stiffarm_gap::robot::arm(&robot)?;
    let effects = Some(Vec::new());
    let known = Known::all(&robot, &arm, &Catalogue::default());
    let known = known.map_err(|errors| format!("{errors:?}"))?;
    let options = Options { known, effects, ..options() };
    let begins = diagnose_with(&arm, &drawn.data, &options, &|_| {})?.diagnosis.gap.before;
    let all = [gap.after.clone(), predicted, begins];
    Ok(all.map(|of| of.position_rms / gap.fitted.position_rms))
}

/// How far it shrinks over all later sessions, where the instrument was not just wrong.
fn realised(drawn: &Drawn, diagnosed: &Diagnosed) -> Option<f64> {
    let (mut before, mut after) = (Vec::new(), Vec::new());
    let size = |gap: &Vector6<f64>| gap.fixed_rows::<3>(0).norm();
    for (fresh, wrong) in &drawn.fresh {
        let prediction = diagnosed.explanation.predict(fresh).ok()?;
        let sizes = |gaps: &[Vector6<f64>]| -> Vec<f64> {
            gaps.iter().zip(wrong).filter(|(_, wrong)| !**wrong).map(|(gap, _)| size(gap)).collect()
        };
        before.extend(sizes(&prediction.before));
        after.extend(sizes(&prediction.after));
    }
    Some(1.0 - rms(&after) / rms(&before))
}
