//! The diagnosis of a joint log on one screen.

use stiffarm_gap::log::report::JointGap;
use stiffarm_gap::log::{Domain, LogDiagnosis};
use stiffarm_gap::report::{Alternative, Finding, Parameter};

use super::{BAR, MOST, WIDTH, less, percent, words};
use crate::diagnose::LogCheck;
use crate::input::quantity::counted;
use crate::terminal::text::{
    Align, bad, bar, bold, decimals, dim, fixed, good, indented, left_bar, listed, minus, short,
    table, wrapped,
};

/// Findings that are shown with their numbers.
const DETAILED: usize = 12;

/// Findings that the sentence tells.
const TOLD: usize = 3;

/// Width of a finding's bar.
const NARROW: usize = 12;

/// Where the text beside the names of remarks begins.
const MARGIN: usize = 14;

/// The whole screen.
pub fn text(found: &LogDiagnosis, check: Option<&LogCheck>) -> String {
    let sentence = wrapped(&sentence(found), WIDTH, 0);
    let check = check.map_or_else(String::new, |check| {
        format!("\n{}", wrapped(&checked(found, check), WIDTH, 0))
    });
    let parts =
        [head(found), format!("\n{sentence}\n"), gap(found), check, findings(found), notes(found)];
    parts.concat()
}

/// What is left of another log.
pub fn checked(found: &LogDiagnosis, check: &LogCheck) -> String {
    let [before, after] = left(&check.gap).map(|part| format!("{} %", fixed(100.0 * part, 1)));
    let text = format!(
        "Of {} ({}) the same model leaves {after} {}, without the findings {before}; nothing is \
         fitted to it.",
        check.files.join(", "),
        counted(check.samples, "sample"),
        what(found.rows),
    );
    text
}

/// Of what a part is told.
fn what(rows: Domain) -> &'static str {
    match rows {
        Domain::Torque => "of the torques' spread",
        Domain::Position => "of the position errors",
    }
}

fn head(found: &LogDiagnosis) -> String {
    let facts = format!("{}: {}", found.files.join(", "), facts(found));
    format!("{}\n{}\n", bold(&found.robot), dim(wrapped(&facts, WIDTH, 2).trim_end()))
}

/// What the rows are, how many, and how they are judged.
pub fn facts(found: &LogDiagnosis) -> String {
    let evidence = &found.evidence;
    let rows = match (found.rows, found.torque_side) {
        (Domain::Torque, Some(side)) => format!("torques, {}", format!("{side:?}").to_lowercase()),
        (Domain::Torque, None) => "torques".to_owned(),
        (Domain::Position, _) => "positions against commands".to_owned(),
    };
    let held = match &*evidence.held_out_by {
        "run" => format!("each of {} runs held out in turn", evidence.folds),
        _ => format!("held out in {} folds of blocks", evidence.folds),
    };
    format!(
        "{rows}; {} in {}; below {} Hz; about {:.0} independent numbers, blocks of {} s, {held}",
        counted(found.samples, "sample"),
        counted(found.runs, "run"),
        short(found.filter.band),
        evidence.effective,
        short(evidence.block_length),
    )
}

/// Mean of the joints' gaps as parts of their sizes, before and after.
pub fn left(gap: &[JointGap]) -> [f64; 2] {
    let mean = |of: fn(&JointGap) -> f64| {
        gap.iter().map(|g| of(g) / g.size).sum::<f64>() / gap.len() as f64
    };
    [mean(|g| g.before), mean(|g| g.after)]
}

/// What a search leaves that has not seen the time, as parts of the joints' sizes, mean; where it was run.
fn nested_mean(found: &LogDiagnosis) -> Option<f64> {
    let parts: Option<Vec<f64>> =
        found.gap.iter().map(|g| g.nested.map(|nested| nested / g.size)).collect();
    parts.map(|parts| parts.iter().sum::<f64>() / parts.len() as f64)
}

/// The same of each joint; empty where it was not run.
pub fn nested(found: &LogDiagnosis) -> Vec<String> {
    found.gap.iter().filter_map(|g| Some(short(shown(&g.unit).1 * g.nested?))).collect()
}

