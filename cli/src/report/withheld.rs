//! The page of the withheld check: what an experiment can find, before anyone runs it.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use askama::Template;
use stiffarm_gap::study::withhold::{Case, Confusion, Facts, Rate, Report};

#[derive(Template)]
#[template(path = "withheld.html")]
struct Page<'a> {
    report: &'a Report,
    facts: String,
    sentence: String,
    rates: Vec<Line>,
    rates_csv: String,
    named: Vec<String>,
    confusions: Vec<Confusions>,
    confusions_csv: String,
    strays: Vec<Stray>,
    cases_csv: String,
    style: &'static str,
    script: &'static str,
}

/// How often something happened.
struct Line {
    what: &'static str,
    hits: usize,
    of: usize,
    percent: String,
    interval: String,
    width: f64,
    good: &'static str,
}

/// What one effect was taken for.
struct Confusions {
    truth: String,
    /// Count, part of the row in per cent, and whether it is the truth itself; in the order of the
    /// columns.
    cells: Vec<(usize, f64, bool)>,
}

/// A case in which what was put in is not what was named first.
struct Stray {
    kind: String,
    truths: String,
    found: String,
    unexplained: String,
}

/// What is said where nothing was found.
const NOTHING: &str = "nothing";

/// The page.
///
/// # Errors
/// [`askama::Error`] if the template cannot be filled.
pub fn html(report: &Report) -> Result<String, askama::Error> {
    let rates = rates(report);
    let named: Vec<String> = report
        .confusion
        .iter()
        .map(|c| c.named.clone().unwrap_or_else(|| NOTHING.to_owned()))
        .collect::<BTreeSet<_>>()
        .into_iter()
        .collect();
    let page = Page {
        facts: format!(
            "{}; effects of {} to {} times the noise; seed {}",
            facts(&report.experiment),
            report.multiple[0],
            report.multiple[1],
            report.seed
        ),
        sentence: sentence(report),
        rates_csv: csv(
            ["what", "hits", "of"],
            rates.iter().map(|l| vec![l.what.to_owned(), l.hits.to_string(), l.of.to_string()]),
        ),
        rates,
        confusions: confusions(report, &named),
        confusions_csv: csv(
            ["truth", "named", "at_its_place", "cases"],
            report.confusion.iter().map(|c| {
                let named = c.named.clone().unwrap_or_else(|| NOTHING.to_owned());
                vec![c.truth.clone(), named, c.at_its_place.to_string(), c.cases.to_string()]
            }),
        ),
        named,
        strays: report.cases.iter().filter(|case| strays(case)).map(stray).collect(),
        cases_csv: csv(
            ["kind", "truths", "found", "unexplained"],
            report.cases.iter().map(|case| {
                let Stray { kind, truths, found, unexplained } = stray(case);
                vec![kind, truths, found, unexplained]
            }),
        ),
        style: include_str!("style.css"),
        script: include_str!("script/theme.js"),
        report,
    };
    page.render()
}

fn facts(facts: &Facts) -> String {
    match facts {
        Facts::Campaign { design, measurements, poses, noise_position, noise_rotation } => format!(
            "{design}: {measurements} measurements at {poses} poses, noise {:.1} µm and {:.3} mrad",
            1e6 * noise_position,
            1e3 * noise_rotation
        ),
        Facts::Log { duration, runs, rate, noise_torque, noise_reading } => format!(
            "joint logs: {runs} runs, {duration:.0} s at {rate} Hz; noise {:.1} % of the torques' \
             spread, {noise_reading:e} of a reading",
            100.0 * noise_torque
        ),
    }
}

fn percent(rate: Rate) -> String {
    rate.rate.map_or_else(|| "–".to_owned(), |r| format!("{:.0} %", 100.0 * r))
}

fn sentence(report: &Report) -> String {
    let single = &report.single;
    if single.first_named.of == 0 {
        return format!(
            "This experiment raised {} false alarms in {} cases without an effect.",
            report.false_alarms.hits, report.false_alarms.of
        );
    }
    let size = single.mean_set_size.unwrap_or(1.0);
    format!(
        "An effect of {} to {} times the noise is named first, at its place, in {} of cases; what \
         this experiment cannot tell from it comes to {size:.1} explanations on average, and {} of \
         {} cases without an effect raise a false alarm.",
        report.multiple[0],
        report.multiple[1],
        percent(single.first_named),
        report.false_alarms.hits,
        report.false_alarms.of
    )
}

