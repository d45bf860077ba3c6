//! What was identified, on one screen, in the units that people use.

use stiffarm_gap::Measurements;
use stiffarm_gap::gap::Statistics;
use stiffarm_gap::identify::measured::{Answer, Unknown};

use super::words;
use crate::input::quantity::counted;
use crate::input::source::Source;
use crate::report::identified::Said;
use crate::terminal::text::{Align, bar, bold, dim, indented, short, table, wrapped};

/// Width of a line.
const WIDTH: usize = 100;

/// Width of the bars.
const BAR: usize = 20;

/// The whole screen.
pub fn text(
    source: &Source,
    data: &Measurements,
    answer: &Answer,
    said: &[Said],
    sentence: &str,
) -> String {
    let mut text = head(source, data, answer);
    text.push_str(&wrapped(sentence, WIDTH, 0));
    text.push('\n');
    text.push_str(&springs(answer, said));
    text.push_str(&links(answer, said));
    text.push_str(&gap(answer));
    let advice = words::advice(answer);
    if !advice.is_empty() {
        text.push_str(&format!("\n{}\n", advice.join("\n")));
    }
    text
}

fn head(source: &Source, data: &Measurements, answer: &Answer) -> String {
    let measured = data.kind.measured();
    let facts = format!(
        "{}: {} of {} at {}, held out in {}",
        data.file,
        counted(data.rows.len(), "measurement"),
        measured.join(" "),
        counted(data.poses, "pose"),
        counted(answer.gap.folds, "fold")
    );
    format!("{}\n{}\n\n", bold(&source.robot.name), dim(facts))
}

/// Joints and base: stiffnesses.
fn springs(answer: &Answer, said: &[Said]) -> String {
    let mut rows = vec![
        [bold("Stiffness"), dim("found"), dim("95 %"), dim("robot file"), String::new()].to_vec(),
    ];
    for (parameter, said) in answer.parameters.iter().zip(said) {
        if matches!(parameter.unknown, Unknown::Link(_)) {
            continue;
        }
        let quiet = |text: &String, word: &str| {
            if text == word { dim(text) } else { text.clone() }
        };
        rows.push(vec![
            said.place.clone(),
            quiet(&said.found, "held"),
            said.interval.clone(),
            quiet(&said.file, "rigid"),
            said.verdict.clone(),
        ]);
    }
    under_heading(&rows, &[Align::Left; 5])
}

fn links(answer: &Answer, said: &[Said]) -> String {
    let mut rows = vec![vec![bold("Flexibility"), dim("× the file's"), dim("95 %")]];
    for (parameter, said) in answer.parameters.iter().zip(said) {
        let Unknown::Link(_) = parameter.unknown else { continue };
        rows.push(match said.interval.as_str() {
            "" => vec![said.place.clone(), dim(&said.found), said.verdict.clone()],
            _ => vec![said.place.clone(), said.found.clone(), said.interval.clone()],
        });
    }
    if rows.len() == 1 {
        return String::new();
    }
    format!("\n{}", under_heading(&rows, &[Align::Left; 3]))
}

fn gap(answer: &Answer) -> String {
    let (gap, noise) = (&answer.gap, &answer.noise);
    let mut heads = vec![bold("Gap")];
    if noise.position.is_some() {
        heads.extend(["rms mm", "max mm"].map(dim));
    }
    if noise.rotation.is_some() {
        heads.push(dim("rms mrad"));
    }
    let main = |s: &Statistics| match noise.position {
        Some(_) => s.position_rms,
        None => s.rotation_rms,
    };
    let line = |name: &str, s: &Statistics| {
        let mut cells = vec![name.to_owned()];
        if noise.position.is_some() {
            cells.extend([s.position_rms, s.position_max].map(|x| short(1e3 * x)));
        }
        if noise.rotation.is_some() {
            cells.push(short(1e3 * s.rotation_rms));
        }
        let whole = main(&gap.before);
        cells.push(bar(if whole > 0.0 { main(s) / whole } else { 0.0 }, BAR));
        cells
    };
    let mut last = vec![
        match noise.from {
            "option" => "noise of a component, as given",
            "repeats" => "noise of a component, repeats",
            _ => "noise of a component, left",
        }
        .to_owned(),
    ];
    if let Some(sd) = noise.position {
        last.extend([short(1e3 * sd), String::new()]);
    }
    if let Some(sd) = noise.rotation {
        last.push(short(1e3 * sd));
    }
    let rows = [
        heads,
        line("as the robot file is", &gap.before),
        line("with what was found, held out", &gap.held_out),
        last,
    ];
    let align = [Align::Left, Align::Right, Align::Right, Align::Right];
    let columns = rows[1].len() - 1;
    let mut align = align[..columns].to_vec();
    align.push(Align::Left);
    format!("\n{}", under_heading(&rows, &align))
}

/// The heading stands out to the left of the lines below it.
fn under_heading(rows: &[Vec<String>], align: &[Align]) -> String {
    let lines = table(rows, align);
    let (head, rest) = lines.split_once('\n').unwrap_or((&lines, ""));
    format!("{}\n{}", head.replacen("  ", "    ", 1), indented(rest, 2))
}
