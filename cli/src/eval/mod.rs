//! `stiffarm eval`: everything elastostatic at one posture under one load, or the postures of one pose.

mod pose;

use nalgebra::Vector6;
use serde::Serialize;
use stiffarm_codegen::derive::Given;
use stiffarm_document::text::{Align, bold, counted, decimals, dim, indented, minus, table};
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_kernels::Output;
use stiffarm_kernels::generic::Arm;

use super::Verdict;
use crate::host::Host;
use crate::input::model::Model;
use crate::input::quantity;
use crate::input::source::{RobotArgs, Source};
use crate::input::wrench::wrench;
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm eval ur5 --q 0,-90deg,90deg,0,90deg,0 --wrench 0,0,-100,0,0,0
  stiffarm eval kuka_kr240 --q 0.1,-0.8,0.6,0,0.4,0 --wrench 0,0,-500,0,0,0 --json state.json
  stiffarm eval better.toml --q 0,0.5,0,0,0,0 --sides 1,-1,1,1,1,-1 --warming 8
  stiffarm eval kuka_kr240 --pose 1.6,0.2,1.1,0,90deg,0 --wrench 0,0,-2000,0,0,0
  stiffarm eval panda --pose 0.4,0.1,0.5,180deg,0,0 --q 0,0,0,-90deg,0,90deg,45deg
  stiffarm eval iiwa14 --pose 0.5,0.1,0.6,180deg,0,0 --given elbow_angle=20deg
  stiffarm eval lin_planar_symbolic --set L1=24in … --q 0,0 --json - | jq .deflection

--pose asks for the inverse: every branch of the arm's closed form, or of the nearest table's with the steps from
there to the arm of the file, its effects and (with --wrench or --gravity) what it gives included; what a
branch misses the pose by; and which are within the limits. Of seven joints the pose leaves one free: every
branch has the last one (or the first) as --q has it, or what --given names. Where no table with a closed form is
near, every solution is searched for.";

/// Pose, Jacobian, stiffness and deflection at one posture under one load
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Joint values, base to tip: rad (m if prismatic), or with a unit: 30deg, 50mm
    #[arg(long, value_name = "q1,q2,…", allow_hyphen_values = true)]
    #[arg(required_unless_present = "pose")]
    q: Option<String>,
    /// Pose of the tool in the base frame, in place of joint values: coordinates and rotation vector; every branch
    /// of the inverse kinematics is told, by whole turns near --q
    #[arg(long, value_name = "x,y,z,rx,ry,rz", allow_hyphen_values = true)]
    pose: Option<String>,
    /// Of seven joints what every branch has as --q has it, or as it is told here: a joint by its name or number, or
    /// elbow_angle of an arm with a spherical shoulder and wrist [default: the last joint, or the first]
    #[arg(long, value_name = "WHAT[=VALUE]", requires = "pose")]
    given: Option<String>,
    /// Load on the tool: base axes, at the tool origin; N and N·m, or with a unit: 50lbf
    #[arg(long, value_name = "fx,fy,fz,mx,my,mz", allow_hyphen_values = true)]
    wrench: Option<String>,
    /// From which side each joint came to rest, base to tip: -1, 0 (unknown) or 1
    #[arg(long, value_name = "s1,s2,…", allow_hyphen_values = true, value_delimiter = ',')]
    #[arg(value_parser = clap::value_parser!(i8).range(-1..=1))]
    sides: Option<Vec<i8>>,
    /// How much warmer the arm is than when it was measured, K
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    warming: Option<f64>,
    /// Let the links' weights count: in deflection, joint torque and K_C
    #[arg(long)]
    gravity: bool,
    /// Write the result as JSON (`-`: to standard output) instead of a table
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
}

/// The result as the format has it; matrices row by row.
#[derive(Serialize)]
struct Evaluation {
    position: Vec<f64>,
    rotation: Vec<Vec<f64>>,
    jacobian: Vec<Vec<f64>>,
    k_c: Vec<Vec<f64>>,
    compliance: Vec<Vec<f64>>,
    deflection: Vec<f64>,
    joint_torque: Vec<f64>,
}

