//! `stiffarm simulate`: measurements, or a joint log, of an arm with chosen effects.

mod log;

use std::path::PathBuf;

use clap::ValueEnum;
use stiffarm_document::text::{counted, short};
use stiffarm_gap::Measurements;
use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::effects::Known;
use stiffarm_gap::instrument::{Bench, Seen, View};
use stiffarm_gap::measurement::{Dimension, Kind};
use stiffarm_kernels::generic::Arm;
use stiffarm_plant::design::{Design, Shape, beside, in_view, placed};
use stiffarm_plant::{Frames, Noise, Plant, Truth, csv};

use super::Verdict;
use crate::host::Host;
use crate::input::source::{RobotArgs, Source};
use crate::input::{data, quantity};
use crate::motion::{MotionArgs, RecordArgs};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm simulate ur5 --effect 'backlash@joint 2=0.3 mrad' --csv run.csv
  stiffarm simulate arm.toml --effect 'joint_compliance@joint 2=1.5e-7 rad/(N·m)' \\
      --effect 'tool_frame:x=1mm,rz=0.5mrad' --design force --payload 500N
  stiffarm simulate arm.toml run1.csv --effect 'slip@tool:after=40,x=0.3mm' \\
      --withhold --csv blind.csv
  stiffarm simulate panda --log log.csv --effect 'presliding@joint 4:torque=0.5,distance=0.01'
  stiffarm simulate arm.toml commands.csv --log log.csv --logged position --effect latency=0.1

An EFFECT is effect@place=value, which sets its first parameter, or effect@place:name=value,…
Effects and places are those that `stiffarm diagnose` looks for; a value has its unit or is in SI.";

/// Measurements, or a joint log, of an arm with chosen effects
///
/// Exact transforms at static equilibrium on the loaded geometry, with noise. Without DATA the
/// poses and loads are drawn; with DATA they are those of the file, and only what was measured is
/// replaced. With --log the arm is moved: along the commands of DATA, or along motions that are drawn.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Take poses, loads, order and measured components of this measurement file
    data: Option<PathBuf>,
    /// What reality does and the robot file does not say [default: nothing]
    #[arg(long = "effect", value_name = "EFFECT")]
    effects: Vec<String>,
    #[command(flatten)]
    experiment: ExperimentArgs,
    /// `unknown`: measure in frames that are nowhere near those of the robot file, a base for each
    /// session
    #[arg(long)]
    frames: Option<FramesArg>,
    /// Add sim_ columns: the robot file's model to first order in the load
    #[arg(long)]
    first_order_sim: bool,
    /// Leave out of the comments what the effects are
    #[arg(long)]
    withhold: bool,
    /// Where the measurement file goes [default: standard output]
    #[arg(long, value_name = "OUT", conflicts_with = "log")]
    csv: Option<Target>,
    /// Move the arm, and write a joint log there (`-`: to standard output)
    #[arg(
        long,
        value_name = "OUT",
        group = "moved",
        conflicts_with_all = ["frames", "first_order_sim", "design", "poses", "payload", "repeats",
                              "measure", "noise_position", "noise_rotation"]
    )]
    log: Option<Target>,
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    record: RecordArgs,
}

