//! `stiffarm predict`: what the corrected arm is to read, and how far off it is.

use std::path::PathBuf;

use nalgebra::Vector6;
use serde::Serialize;
use stiffarm_document::Unit;
use stiffarm_document::text::{bold, counted, dim};
use stiffarm_gap::Measurements;
use stiffarm_gap::effects::Catalogue;
use stiffarm_gap::gap::{Statistics, row_gap};
use stiffarm_gap::measurement::Row;
use stiffarm_gap::predicted::{predicted, predicted_on_bench};
use stiffarm_gap::simulate::Reading;
use stiffarm_gap::whole::Whole;
use stiffarm_plant::csv;

use super::Verdict;
use crate::host::Host;
use crate::input::data::{self, BenchArgs};
use crate::input::source::{RobotArgs, Source};
use crate::terminal::failure::Failure;
use crate::terminal::json;
use crate::terminal::output::Target;

const EXAMPLES: &str = "\
Examples:
  stiffarm predict found.json run2.csv
  stiffarm predict better.toml plan.csv --csv expected.csv

DATA is a measurement file, or a plan whose measured cells are empty. Base, tool and markers stand where the
robot file has them. What is unknown of the bench (where a socket or a camera is, the zero of a gauge) is fitted to
DATA, and the gap is what that leaves; nothing else is fitted. Of a diagnosis (JSON) the rows beyond the joint ranges and
loads of its data, and those at which what was fitted is known less well than at any of these (their
leverage is larger), are counted and not judged.";

/// What the arm reads at other postures and loads, and its gap where they were measured
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// The measurement file, or a plan (CSV)
    data: PathBuf,
    #[command(flatten)]
    bench: BenchArgs,
    /// Write the file with what is predicted in the place of what is measured (`-`: to standard output)
    #[arg(long, value_name = "OUT")]
    csv: Option<Target>,
    /// Write the gap as JSON (`-`: to standard output, in place of the screen)
    #[arg(long, value_name = "OUT")]
    json: Option<Target>,
}

/// The result as it is written; SI.
#[derive(Serialize)]
struct Written<'a> {
    stiffarm: &'static str,
    robot: &'a str,
    file: &'a str,
    rows: usize,
    /// Those within the joint ranges, loads and largest leverage of the diagnosis; only they are judged.
    inside: usize,
    /// `None` where nothing is measured, or no row is inside.
    gap: Option<Statistics>,
}

pub fn run(args: &Args, host: &Host) -> Result<Verdict, Failure> {
    let source = args.robot.load(host)?;
    let arm = source.arm()?;
    let layout = args.bench.layout(&source, host)?;
    let plan = data::read_plan(&args.data, &layout, host)?;
    let is_read = |row: &Row| row.measured != Vector6::zeros() || row.reads_joints_alone();
    let is_measured = plan.rows.iter().any(is_read);
    // A row with a hole is no measurement, and is left out and said.
    let data = if is_measured { data::read(&args.data, &layout, host)? } else { plan };
    if !is_measured && args.csv.is_none() {
        let message = format!("{}: found nothing measured", args.data.display());
        return Err(Failure::with_help(message, "--csv OUT writes what is predicted"));
    }
    data::doubted(&arm, &data, &[], host);
    let whole = Whole { arm: &arm, known: &source.known };
    let [data, found] = match is_measured {
        true => predicted_on_bench(whole, data)?,
        false => {
            let found = predicted(whole, &data)?;
            [data, found]
        }
    };
    let trusted = source.trust.as_ref().map(|t| t.holds(whole, &Catalogue::default(), &data));
    let trusted = trusted.transpose()?;
    let covers = |number: &usize| {
        source.covers.as_ref().is_none_or(|covers| covers.holds(&data.rows[*number]))
            && trusted.as_ref().is_none_or(|trusted| trusted[*number])
    };
    let gap = |number: usize| {
        let found = Reading::from_vector(&found.rows[number].measured);
        row_gap(&data, &data.rows[number], &found)
    };
    let inside: Vec<usize> = (0..data.rows.len()).filter(covers).collect();
    let gaps: Vec<Vector6<f64>> = inside.iter().map(|number| gap(*number)).collect();
    let judged = inside.iter().map(|number| &data.rows[*number]).zip(&gaps);
    let written = Written {
        stiffarm: env!("CARGO_PKG_VERSION"),
        robot: &source.robot.name,
        file: &data.file,
        rows: data.rows.len(),
        inside: gaps.len(),
        gap: (is_measured && !gaps.is_empty()).then(|| Statistics::of_rows(data.kind, judged)),
    };
    let comment = format!("{}, predicted: {}", source.robot.name, data.file);
    host.put(&args.csv, || Ok(csv(&arm, &found, &[comment])))?;
    host.put(&args.json, || json::text(&written))?;
    if host.shows(&[&args.csv, &args.json]) {
        host.print(&screen(&source, &data, &written))?;
    }
    Ok(Verdict::Good)
}

fn screen(source: &Source, data: &Measurements, written: &Written<'_>) -> String {
    let rows = counted(written.rows, "row");
    let covered = source.covers.as_ref().map_or_else(String::new, |_| {
        format!(", {} of them within the range of the diagnosed data", written.inside)
    });
    let mut text =
        format!("{}\n{}\n", bold(written.robot), dim(format!("{}: {rows}{covered}", written.file)));
    let Some(gap) = &written.gap else {
        text.push_str(if written.inside == 0 {
            "None is judged.\n"
        } else {
            "Nothing is measured.\n"
        });
        return text;
    };
    for (kind, size) in &gap.kinds {
        let rms = Unit::of(&size.unit, size.rms).with_unit(size.rms);
        text.push_str(&format!("The error of the {kind} readings is {rms} rms.\n"));
    }
    let components = data.kind.components().map(|is| is && gap.kinds.is_empty());
    if components[..3].contains(&true) {
        let size = Unit::of("m", gap.position_max);
        text.push_str(&format!(
            "The position error is {} rms; 95 % of the rows are below {}, all below {}.\n",
            size.with_unit(gap.position_rms),
            size.with_unit(gap.position_p95),
            size.with_unit(gap.position_max)
        ));
    }
    if components[3..].contains(&true) {
        let size = Unit::of("rad", gap.rotation_rms);
        text.push_str(&format!(
            "The rotation error is {} rms.\n",
            size.with_unit(gap.rotation_rms)
        ));
    }
    text
}
