//! `stiffarm import`: a robot file from a URDF.

use std::path::PathBuf;

use stiffarm_codegen::robot::urdf::{self, Chain, Frame, Refusal, Table, Urdf, robot_file};
use stiffarm_codegen::robot::{Motion, Robot};

use super::Verdict;
use crate::diagnose::commented;
use crate::host::Host;
use crate::input::source::text;
use crate::terminal::failure::{Failure, Remark};
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm import arm.urdf > arm.toml
  stiffarm import arm.urdf --base base_link --tip tool0 --toml arm.toml
  xacro arm.xacro > arm.urdf && stiffarm import arm.urdf --toml arm.toml

Any serial chain of joints that turn or slide: fixed joints are folded away, each axis becomes a row
of the modified Denavit-Hartenberg convention, inertials become mass and com, limits are kept. The
zero of every joint is the URDF's. A URDF knows no stiffness: add `stiffness = …` to the rows.

Where a row cannot place axis 1 in the URDF's base link, `[base]` does; axes that are parallel but for
an error have `beta`, Hayati's parameter. Before the file is written, its forward kinematics is
compared with the URDF's.";

/// A robot file from a URDF: any serial chain, exactly
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// The URDF
    urdf: PathBuf,
    /// The link at the end of the chain [default: the only link on which nothing hangs]
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// The link at its foot [default: the root]
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// Write the robot file to OUT [default: standard output]
    #[arg(long, value_name = "OUT", default_value = "-", hide_default_value = true)]
    toml: Target,
    /// Keep 1.5708 as 1.5708: by default a rounding of a simple multiple of π is that multiple
    #[arg(long)]
    as_written: bool,
}

/// Postures in which the file is compared with the URDF.
const POSTURES: usize = 100;

/// More than this, m and rad, is no rounding.
const AGREES: f64 = 1e-9;

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let file = args.urdf.display().to_string();
    let source = text(&args.urdf, host)?;
    let chosen = (args.base.as_deref(), args.tip.as_deref());
    let (written, remarks) = imported(&file, &source, chosen, args.as_written)?;
    remarks.iter().for_each(|remark| host.note(remark));
    host.write(&args.toml, &written)?;
    Ok(Verdict::Good)
}

/// The text of a robot file from that of a URDF, from its link `base` to its link `tip`, and what a user must
/// know of it.
pub fn imported(
    file: &str,
    source: &str,
    (base, tip): (Option<&str>, Option<&str>),
    as_written: bool,
) -> Result<(String, Vec<String>), Failure> {
    let shown = |refusal| failure(&refusal, file, source);
    let urdf = urdf::read(source, as_written).map_err(shown)?;
    let chain = Chain::new(&urdf.robot, base, tip).map_err(shown)?;
    let table = Table::new(&chain);
    let robot = robot_file(&chain, &table);
    let mut remarks = remarks(&urdf, &chain, &table);
    let head = format!(
        "Imported by stiffarm from {file}: from link `{}` to link `{}`.",
        chain.base, chain.tip
    );
    let written = commented(std::iter::once(head).chain(remarks.iter().cloned()).collect(), &robot);
    let deviation = deviation(&chain, &written)?;
    if deviation.is_nan() || deviation > AGREES {
        let message = format!("{file}: no table in double precision holds this chain");
        return Err(Failure::new(message));
    }
    remarks.push(format!(
        "forward kinematics as in the URDF to {deviation:.0e} m and rad at {POSTURES} random postures"
    ));
    Ok((written, remarks))
}

fn failure(refusal: &Refusal, file: &str, source: &str) -> Failure {
    let span = urdf::bytes(source, &refusal.place);
    let Refusal { message, help, .. } = refusal;
    Failure::File(vec![Remark::error(message.clone(), help.clone(), file, source, span)])
}

/// What the file cannot say in its rows.
fn remarks(urdf: &Urdf, chain: &Chain, table: &Table) -> Vec<String> {
    let mut remarks = Vec::new();
    if table.base != Frame::IDENTITY {
        remarks.push(format!(
            "`[base]` says where axis 1 stands in link `{}`: no row of a table could",
            chain.base
        ));
    }
    let on_the_way = |joint: &str| chain.steps.iter().any(|step| step.name == joint);
    for (joint, found, exact) in &urdf.rounded {
        let off = (found - exact).abs();
        if on_the_way(joint) || off > AGREES {
            remarks.push(format!(
                "joint `{joint}`: {found} rad is read as {} (off by {off:.0e} rad; --as-written \
                 keeps it)",
                multiple(*exact)
            ));
        }
    }
    remarks.extend(chain.remarks.iter().cloned());
    remarks
}

/// `pi/2`, `-2*pi/3`.
fn multiple(x: f64) -> String {
    let n = [1.0, 2.0, 3.0, 4.0, 6.0].into_iter().find(|n| {
        let k = x * n / core::f64::consts::PI;
        (k - k.round()).abs() < 1e-9
    });
    let n = n.unwrap_or(1.0);
    let k = (x * n / core::f64::consts::PI).round();
    let times = match k {
        1.0 => String::new(),
        -1.0 => "-".to_owned(),
        k => format!("{k}*"),
    };
    if n == 1.0 { format!("{times}pi") } else { format!("{times}pi/{n}") }
}

/// The largest difference of the tip's pose by the written file and by the URDF, m and rad.
fn deviation(chain: &Chain, written: &str) -> Result<f64, Failure> {
    let unsound = |error: String| Failure::new(format!("the robot file is not sound: {error}"));
    let (robot, _) = Robot::from_toml(written, "the imported robot")
        .map_err(|error| unsound(error.to_string()))?;
    let arm = stiffarm_gap::robot::arm(&robot).map_err(|error| unsound(error.to_string()))?;
    let mut worst = 0.0_f64;
    for posture in 0..POSTURES {
        // Fractions of the golden ratio and its like: spread evenly, the same for every run.
        let part = |k: usize| (0.5 + posture as f64 * 0.618_034 + k as f64 * 0.414_214).fract();
        let value = |(k, step): (usize, &urdf::Step)| {
            let range = match step.motion {
                Motion::Revolute => core::f64::consts::PI,
                Motion::Prismatic => 1.0,
            };
            let [low, high] = step.limits.unwrap_or([-range, range]);
            low + (high - low) * part(k * (1 + posture % 7))
        };
        let q: Vec<f64> = chain.steps.iter().enumerate().map(value).collect();
        let (ours, theirs) = (arm.pose(&q), chain.pose(&q));
        let axes = ours.rotation.to_rotation_matrix();
        let axes = core::array::from_fn(|c| axes.matrix().column(c).into_owned().into());
        let ours = Frame { axes, origin: ours.translation.vector.into() };
        let numbers = |frame: &Frame| frame.axes.concat().into_iter().chain(frame.origin);
        for (a, b) in numbers(&ours).zip(numbers(&theirs)) {
            let off = (a - b).abs();
            if off.is_nan() {
                return Ok(f64::INFINITY);
            }
            worst = worst.max(off);
        }
    }
    Ok(worst)
}