/// What is measured, and how well.
#[derive(clap::Args)]
pub struct ExperimentArgs {
    #[command(flatten)]
    pub bench: data::BenchArgs,
    /// Which poses and loads are drawn
    #[arg(long, value_enum, conflicts_with = "data", default_value_t = DesignArg::Payload)]
    design: DesignArg,
    /// Number of poses that are drawn
    #[arg(long, value_name = "N", conflicts_with = "data", default_value_t = 40)]
    poses: usize,
    /// The full load: a mass (10kg), or a force (100N)
    #[arg(long, value_name = "LOAD", conflicts_with = "data", default_value = "10kg")]
    payload: String,
    /// How often each pose and load is measured
    #[arg(long, value_name = "R", conflicts_with = "data", default_value_t = 1)]
    repeats: usize,
    /// What is measured
    #[arg(long, value_enum, conflicts_with = "data", default_value_t = MeasureArg::Pose)]
    measure: MeasureArg,
    /// Standard deviation of each measured coordinate
    #[arg(long, value_name = "LENGTH", default_value = "30um")]
    noise_position: String,
    /// Standard deviation of each component of a measured rotation, or of each coordinate in a picture (0.2px)
    #[arg(long, value_name = "ANGLE", default_value = "0.005deg")]
    noise_rotation: String,
    /// Decides poses, loads and noise; the same seed gives the same bytes
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FramesArg {
    Unknown,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum DesignArg {
    /// No, half and full payload at every pose
    Payload,
    /// No load and three forces in various directions at every pose
    Force,
    /// Payload, within a tenth of the joints' ranges
    Narrow,
    /// Payload, every joint coming to rest from below
    OneSided,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MeasureArg {
    /// Position and orientation
    Pose,
    /// Position alone
    Position,
    /// Loaded minus unloaded, all six components
    Displacement,
    /// Distance from a fixed point that is within the arm's reach, in from_x, from_y, from_z
    Distance,
    /// Nothing but the joints: the tool's point is in one of six sockets, in unknown places
    Point,
    /// Height above one of six plates, in unknown places
    Plane,
    /// Distance from one of three ends of a wire or a ball bar, in unknown places
    Wire,
    /// A gauge of unknown zero along one of six directions
    Along,
    /// Two angles of a level on the flange, of unknown zeros
    Tilt,
    /// Where the camera of --bench, beside the arm, shows each corner of its board on the tool
    Camera,
    /// The pose of a board on the tool in the axes of a camera beside the arm, as a detector tells it
    Board,
}

/// Most rows that are drawn.
const MOST_ROWS: usize = 1_000_000;

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let source = args.robot.load(host)?;
    if let Some(target) = &args.log {
        return log::run(args, &source, target, host);
    }
    let (arm, design) = args.experiment.rows(args.data.as_ref(), &source, source.arm()?, host)?;
    let truths = args.truths(&arm)?;
    let noise = args.experiment.noise(&design)?;
    let seed = args.experiment.seed;
    let known: Vec<Known> =
        source.known.iter().filter(|known| known.is_there(&design)).cloned().collect();
    let mut plant = Plant::beyond(&arm, &known, &truths)?;
    if args.frames.is_some() {
        let others = (1..).map(|session| Frames::unknown(seed.wrapping_add(session)).base);
        let others = others.take(design.sessions().count().saturating_sub(1)).collect();
        plant = plant.with_sessions(&Frames::unknown(seed), others);
    }
    if args.first_order_sim {
        plant = plant.with_first_order_sim();
    }
    let measured = plant.seated(&plant.measure(&design, noise, seed)?)?;
    let target = args.csv.as_ref().unwrap_or(&Target::Stdout);
    host.write(target, &csv(&arm, &measured, &args.comments(&design, noise, &truths, &arm)))?;
    Ok(Verdict::Good)
}

impl Args {
    fn truths(&self, arm: &Arm) -> Result<Vec<Truth>, Failure> {
        self.effects.iter().map(|text| Ok(Truth::parse(text, arm)?)).collect()
    }

    fn comments(
        &self,
        design: &Measurements,
        noise: Noise,
        truths: &[Truth],
        arm: &Arm,
    ) -> Vec<String> {
        let rows = counted(design.rows.len(), "row");
        let poses = counted(design.poses, "pose");
        let mut lines = vec![
            format!("{}, simulated: {}, {rows} at {poses}", arm.name, design.file),
            format!(
                "noise {} um in each coordinate, {} mrad in each rotation; seed {}",
                short(1e6 * noise.position),
                short(1e3 * noise.rotation),
                self.experiment.seed
            ),
        ];
        if self.frames.is_some() {
            lines
                .push("measured in unknown frames: base_frame and tool_frame are nuisances".into());
        }
        lines.extend(self.told(truths));
        lines
    }

    /// What was put in, if it may be told.
    fn told(&self, truths: &[impl core::fmt::Display]) -> Vec<String> {
        match truths {
            _ if self.withhold => vec!["effects withheld".to_owned()],
            [] => vec!["no effect: the arm is as the robot file says".to_owned()],
            some => some.iter().map(|truth| format!("effect {truth} (SI)")).collect(),
        }
    }
}

impl ExperimentArgs {
    /// The rows that are to be measured, of the file or drawn; and the arm where what measures it has it.
    pub fn rows(
        &self,
        file: Option<&PathBuf>,
        source: &Source,
        arm: Arm,
        host: &Host,
    ) -> Result<(Arm, Measurements), Failure> {
        let layout = self.bench.layout(source, host)?;
        let Some(path) = file else {
            let arm = if self.is_by_camera() { Arm { base: beside(&arm), ..arm } } else { arm };
            let design = self.drawn(&arm, &layout.bench, 0)?;
            return Ok((arm, design));
        };
        let mut design = data::read_plan(path, &layout, host)?;
        // What the file measures is replaced, its frames with it.
        data::doubted(&arm, &design, &Nuisance::ALL, host);
        if !design.by_camera {
            let design = placed(&arm, &design);
            return Ok((arm, design));
        }
        let arm = in_view(&arm, &mut design, &layout.bench)
            .map_err(|fault| Failure::new(format!("{}: {fault}", path.display())))?;
        Ok((arm, design))
    }

    /// Whether a camera measures what is drawn.
    fn is_by_camera(&self) -> bool {
        matches!(self.measure, MeasureArg::Camera | MeasureArg::Board)
    }

    fn drawn(&self, arm: &Arm, bench: &Bench, more: u64) -> Result<Measurements, Failure> {
        let design = self.design()?;
        let design = Design { seed: design.seed.wrapping_add(more), ..design };
        let refused = |fault| Failure::new(format!("--measure camera: {fault}"));
        Ok(match self.measure {
            MeasureArg::Camera => design.shown(arm, bench).map_err(refused)?,
            MeasureArg::Board => design.detected(arm),
            MeasureArg::Wire => design.read_by(arm, Seen::Distance),
            MeasureArg::Along => design.read_by(arm, Seen::Direction),
            _ => design.rows(arm),
        })
    }

    /// Four sessions of the same design at other poses.
    pub fn other_sessions(
        &self,
        source: &Source,
        arm: &Arm,
        host: &Host,
    ) -> Result<Vec<Measurements>, Failure> {
        let bench = self.bench.layout(source, host)?.bench;
        (1..=4).map(|more| self.drawn(arm, &bench, more)).collect()
    }

    fn design(&self) -> Result<Design, Failure> {
        for (option, found) in [("--poses", self.poses), ("--repeats", self.repeats)] {
            if found == 0 {
                return Err(Failure::new(format!("{option}: found 0, expected at least 1")));
            }
        }
        if self.poses.saturating_mul(self.repeats).saturating_mul(4) > MOST_ROWS {
            let message = format!(
                "--poses {} with --repeats {}: expected at most {MOST_ROWS} rows",
                self.poses, self.repeats
            );
            return Err(Failure::with_help(message, "measure fewer poses or repeats"));
        }
        let payload = payload(&self.payload)?;
        if self.measure == MeasureArg::Displacement && payload == 0.0 {
            return Err(Failure::with_help(
                "--measure displacement: found no load, expected one",
                "a displacement is loaded minus unloaded: give a --payload",
            ));
        }
        Ok(Design {
            shape: match self.design {
                DesignArg::Payload => Shape::Payload,
                DesignArg::Force => Shape::Force,
                DesignArg::Narrow => Shape::Narrow,
                DesignArg::OneSided => Shape::OneSided,
            },
            poses: self.poses,
            repeats: self.repeats,
            payload,
            kind: match self.measure {
                MeasureArg::Pose | MeasureArg::Board => Kind::Pose { orientation: true },
                MeasureArg::Position => Kind::Pose { orientation: false },
                MeasureArg::Displacement => Kind::Displacement { components: [true; 6] },
                MeasureArg::Distance => Kind::Distance,
                MeasureArg::Point => Kind::Bench { lengths: 3, angles: false },
                MeasureArg::Plane | MeasureArg::Wire | MeasureArg::Along => {
                    Kind::Bench { lengths: 1, angles: false }
                }
                MeasureArg::Camera | MeasureArg::Tilt => Kind::Bench { lengths: 0, angles: true },
            },
            seed: self.seed,
        })
    }

    /// The noise of the instrument that measures a design.
    pub fn noise(&self, design: &Measurements) -> Result<Noise, Failure> {
        let read = |option: &str, text: &str, dimension: Dimension| {
            let bare = quantity::read(text, None).is_some();
            let value = quantity::read(text, Some(dimension)).filter(|x| *x >= 0.0 && !bare);
            value.ok_or_else(|| {
                let units = dimension.units();
                Failure::new(format!(
                    "{option}: found `{text}`, expected a number that is not negative and its \
                     unit, one of {units}"
                ))
            })
        };
        let camera = design.rows.first().and_then(|row| row.view(design.kind));
        let rotation = match camera {
            Some(View::Camera { lens, .. }) if self.noise_rotation.trim().ends_with("px") => {
                read("--noise-rotation", &self.noise_rotation, Dimension::Pixels)? / lens.focus
            }
            _ => read("--noise-rotation", &self.noise_rotation, Dimension::Angle)?,
        };
        let position = read("--noise-position", &self.noise_position, Dimension::Length)?;
        Ok(Noise { position, rotation })
    }
}

/// What hangs at the tool, kg: a mass, or the mass whose weight is a force.
fn payload(text: &str) -> Result<f64, Failure> {
    const STANDARD_GRAVITY: f64 = 9.80665;
    let mass = text.trim().strip_suffix("kg").unwrap_or(text);
    let of_force = || quantity::read(text, Some(Dimension::Force)).map(|f| f / STANDARD_GRAVITY);
    let read = quantity::read(mass, None).or_else(of_force);
    read.filter(|mass| (0.0..=1e9).contains(mass)).ok_or_else(|| {
        let forces = Dimension::Force.units();
        Failure::new(format!(
            "--payload: found `{text}`, expected a mass in kg, or a force in one of {forces}"
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_payload_is_a_mass_or_a_force() {
        assert_eq!(payload("12.5kg").unwrap(), 12.5);
        assert_eq!(payload(" 3 ").unwrap(), 3.0);
        assert_eq!(payload("9.80665 N").unwrap(), 1.0);
        assert_eq!(payload("2kgf").unwrap(), 2.0);
        for wrong in ["", "heavy", "-1kg", "10mm", "1e12kg", "nankg"] {
            assert!(payload(wrong).is_err(), "{wrong}");
        }
    }
}