const OUTPUTS: [Output; 8] = [
    Output::Pose,
    Output::Jacobian,
    Output::ComplementaryStiffness,
    Output::JointTorque,
    Output::WeightTorque,
    Output::WeightStiffness,
    Output::Compliance,
    Output::Deflection,
];

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let source = args.robot.load(host)?;
    let arm = source.arm()?;
    let q = args.q.as_ref().map(|q| quantity::list("--q", q, &source.readings(), &joints(&source)));
    let q = q.transpose()?.unwrap_or_default();
    let given = args.wrench.as_ref().map(|text| wrench("--wrench", text)).transpose()?;
    let given = given.unwrap_or_default();
    if let Some(at) = &args.pose {
        let beside = given_beside(args, &source, &arm)?;
        let at = pose::read(at)?;
        let result = pose::inverse(&source, args, (&at, &q), (&given, &beside))?;
        match &args.json {
            Some(target) => host.write(target, &json::text(&result)?)?,
            None => host.print(&pose::screen(&source, &result))?,
        }
        return Ok(Verdict::Good);
    }
    // The kernels know the axes of the world in which the base stands, and no others.
    let base = arm.base.rotation;
    let (force, moment) = (base * given.fixed_rows::<3>(0), base * given.fixed_rows::<3>(3));
    let wrench = [force.x, force.y, force.z, moment.x, moment.y, moment.z];
    let deflection = if args.gravity { Output::DeflectionWithGravity } else { Output::Deflection };
    let robot = source.for_kernels()?;
    let given = given_beside(args, &source, &arm)?;
    let model = Model::new(&robot, &[&OUTPUTS[..7], &[deflection]].concat());
    let result = evaluate(&model, (&q, &given), &wrench, args.gravity, deflection)?;
    match &args.json {
        Some(target) => host.write(target, &json::text(&result)?)?,
        None => host.print(&screen(&source, &q, &wrench, args.gravity, &result))?,
    }
    Ok(Verdict::Good)
}

/// What is said beside posture and load: all that the arm's effects depend on.
fn given_beside(args: &Args, source: &Source, arm: &Arm) -> Result<Given, Failure> {
    if let Some(sides) = args.sides.as_ref().filter(|sides| sides.len() != arm.dof()) {
        let found = counted(sides.len(), "value");
        let message = format!("--sides: found {found}, expected {}", arm.dof());
        return Err(Failure::with_help(message, joints(source)));
    }
    if let Some(warming) = args.warming.filter(|warming| !warming.is_finite()) {
        return Err(Failure::new(format!("--warming: found {warming}, expected a finite number")));
    }
    let at = Situation {
        direction: args.sides.clone(),
        warming: args.warming,
        ..Situation::under(Vector6::zeros())
    };
    source.refuse_undecided("eval", &Whole { arm, known: &source.known }, &at)?;
    let sides = args.sides.iter().flatten().map(|side| f64::from(*side)).collect();
    Ok(Given { sides, warming: args.warming.unwrap_or_default(), ..Given::default() })
}

fn joints(source: &Source) -> String {
    let n = source.robot.dof();
    let joints = counted(n, "joint");
    format!("{} has {joints}: one value for each, base to tip", source.robot.name)
}

fn evaluate(
    model: &Model,
    (q, given): (&[f64], &Given),
    wrench: &[f64; 6],
    gravity: bool,
    deflection: Output,
) -> Result<Evaluation, Failure> {
    let n = q.len();
    let block = |output: Output| -> Result<Vec<f64>, Failure> {
        let block = model.evaluate(output, q, wrench, given).map_err(|unstable| {
            Failure::with_help(unstable.to_string(), "check the load, its unit and the stiffness")
        })?;
        if block.iter().all(|x| x.is_finite()) {
            return Ok(block);
        }
        let name = output.name();
        Err(Failure::new(format!("{name} is too large for a double: check the table's numbers")))
    };
    // With the links' weights, what they add.
    let loaded = |of_wrench: Output, of_weights: Output| -> Result<Vec<f64>, Failure> {
        let mut sum = block(of_wrench)?;
        if gravity {
            sum.iter_mut().zip(block(of_weights)?).for_each(|(x, weight)| *x += weight);
        }
        Ok(sum)
    };
    let pose = block(Output::Pose)?;
    let k_c = loaded(Output::ComplementaryStiffness, Output::WeightStiffness)?;
    Ok(Evaluation {
        position: rows(&pose[9..], 3).into_iter().flatten().collect(),
        rotation: rows(&pose[..9], 3),
        jacobian: rows(&block(Output::Jacobian)?, 6),
        k_c: rows(&k_c, n),
        compliance: rows(&block(Output::Compliance)?, 6),
        deflection: rows(&block(deflection)?, 6).concat(),
        joint_torque: rows(&loaded(Output::JointTorque, Output::WeightTorque)?, n).concat(),
    })
}

