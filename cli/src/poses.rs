//! `stiffarm poses`: a measurement file that is still to be measured.

mod file;
mod motion;
mod screen;

use clap::ValueEnum;
use nalgebra::Vector6;
use stiffarm_document::text::counted;
use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::instrument::{Lens, View};
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::whole::Whole;
use stiffarm_kernels::generic::Arm;
use stiffarm_study::dexterity::design::{Plan, Purpose, Station, Suspect, design};

use super::Verdict;
use crate::host::Host;
use crate::input::data::BenchArgs;
use crate::input::quantity;
use crate::input::source::{RobotArgs, Source};
use crate::input::wrench::wrench;
use crate::motion::MotionArgs;
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;
use crate::terminal::progress::{PARTS, Progress};

const EXAMPLES: &str = "\
Examples:
  stiffarm poses arm.toml --count 20 --load 0,0,-50kgf,0,0,0 --csv plan.csv
  stiffarm poses kuka_kr240 --count 15 --load 0,0,-2kN,0,0,0 --load 2kN,0,0,0,0,0 --csv plan.csv
  stiffarm poses arm.toml --count 30 --for diagnose --load 0,0,-100,0,0,0 --csv plan.csv
  stiffarm poses arm.toml --count 30 --for diagnose --bench sockets.toml --csv plan.csv
  stiffarm poses arm.toml --count 10 --for separate 'joint_compliance@joint 2' \\
      'link_compliance@link 2' --load 0,0,-2kN,0,0,0 --load 0,1kN,0,0,0,0 --csv plan.csv

  stiffarm poses panda --for motion --period 20s --max-rate 1.2 --csv commands.csv

Postures are drawn within the joint limits; those that are not dexterous are left out, and those in
which the loaded geometry (K_C) would matter most. Of the rest, each with one of the loads, those
are chosen that together say most (D-optimality). For `identify` each posture is one displacement,
loaded minus unloaded; for `diagnose` each is two poses, without a load and with one. With --bench the
tool is in a [[point]] or on a [[plane]] at every posture, or, where the bench has one, the whole of a
[[board]] in the picture of its [[camera]], and no joint is below a plane; what says where they are need only be rough. For `separate`
those are chosen in which neither of two effects can pass for the other (T-optimality): name both as
`stiffarm diagnose` does, effect@place (`transmission_error@joint 2:cos 20` for one of its forms).

For `motion` the joints are sent along a Fourier series that holds the limits and begins and ends at
rest, and whose log says most of what friction, rotors and the like do (D-optimality): of the effects
that are named, or of the usual ones; two that are named are told from each other (T-optimality). The
file is what a controller and `stiffarm simulate --log` take.

Fill in the empty columns, put the readings that the controller shows into q1 … qn, and give the
file to `stiffarm identify` or `stiffarm diagnose`. Nothing here knows of floor, cables or cell:
leave out the rows that cannot be reached.";

/// Test postures and loads that say most, as a measurement file to fill in
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// How many postures; not of a motion
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    count: Option<u16>,
    /// What the measurements are for
    #[arg(long = "for", value_enum, value_name = "PURPOSE", default_value_t = For::Identify)]
    purpose: For,
    /// The two effects of `--for separate`, or those of `--for motion`, each effect@place
    #[arg(value_name = "EFFECT")]
    effects: Vec<String>,
    /// Frames known to be unknown, fitted along by `--for separate`: base_frame, tool_frame
    #[arg(long, value_name = "a,b", value_delimiter = ',')]
    nuisance: Vec<String>,
    /// A load to choose from, given as often as there are loads; base axes, at the tool origin; N
    /// and N·m, or with a unit [default: pulls of 100 N along ±x, ±y and −z]
    #[arg(long = "load", value_name = "fx,fy,fz,mx,my,mz", allow_hyphen_values = true)]
    loads: Vec<String>,
    #[command(flatten)]
    bench: BenchArgs,
    /// Rotations will be measured too
    #[arg(long)]
    rotations: bool,
    /// Standard deviation of a measured coordinate
    #[arg(long, value_name = "LENGTH", default_value = "30um", allow_hyphen_values = true)]
    noise_position: String,
    /// Standard deviation of a measured rotation, or of a coordinate in a picture (0.2px)
    #[arg(long, value_name = "ANGLE", default_value = "0.1mrad", allow_hyphen_values = true)]
    noise_rotation: String,
    /// Seed of the postures that are chosen from; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the measurement file, or the commands (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT", group = "moved")]
    csv: Target,
    #[command(flatten)]
    motion: MotionArgs,
}

/// What the measurements are for.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum For {
    /// The joints' stiffnesses
    Identify,
    /// Zeros and stiffnesses of the joints, and whatever else shows
    Diagnose,
    /// To tell two effects apart: give both behind it
    Separate,
    /// Joint logs of an arm that moves: commands instead of postures
    Motion,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let source = args.robot.load(host)?;
    if args.purpose == For::Motion {
        return motion::run(args, &source, host);
    }
    if let Some(option) = args.motion.given() {
        return Err(Failure::new(format!("{option} is for --for motion")));
    }
    let arm = source.arm_at_its_base()?;
    let whole = Whole { arm: &arm, known: &source.known };
    let plan = args.at_bench(args.plan(&arm)?, &source, host)?;
    let progress = Progress::new(&source.given, PARTS, host);
    let found = design(whole, &plan, &|part| progress.reach(part, PARTS));
    drop(progress);
    let found = found?;
    host.write(&args.csv, &file::file(&source, &plan, &found))?;
    if args.csv != Target::Stdout && !host.is_quiet() {
        host.print(&screen::screen(&source, &arm, &plan, &found))?;
    }
    Ok(Verdict::Good)
}