/// What the model lacks, and what that leaves.
pub fn sentence(found: &LogDiagnosis) -> String {
    let [before, after] = left(&found.gap).map(|part| format!("{} %", fixed(100.0 * part, 1)));
    let what = what(found.rows);
    if found.findings.is_empty() {
        return format!(
            "Nothing is found: no effect that was tried makes the gap of {before} {what} smaller on \
             time that no fit has seen."
        );
    }
    let name = |f: &Finding| format!("{} at {}", words(&f.effect), f.place);
    let mut told: Vec<String> = found.findings.iter().take(TOLD).map(name).collect();
    if let Some(more) = found.findings.len().checked_sub(TOLD).filter(|more| *more > 0) {
        told.push(counted(more, "more effect"));
    }
    let last = told.pop().unwrap_or_default();
    let told = if told.is_empty() { last } else { format!("{} and {last}", told.join(", ")) };
    let mut text = format!(
        "The model lacks {told}: with them {after} {what} is left on time that no fit has seen, without \
         them {before}: {}.",
        less(&found.shrink)
    );
    if let Some(nested) = nested_mean(found) {
        text.push_str(&format!(
            " Where the search has not seen the time either, {} % is left.",
            fixed(100.0 * nested, 1)
        ));
    }
    let open = found.findings.iter().filter(|f| !f.alternatives.is_empty()).count();
    if open > 0 {
        text.push_str(&format!(
            " This log does not tell {} from others.",
            counted(open, "finding")
        ));
    }
    text
}

/// Position errors are told in what people read.
pub fn shown(unit: &str) -> (&str, f64) {
    match unit {
        "rad" => ("°", 180.0 / core::f64::consts::PI),
        "m" => ("mm", 1e3),
        other => (other, 1.0),
    }
}

/// Of each joint its name, its size, what is left before and after, and what part that is.
pub fn gaps(found: &LogDiagnosis) -> Vec<[String; 5]> {
    let of = |(joint, gap): (usize, &JointGap)| {
        let (name, factor) = shown(&gap.unit);
        let number = |x: f64| short(factor * x);
        [
            format!("joint {}", joint + 1),
            format!("{} {name}", number(gap.size)),
            number(gap.before),
            number(gap.after),
            format!("{} %", fixed(100.0 * gap.after / gap.size, 1)),
        ]
    };
    found.gap.iter().enumerate().map(of).collect()
}

fn gap(found: &LogDiagnosis) -> String {
    let size = match found.rows {
        Domain::Torque => "spread",
        Domain::Position => "as logged",
    };
    let before = match found.rows {
        Domain::Torque => "rigid links alone",
        Domain::Position => "before",
    };
    let heads = ["Gap, rms", size, before, "with the findings", ""];
    let mut rows = vec![heads.map(|h| if h == "Gap, rms" { bold(h) } else { dim(h) }).to_vec()];
    for (gap, [joint, size, before, after, _]) in found.gap.iter().zip(gaps(found)) {
        let left = bar(gap.after / gap.size.max(gap.before), BAR);
        rows.push(vec![format!("  {joint}"), size, before, after, left]);
    }
    use Align::{Left, Right};
    let mut align = vec![Left, Right, Right, Right, Left];
    let nested = nested(found);
    if !nested.is_empty() {
        let cells = [dim("searched anew")].into_iter().chain(nested);
        rows.iter_mut().zip(cells).for_each(|(row, cell)| row.insert(4, cell));
        align.insert(4, Right);
    }
    table(&rows, &align)
}

fn findings(found: &LogDiagnosis) -> String {
    if found.findings.is_empty() {
        return String::new();
    }
    let part = |x: f64| fixed(100.0 * x, 1);
    let line = |(k, f): (usize, &Finding)| {
        vec![
            (k + 1).to_string(),
            good(format!("{} at {}", words(&f.effect), f.place)),
            format!("{} → {} %", part(f.held_out.before()), part(f.held_out.after())),
            left_bar(f.held_out.before(), f.held_out.after(), NARROW),
        ]
    };
    let rows: Vec<Vec<String>> = found.findings.iter().enumerate().map(line).collect();
    let what = dim("in the order in which they were added; mean gap of the joints, held out");
    let mut text = format!("\n{}  {what}\n", bold("Findings"));
    for (line, finding) in table(&rows, &[Align::Right]).lines().zip(&found.findings) {
        text.push_str(&format!("  {line}\n"));
        if found.findings.len() <= DETAILED || !finding.alternatives.is_empty() {
            text.push_str(&details(finding));
        }
    }
    if found.findings.len() > DETAILED {
        text.push_str("  the numbers of all: --json\n");
    }
    text
}

fn details(finding: &Finding) -> String {
    let numbers: Vec<String> = finding.parameters.iter().map(number).collect();
    let mut text = format!("     {}; p = {}", numbers.join("; "), short(finding.p_value));
    if !finding.alternatives.is_empty() {
        let name = |a: &Alternative| {
            let more = percent(a.left.size() - 1.0);
            format!("{} at {} (leaves {more} more)", words(&a.effect), a.place)
        };
        let names: Vec<String> = finding.alternatives.iter().map(name).collect();
        text.push_str(&format!(
            "; {}: {}",
            bad("this log cannot tell it from"),
            listed(&names, MOST)
        ));
    }
    let mut text = wrapped(&text, WIDTH, 7);
    if let Some(advice) = finding.advice() {
        text.push_str(&wrapped(&format!("     to tell them apart: {advice}"), WIDTH, 7));
    }
    text
}

