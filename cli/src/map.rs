//! `stiffarm map`: a quantity over two joints, as a picture or as numbers.

mod axes;
mod learnt;
mod picture;
mod quantity_of;
mod sweep;

use std::sync::atomic::{AtomicUsize, Ordering};

use stiffarm_document::plot::number;
use stiffarm_document::text::{bold, counted, dim, short};
use stiffarm_gap::whole::Whole;
use stiffarm_study::dexterity::Map;

use super::Verdict;
use crate::host::Host;
use crate::input::source::RobotArgs;
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;
use crate::terminal::progress::Progress;
pub use axes::Axes;
use learnt::{Learnt, LearntArgs};
use quantity_of::{NoValue, Of, Quantity};
use sweep::Sweep;

const EXAMPLES: &str = "\
Examples:
  stiffarm map kuka_kr240 --over q2,q3 --of condition --at q4=45deg,q5=45deg --svg dexterity.svg
  stiffarm map arm.toml --over q2,q3 --of deflection --wrench 0,0,-500,0,0,0 --svg sag.svg
  stiffarm map arm.toml --over q2,q3 --of stiffness --wrench 100,0,0,0,0,0 --csv k.csv --steps 50
  stiffarm map arm.toml --over q2,q3 --of shrink --data run.csv --wrench 0,0,-2kN,0,0,0 --svg s.svg

The two joints go over their limits (a revolute joint without limits once around); the others stand
where --at puts them, else at 0 or the limit next to it. Of the quantities

  condition   1/κ of the Jacobian, 0 singular to 1 isotropic (Dumas et al. 2011, Fig. 3)
  nu_p nu_r   what leaving the loaded geometry K_C out costs (Dumas et al. 2011, Fig. 4)
  deflection  how far the tool is moved, loaded geometry and links included
  stiffness   the force over the displacement in its direction
  shrink      how much of the gap goes where the findings of a diagnosis of --data are put into the
              model; what stays is their uncertainty, the noise and what the diagnosis leaves

all but the first and the last need a --wrench. A map stays empty where the arm has no stable rest.";

/// A workspace map of dexterity, deflection or stiffness over two joints
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("output").required(true).multiple(true))]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// The two joints that move: q2,q3
    #[arg(long, value_name = "qI,qJ")]
    over: String,
    /// What is mapped
    #[arg(long, value_enum, value_name = "QUANTITY")]
    of: Of,
    /// Where the other joints stand: q1=0,q4=45deg
    #[arg(long, value_name = "qI=VALUE,…", allow_hyphen_values = true, default_value = "")]
    #[arg(hide_default_value = true)]
    at: String,
    /// Load on the tool: base axes, at the tool origin; N and N·m, or with a unit: 50lbf
    #[arg(long, value_name = "fx,fy,fz,mx,my,mz", allow_hyphen_values = true)]
    wrench: Option<String>,
    /// Length that makes translations and rotations comparable in `condition`: 682mm [default: the
    /// characteristic length, with which the best posture is conditioned best]
    #[arg(long, value_name = "LENGTH")]
    length: Option<String>,
    #[command(flatten)]
    learnt: LearntArgs,
    /// Values of each joint
    #[arg(long, value_name = "N", default_value_t = 100)]
    #[arg(value_parser = clap::value_parser!(u16).range(2..=1000))]
    steps: u16,
    /// Write the map as a picture (`-`: to standard output)
    #[arg(long, value_name = "OUT", group = "output")]
    svg: Option<Target>,
    /// Write its numbers, a row for each cell (`-`: to standard output)
    #[arg(long, value_name = "OUT", group = "output")]
    csv: Option<Target>,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let source = args.robot.load(host)?;
    let table = source.arm()?;
    let arm = source.arm_at_its_base()?;
    let whole = Whole { arm: &arm, known: &source.known };
    let sweep = Sweep::new(&source, &arm, &args.over, &args.at, usize::from(args.steps))?;
    let learnt = Learnt::new(&args.learnt, args.of == Of::Shrink, &source, &table, host)?;
    let asked =
        Quantity::new(args.of, args.wrench.as_deref(), args.length.as_deref(), &arm, learnt)?;
    if let (Of::Condition, None) = (args.of, &args.length) {
        host.note(&format!("characteristic length L = {} m", short(asked.length)));
    }
    let cells = sweep.plane.first.len() * sweep.plane.second.len();
    let progress = Progress::new(&source.given, cells, host);
    let unstable = AtomicUsize::new(0);
    let map = sweep.plane.map(|q| {
        progress.add(1);
        // The diagnosis of a shrink knows what the file says.
        if args.of != Of::Shrink {
            source.refuse_untold("map", &whole, q, &asked.situation())?;
        }
        match asked.value(whole, q) {
            Ok(value) => Ok(value),
            Err(NoValue::Unstable) => {
                unstable.fetch_add(1, Ordering::Relaxed);
                Ok(f64::NAN)
            }
            Err(NoValue::Wrong(why)) => Err(Failure::new(why)),
        }
    });
    drop(progress);
    let (map, unstable) = (map?, unstable.into_inner());
    if unstable == cells {
        return Err(Failure::with_help(
            "the arm is not stable under this load in any posture of the map",
            "check the load, its unit and the stiffness",
        ));
    }
    host.put(&args.svg, || picture::svg(&source, &sweep, &asked, &map))?;
    host.put(&args.csv, || Ok(numbers(&sweep, &asked, &map)))?;
    let printed = [&args.svg, &args.csv].into_iter().flatten().any(|to| *to == Target::Stdout);
    if !host.is_quiet() && !printed {
        host.print(&screen(&source.robot.name, &sweep, &asked, &map, unstable))?;
    }
    Ok(Verdict::Good)
}

/// A row for each cell; empty where there is no value.
fn numbers(sweep: &Sweep, asked: &Quantity, map: &Map) -> String {
    let [first, second] = &sweep.axes;
    let mut text = format!("{},{},{}\n", first.header(), second.header(), asked.header());
    for cell in map.cells() {
        let value =
            if cell.value.is_finite() { format!("{:e}", cell.value) } else { String::new() };
        text.push_str(&format!(
            "{},{},{value}\n",
            first.shown(cell.first),
            second.shown(cell.second)
        ));
    }
    text
}

fn screen(robot: &str, sweep: &Sweep, asked: &Quantity, map: &Map, unstable: usize) -> String {
    let cells = counted(map.values.len(), "cell");
    let mut text = format!("{}\n{}\n\n", bold(robot), dim(format!("{}: {cells}", asked.name())));
    let finite = || map.cells().filter(|cell| cell.value.is_finite());
    let lowest = finite().min_by(|a, b| a.value.total_cmp(&b.value));
    let highest = finite().max_by(|a, b| a.value.total_cmp(&b.value));
    for (what, peak) in [("lowest", lowest), ("highest", highest)] {
        if let Some(peak) = peak {
            let [first, second] = &sweep.axes;
            text.push_str(&format!(
                "  {what:7}  {} {} at {} = {} {}, {} = {} {}\n",
                short(peak.value),
                asked.unit(),
                first.name,
                number((1e3 * first.shown(peak.first)).round() / 1e3),
                first.unit,
                second.name,
                number((1e3 * second.shown(peak.second)).round() / 1e3),
                second.unit,
            ));
        }
    }
    if unstable > 0 {
        let cells = counted(unstable, "cell");
        text.push_str(&format!("  empty: {cells} in which the arm is not stable under the load\n"));
    }
    text
}
