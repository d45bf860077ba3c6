//! Pages of diagnoses of plants.

use serde_json::Value;
use stiffarm_gap::diagnose::{Diagnosed, Nuisance};
use stiffarm_gap::measurement::Kind;
use stiffarm_gap::report::Report;
use stiffarm_gap::{Measurements, Options, diagnose_with};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape};
use stiffarm_plant::{Frames, Noise, Plant, Truth};
use stiffarm_table::robot::Robot;

use super::{Campaign, Fitted};
use crate::beside::{Accepted, Compared, Hashes, Provenance};

const ROBOT: &str = include_str!("../../../cli/tests/cli/diagnose/shoulder.toml");

/// Everything that a document borrows.
struct Bench {
    arm: Arm,
    data: Measurements,
    options: Options,
    diagnosed: Diagnosed,
    accepted: Accepted,
    compared: Compared,
    made: Provenance,
}

impl Bench {
    fn new(kind: Kind, poses: usize, truths: &[&str], effects: &[&str], free: bool) -> Bench {
        let (robot, _) =
            Robot::from_toml(&ROBOT.replacen("shoulder and elbow", "shoulder <& elbow>", 1), "arm")
                .expect("a robot file");
        let arm = stiffarm_gap::robot::arm(&robot).expect("with numbers");
        let truth = |t: &&str| Truth::parse(t, &arm).expect("an effect of this arm");
        let truths: Vec<Truth> = truths.iter().map(truth).collect();
        let mut plant = Plant::new(&arm, &truths).expect("a plant");
        let mut options = Options { version: "9.9.9".to_owned(), seed: 7, ..Options::default() };
        options.effects = Some(effects.iter().map(|e| (*e).to_owned()).collect());
        if free {
            plant = plant.with_frames(Frames::unknown(1));
            options.nuisances = vec![Nuisance::BaseFrame, Nuisance::ToolFrame];
        }
        let design =
            Design { shape: Shape::Payload, poses, repeats: 1, payload: 15.0, kind, seed: 1 };
        let noise = Noise { position: 2e-5, rotation: 4e-5 };
        let data = plant.measure(&design.rows(&arm), noise, 1).expect("it stands");
        let diagnosed = diagnose_with(&arm, &data, &options, &|_| {}).expect("a diagnosis");
        let hashes = Hashes { data_sha256: "0a".repeat(32), robot_sha256: "1b".repeat(32) };
        let accepted = Accepted {
            tolerance: 1e-3,
            position_p95: 2e-3,
            accepted: false,
            of: "a <b> & c".to_owned(),
        };
        let reached = (&diagnosed.diagnosis.gap.shrink).into();
        let compared = Compared {
            file: "last.json".to_owned(),
            same_data: None,
            same_robot: None,
            last: reached,
            now: reached,
            added: vec![("a_>_b".into(), "joint 1".to_owned())],
            removed: Vec::new(),
            numbers: Vec::new(),
        };
        let command = "stiffarm diagnose 'a <b>'".to_owned();
        let made = Provenance { command, date: Some(("made", "2026-11-22".to_owned())), hashes };
        Bench { arm, data, options, diagnosed, accepted, compared, made }
    }

    fn campaign<'a>(&'a self, fitted: Option<Fitted<'a>>) -> Campaign<'a> {
        Campaign {
            found: &self.diagnosed.diagnosis,
            data: &self.data,
            arm: &self.arm,
            options: &self.options,
            check: None,
            accepted: Some(&self.accepted),
            compared: Some(&self.compared),
            made: &self.made,
            fitted,
        }
    }

    fn html(&self) -> String {
        let explanation = &self.diagnosed.explanation;
        let gaps = explanation.predict(&self.data).expect("the same data");
        let fitted = Fitted { explanation, gaps: &gaps };
        let campaign = self.campaign(Some(fitted));
        let embedded = campaign.embedded(&fitted, &self.diagnosed.diagnosis).expect("numbers");
        campaign.document().html(&embedded).expect("a page")
    }
}

