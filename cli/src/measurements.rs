//! `stiffarm measurements`: a measurement file from a table as another program wrote it.

use std::path::PathBuf;

use stiffarm_gap::io::Map;
use stiffarm_gap::readings::{By, Stopped, import, import_into};

use super::Verdict;
use crate::host::Host;
use crate::input::data;
use crate::input::source::RobotArgs;
use crate::terminal::failure::Failure;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm measurements tracker.xlsx --csv run.csv
  stiffarm measurements export.txt --map map.toml --robot arm.toml --csv run.csv
  stiffarm measurements tracker.csv --join controller.csv --by time --csv run.csv

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
    /// The table: text, or a workbook
    raw: PathBuf,
    /// What is to be known of its columns (TOML)
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
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
    /// Read the result as this robot's, and refuse what could not be diagnosed
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    /// Where the measurement file goes
    #[arg(long, value_name = "OUT", default_value = "-")]
    csv: Target,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let mut map = match &args.map {
        None => Map::default(),
        Some(path) => {
            let text = String::from_utf8_lossy(&host.read(path)?).into_owned();
            Map::read(&path.display().to_string(), &text)?
        }
    };
    map.sheet = args.sheet.clone().or(map.sheet);
    let raw = host.sheet(&args.raw)?;
    let other = args.join.as_deref().map(|path| host.sheet(path)).transpose()?;
    let other = other.as_ref().map(|other| (other, &args.by));
    let said = match &args.robot {
        Some(robot) => {
            let imported = import(&raw, other, &map)?;
            let source = RobotArgs::named(robot).load(host)?;
            let written = PathBuf::from("what was made of it");
            let layout = data::layout(&source)?;
            let data = data::from_bytes(&written, imported.csv.as_bytes(), &layout)?;
            data::doubted(&source.arm()?, &data, &[], host);
            host.write(&args.csv, &imported.csv)?;
            imported.said
        }
        None => {
            let mut done = Ok::<_, Failure>(Vec::new());
            host.stream(&args.csv, &mut |sink| match import_into(&raw, other, &map, sink) {
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
            done?
        }
    };
    said.iter().for_each(|said| host.note(said));
    Ok(Verdict::Good)
}
