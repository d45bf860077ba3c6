//! The document of the withheld check: what an experiment can find, before anyone runs it.

use std::collections::BTreeSet;

use stiffarm_document::report::Method;
use stiffarm_document::text::{counted, short};
use stiffarm_document::words::{percent, words};
use stiffarm_document::{Block, Cell, Document, Row, Table};
use stiffarm_study::withhold::{Case, Confusion, Facts, Rate, Report};

/// How every check is made.
const METHOD: &str = "\
Effects are put into a simulated arm: one at a time, two together, none, and one that is removed from the diagnosis' \
dictionary; the diagnosis is not told which. The simulated arm has its own transforms and finds its equilibrium by virtual \
work on the deformed arm; it shares with the diagnosis only the robot file, the rows to be measured and the definition of \
the effects. Each effect is scaled so that its error is the stated multiple of the noise.";

/// What stands for no finding.
const NOTHING: &str = "nothing";

/// Confusions that a screen has.
const MOST: usize = 6;

pub fn document(report: &Report, position_log: bool) -> Document {
    let mut blocks = vec![Block::Sentence(sentence(report)), rates(report)];
    blocks.extend(confusions(report));
    blocks.extend(Block::note("Unobservable", names(&report.cannot_plant)));
    if report.failed > 0 {
        let failed = counted(report.failed, "diagnosis without result");
        let error = report.cases.iter().find_map(|case| case.error.as_deref());
        let text = format!("{failed}, the first: {}", error.unwrap_or_default());
        blocks.extend(Block::note("Failed", text));
    }
    let method = Method { text: METHOD, facts: Vec::new(), lists: &[] };
    blocks.push(Block::Page(vec![matrix(report), strays(report), method.section()]));
    Document {
        robot: report.robot.clone(),
        about: "what this experiment can find",
        facts: format!(
            "{}; {}, effects of {} to {} times the noise, seed {}",
            facts(&report.experiment, position_log),
            counted(report.cases.len(), "case"),
            short(report.multiple[0]),
            short(report.multiple[1]),
            report.seed
        ),
        blocks,
    }
}

fn names(effects: &[String]) -> String {
    match effects {
        [] => String::new(),
        _ => {
            let names: Vec<String> = effects.iter().map(|effect| words(effect)).collect();
            format!("{}: they move nothing that is measured", names.join(", "))
        }
    }
}

/// What is measured, and how well.
fn facts(facts: &Facts, position_log: bool) -> String {
    match facts {
        Facts::Campaign { design, measurements, poses, noise_position, noise_rotation } => format!(
            "{design}: {} at {}, noise {} µm and {} mrad",
            counted(*measurements, "measurement"),
            counted(*poses, "pose"),
            short(1e6 * noise_position),
            short(1e3 * noise_rotation),
        ),
        Facts::Log { duration, runs, rate, noise_torque, noise_reading } => {
            let noise = match position_log {
                true => format!("{} of a joint value", short(*noise_reading)),
                false => format!("{} % of the torques' spread", short(100.0 * noise_torque)),
            };
            format!(
                "{} of {} s at {} Hz, noise {noise}",
                counted(*runs, "run"),
                short(duration / *runs as f64),
                short(*rate),
            )
        }
    }
}

fn sentence(report: &Report) -> String {
    let (single, alarms) = (&report.single, report.false_alarms);
    let raised = format!("{} of {} without an effect", alarms.hits, counted(alarms.of, "case"));
    let Some(named) = single.first_named.rate else {
        return format!("A false alarm was raised in {raised}.");
    };
    let size = single.mean_set_size.unwrap_or(1.0);
    format!(
        "An effect of {} to {} times the noise is found first, and at its place, in {} of cases; the set of \
         indistinguishable explanations has {size:.1} on average. A false alarm is raised in {raised}.",
        short(report.multiple[0]),
        short(report.multiple[1]),
        percent(named),
    )
}

fn rates(report: &Report) -> Block {
    let none = String::new;
    let size = report.single.mean_set_size;
    let size = size.map_or_else(none, |s| format!("mean set size {}", short(s)));
    let median = report.after.median.map_or_else(none, |m| format!("median {}", short(m)));
    let (single, removed) = (&report.single, &report.removed);
    let mut all = vec![
        ("no effect: something is found (false alarm)", report.false_alarms, none()),
        ("no effect: something is unexplained", report.false_unexplained, none()),
        ("one effect: found first, at its place", single.first_named, none()),
        ("one effect: found, or indistinguishable from what is", single.in_set, size),
    ];
    if matches!(report.experiment, Facts::Log { .. }) {
        all.push(("one effect: more than one finding", single.more_than_one, none()));
    }
    all.extend([
        ("two effects: both found", report.pairs.both_in_sets, none()),
        ("unknown effect: something is unexplained", removed.flagged, none()),
        ("  where known effects leave an error", removed.flagged_of_open, none()),
        ("  at the right joint", removed.right_joint, none()),
        ("error reduced to 1.2 times the noise", report.after.within_1_2_of_noise, median),
    ]);
    let shrink = report.shrink.as_ref();
    all.extend(shrink.map(|shrink| ("reduced on new poses as predicted", shrink.inside, none())));
    let row = |(what, rate, remark): (&str, Rate, String)| -> Option<Row> {
        let (value, [low, high]) = rate.rate.zip(rate.ci95)?;
        Some(vec![
            what.into(),
            Cell::number(percent(value)),
            format!("[{:.0} to {:.0}]", 100.0 * low, 100.0 * high).into(),
            format!("{} of {}", rate.hits, rate.of).into(),
            Cell::Bar(value),
            remark.into(),
        ])
    };
    let table = Table {
        heads: ["", "rate", "95 %", "cases", "", ""].map(str::to_owned).to_vec(),
        rows: all.into_iter().filter_map(row).collect(),
        caption: String::new(),
    };
    Block::section("How often", vec![Block::Table(table), Block::Page(vec![Block::Csv("cases")])])
}

