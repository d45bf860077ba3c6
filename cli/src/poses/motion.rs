//! Commands of a motion whose log says most.

use stiffarm_document::text::{bold, dim, indented, short, table};
use stiffarm_document::words::words;
use stiffarm_gap::effects::Spot;
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::course::{Course, commands};
use stiffarm_plant::motion::{Law, Logged, MotionTruth, Side};
use stiffarm_study::excite::{Excitation, Plan, Purpose, excite};

use super::Args;
use crate::Verdict;
use crate::host::Host;
use crate::input::source::Source;
use crate::motion;
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;
use crate::terminal::progress::{PARTS, Progress};

/// Effects that are looked for where none is named: what every drive may have.
const USUAL: [&str; 6] = [
    "coulomb_friction",
    "viscous_friction",
    "friction_curve",
    "load_friction",
    "rotor_inertia",
    "torque_offset",
];

/// Commands a second.
const RATE: f64 = 100.0;

/// Variations that are tried.
const TRIES: usize = 150;

/// Chooses a motion and writes its commands.
pub(super) fn run(args: &Args, source: &Source, host: &Host) -> Result<Verdict, Failure> {
    if args.count.is_some() || !args.loads.is_empty() || !args.nuisance.is_empty() || args.rotations
    {
        return Err(Failure::with_help(
            "found an option of postures beside --for motion",
            "leave out --count, --load, --nuisance and --rotations: a motion is a single one",
        ));
    }
    let arm = motion::arm(source, "poses --for motion")?;
    let limits = args.motion.limits(&arm)?;
    let (period, harmonics) = args.motion.series();
    let plan = Plan {
        arm: &arm,
        limits: &limits,
        logged: Logged::Torque(Side::Motor),
        purpose: purpose(&args.effects, &arm)?,
        period,
        harmonics,
        tries: TRIES,
        seed: args.seed,
    };
    let progress = Progress::new(&source.given, PARTS, host);
    let found = excite(&plan, &|part| progress.reach(part, PARTS));
    drop(progress);
    let found = found?;
    let comments = [
        format!("{}: a motion of {} s that may be repeated", arm.name, short(period)),
        "it begins and ends at rest, where its first row is; nothing here knows of floor and cell"
            .to_owned(),
    ];
    host.write(&args.csv, &commands(&arm, &found.course, RATE, &comments))?;
    if args.csv != Target::Stdout && !host.is_quiet() {
        host.print(&screen(&arm, &found))?;
    }
    Ok(Verdict::Good)
}

fn purpose(named: &[String], arm: &Arm) -> Result<Purpose, Failure> {
    let suspect = |text: &String| MotionTruth::place(text, arm, 1);
    let named: Vec<(&'static Law, Spot)> = named.iter().map(suspect).collect::<Result<_, _>>()?;
    Ok(match named[..] {
        [] => Purpose::All(usual(arm)),
        [a, b] => Purpose::Apart([a, b]),
        _ => Purpose::All(named),
    })
}

fn usual(arm: &Arm) -> Vec<(&'static Law, Spot)> {
    let laws = USUAL.iter().filter_map(|name| Law::named(name));
    laws.flat_map(|law| law.spots(arm, 1).into_iter().map(move |spot| (law, spot))).collect()
}

fn screen(arm: &Arm, found: &Excitation) -> String {
    let facts = format!(
        "a motion of {} s; as good as {} times as long a motion of chance",
        short(found.course.duration()),
        short(found.efficiency)
    );
    let mut text = format!("{}\n{}\n\n", bold(&arm.name), dim(facts));
    let mut rows = vec![vec![bold("Intervals"), dim("narrower than of chance")]];
    for told in &found.told {
        let name = format!("{} at {}: {}", words(told.effect), told.spot, told.number);
        rows.push(vec![format!("  {name}"), format!("{} ×", short(told.narrower))]);
    }
    text.push_str(&table(&rows, &[]));
    if !found.hidden.is_empty() {
        let name = |(effect, spot, number): &(&str, Spot, &str)| {
            format!("{} at {spot} ({number})", words(effect))
        };
        let names: Vec<String> = found.hidden.iter().map(name).collect();
        let why = dim("other masses of the links do the same in any motion");
        text.push_str(&format!("\n{}  {why}\n", bold("Cannot be seen")));
        text.push_str(&indented(&format!("{}\n", names.join(", ")), 2));
    }
    text
}
