//! The page's text, filled into the template.

use askama::Template;
use stiffarm_gap::diagnose::{Finding, NuisanceReport};

use super::experiment::drawn_of;
use super::known::{Known, known, left};
use super::performance::{Figures, figures};
use super::steps::steps;
use super::waterfall::{Waterfall, waterfall};
use super::worst::worst;
use super::{Report, embedded, method};
use crate::screen::{chance, less, loads};

/// Places or rivals that are named one by one.
const MOST: usize = 8;

/// A share below this is not shown.
const LEAST: f64 = 0.005;

/// The scripts, one matter each, in the order in which they stand in the page.
pub(super) const SCRIPT: &str = concat!(
    include_str!("script/data.js"),
    include_str!("script/theme.js"),
    include_str!("script/plot.js"),
    include_str!("script/residuals.js"),
    include_str!("script/quantiles.js"),
    include_str!("script/arm.js"),
);

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    robot: &'a str,
    file: &'a str,
    rows: usize,
    poses: usize,
    version: &'a str,
    sentence: &'a str,
    waterfall: Waterfall,
    findings: Vec<Found<'a>>,
    parts: Vec<(&'a str, String)>,
    places: Vec<Place<'a>>,
    unexplained: Option<Left<'a>>,
    acceptance: Option<&'a (bool, String)>,
    changes: &'a [String],
    since: &'a str,
    performance: Figures,
    worst: Vec<Worst>,
    left: Vec<String>,
    known: Option<Known>,
    date: String,
    hidden: &'a [String],
    covers: Vec<String>,
    frames: Vec<Frame>,
    loads: &'a str,
    rivals: Vec<Compared<'a>>,
    method: &'static str,
    facts: Vec<(&'static str, String)>,
    style: &'static str,
    script: &'static str,
    data: String,
    /// Which rows are drawn, where these are not all.
    drawn: String,
}

/// A finding.
struct Found<'a> {
    name: String,
    said: String,
    numbers: &'a [String],
    /// From what to what, and by how much.
    shrink: (String, String),
    /// The chance of it without cause, and how often it is found again.
    evidence: (String, String),
    /// What this data does not tell from it.
    same: Vec<String>,
    more: usize,
    /// The best of what it does.
    next: Option<String>,
    advice: Option<&'a str>,
}

/// A place with its share.
struct Place<'a> {
    name: &'a str,
    /// In percent: as text, and for the bar.
    share: String,
    width: String,
}

/// What no effect explains.
struct Left<'a> {
    size: String,
    places: Vec<Place<'a>>,
    depends_on: &'a [String],
}

/// A frame that was fitted along.
struct Frame {
    name: String,
    translation: String,
    rotation: String,
}

/// A pose that is far off.
struct Worst {
    name: String,
    rows: usize,
    before: String,
    after: String,
}

/// Another model's predictions.
struct Compared<'a> {
    name: &'a str,
    theirs: String,
    ours: String,
    verdict: &'static str,
}

/// The page.
pub fn html(report: &Report<'_>) -> Result<String, askama::Error> {
    let found = report.found;
    let unexplained = &found.unexplained;
    let size = match unexplained.position_rms {
        rms if rms > 0.0 => format!("{} beyond the noise", report.main_unit().with_unit(rms)),
        _ => "A pattern within the noise".to_owned(),
    };
    let page = Page {
        robot: &found.robot,
        file: &report.data.file,
        rows: found.measurements,
        poses: report.data.poses,
        version: &found.stiffarm,
        sentence: &report.words.sentence,
        waterfall: waterfall(steps(report), report.main_unit()),
        findings: findings(report),
        parts: found.parts.iter().map(|p| (&*p.part, percent(p.share))).collect(),
        places: places(&found.places),
        unexplained: unexplained.present.then(|| Left {
            size,
            places: places(&unexplained.places),
            depends_on: &unexplained.depends_on,
        }),
        acceptance: report.words.acceptance.as_ref(),
        changes: &report.words.changes,
        since: &report.words.since,
        performance: figures(report),
        worst: worst_poses(report),
        left: left(report),
        known: known(report),
        date: date(report),
        hidden: &report.words.hidden,
        covers: covers(report),
        frames: found.nuisances.iter().map(frame).collect(),
        loads: loads(found),
        rivals: rivals(report),
        method: method::METHOD,
        facts: method::facts(report),
        style: include_str!("style.css"),
        script: SCRIPT,
        drawn: drawn_of(report.data.rows.len()),
        data: embedded::json(report).map_err(askama::Error::custom)?,
    };
    page.render()
}