const POSE: Kind = Kind::Pose { orientation: true };
const SPRING: &str = "joint_compliance@joint 2=6e-6 rad/(N·m)";
const WAVE: &str = "transmission_error@joint 3: cos 2 = 0.4 mrad";

/// The embedded numbers.
fn embedded(html: &str) -> Value {
    let (_, rest) = html.split_once(r#"<script id="data" type="application/json">"#).expect("data");
    let (json, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(json).expect("JSON")
}

/// The numbers of a column.
fn column(table: &Value, name: &str) -> Vec<f64> {
    let heads = table["columns"].as_array().expect("columns");
    let at = heads.iter().position(|h| h == name).unwrap_or_else(|| panic!("{name} in {heads:?}"));
    let rows = table["rows"].as_array().expect("rows");
    rows.iter().map(|row| row[at].as_f64().expect("a number")).collect()
}

/// Elements that have no end.
const VOID: [&str; 3] = ["meta", "link", "input"];

/// Every element ends, in the order in which they began; scripts and styles are text.
fn assert_balanced(html: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = html.strip_prefix("<!doctype html>").expect("a document type");
    while let Some((_, after)) = rest.split_once('<') {
        let (tag, text) = after.split_once('>').expect("a tag ends");
        let name = tag.trim_start_matches('/').split_whitespace().next().expect("a name");
        let name = name.trim_end_matches('/');
        assert!(name.bytes().all(|b| b.is_ascii_alphanumeric()), "<{tag}>");
        rest = text;
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "</{name}> after {open:?}");
        } else if !tag.ends_with('/') && !VOID.contains(&name) {
            open.push(name);
        }
        if !tag.starts_with('/') && ["script", "style"].contains(&name) {
            let end = format!("</{name}>");
            rest = &text[text.find(&end).expect("an end")..];
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

/// Well formed, and nothing in it is to be fetched.
fn assert_stands_alone(html: &str) {
    assert_balanced(html);
    assert!(!html.contains("http"), "the page refers to the network");
    for word in ["@import", "url(", "src=", "//cdn"] {
        assert!(!html.contains(word), "{word}");
    }
    for link in html.split("href=\"").skip(1) {
        assert!(link.starts_with('#') || link.starts_with("data:,\""), "{}", &link[..40]);
    }
}

#[test]
fn a_page_opens_with_its_sentence_and_holds_every_row() {
    let effects = ["joint_compliance", "transmission_error", "backlash", "joint_offset"];
    let bench = Bench::new(POSE, 60, &[SPRING, WAVE], &effects, true);
    let html = bench.html();
    assert_stands_alone(&html);
    let (_, rest) = html.split_once(r#"<p id="sentence" class="sentence">"#).expect("a sentence");
    assert!(rest.starts_with("Joint 2 twists "), "{}", &rest[..200]);
    for text in
        ["9.9.9", "shoulder &#60;&#38; elbow&#62;", "a &#60;b&#62; &#38; c", "new: a &#62; b"]
    {
        assert!(html.contains(text), "{text}");
    }
    // The screen is another print of the same document.
    let screen = bench.campaign(None).document().text(usize::MAX);
    for text in ["Not accepted: ", "new: a > b at joint 1", "joint compliance at joint 2"] {
        assert!(screen.contains(text), "{screen}");
    }
    let data = embedded(&html);
    let rows = &data["rows"]["table"];
    assert_eq!(rows["rows"].as_array().map(Vec::len), Some(bench.data.rows.len()));
    // The gap before has no finding in it, but the frames, which were fitted to these rows: on held-out
    // ones, which the diagnosis tells, it is larger by √((1 + p/n)/(1 − p/n)), 12 numbers of 6 · 60.
    let before = column(rows, "gap_position_before[m]");
    let whole = bench.diagnosed.diagnosis.gap.before.position_rms;
    let ratio = stiffarm_gap::gap::rms(&before) / whole;
    assert!((0.9..1.0).contains(&ratio), "{ratio}");
    let after = column(rows, "gap_position_after[m]");
    assert!(stiffarm_gap::gap::rms(&after) < 0.1 * whole);
    let points = data["scene"]["points"].as_array().expect("points");
    assert_eq!(points.len(), before.len());
}

/// Two numbers of one wave at a joint, and a spring: what is told of their correlations is one matrix, and
/// what is left lies along the line.
#[test]
fn what_is_left_and_how_numbers_are_told_is_shown() {
    let effects = ["joint_compliance", "transmission_error"];
    let bench = Bench::new(POSE, 60, &[SPRING, WAVE], &effects, true);
    let html = bench.html();
    for text in ["Are the residuals noise?", "How well the parameters are determined"] {
        assert!(html.contains(text), "{text}");
    }
    let data = embedded(&html);
    let matrix = &data["whole"]["observability"]["matrix"];
    let names = matrix["of"].as_array().expect("names");
    assert!(names.contains(&"compliance of joint_compliance at joint 2".into()), "{names:?}");
    let at = |r: usize, c: usize| matrix["rows"][r][c].as_f64().expect("a number");
    for r in 0..names.len() {
        assert!((at(r, r) - 1.0).abs() < 1e-12);
        assert!((0..names.len()).all(|c| at(r, c) == at(c, r) && at(r, c).abs() <= 1.0));
    }
    assert_eq!(html.matches("style=\"--share:60%\"").count(), names.len());
    // What is written is what is read.
    let report = Report::Campaign(Box::new(bench.diagnosed.diagnosis));
    let text = serde_json::to_string(&report).expect("JSON");
    assert_eq!(serde_json::from_str::<Report>(&text).expect("the same"), report);
    let quantiles = &data["whole"]["residual"]["normality"]["quantiles"];
    let far = quantiles.as_array().expect("pairs").iter().map(|pair| {
        (pair[0].as_f64().expect("a number") - pair[1].as_f64().expect("a number")).abs()
    });
    // Of 1080 normal numbers the largest scatters by 0.35 of a deviation; two of these to either side.
    assert!(far.fold(0.0, f64::max) < 1.0, "{quantiles}");
}

/// The slope of the points over the torque is the planted spring, by a straight line through them
/// alone: the sign, the projection and the torque are right.
#[test]
fn partial_residuals_lie_along_the_planted_spring() {
    let displaced = Kind::Displacement { components: [true, true, true, false, false, false] };
    for kind in [POSE, displaced] {
        let bench = Bench::new(kind, 60, &[SPRING], &["joint_compliance"], false);
        let data = embedded(&bench.html());
        let shape = &data["shapes"][0];
        assert_eq!(shape["title"], "joint compliance at joint 2");
        let x = column(&shape["table"], "torque[Nm]");
        let y = column(&shape["table"], "partial_residual[rad]");
        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
        let (mx, my) = (mean(&x), mean(&y));
        let over: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
        let slope = over / x.iter().map(|x| (x - mx).powi(2)).sum::<f64>();
        // Noise of 20 µm at levers of some decimetres, against 1 mrad and more, over 180 points.
        assert!((slope / 6e-6 - 1.0).abs() < 0.02, "{kind:?}: {slope}");
    }
}

#[test]
fn a_thousand_poses_make_less_than_three_megabytes() {
    let bench = Bench::new(POSE, 1000, &[SPRING], &["joint_compliance"], false);
    let html = bench.html();
    assert_eq!((bench.data.poses, bench.data.rows.len()), (1000, 3000));
    assert!(html.len() <= 3_000_000, "{} bytes", html.len());
    assert_stands_alone(&html);
}

#[test]
fn nothing_found_and_rotations_alone_have_pages_too() {
    let turned = Kind::Displacement { components: [false, false, false, true, true, true] };
    for (kind, truths) in [(POSE, &[][..]), (turned, &[SPRING][..])] {
        let bench = Bench::new(kind, 12, truths, &["joint_compliance"], false);
        assert_eq!(bench.diagnosed.diagnosis.findings.is_empty(), truths.is_empty());
        let html = bench.html();
        assert_stands_alone(&html);
        assert_eq!(html.contains("<h2>Findings</h2>"), !truths.is_empty());
        let vectors = &embedded(&html)["rows"]["vectors"][0];
        assert!(vectors.as_array().expect("three").iter().all(serde_json::Value::is_u64));
    }
}
