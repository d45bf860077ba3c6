//! Measurement files, each mistake shown at its cell.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use stiffarm_document::text::{counted, listed};
use stiffarm_gap::Measurements;
use stiffarm_gap::diagnose::Nuisance;
use stiffarm_gap::doubts::doubts;
use stiffarm_gap::instrument::Bench;
use stiffarm_gap::io::{MOST_MISTAKES, ReadError};
use stiffarm_gap::measurement::Layout;
use stiffarm_kernels::generic::Arm;

use super::source::Source;
use crate::host::Host;
use crate::terminal::failure::{Failure, Remark};
use crate::terminal::snippet;

/// What is known of the bench on which a file was measured.
#[derive(Clone, Default, clap::Args)]
pub struct BenchArgs {
    /// Known constants of the bench (TOML): points and their distances, planes, centres. What it does not
    /// give is co-estimated
    #[arg(long, value_name = "BENCH.toml")]
    bench: Option<PathBuf>,
}

impl BenchArgs {
    /// Whether a file is given.
    pub fn is_given(&self) -> bool {
        self.bench.is_some()
    }

    /// What the reader of a file must know of the robot and the bench.
    pub fn layout(&self, source: &Source, host: &Host) -> Result<Layout, Failure> {
        layout_beside(self.bench.as_deref(), source, host)
    }
}

/// What the reader of a file must know of the robot, and of the bench where there is a file of it.
pub fn layout_beside(
    bench: Option<&Path>,
    source: &Source,
    host: &Host,
) -> Result<Layout, Failure> {
    let layout = layout(source)?;
    let Some(path) = bench else { return Ok(layout) };
    let bytes = host.read(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let bench = Bench::read(&path.display().to_string(), &text);
    let bench = bench.map_err(|error| refusal(&bytes, &error))?;
    Ok(Layout { bench, ..layout })
}

/// What the reader of a file must know of the robot.
pub fn layout(source: &Source) -> Result<Layout, Failure> {
    Ok(stiffarm_gap::robot::layout(&source.robot)?)
}

/// Reads a file, and says which rows are left out unless `quiet`.
pub fn read(path: &Path, layout: &Layout, host: &Host) -> Result<Measurements, Failure> {
    if !host.is_on_disk(path) {
        return read_bytes(path, &host.read(path)?, layout, host);
    }
    let source = File::open(path).map_err(|error| Failure::io("read", path, &error))?;
    let name = path.display().to_string();
    let data = match Measurements::from_source(&name, BufReader::new(source), layout) {
        Ok(data) => Ok(data),
        // Its lines are shown at their mistakes.
        Err(error) => Err(refusal(&host.read(path)?, &error)),
    };
    told(data, host)
}

/// The same of a file whose bytes are there.
pub fn read_bytes(
    path: &Path,
    bytes: &[u8],
    layout: &Layout,
    host: &Host,
) -> Result<Measurements, Failure> {
    told(from_bytes(path, bytes, layout), host)
}

fn told(data: Result<Measurements, Failure>, host: &Host) -> Result<Measurements, Failure> {
    let data = data?;
    let mut lines: Vec<u64> = data.skipped.iter().filter_map(|mistake| mistake.line).collect();
    lines.dedup();
    if !lines.is_empty() {
        let rows = counted(lines.len(), "row");
        let (all, first) = (lines.len() + data.rows.len(), &data.skipped[0]);
        let lines: Vec<String> = lines.iter().map(u64::to_string).collect();
        let text = format!(
            "{}: {rows} of {all} left out for a cell that is empty or not a number: line {}; {first}",
            data.file,
            listed(&lines, MOST_MISTAKES)
        );
        host.note(&text);
    }
    Ok(data)
}

/// Reads the poses and loads of a file, of which nothing need be measured.
pub fn read_plan(path: &Path, layout: &Layout, host: &Host) -> Result<Measurements, Failure> {
    let bytes = host.read(path)?;
    let file = path.display().to_string();
    let data = Measurements::plan_from_bytes(&file, &bytes, layout);
    told(data.map_err(|error| refusal(&bytes, &error)), host)
}

/// Says what is to be doubted of a file unless `quiet`, and returns it; `along` are the frames that
/// are fitted along.
pub fn doubted(arm: &Arm, data: &Measurements, along: &[Nuisance], host: &Host) -> Vec<String> {
    let doubts = doubts(arm, data, along);
    doubts.iter().for_each(|doubt| host.note(doubt));
    doubts
}

/// Reads the bytes of a file.
pub fn from_bytes(path: &Path, bytes: &[u8], layout: &Layout) -> Result<Measurements, Failure> {
    let file = path.display().to_string();
    let data = Measurements::from_bytes(&file, bytes, layout);
    data.map_err(|error| refusal(bytes, &error))
}

/// The mistakes of a file, each at its cell, and how many more there are.
pub fn refusal(bytes: &[u8], error: &ReadError) -> Failure {
    let ReadError { file, mistakes, more } = error;
    let text = core::str::from_utf8(bytes).unwrap_or_default();
    let each = mistakes.iter().map(|mistake| {
        let column = mistake.column.as_ref().map(|column| column.number);
        let span = mistake.line.and_then(|line| snippet::cell(text, line, column));
        Remark::error(mistake.to_string(), None, file, text, span)
    });
    let rest = (*more > 0).then(|| format!("and {more} more mistakes"));
    let rest = rest.map(|rest| Remark::error(rest, None, file, "", None));
    Failure::File(each.chain(rest).collect())
}
