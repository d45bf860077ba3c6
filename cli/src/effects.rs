//! `stiffarm effects`: what reality does that a model leaves out, as the catalogue has it.

use serde::Serialize;
use stiffarm_gap::effects::{About, Catalogue, Effect, Place, Spot};
use stiffarm_kernels::generic::Arm;

use crate::Verdict;
use crate::input::named;
use crate::input::source::RobotArgs;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::{Target, print};
use crate::terminal::text::{bold, dim, wrapped};

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

/// One effect.
#[derive(Serialize)]
struct Entry {
    effect: &'static str,
    /// `joint i`, `base`.
    places: Vec<String>,
    numbers: Vec<Number>,
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

/// Runs the command.
///
/// # Errors
/// [`Failure`]: an effect that there is not, or an output that cannot be written.
pub fn run(args: &Args) -> Result<Verdict, Failure> {
    let mut arm = RobotArgs::named(SAMPLE).load(true)?.arm()?;
    arm.joints.iter_mut().for_each(|joint| joint.drive.gear = GEAR);
    let all: Vec<_> = Catalogue::default().iter().collect();
    let chosen =
        if args.effects.is_empty() { all } else { named::effects(&all, &args.effects, "")? };
    let entries: Vec<Entry> = chosen.into_iter().map(|effect| entry(effect, &arm)).collect();
    match (&args.markdown, &args.json) {
        (Some(target), _) => target.write(&markdown(&entries))?,
        (_, Some(target)) => target.write(&json::text(&entries)?)?,
        _ => print(&screen(&entries))?,
    }
    Ok(Verdict::Good)
}

/// An arm that has joints of both kinds, and masses: with gears every effect has a place there.
const SAMPLE: &str = "stanford";

/// Turns of a motor in one of its joint.
const GEAR: f64 = 100.0;

fn entry(effect: &'static dyn Effect, arm: &Arm) -> Entry {
    let About { reality, signature, confused_with, separated_by } = effect.about();
    let mut places: Vec<String> = Vec::new();
    let mut numbers: Vec<Number> = Vec::new();
    for place in effect.places(arm) {
        let any = match place {
            Place::Joint(_) => "joint i".to_owned(),
            Place::Link(_) => "link i".to_owned(),
            only => only.to_string(),
        };
        if !places.contains(&any) {
            places.push(any);
        }
        let form = effect.named_forms(arm, place).first().copied().unwrap_or(0);
        let each = effect.parameters(arm, Spot { place, form });
        for (key, unit) in each.iter().map(|p| (p.key, p.quantity.unit())) {
            match numbers.iter_mut().find(|number| number.key == key) {
                None => numbers.push(Number { key, units: vec![unit] }),
                Some(known) if known.units.contains(&unit) => {}
                Some(known) => known.units.push(unit),
            }
        }
    }
    let unit = effect.form_number().map_or("1", |number| number.quantity.unit());
    let form = effect.forms_are().key().map(|key| Number { key, units: vec![unit] });
    let numbers = form.into_iter().chain(numbers).collect();
    let effect = effect.identifier();
    Entry { effect, places, numbers, reality, signature, confused_with, separated_by }
}

impl Entry {
    /// `cos (rad), sin (rad)`.
    fn numbers(&self, mark: &str) -> String {
        let each = self.numbers.iter().map(|Number { key, units }| match units.as_slice() {
            ["1"] => format!("{mark}{key}{mark}"),
            units => format!("{mark}{key}{mark} ({})", units.join(" or ")),
        });
        each.collect::<Vec<_>>().join(", ")
    }

    /// What is said of it, each with its heading.
    fn said(&self) -> [(&'static str, &'static str); 3] {
        [
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
        let head = format!("{}  {}", bold(entry.effect), dim(entry.places.join(", ")));
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

What a real arm does that its model leaves out: the catalogue that `stiffarm diagnose` tries, in the
order in which equally good explanations are preferred. `stiffarm effects` prints this page; how a
diagnosis chooses between them is in [gap.md](gap.md). An `[[effect]]` of a robot file takes the
numbers as they are called here.
";

fn markdown(entries: &[Entry]) -> String {
    let one = |entry: &Entry| {
        let Entry { effect, reality, .. } = entry;
        let places = entry.places.join(", ");
        let mut text = format!("\n## {effect}\n\n{reality}\n\n| | |\n|---|---|\n");
        text += &format!("| at | {places} |\n| numbers | {} |\n", entry.numbers("`"));
        for (heading, said) in entry.said() {
            text += &format!("| {heading} | {said} |\n");
        }
        text
    };
    HEAD.to_owned() + &entries.iter().map(one).collect::<String>()
}
