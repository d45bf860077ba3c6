//! `stiffarm effects`: what reality does that a model leaves out, as the catalogue has it.

use serde::Serialize;
use stiffarm_document::text::{bold, dim, wrapped};
use stiffarm_gap::effects::{self, AtRest, Facts, InMotion, Place, Spot};
use stiffarm_gap::log::Domain;
use stiffarm_kernels::generic::Arm;

use crate::Verdict;
use crate::host::Host;
use crate::input::named;
use crate::input::source::RobotArgs;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm effects
  stiffarm effects backlash latency
  stiffarm effects --json | jq -r '.[].effect'";

/// The effects that a diagnosis tries: what each does, how it shows, what it is confused with
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Only these
    effects: Vec<String>,
    /// Write them as Markdown to OUT (standard output if there is no OUT)
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    #[arg(conflicts_with = "json")]
    markdown: Option<Target>,
    /// Write them as JSON
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    json: Option<Target>,
}

/// A law of an effect.
#[derive(Serialize)]
struct Entry {
    /// As files and findings call it.
    effect: &'static str,
    /// The effect whose law it is.
    #[serde(skip)]
    law_of: &'static str,
    /// The rows of a log in which it is seen; none of an arm at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<Domain>,
    /// `joint i`, `base`.
    places: Vec<String>,
    numbers: Vec<Number>,
    formula: &'static str,
    reality: &'static str,
    signature: &'static str,
    confused_with: &'static str,
    separated_by: &'static str,
}

/// A number, as an `[[effect]]` of a robot file calls it.
#[derive(Serialize)]
struct Number {
    key: &'static str,
    /// Of a revolute joint, of a prismatic one; one where that is the same.
    units: Vec<&'static str>,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let mut arm = RobotArgs::named(SAMPLE).load(&host.quiet(true))?.arm()?;
    arm.joints.iter_mut().for_each(|joint| joint.drive.gear = GEAR);
    let mut chosen = effects::Entry::all();
    if !args.effects.is_empty() {
        let names = |entry: &effects::Entry| {
            let laws = entry.laws().map(|law| law.identifier());
            let names: Vec<&str> = [entry.identifier].into_iter().chain(laws).collect();
            names.into_iter().map(|name| (name, entry.clone())).collect::<Vec<_>>()
        };
        let known: Vec<_> = chosen.iter().flat_map(names).collect();
        chosen = named::effects(&known, &args.effects, "")?;
    }
    let entries: Vec<Entry> = chosen.iter().flat_map(|entry| laws(entry, &arm)).collect();
    match (&args.markdown, &args.json) {
        (Some(target), _) => host.write(target, &markdown(&entries))?,
        (_, Some(target)) => host.write(target, &json::text(&entries)?)?,
        _ => host.print(&screen(&entries))?,
    }
    Ok(Verdict::Good)
}

/// An arm that has joints of both kinds, and masses: with gears every effect has a place there.
const SAMPLE: &str = "stanford";

/// Turns of a motor in one of its joint.
const GEAR: f64 = 100.0;

/// What an effect does at rest, then what it does in motion.
fn laws(entry: &effects::Entry, arm: &Arm) -> Vec<Entry> {
    let at_rest = entry.at_rest.map(|law| at_rest(law, arm));
    at_rest.into_iter().chain(entry.in_motion.iter().map(|law| in_motion(*law, arm))).collect()
}

fn at_rest(law: &'static dyn AtRest, arm: &Arm) -> Entry {
    let places = law.places(arm);
    let mut numbers: Vec<Number> = Vec::new();
    for place in &places {
        let form = law.named_forms(arm, *place).first().copied().unwrap_or(0);
        let each = law.parameters(arm, Spot { place: *place, form });
        for (key, unit) in each.iter().map(|p| (p.key, p.quantity.unit())) {
            match numbers.iter_mut().find(|number| number.key == key) {
                None => numbers.push(Number { key, units: vec![unit] }),
                Some(known) if known.units.contains(&unit) => {}
                Some(known) => known.units.push(unit),
            }
        }
    }
    let unit = law.form_number().map_or("1", |number| number.quantity.unit());
    let form = law.forms_are().key().map(|key| Number { key, units: vec![unit] });
    let names = places.iter().map(|place| numbered(*place, place.to_string()));
    Entry::of(law.facts(), names, form.into_iter().chain(numbers).collect())
}