fn findings<'a>(report: &Report<'a>) -> Vec<Found<'a>> {
    let told = report.found.findings.iter().zip(&report.words.findings);
    let each = told.map(|(finding, told)| {
        let leaves = |a: &stiffarm_gap::diagnose::Alternative| {
            let left = report.main_unit().with_unit(a.left.size());
            format!("{} at {}, which leaves {left}", a.effect.replace('_', " "), a.place)
        };
        let (same, other): (Vec<_>, Vec<_>) =
            finding.alternatives.iter().partition(|a| !a.separable());
        Found {
            name: format!("{} at {}", finding.effect.replace('_', " "), finding.place),
            said: capital(&told.said),
            numbers: &told.numbers,
            shrink: shrink(report, finding),
            evidence: evidence(finding),
            more: same.len().saturating_sub(MOST),
            same: same.into_iter().take(MOST).map(leaves).collect(),
            next: other.first().map(|a| leaves(a)),
            advice: finding.advice(),
        }
    });
    each.collect()
}

fn shrink(report: &Report<'_>, finding: &Finding) -> (String, String) {
    let (held, unit) = (&finding.held_out, report.main_unit());
    let sizes = format!("{} → {}", unit.number(held.before()), unit.with_unit(held.after()));
    (sizes, held.shrink().map_or_else(String::new, less))
}

fn evidence(finding: &Finding) -> (String, String) {
    let again = percent(finding.stability.unwrap_or_default());
    (chance(finding.p_value), format!("found again on {again} of random halves"))
}

fn places(shares: &[stiffarm_gap::diagnose::Share]) -> Vec<Place<'_>> {
    let there = shares.iter().filter(|s| s.share >= LEAST);
    let place = |s: &'_ stiffarm_gap::diagnose::Share| (100.0 * s.share).clamp(0.0, 100.0);
    there
        .map(|s| Place {
            name: &s.place,
            share: percent(s.share),
            width: format!("{:.1}", place(s)),
        })
        .collect()
}

/// Where the data has been.
fn covers(report: &Report<'_>) -> Vec<String> {
    let covers = &report.found.covers;
    let joints = covers.joints.iter().zip(&report.arm.joints).enumerate();
    let mut lines: Vec<String> = joints
        .map(|(j, ([low, high], joint))| {
            let (unit, si) = match joint.motion {
                stiffarm_kernels::Motion::Revolute => ("°", 1_f64.to_radians()),
                stiffarm_kernels::Motion::Prismatic => (" mm", 1e-3),
            };
            let [low, high] = [low, high].map(|q| format!("{:.0}", q / si).replacen('-', "−", 1));
            format!("joint {}: {low}{unit} to {high}{unit}", j + 1)
        })
        .collect();
    lines.push(format!("force: up to {:.0} N", covers.force));
    lines.push(format!("moment: up to {:.0} N·m", covers.moment));
    lines
}

fn frame(found: &NuisanceReport) -> Frame {
    let list = |v: [f64; 3]| v.map(|x| format!("{:.3}", 1e3 * x).replacen('-', "−", 1)).join(", ");
    Frame {
        name: match &found.session {
            Some(session) => format!("{} in session {session}", found.name),
            None => found.name.clone(),
        },
        translation: list(found.translation),
        rotation: list(found.rotation),
    }
}

fn worst_poses(report: &Report<'_>) -> Vec<Worst> {
    let unit = report.main_unit();
    let pose = |pose: super::worst::Pose| Worst {
        name: pose.name,
        rows: pose.rows,
        before: unit.with_unit(pose.before),
        after: unit.with_unit(pose.after),
    };
    worst(report).into_iter().map(pose).collect()
}

fn date(report: &Report<'_>) -> String {
    let date = report.made.date.as_ref();
    date.map_or_else(String::new, |(what, day)| format!("; {what} {day}"))
}

fn rivals<'a>(report: &Report<'a>) -> Vec<Compared<'a>> {
    let unit = report.main_unit();
    let rivals = report.found.rivals.as_deref().unwrap_or_default().iter();
    let compared = rivals.map(|r| Compared {
        name: &r.name,
        theirs: unit.with_unit(r.rms),
        ours: unit.with_unit(r.held_out_rms),
        verdict: match (r.significant, r.mean_square_gain > 0.0) {
            (true, true) => "ours is significantly better",
            (true, false) => "ours is significantly worse",
            (false, true) => "ours is not significantly better",
            (false, false) => "ours is not better",
        },
    });
    compared.collect()
}

pub(super) fn percent(part: f64) -> String {
    format!("{:.0} %", 100.0 * part).replacen('-', "−", 1)
}

/// With a capital letter at its beginning.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// To a tenth of a pixel.
pub(super) fn px(x: f64) -> String {
    format!("{x:.1}")
}
