//! `stiffarm controller`: what was found, as the files that controllers take.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use nalgebra::Isometry3;
use stiffarm_compensate::controller::{
    ControllerError, Holds, calibration, joint_limits, kinematics, lost, mastering, model, origins,
};
use stiffarm_gap::effects::Known;
use stiffarm_kernels::generic::Arm;

use super::Verdict;
use crate::host::Host;
use crate::input::source::{RobotArgs, Source};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm controller better.toml --format ur-calibration --nominal ur10 --into calibration.conf --out new.conf
  stiffarm controller better.toml --format ur-kinematics --hash calib_17227329492635474227 --out kinematics.yaml
  stiffarm controller better.toml --format kuka-mastering --nominal arm.toml --into '$machine.dat' --out new.dat
  stiffarm controller better.toml --format joint-limits --out joint_limits.yaml
  stiffarm controller better.toml --format xacro --out origins.xacro

A file holds what its format can: the zeros of the axes, or whole rows of the table. Everything else that the
robot file has is named and lost; `stiffarm compensate --program` corrects programs by all of it.";

/// What was found as a controller's file: UR's calibration, KUKA's mastering, ROS's kinematics and joint limits
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Which file
    #[arg(long, value_enum)]
    format: Format,
    /// The robot as its controller computes it: a robot file, the id of a built-in robot, or urcontrol.conf of a
    /// Universal Robots controller (a file that ends with .conf)
    #[arg(long, value_name = "ROBOT")]
    nominal: Option<String>,
    /// The controller's own file, of which what was found is changed and nothing else
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
    /// The hash of the robot's own kinematics file, which its driver compares
    #[arg(long, value_name = "HASH")]
    hash: Option<String>,
    /// Write here (`-`: to standard output)
    #[arg(long, value_name = "FILE", default_value = "-")]
    out: Target,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// calibration.conf of a Universal Robots controller: delta_theta, delta_a, delta_d, delta_alpha
    UrCalibration,
    /// The kinematics file of the ROS package ur_description
    UrKinematics,
    /// $MAMES in KUKA's $machine.dat: the zeros of the axes, which act when the axes are mastered again
    KukaMastering,
    /// joint_limits.yaml of ros2_control and MoveIt: the limits of positions
    JointLimits,
    /// The origins of the joints and of the tool as properties of xacro
    Xacro,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    args.go_together()?;
    let source = args.robot.load(host)?;
    let real = source.arm()?;
    let nominal = args.nominal.as_deref().map(|robot| computed(robot, host)).transpose()?;
    let has = |arm: &Arm| arm.joints.len();
    if let Some(found) = nominal.as_ref().map(has).filter(|found| *found != has(&real)) {
        let message = format!("--nominal: found {found} joints, expected {}", has(&real));
        return Err(Failure::new(message));
    }
    let own = match &args.into {
        Some(path) => Some((path, host.read(path)?)),
        None => None,
    };
    let told = |error: ControllerError| {
        let name = match (&own, &error) {
            (Some((path, _)), ControllerError::Missing(..) | ControllerError::Entry { .. }) => {
                path.display().to_string()
            }
            _ => source.robot.name.clone(),
        };
        Failure::new(format!("{name}: {error}"))
    };
    let lost = args.lost(nominal.as_ref(), &real, &source);
    let text = match (args.format, &nominal, &own) {
        (Format::UrCalibration, Some(nominal), own) => {
            let own = own.as_ref().map(|(_, bytes)| bytes.as_slice());
            calibration(own, nominal, &real).map_err(told)?
        }
        (Format::KukaMastering, Some(nominal), Some((_, own))) => {
            mastering(own, nominal, &real, lost.as_deref()).map_err(told)?
        }
        (Format::UrKinematics, ..) => {
            kinematics(&real, args.hash.as_deref().unwrap_or("calib_unknown")).map_err(told)?.into()
        }
        (Format::Xacro, ..) => origins(&real, &names(&source), lost.as_deref()).into(),
        _ => joint_limits(&real, &names(&source)).map_err(told)?.into(),
    };
    // YAML has comments, too.
    let head = match (&lost, args.format) {
        (Some(lost), Format::UrKinematics) => format!("# {lost}\n"),
        _ => String::new(),
    };
    let text = [head.as_bytes(), &text].concat();
    host.stream(&args.out, &mut |to| to.write_all(&text).map(|()| true))?;
    lost.iter().for_each(|lost| host.note(lost));
    if args.format == Format::UrKinematics && args.hash.is_none() {
        host.note(
            "the hash is not the robot's, and its driver will say so: give its own by --hash",
        );
    }
    Ok(Verdict::Good)
}

impl Args {
    /// What the format does not hold, a sentence.
    fn lost(&self, nominal: Option<&Arm>, real: &Arm, source: &Source) -> Option<String> {
        let holds = match self.format {
            Format::UrCalibration | Format::UrKinematics | Format::Xacro => Holds::Rows,
            Format::KukaMastering => Holds::Zeros,
            // Limits are not what was found: nothing of that is asked for.
            Format::JointLimits => return None,
        };
        // A kinematics file has the whole table: what it lacks is what stands around it, which origins have, too.
        let bare = || match self.format {
            Format::Xacro => real.clone(),
            _ => Arm { base: Isometry3::identity(), tool: Isometry3::identity(), ..real.clone() },
        };
        let mut lost = lost(&nominal.cloned().unwrap_or_else(bare), real, holds);
        let name = |id: &str, place: &dyn std::fmt::Display| {
            format!("{} at {place}", id.replace('_', " "))
        };
        let known = |known: &Known| name(known.effect.identifier(), &known.spot.place);
        lost.extend(source.known.iter().map(known));
        let moves = source.in_motion_alone();
        lost.extend(moves.map(|effect| name(&effect.id.value, &effect.place.value)));
        let is_some = !lost.is_empty();
        is_some.then(|| format!("the format does not hold {}", lost.join("; ")))
    }

    fn go_together(&self) -> Result<(), Failure> {
        let needs_nominal = matches!(self.format, Format::UrCalibration | Format::KukaMastering);
        if needs_nominal && self.nominal.is_none() {
            let help = "give the robot as its controller computes it: --nominal ROBOT";
            return Err(Failure::with_help("found no --nominal: the file holds differences", help));
        }
        if self.format == Format::KukaMastering && self.into.is_none() {
            let help = "give the controller's own $machine.dat: --into FILE";
            let message =
                "found no --into: the zeros add to the ones that the axes were mastered with";
            return Err(Failure::with_help(message, help));
        }
        for (option, given, fits) in [
            ("--nominal", self.nominal.is_some(), needs_nominal),
            ("--into", self.into.is_some(), needs_nominal),
            ("--hash", self.hash.is_some(), self.format == Format::UrKinematics),
        ] {
            if given && !fits {
                return Err(Failure::new(format!("{option} is not for this format")));
            }
        }
        Ok(())
    }
}

/// The robot as its controller computes it.
fn computed(robot: &str, host: &Host) -> Result<Arm, Failure> {
    let path = Path::new(robot);
    match path.extension() {
        Some(end) if end == "conf" => {
            let model = model(&host.read(path)?);
            model.map_err(|error| Failure::new(format!("{robot}: {error}")))
        }
        _ => RobotArgs::named(robot).load(host)?.arm(),
    }
}

/// Of the joints, as names of parameters.
fn names(source: &Source) -> Vec<String> {
    source.robot.joints.iter().map(|joint| joint.name.replace(' ', "_")).collect()
}
