//! `stiffarm robots`: the built-in robots.

use serde::Serialize;
use stiffarm_codegen::derive::{Output, derive};
use stiffarm_codegen::robot::{Convention, Motion, Robot};
use stiffarm_document::text::{Align, bold, dim, indented, table};
use stiffarm_robots::{ARMS, SYMBOLIC};

use super::Verdict;
use crate::host::Host;
use crate::input::source;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::Target;

/// The built-in robots: their joints, what their files know, and what a Jacobian costs
#[derive(clap::Args)]
#[command(after_help = "Example:\n  stiffarm robots --json | jq -r '.[].id'")]
pub struct Args {
    /// Write the list as JSON to OUT (standard output if there is no OUT)
    #[arg(long, value_name = "OUT", num_args = 0..=1, default_missing_value = "-")]
    json: Option<Target>,
    /// Print the JSON Schema of a robot file, for editors
    #[arg(long, conflicts_with = "json")]
    schema: bool,
}

/// One robot of the list.
#[derive(Serialize)]
struct Entry {
    id: &'static str,
    name: String,
    joints: String,
    convention: &'static str,
    stiffness: bool,
    beams: bool,
    masses: bool,
    jacobian_flops: u32,
    parameters: Vec<String>,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    if args.schema {
        host.print(&Robot::json_schema())?;
        return Ok(Verdict::Good);
    }
    let ids = ARMS.iter().map(|arm| arm.id).chain(SYMBOLIC.iter().map(|arm| arm.id));
    let entries: Vec<Entry> = ids.map(|id| entry(id, host)).collect::<Result<_, _>>()?;
    match &args.json {
        Some(target) => host.write(target, &json::text(&entries)?)?,
        None => host.print(&screen(&entries))?,
    }
    Ok(Verdict::Good)
}

fn entry(id: &'static str, host: &Host) -> Result<Entry, Failure> {
    let robot = source::open(id, &host.quiet(true))?.robot;
    let beams = || robot.joints.iter().filter_map(|j| j.beam.as_ref());
    Ok(Entry {
        id,
        joints: motions(&robot),
        convention: convention(robot.convention),
        stiffness: robot.joints.iter().any(|j| j.stiffness.is_some()),
        beams: beams().next().is_some(),
        masses: robot.joints.iter().any(|j| j.mass.is_some())
            || beams().any(|b| b.density.is_some()),
        jacobian_flops: derive(&robot, &[Output::Jacobian]).ops().flops(),
        parameters: robot.symbols().into_iter().map(|s| s.name).collect(),
        name: robot.name,
    })
}

/// `6R`, `2R1P3R`.
pub fn motions(robot: &Robot) -> String {
    let mut runs: Vec<(char, usize)> = Vec::new();
    for joint in &robot.joints {
        let letter = match joint.motion {
            Motion::Revolute => 'R',
            Motion::Prismatic => 'P',
        };
        match runs.last_mut() {
            Some((last, count)) if *last == letter => *count += 1,
            _ => runs.push((letter, 1)),
        }
    }
    runs.iter().map(|(letter, count)| format!("{count}{letter}")).collect()
}

/// The convention's name, as a robot file has it.
pub fn convention(convention: Convention) -> &'static str {
    match convention {
        Convention::Standard => "standard",
        Convention::Modified => "modified",
    }
}

fn screen(entries: &[Entry]) -> String {
    let head = ["id", "robot", "joints", "convention", "knows", "J flops"];
    let mut rows = vec![head.map(bold).to_vec()];
    rows.extend(entries.iter().map(|e| {
        let known = [("springs", e.stiffness), ("beams", e.beams), ("masses", e.masses)];
        let known: Vec<&str> =
            known.iter().filter(|(_, has)| *has).map(|(what, _)| *what).collect();
        vec![
            e.id.to_owned(),
            e.name.clone(),
            e.joints.clone(),
            e.convention.to_owned(),
            if known.is_empty() { dim("–") } else { known.join(", ") },
            e.jacobian_flops.to_string(),
        ]
    }));
    use Align::{Left, Right};
    let mut text = table(&rows, &[Left, Left, Left, Left, Left, Right]);
    text.push_str(&dim(
        "J flops: additions and multiplications of the Jacobian, sin and cos apart\n",
    ));
    text.push_str(&format!("\n{}  {}\n", bold("Symbolic parameters"), dim("--set NAME=VALUE")));
    let symbolic = entries.iter().filter(|e| !e.parameters.is_empty());
    let lines = symbolic.flat_map(|e| {
        let names = e.parameters.chunks(NAMES).map(|names| names.join(" ")).enumerate();
        names.map(|(k, names)| vec![if k == 0 { e.id.to_owned() } else { String::new() }, names])
    });
    text.push_str(&indented(&table(&lines.collect::<Vec<_>>(), &[]), 2));
    text
}

/// Names of parameters on a line.
const NAMES: usize = 16;