fn in_motion(law: &'static dyn InMotion, arm: &Arm) -> Entry {
    let numbers = law.parameters().iter();
    let numbers = numbers.map(|p| Number { key: p.key, units: vec![p.quantity.unit()] }).collect();
    let places = law.facts().at.places(arm).into_iter();
    Entry::of(law.facts(), places.map(|p| numbered(p, Spot::at(p).to_string())), numbers)
}

/// The text of a place, `joint i` for one of many.
fn numbered(place: Place, text: String) -> String {
    match place {
        Place::Joint(_) => "joint i".to_owned(),
        Place::Link(_) => "link i".to_owned(),
        Place::Pair(..) => "joints i ± j".to_owned(),
        Place::Held(_) => "the tool in run i".to_owned(),
        _ => text,
    }
}

impl Entry {
    fn of(facts: &Facts, all: impl Iterator<Item = String>, numbers: Vec<Number>) -> Entry {
        let mut places: Vec<String> = Vec::new();
        for place in all {
            if !places.contains(&place) {
                places.push(place);
            }
        }
        let (effect, law_of) = (facts.identifier, facts.effect());
        let Facts { rows, formula, reality, signature, confused_with, separated_by, .. } = *facts;
        Entry {
            effect,
            law_of,
            rows,
            places,
            numbers,
            formula,
            reality,
            signature,
            confused_with,
            separated_by,
        }
    }

    /// Where it is seen, if not at rest.
    fn seen(&self) -> Option<&'static str> {
        self.rows.map(|rows| match rows {
            Domain::Torque => "torques of a log",
            Domain::Position => "positions of a log",
        })
    }

    /// `cos (rad), sin (rad)`.
    fn numbers(&self, mark: &str) -> String {
        let each = self.numbers.iter().map(|Number { key, units }| match units.as_slice() {
            ["1"] => format!("{mark}{key}{mark}"),
            units => format!("{mark}{key}{mark} ({})", units.join(" or ")),
        });
        each.collect::<Vec<_>>().join(", ")
    }

    /// What is said of it, each with its heading.
    fn said(&self) -> [(&'static str, &'static str); 4] {
        [
            ("law", self.formula),
            ("shows as", self.signature),
            ("confused with", self.confused_with),
            ("separated by", self.separated_by),
        ]
    }
}

/// Characters of a line.
const WIDTH: usize = 100;

fn screen(entries: &[Entry]) -> String {
    let one = |entry: &Entry| {
        let seen = entry.seen().map_or_else(String::new, |seen| format!("; {seen}"));
        let head = format!("{}  {}", bold(entry.effect), dim(entry.places.join(", ") + &seen));
        let mut text = format!("{head}\n{}", wrapped(&format!("  {}", entry.reality), WIDTH, 2));
        text += &wrapped(&format!("  {:<14} {}", "numbers", entry.numbers("")), WIDTH, 17);
        for (heading, said) in entry.said() {
            text += &wrapped(&format!("  {heading:<14} {}", said.replace('`', "")), WIDTH, 17);
        }
        text
    };
    entries.iter().map(one).collect::<Vec<_>>().join("\n")
}

const HEAD: &str = "\
# Effects

What a real arm does that its model leaves out: the catalogue that `stiffarm diagnose` tries. First stand the effects
of an arm at rest, in the order in which equally good explanations are preferred, with what they do to a joint log;
then those that only a log shows. `stiffarm effects` prints this page; how a diagnosis chooses between them is in
[gap.md](gap.md) and [logs.md](logs.md). An `[[effect]]` of a robot file takes the numbers as they are called here.
";

fn markdown(entries: &[Entry]) -> String {
    let mut text = HEAD.to_owned();
    for (k, entry) in entries.iter().enumerate() {
        let Entry { effect, law_of, reality, .. } = entry;
        if k == 0 || entries[k - 1].law_of != *law_of {
            text += &format!("\n## {law_of}\n");
        }
        if let Some(seen) = entry.seen() {
            text += &format!("\nIn the {seen}");
            text +=
                &if effect == law_of { ":\n".to_owned() } else { format!(", as `{effect}`:\n") };
        }
        let places = entry.places.join(", ");
        text += &format!("\n{reality}\n\n| | |\n|---|---|\n");
        text += &format!("| at | {places} |\n| numbers | {} |\n", entry.numbers("`"));
        for (heading, said) in entry.said() {
            // A bar would end the cell.
            text += &format!("| {heading} | {} |\n", said.replace('|', "\\|"));
        }
    }
    text
}
