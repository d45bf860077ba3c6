//! Results as text: as they come, and never half a file.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use arrow::array::RecordBatch;
use arrow::csv;
use arrow::datatypes::Schema;
use arrow::json::writer::LineDelimited;
use arrow::json::{Writer, WriterBuilder};
use arrow::util::pretty::pretty_format_batches;
use clap::ValueEnum;
use datafusion::execution::SendableRecordBatchStream;
use futures::StreamExt;
use stiffarm_cli::Whole;

use crate::sentence::of_engine;

/// How a result is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Columns side by side, for people
    Table,
    /// Comma-separated; of plain columns alone
    Csv,
    /// A JSON object on each line
    Json,
}

/// Writes a result to `path`, or to standard output.
///
/// # Errors
/// A sentence: what the engine could not do, or what cannot be written; there is no file then.
pub async fn write(
    result: SendableRecordBatchStream,
    format: Format,
    path: Option<&Path>,
) -> Result<(), String> {
    let Some(path) = path else {
        return written(result, format, io::stdout()).await.map(|_| ());
    };
    let wrong = |error: io::Error| wrong(path, &error);
    let mut whole = Whole::new(path).map_err(wrong)?;
    let said = |said| format!("{}: {said}", path.display());
    written(result, format, &mut whole).await.map_err(said)?;
    whole.finish().map_err(wrong)
}

/// A file that cannot be written, as a sentence.
pub fn wrong(path: &Path, error: &io::Error) -> String {
    format!("cannot write {}: {error}", path.display())
}

async fn written<W: Write>(
    mut result: SendableRecordBatchStream,
    format: Format,
    out: W,
) -> Result<W, String> {
    let mut sink = Sink::new(format, &result.schema(), out)?;
    while let Some(batch) = result.next().await {
        sink.take(batch.map_err(|error| of_engine(&error))?)?;
    }
    sink.finish()
}

enum Sink<W: Write> {
    Table(Vec<RecordBatch>, W),
    Csv(Box<csv::Writer<BufWriter<W>>>),
    Json(Writer<BufWriter<W>, LineDelimited>),
}

impl<W: Write> Sink<W> {
    fn new(format: Format, schema: &Schema, out: W) -> Result<Sink<W>, String> {
        Ok(match format {
            Format::Table => Sink::Table(Vec::new(), out),
            Format::Json => {
                let out = BufWriter::new(out);
                Sink::Json(WriterBuilder::new().with_explicit_nulls(true).build(out))
            }
            Format::Csv => {
                let nested = schema.fields().iter().find(|field| field.data_type().is_nested());
                if let Some(field) = nested {
                    return Err(format!(
                        "column {}: found several values in one cell, expected one for --format csv; take one of \
                         them, as {0}[1] or {0}['json'], or --format json",
                        field.name()
                    ));
                }
                Sink::Csv(Box::new(csv::Writer::new(BufWriter::new(out))))
            }
        })
    }

    fn take(&mut self, batch: RecordBatch) -> Result<(), String> {
        match self {
            Sink::Table(batches, _) => {
                batches.push(batch);
                Ok(())
            }
            Sink::Csv(csv) => csv.write(&batch).map_err(|error| error.to_string()),
            Sink::Json(json) => json.write(&batch).map_err(|error| error.to_string()),
        }
    }

    fn finish(self) -> Result<W, String> {
        let flushed = |out: BufWriter<W>| out.into_inner().map_err(|error| error.to_string());
        match self {
            Sink::Table(batches, mut out) => {
                let table = pretty_format_batches(&batches).map_err(|error| error.to_string())?;
                writeln!(out, "{table}").map_err(|error| error.to_string())?;
                Ok(out)
            }
            Sink::Csv(csv) => flushed((*csv).into_inner()),
            Sink::Json(mut json) => {
                json.finish().map_err(|error| error.to_string())?;
                flushed(json.into_inner())
            }
        }
    }
}
