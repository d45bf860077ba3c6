//! `stiffarm check`: whether what is generated from a table is right.

use std::collections::BTreeMap;

use nalgebra::{UnitQuaternion, Vector3, Vector6};
use serde_json::{Value, json};
use stiffarm_codegen::derive::Given;
use stiffarm_document::text::{Align, bad, bold, dim, good, indented, table, thousands};
use stiffarm_gap::whole::{Situation, Whole};
use stiffarm_robots::{ARMS, SYMBOLIC};

use super::{Verdict, robots};
use crate::host::Host;
use crate::input::model::Model;
use crate::input::source;
use crate::input::source::{RobotArgs, Source};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;
use crate::terminal::progress::Progress;
use stiffarm_kernels::parity::{Agreement, Beyond, Comparison, Evaluate, Line, Subject, agreement};

const EXAMPLES: &str = "\
Examples:
  stiffarm check kuka_kr240
  stiffarm check arm.toml --count 1000
  stiffarm check --all --json -

What is checked is the graph that is derived from the table, of which every kernel is a print. It is
compared with the textbook (the same quantity by matrices at run time), of a built-in robot in single
precision too; with central differences of the textbook; and with the derivatives of the forward
kinematics by dual numbers. Of an arm with effects beyond its table the textbook is told by the
effects' own laws, as the diagnosis has them, at sides and temperatures of all kinds.
Deviations are the largest over all postures, relative to the output's scale. Exit status 1 if one
is larger than its arithmetic accounts for.";

/// Generated = textbook = differences = dual numbers, at random postures and loads
#[derive(clap::Args)]
#[command(after_help = EXAMPLES, override_usage = "stiffarm check [OPTIONS] <ROBOT|--all>")]
pub struct Args {
    #[command(flatten)]
    robot: Option<RobotArgs>,
    /// Check every built-in robot, a line for each
    #[arg(long, conflicts_with = "robot", required_unless_present = "robot")]
    all: bool,
    /// Postures and wrenches per robot [default: 10000, and of more than 8 joints as many as take no
    /// longer]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    count: Option<u32>,
    /// Seed of the postures and wrenches
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Write the deviations as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
}

/// Postures of an arm of up to so many joints.
const USUAL: (usize, usize) = (10_000, 8);

/// Postures of any arm, at least.
const LEAST: usize = 10;

/// As many postures as are usual. Derivatives by two joints each, through all the links: what a posture
/// takes grows with the cube of the joints.
fn usual(joints: usize) -> usize {
    let (postures, most) = USUAL;
    (postures * most.pow(3) / joints.max(most).pow(3)).max(LEAST)
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let checked = match &args.robot {
        Some(robot) => vec![check(robot.load(host)?, args, host)?],
        None => {
            let each = ARMS.iter().map(|arm| check(source::open(arm.id, host)?, args, host));
            each.collect::<Result<_, _>>()?
        }
    };
    let failed = checked.iter().any(|c| !c.agrees());
    host.put(&args.json, || crate::terminal::json::text(&written(&checked, args)))?;
    if (failed || !host.is_quiet()) && args.json != Some(Target::Stdout) {
        host.print(&if args.all { summary(&checked, args) } else { checked[0].report(args) })?;
    }
    Ok(if failed { Verdict::Failed } else { Verdict::Good })
}

/// A robot and how well its implementations agree.
struct Checked {
    source: Source,
    postures: usize,
    agreement: Agreement,
}

fn check(source: Source, args: &Args, host: &Host) -> Result<Checked, Failure> {
    let robot = source.for_kernels()?;
    let (table, known) = source.as_it_stands()?;
    let outputs = robot.generated();
    let model = Model::new(&robot, &outputs);
    let whole = Whole { arm: &table, known: &known };
    let arm = stiffarm_gap::robot::arm(&robot)?;
    let at = |q: &[f64], w: &[f64; 6]| drawn(&q[..arm.dof()], (arm.base.rotation, w));
    let generated =
        |output, q: &[f64], w: &[f64; 6]| model.evaluate(output, q, w, &given(&at(q, w)));
    let evaluate = |output, q: &[f64], w: &[f64; 6]| whole.evaluate(output, q, &at(q, w));
    let slopes = |output, q: &[f64], w: &[f64; 6]| whole.slopes(output, q, &at(q, w));
    let beyond = Beyond { evaluate: &evaluate, slopes: &slopes };
    let beyond = (!known.is_empty()).then_some(beyond);
    let single = |output, q: &[f64], w: &[f64; 6]| model.single(output, q, w);
    // Near buckling the last digits of single precision are lost: not every arm is to be held to its limit.
    let single: Option<&Evaluate<'_>> = if source.built_in { Some(&single) } else { None };
    let outputs = &outputs;
    let subject = Subject { outputs, arm: &arm, beyond, generated: &generated, single };
    let count = args.count.map_or_else(|| usual(arm.dof()), |count| count as usize);
    let progress = Progress::new(&source.given, count, host);
    let agreement = agreement(&subject, count, args.seed, &|steps| progress.add(steps));
    if agreement.too_large > 0 {
        let evaluations = thousands(agreement.too_large);
        return Err(Failure::with_help(
            format!("{}: {evaluations} evaluations are too large for a double", source.given),
            "check the table's numbers",
        ));
    }
    Ok(Checked { source, postures: count, agreement })
}

/// A posture and a load, and sides and a warming that go with them in no way: each sample has its own.
fn drawn(q: &[f64], (base, w): (UnitQuaternion<f64>, &[f64; 6])) -> Situation {
    let scrambled = |x: f64| (1e4 * x).sin();
    let [f, m] = [0, 3].map(|k| base.inverse() * Vector3::new(w[k], w[k + 1], w[k + 2]));
    Situation {
        direction: Some(q.iter().map(|q| (1.5 * scrambled(*q)).round() as i8).collect()),
        warming: Some(20.0 * scrambled(w[0])),
        ..Situation::under(Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z))
    }
}