/// What was found in place of a single effect, the largest counts first; `None` where nothing was.
fn confusions(report: &Report) -> Option<Block> {
    let wrong = |c: &&Confusion| c.named.as_ref() != Some(&c.truth) || !c.at_its_place;
    let line = |c: &Confusion| {
        let named = match &c.named {
            None => NOTHING.to_owned(),
            Some(named) if *named == c.truth => format!("{named}, at another place"),
            Some(named) => named.clone(),
        };
        format!("{} → {}: {}", words(&c.truth), words(&named), counted(c.cases, "case"))
    };
    let lines: Vec<String> = report.confusion.iter().filter(wrong).map(line).collect();
    (!lines.is_empty()).then_some(Block::Note { name: "Confused", lines, most: MOST })
}

/// What each effect was taken for.
fn matrix(report: &Report) -> Block {
    let name = |c: &Confusion| c.named.clone().unwrap_or_else(|| NOTHING.to_owned());
    let named: BTreeSet<String> = report.confusion.iter().map(name).collect();
    let truths: BTreeSet<&String> = report.confusion.iter().map(|c| &c.truth).collect();
    if truths.is_empty() {
        let none = Block::Paragraph("No case had a single effect.".to_owned());
        return Block::section("What each effect was taken for", vec![none]);
    }
    let row = |truth: &String| -> Row {
        let of_truth = || report.confusion.iter().filter(|c| c.truth == *truth);
        let all: usize = of_truth().map(|c| c.cases).sum();
        let cell = |column: &String| {
            let count: usize = of_truth().filter(|c| name(c) == *column).map(|c| c.cases).sum();
            let text = if count == 0 { "·".to_owned() } else { count.to_string() };
            Cell::Shade(count as f64 / all.max(1) as f64, text)
        };
        std::iter::once(words(truth).into()).chain(named.iter().map(cell)).collect()
    };
    let heads = std::iter::once(String::new()).chain(named.iter().map(|name| words(name)));
    let table = Table {
        heads: heads.collect(),
        rows: truths.into_iter().map(row).collect(),
        caption: "Rows: the single effect that was put in. Columns: what was found first."
            .to_owned(),
    };
    let blocks = vec![Block::Table(table), Block::Csv("confusion")];
    Block::section("What each effect was taken for", blocks)
}

/// The cases in which what was put in is not what was found first.
fn strays(report: &Report) -> Block {
    let list = |names: Vec<String>| {
        if names.is_empty() { NOTHING.to_owned() } else { names.join("; ") }
    };
    let row = |case: &Case| -> Row {
        let verdict = case.verdict.as_ref();
        let found = case.sets().iter().filter_map(|set| set.first());
        let found: Vec<String> = found.map(|n| format!("{} at {}", n.effect, n.place)).collect();
        let unexplained = match verdict.filter(|v| v.unexplained) {
            Some(v) if v.unexplained_places.is_empty() => "somewhere".to_owned(),
            Some(v) => v.unexplained_places.join(", "),
            None => "–".to_owned(),
        };
        vec![
            format!("{:?}", case.kind).to_lowercase().into(),
            list(case.truths.clone()).into(),
            case.error.clone().unwrap_or_else(|| list(found)).into(),
            unexplained.into(),
        ]
    };
    let mut table = Table::new(["case", "put in", "found", "unexplained at"]);
    table.rows = report.cases.iter().filter(|case| is_stray(case)).map(row).collect();
    let block = match table.rows.is_empty() {
        true => Block::Paragraph("There are none.".to_owned()),
        false => Block::Table(table),
    };
    Block::section("Cases in which another effect was found", vec![block])
}

/// Whether a case did not end as it should.
fn is_stray(case: &Case) -> bool {
    let Some(verdict) = &case.verdict else { return true };
    let first = verdict.sets.iter().filter_map(|set| set.first());
    let same = case.labels.iter().all(|label| first.clone().any(|found| found == label));
    !same || verdict.sets.len() != case.labels.len()
}