/// The rows of a column-major block; a negative zero is a zero.
fn rows(block: &[f64], rows: usize) -> Vec<Vec<f64>> {
    (0..rows).map(|r| block.iter().skip(r).step_by(rows).map(|x| x + 0.0).collect()).collect()
}

fn screen(
    source: &Source,
    q: &[f64],
    wrench: &[f64; 6],
    gravity: bool,
    result: &Evaluation,
) -> String {
    let si = |kind: &Dimension| kind.si().name;
    let units: Vec<&str> = source.readings().iter().map(si).collect();
    let weights = if gravity { ", links' weights included" } else { "" };
    let mut text = format!(
        "{}  {}\n\n",
        bold(&source.robot.name),
        dim(format!("{} by the derived graph{weights}", source.given))
    );
    let mut part = |name: &str, unit: &str, rows: &[&[f64]]| {
        let (power, matrix) = matrix(rows);
        let factor = if power == 0 { String::new() } else { format!("× 1e{power}  ") };
        let head = format!("{}  {}", bold(name), dim(format!("{factor}{unit}")));
        text.push_str(&format!("{}\n{}", head.trim_end(), indented(&matrix, 2)));
    };
    part("q", &distinct(&units), &[q]);
    part("wrench", "N, N·m", &[wrench]);
    part("position", "m", &[&result.position]);
    part("rotation", "", &borrowed(&result.rotation));
    part(
        "jacobian",
        "base axes, at the tool: translations, then rotations",
        &borrowed(&result.jacobian),
    );
    part("k_c", "row j, column i: ∂τ_j/∂q_i", &borrowed(&result.k_c));
    part("joint_torque", "N·m, N if prismatic", &[&result.joint_torque]);
    part("compliance", "m/N, rad/N; m/(N·m), rad/(N·m)", &borrowed(&result.compliance));
    part("deflection", "m, m, m, rad, rad, rad", &[&result.deflection]);
    text
}

fn distinct(units: &[&str]) -> String {
    let mut seen: Vec<&str> = Vec::new();
    units.iter().for_each(|u| {
        if !seen.contains(u) {
            seen.push(u)
        }
    });
    if seen.len() < 2 { seen.concat() } else { units.join(", ") }
}

fn borrowed(rows: &[Vec<f64>]) -> Vec<&[f64]> {
    rows.iter().map(Vec::as_slice).collect()
}

/// Numbers with the same digits behind the point, where they are small or large without a
/// common power of ten.
fn matrix(rows: &[&[f64]]) -> (i32, String) {
    let largest = rows.iter().copied().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 && rows.len() > 1 {
        return (0, "0 throughout\n".to_owned());
    }
    let plain = largest == 0.0 || (1e-2..1e6).contains(&largest);
    let power = if plain { 0 } else { 3 * (largest.log10() / 3.0).floor() as i32 };
    let scaled = |x: f64| x / 10f64.powi(power);
    let digits = decimals(scaled(largest), 6).min(6);
    let number = |x: &f64| {
        let text = format!("{:.digits$}", scaled(*x));
        // What rounds to zero shows no sign; what is zero shows no digits.
        let zero = text.bytes().all(|b| b"-0.".contains(&b));
        match (*x == 0.0, zero) {
            (true, _) => "0".to_owned(),
            (false, true) => text.replace('-', ""),
            (false, false) => minus(text),
        }
    };
    let cells: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(number).collect()).collect();
    let columns = rows.first().map_or(0, |row| row.len());
    (power, table(&cells, &vec![Align::Right; columns]))
}