fn rates(report: &Report) -> Vec<Line> {
    let line = |what, good, rate: Rate| Line {
        what,
        hits: rate.hits,
        of: rate.of,
        percent: percent(rate),
        interval: rate.ci95.map_or_else(String::new, |[low, high]| {
            format!("{:.0} to {:.0} %", 100.0 * low, 100.0 * high)
        }),
        width: 100.0 * rate.rate.unwrap_or(0.0),
        good,
    };
    let mut lines = vec![
        line("One effect: it and its place named first", "high", report.single.first_named),
        line("One effect: among what cannot be told apart", "high", report.single.in_set),
        line("One effect: more than one finding", "low", report.single.more_than_one),
        line("Two effects: both among the findings' sets", "high", report.pairs.both_in_sets),
        line("Unknown effect: something unexplained", "high", report.removed.flagged),
        line(
            "Unknown effect that no other closes: something unexplained",
            "high",
            report.removed.flagged_of_open,
        ),
        line("Unknown effect: at the right joint", "high", report.removed.right_joint),
        line("Gap closed to 1.2 times the noise", "high", report.after.within_1_2_of_noise),
        line("No effect: a finding (false alarm)", "low", report.false_alarms),
        line("No effect: something unexplained", "low", report.false_unexplained),
    ];
    // A log tells neither.
    lines.retain(|line| line.of > 0 || matches!(report.experiment, Facts::Campaign { .. }));
    if let Some(shrink) = &report.shrink {
        lines.push(line("Shrink on new poses as predicted (95 %)", "high", shrink.inside));
    }
    lines
}

fn confusions(report: &Report, named: &[String]) -> Vec<Confusions> {
    let truths: BTreeSet<&String> = report.confusion.iter().map(|c| &c.truth).collect();
    let row = |truth: &String| {
        let of_truth = || report.confusion.iter().filter(|c| c.truth == *truth);
        let all: usize = of_truth().map(|c| c.cases).sum();
        let cell = |name: &String| {
            let is = |c: &&Confusion| c.named.as_deref().unwrap_or(NOTHING) == name;
            let count: usize = of_truth().filter(is).map(|c| c.cases).sum();
            (count, 100.0 * count as f64 / all.max(1) as f64, name == truth)
        };
        Confusions { truth: truth.clone(), cells: named.iter().map(cell).collect() }
    };
    truths.into_iter().map(row).collect()
}

/// Whether a case did not end as it should.
fn strays(case: &Case) -> bool {
    let Some(verdict) = &case.verdict else { return true };
    let first = verdict.sets.iter().filter_map(|set| set.first());
    let same = case.labels.iter().all(|label| first.clone().any(|found| found == label));
    !same || verdict.sets.len() != case.labels.len()
}

fn stray(case: &Case) -> Stray {
    let list = |names: Vec<String>| {
        if names.is_empty() { NOTHING.to_owned() } else { names.join("; ") }
    };
    let verdict = case.verdict.as_ref();
    let found = case.sets().iter().filter_map(|set| set.first());
    let found: Vec<String> = found.map(|n| format!("{} at {}", n.effect, n.place)).collect();
    let unexplained = match verdict.filter(|v| v.unexplained) {
        Some(v) if v.unexplained_places.is_empty() => "somewhere".to_owned(),
        Some(v) => v.unexplained_places.join(", "),
        None => "–".to_owned(),
    };
    Stray {
        kind: format!("{:?}", case.kind).to_lowercase(),
        truths: list(case.truths.clone()),
        found: case.error.clone().unwrap_or_else(|| list(found)),
        unexplained,
    }
}

/// A table as a `data:` address.
fn csv<const N: usize>(head: [&str; N], rows: impl Iterator<Item = Vec<String>>) -> String {
    let quoted = |cell: &str| format!("\"{}\"", cell.replace('"', "\"\""));
    let mut text = head.join(",");
    text.push('\n');
    for row in rows {
        text.push_str(&row.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(","));
        text.push('\n');
    }
    let mut address = "data:text/csv;charset=utf-8,".to_owned();
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"-_.~".contains(&byte) {
            address.push(char::from(byte));
        } else {
            // Writing to a string cannot fail.
            let _ = write!(address, "%{byte:02X}");
        }
    }
    address
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_an_address() {
        let rows = [vec!["a \"b\"".to_owned(), "µ".to_owned()]];
        let address = csv(["x", "y"], rows.into_iter());
        assert_eq!(
            address,
            "data:text/csv;charset=utf-8,x%2Cy%0A%22a%20%22%22b%22%22%22%2C%22%C2%B5%22%0A"
        );
    }
}
