//! `stiffarm measurements`: a measurement file from a table as another program wrote it.

use std::path::{Path, PathBuf};

use stiffarm_gap::io::{Cell, Map};
use stiffarm_gap::measurement::Dimension;
use stiffarm_gap::readings::{By, Sheet, Stopped, import, import_into, rests};

use super::Verdict;
use crate::diagnose::{Part, names, parts, read};
use crate::host::Host;
use crate::input::source::{RobotArgs, Source};
use crate::input::{data, quantity};
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm measurements tracker.xlsx --csv run.csv
  stiffarm measurements export.txt --map map.toml --robot arm.toml --csv run.csv
  stiffarm measurements tracker.csv --join controller.csv --by time --csv run.csv
  stiffarm measurements hole_0.csv hole_1.csv --set 'point=front:{file}' --csv front.csv
  stiffarm measurements hole_0.mcap hole_1.mcap --robot panda --set 'point=front:{file}' --csv front.csv
  stiffarm measurements wire.csv --set from=left --csv left.csv

Several tables stand one below the other, and have the same columns. A joint log in which postures were
held (MCAP, ROS 2 bags; with --still texts, too) is a row for each rest.

A map says what is not found by name:

  decimal = \",\"
  orientation = \"abc\"        # abc, rpy, quaternion, matrix, rotation_vector; xyz, zyz … about the
                             # tool's axes as they turn; fixed_xyz, fixed_zyx … about the base's
  ignore = [\"Operator\"]      # not kept

  [columns]                  # ours = theirs
  q1 = \"Axis 1\"
  x = { column = \"Pos X\", unit = \"mm\" }
  mass = { column = \"Load\", unit = \"kg\" }";

/// A measurement file from a table as another program wrote it
///
/// Any separator, a decimal comma, xlsx and ods; columns by the names that controllers and trackers
/// give them; angles of several conventions, quaternions, payloads in kg. What was done is said.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// The tables: texts or workbooks; or joint logs in which postures were held
    #[arg(required = true)]
    raw: Vec<PathBuf>,
    /// What is to be known of its columns (TOML); of a joint log also a program's name, as for `diagnose`
    #[arg(long, value_name = "FILE")]
    map: Option<String>,
    /// A column that the table has not, the same in every row; `{file}` is the file's name without its end
    #[arg(long, value_name = "COLUMN=VALUE")]
    set: Vec<String>,
    /// A row for each rest of a joint log that is no shorter; of messages, where nothing is said, of 0.5 s
    #[arg(long, value_name = "TIME")]
    still: Option<String>,
    /// The topic of a joint log's messages, where there are several
    #[arg(long, value_name = "TOPIC")]
    topic: Option<String>,
    /// A second table whose columns stand beside: a controller's log of what a tracker saw
    #[arg(long, value_name = "FILE")]
    join: Option<PathBuf>,
    /// Which of its rows belongs to which: `row` (one to one), `time` (interpolated; `time+0.5` where the
    /// raw table's clock is half a second ahead), or the name of a column that both have
    #[arg(long, value_name = "row|time|COLUMN", default_value = "row", requires = "join")]
    by: By,
    /// The sheet of a workbook [default: the first]
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Read the result as this robot's, and refuse what could not be diagnosed; a joint log needs it
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    #[command(flatten)]
    bench: data::BenchArgs,
    /// Where the measurement file goes
    #[arg(long, value_name = "OUT", default_value = "-")]
    csv: Target,
}

/// A rest of a log, where nothing is said: what a hand takes to let go and a controller to settle.
const STILL: &str = "0.5s";

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let source = args.robot.as_deref().map(|robot| RobotArgs::named(robot).load(host));
    let source = source.transpose()?;
    let mut sheets = Vec::with_capacity(args.raw.len());
    for path in &args.raw {
        sheets.push(args.sheet(path, source.as_ref(), host)?);
    }
    let other = args.join.as_deref().map(|path| host.sheet(path)).transpose()?;
    let other = other.as_ref().map(|other| (other, &args.by));
    if let ([(raw, map)], None) = (&sheets[..], &source) {
        let mut done = Ok::<_, Failure>(Vec::new());
        host.stream(&args.csv, &mut |sink| match import_into(raw, other, map, sink) {
            Ok(said) => {
                done = Ok(said);
                Ok(true)
            }
            Err(Stopped::Read(error)) => {
                done = Err(error.into());
                Ok(false)
            }
            Err(Stopped::Write(error)) => Err(error),
        })?;
        done?.iter().for_each(|said| host.note(said));
        return Ok(Verdict::Good);
    }
    if sheets.len() > 1 && other.is_some() {
        return Err(Failure::new("--join: found several tables, expected one beside the other"));
    }
    let mut stacked = String::new();
    let mut said = Vec::new();
    for (path, (raw, map)) in args.raw.iter().zip(&sheets) {
        let imported = import(raw, other, map)?;
        let (header, rows) = imported.csv.split_once('\n').unwrap_or((&imported.csv, ""));
        match stacked.split_once('\n') {
            None => stacked = imported.csv,
            Some((first, _)) if first == header => stacked += rows,
            Some((first, _)) => {
                let (path, above) = (path.display(), args.raw[0].display());
                let message =
                    format!("{path}: found the columns {header}, expected {first} as in {above}");
                return Err(Failure::with_help(
                    message,
                    "make a file of each, and diagnose them together",
                ));
            }
        }
        let new = imported.said.into_iter().filter(|line| !said.contains(line));
        let new: Vec<String> = new.collect();
        said.extend(new);
    }
    if let Some(source) = &source {
        let written = PathBuf::from("what was made of it");
        let layout = args.bench.layout(source, host)?;
        let data = data::from_bytes(&written, stacked.as_bytes(), &layout)?;
        data::doubted(&source.arm()?, &data, &[], host);
    }
    host.write(&args.csv, &stacked)?;
    said.iter().for_each(|said| host.note(said));
    Ok(Verdict::Good)
}

impl Args {
    /// A table and its map; of a joint log that of its rests.
    fn sheet(
        &self,
        path: &Path,
        source: Option<&Source>,
        host: &Host,
    ) -> Result<(Sheet, Map), Failure> {
        // A pipe can be read once.
        let parts = match path.is_file() || path.is_dir() {
            true => parts(&[path.to_owned()], host)?,
            false => Vec::new(),
        };
        let is_log = self.still.is_some() || parts.iter().any(Part::is_no_text);
        let (sheet, mut map) = if is_log {
            let source = source.ok_or_else(|| {
                let message =
                    format!("{}: found a joint log, expected --robot beside it", path.display());
                Failure::with_help(message, "it says which joints the log is to have")
            })?;
            (self.rests(path, parts, source, host)?, Map::default())
        } else {
            let map = self.map.as_deref().map(|path| {
                let text = String::from_utf8_lossy(&host.read(Path::new(path))?).into_owned();
                Ok::<_, Failure>(Map::read(path, &text)?)
            });
            (host.sheet(path)?, map.transpose()?.unwrap_or_default())
        };
        map.sheet = self.sheet.clone().or(map.sheet);
        for told in &self.set {
            let Some((column, cell)) = told.split_once('=') else {
                let message =
                    format!("--set: found `{told}`, expected a column and what stands in it");
                return Err(Failure::with_help(message, "--set point=front"));
            };
            map.set.insert(column.trim().to_owned(), Cell(cell.trim().to_owned()));
        }
        Ok((sheet, map))
    }

    /// The postures of a joint log that were held.
    fn rests(
        &self,
        path: &Path,
        parts: Vec<Part>,
        source: &Source,
        host: &Host,
    ) -> Result<Sheet, Failure> {
        let hold = self.still.as_deref().unwrap_or(STILL);
        let hold = quantity::with_unit("--still", hold, Dimension::Time)?;
        let names = names([&self.map, &self.topic], source, host)?.of_motion();
        let motions: Vec<_> = source.arm()?.joints.iter().map(|joint| joint.motion).collect();
        let log = read(parts, &motions, &names)?;
        log.remarks().iter().for_each(|remark| host.note(remark));
        let file = path.display().to_string();
        let text = rests(&log, &motions, hold)
            .map_err(|fault| Failure::new(format!("{file}: {fault}")))?;
        Ok(Sheet::new(file, text.into_bytes()))
    }
}