impl Args {
    /// The same where something of a bench is read.
    fn at_bench(&self, plan: Plan, source: &Source, host: &Host) -> Result<Plan, Failure> {
        if !self.bench.is_given() {
            return Ok(plan);
        }
        let bench = self.bench.layout(source, host)?.bench;
        let (places, looks) = (bench.places(), bench.looks());
        if places.is_empty() && looks.is_empty() {
            let help = "give each [[point]] its `at`, each [[plane]] its `normal` and `offset`, a [[camera]] and its \
                        [[board]] their `at` and `rotation`, roughly";
            return Err(Failure::with_help("--bench: found nothing whose place is known", help));
        }
        if self.purpose != For::Diagnose {
            return Err(Failure::new("--bench is for --for diagnose"));
        }
        let noise_rotation = match looks.first() {
            Some(look) => Some(self.angle(Some(&look.lens))?),
            None => plan.noise_rotation,
        };
        let plates = places.iter().filter_map(|aim| match aim.view {
            View::Plane(plane) => Some(plane),
            _ => None,
        });
        let plates = plates.collect();
        // Beside a camera a plate is a table, and what else the bench has is another plan's.
        let bench = match looks.is_empty() {
            true => places.into_iter().map(Station::Thing).collect(),
            false => looks.into_iter().map(Station::Board).collect(),
        };
        Ok(Plan { bench, plates, noise_rotation, ..plan })
    }

    /// Standard deviation of an angle, or of a coordinate in a picture.
    fn angle(&self, lens: Option<&Lens>) -> Result<f64, Failure> {
        let text = self.noise_rotation.trim();
        let read = |dimension| quantity::with_unit("--noise-rotation", text, dimension);
        match lens {
            Some(lens) if text.ends_with("px") => Ok(read(Dimension::Pixels)? / lens.focus),
            _ => read(Dimension::Angle),
        }
    }

    fn plan(&self, arm: &Arm) -> Result<Plan, Failure> {
        let given = self.loads.iter().map(|text| wrench("--load", text));
        let mut loads: Vec<Vector6<f64>> = given.collect::<Result<_, _>>()?;
        if loads.is_empty() {
            let pull = |x: f64, y: f64, z: f64| Vector6::new(x, y, z, 0.0, 0.0, 0.0) * 100.0;
            loads = vec![
                pull(1.0, 0.0, 0.0),
                pull(-1.0, 0.0, 0.0),
                pull(0.0, 1.0, 0.0),
                pull(0.0, -1.0, 0.0),
                pull(0.0, 0.0, -1.0),
            ];
        }
        Ok(Plan {
            count: usize::from(self.count.ok_or_else(|| {
                Failure::new("found no --count, expected how many postures: --count 20")
            })?),
            purpose: self.purpose(arm)?,
            along: self.along(arm)?,
            loads,
            bench: Vec::new(),
            plates: Vec::new(),
            noise_position: quantity::with_unit(
                "--noise-position",
                &self.noise_position,
                Dimension::Length,
            )?,
            noise_rotation: self.rotations.then(|| self.angle(None)).transpose()?,
            seed: self.seed,
        })
    }

    fn purpose(&self, arm: &Arm) -> Result<Purpose, Failure> {
        let suspect = |text: &String| {
            let suspect = Suspect::parse(text, arm, &Catalogue::default());
            suspect.map_err(|error| Failure::new(format!("--for: {error}")))
        };
        let found = self.effects.len();
        match (self.purpose, &self.effects[..]) {
            (For::Identify, []) => Ok(Purpose::Identify),
            (For::Diagnose | For::Motion, []) => Ok(Purpose::Diagnose),
            (For::Separate, [a, b]) => Ok(Purpose::Separate([suspect(a)?, suspect(b)?])),
            (For::Separate, _) => Err(Failure::with_help(
                format!("--for separate: found {}, expected two", counted(found, "effect")),
                "name both: --for separate 'joint_compliance@joint 2' 'link_compliance@link 2'",
            )),
            (_, [first, ..]) => Err(Failure::new(format!(
                "found `{first}`, expected an option: effects are named for --for separate"
            ))),
        }
    }

    fn along(&self, arm: &Arm) -> Result<Vec<Suspect>, Failure> {
        if self.purpose != For::Separate && !self.nuisance.is_empty() {
            return Err(Failure::new("--nuisance is for --for separate"));
        }
        let each = self.nuisance.iter().map(|name| {
            let known = Nuisance::parse(name)?;
            Ok(Suspect::parse(known.identifier(), arm, &Catalogue::default())?)
        });
        each.collect()
    }
}