/// The same for the kernels.
fn given(at: &Situation) -> Given {
    let sides = at.direction.iter().flatten().map(|side| f64::from(*side)).collect();
    Given { sides, warming: at.warming.unwrap_or_default(), ..Given::default() }
}

/// The result as it is written. Deviations are relative to the output's scale, by what they are from; evaluations in
/// which the arm is not stable are left out.
fn written(checked: &[Checked], args: &Args) -> Value {
    let by_name = |value: &dyn Fn(usize) -> Option<f64>| -> BTreeMap<&str, f64> {
        let each = HEADS.iter().enumerate();
        each.filter_map(|(k, head)| value(k).map(|value| (*head, value))).collect()
    };
    let robot = |one: &Checked| {
        let lines = one.agreement.lines.iter();
        let outputs = lines.map(|line| (line.output.name(), by_name(&|k| line.worst[k])));
        json!({
            "robot": one.source.given,
            "agrees": one.agrees(),
            "postures": one.postures,
            "unstable": one.agreement.unstable,
            "outputs": outputs.collect::<BTreeMap<_, _>>(),
        })
    };
    json!({
        "stiffarm": env!("CARGO_PKG_VERSION"),
        "count": least(checked),
        "seed": args.seed,
        "agrees": checked.iter().all(Checked::agrees),
        "limits": by_name(&|k| Some(Comparison::EACH[k].limit())),
        "robots": checked.iter().map(robot).collect::<Vec<_>>(),
    })
}

/// The postures of the robot with the fewest.
fn least(checked: &[Checked]) -> usize {
    checked.iter().map(|robot| robot.postures).min().unwrap_or(0)
}

const HEADS: [&str; 4] = ["textbook", "f32", "differences", "dual numbers"];

impl Checked {
    fn agrees(&self) -> bool {
        self.agreement.lines.iter().all(|line| line.exceeded().next().is_none())
    }

    /// A line per output.
    fn report(&self, args: &Args) -> String {
        let robot = &self.source.robot;
        let mut text = format!(
            "{}  {}\n\n",
            bold(&robot.name),
            dim(format!(
                "{}, {}, derived graph: {} postures and wrenches, seed {}",
                robots::motions(robot),
                robots::convention(robot.convention),
                thousands(self.postures),
                args.seed
            ))
        );
        let mut rows = vec![heads("output")];
        rows.extend(self.agreement.lines.iter().map(row));
        rows.push(limits());
        text.push_str(&indented(&table(&rows, &ALIGN), 2));
        text.push('\n');
        if self.agreement.unstable > 0 {
            text.push_str(&format!(
                "left out: {} evaluations in which the arm is not stable under its load\n",
                thousands(self.agreement.unstable)
            ));
        }
        text.push_str(&self.sentence());
        text
    }

    fn sentence(&self) -> String {
        let wrong = self.agreement.lines.iter().filter(|l| l.exceeded().next().is_some());
        let wrong: Vec<&str> = wrong.map(|line| line.output.name()).collect();
        if wrong.is_empty() {
            return format!("{} all agree\n", good("✓"));
        }
        let (name, wrong) = (&self.source.given, wrong.join(", "));
        format!("{} {name}: beyond what the arithmetic accounts for: {wrong}\n", bad("✗"))
    }
}

const ALIGN: [Align; 5] = [Align::Left, Align::Right, Align::Right, Align::Right, Align::Right];

fn heads(first: &str) -> Vec<String> {
    std::iter::once(first).chain(HEADS).map(bold).collect()
}

fn limits() -> Vec<String> {
    let each = Comparison::EACH.map(|c| dim(format!("{:.0e}", c.limit())));
    std::iter::once(dim("at most")).chain(each).collect()
}

fn row(line: &Line) -> Vec<String> {
    let mut cells = vec![line.output.name().to_owned()];
    cells.extend(Comparison::EACH.iter().zip(line.worst).map(|(c, worst)| cell(*c, worst)));
    cells
}

fn cell(comparison: Comparison, worst: Option<f64>) -> String {
    match worst {
        None => dim("–"),
        Some(0.0) => "0".to_owned(),
        Some(x) if x > comparison.limit() => bad(format!("{x:.1e}")),
        Some(x) => format!("{x:.1e}"),
    }
}

/// A line per robot: its largest deviations.
fn summary(checked: &[Checked], args: &Args) -> String {
    let mut rows = vec![heads("robot")];
    for robot in checked {
        let mut cells = vec![robot.source.given.clone()];
        for (k, comparison) in Comparison::EACH.into_iter().enumerate() {
            let worst = robot.agreement.lines.iter().filter_map(|line| line.worst[k]);
            cells.push(cell(comparison, worst.reduce(f64::max)));
        }
        rows.push(cells);
    }
    rows.push(limits());
    let count = thousands(least(checked));
    let mut text = format!(
        "{}  {}\n\n{}\n",
        bold("Built-in robots"),
        dim(format!("largest deviation of any output over {count} postures, seed {}", args.seed)),
        indented(&table(&rows, &ALIGN), 2)
    );
    for robot in checked.iter().filter(|robot| !robot.agrees()) {
        text.push_str(&robot.sentence());
    }
    if checked.iter().all(Checked::agrees) {
        text.push_str(&format!("{} all agree\n", good("✓")));
    }
    let symbolic: Vec<&str> = SYMBOLIC.iter().map(|arm| arm.id).collect();
    text.push_str(&dim(format!(
        "not checked, having symbolic parameters: {}\n",
        symbolic.join(", ")
    )));
    text
}