/// `viscous 8.13 [8.01 to 8.25] N·m·s/rad`.
pub fn number(p: &Parameter) -> String {
    let half = 0.5 * (p.ci95[1] - p.ci95[0]);
    let digits = decimals(half, 2).min(decimals(p.value.abs(), 3).max(decimals(half, 1)));
    let shown = |x: f64| match (1e-4..1e5).contains(&p.value.abs()) {
        true => fixed(x, digits),
        false => minus(format!("{x:.2e}")),
    };
    let [low, high] = p.ci95.map(shown);
    format!("{} {} [{low} to {high}] {}", p.name, shown(p.value), p.unit)
}

fn notes(found: &LogDiagnosis) -> String {
    let note = |name: &str, text: String| {
        let pad = " ".repeat(MARGIN - name.len());
        wrapped(&format!("{}{pad}{text}", bold(name)), WIDTH, MARGIN)
    };
    let mut text = String::from("\n");
    if found.rigid_parameters > 0 {
        let count = counted(found.rigid_parameters, "base parameter");
        text.push_str(&note("Fitted along", format!("the rigid links, {count}")));
    }
    if !found.evidence.long_enough {
        let longest = found.evidence.correlation_time.iter().copied().fold(0.0, f64::max);
        let few = format!(
            "blocks of five correlation times ({} s each) are too few in this log: chances and intervals \
             are told from shorter ones, and too small",
            short(longest)
        );
        text.push_str(&note("Too short", few));
    }
    text.extend(by_command(found).map(|line| note("By commands", line)));
    for (k, line) in unexplained(found).into_iter().take(MOST).enumerate() {
        text.push_str(&note(if k == 0 { "Unexplained" } else { "" }, line));
    }
    for (k, line) in hidden(found).into_iter().enumerate() {
        text.push_str(&note(if k == 0 { "Cannot see" } else { "" }, line));
    }
    indented(&text, 0)
}

/// What the commanded motion as instrument changes; `None` where none is logged.
pub fn by_command(found: &LogDiagnosis) -> Option<String> {
    let all = || found.findings.iter().flat_map(|f| f.parameters.iter().map(move |p| (f, p)));
    let told: Vec<_> = all().filter_map(|(f, p)| Some((f, p, p.by_command?))).collect();
    let off = told.iter().filter(|(_, p, other)| *other < p.ci95[0] || *other > p.ci95[1]);
    let off: Vec<String> = off
        .map(|(f, p, other)| {
            let (value, other) = (short(p.value), short(*other));
            format!(
                "{} of {} at {}, {other} for {value} {}",
                p.name,
                words(&f.effect),
                f.place,
                p.unit
            )
        })
        .collect();
    match (told.is_empty(), off.is_empty()) {
        (true, _) => None,
        (_, true) => Some(
            "with the commanded motion as instrument, which knows nothing of the noise of what is measured, every \
             number stays in its interval"
                .to_owned(),
        ),
        _ => Some(format!(
            "the commanded motion as instrument, which knows nothing of the noise of what is measured, gives other \
             numbers: {}",
            listed(&off, MOST)
        )),
    }
}

/// On what it depends that is left, joint by joint; the largest share first.
pub fn unexplained(found: &LogDiagnosis) -> Vec<String> {
    let mut told: Vec<(&str, Vec<String>)> = Vec::new();
    for rest in &found.unexplained.depends_on {
        // Of a million rows much less than that is no accident.
        let share = if rest.share < 0.005 { "less than 1 %".into() } else { percent(rest.share) };
        let part = format!("{share} with its {}", rest.of);
        match told.iter_mut().find(|(place, _)| *place == rest.place) {
            Some((_, parts)) => parts.push(part),
            None => told.push((&rest.place, vec![part])),
        }
    }
    let line = |(place, parts): (&str, Vec<String>)| {
        format!("of what is left of {place} goes {}", listed(&parts, MOST))
    };
    told.into_iter().map(line).collect()
}

/// What the log cannot show and why, places of the same kind in one line.
pub fn hidden(found: &LogDiagnosis) -> Vec<String> {
    let mut told: Vec<(&str, &str, Vec<&str>)> = Vec::new();
    for hidden in &found.cannot_see {
        let same =
            |t: &&mut (&str, &str, Vec<&str>)| (t.0, t.1) == (&*hidden.effect, hidden.because());
        match told.iter_mut().find(same) {
            Some((.., places)) => places.push(&hidden.place),
            None => told.push((&hidden.effect, hidden.because(), vec![hidden.place.as_str()])),
        }
    }
    let line = |(effect, reason, places): (&str, &str, Vec<&str>)| {
        format!("{} at {}: {reason}", words(effect), places.join(", "))
    };
    told.into_iter().map(line).collect()
}
