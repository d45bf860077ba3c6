//! The columns of a folder of CSV files: types wide enough for all of them, which the engine, file by file, would not
//! find.

use std::fs::File;
use std::path::{Path, PathBuf};

use arrow::csv::reader::Format;
use arrow::datatypes::{DataType, Schema};

/// Every file below a folder, by name; the folder itself if it is one.
///
/// # Errors
/// A folder that cannot be read.
pub fn files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    if folder.is_file() {
        return Ok(vec![folder.to_owned()]);
    }
    let entries = std::fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut entries = entries.collect::<std::io::Result<Vec<_>>>()?;
    entries.sort();
    let mut found = Vec::new();
    for entry in entries {
        if entry.is_dir() { found.extend(files(&entry)?) } else { found.push(entry) }
    }
    Ok(found)
}

/// The columns as a table's definition has them: `("x[m]" DOUBLE, arm VARCHAR) … PARTITIONED BY (arm)` without what is
/// between.
///
/// # Errors
/// A sentence: a file that cannot be read, or has other columns than the first.
pub fn columns(folder: &Path) -> Result<[String; 2], String> {
    let all =
        files(folder).map_err(|error| format!("cannot read {}: {error}", folder.display()))?;
    let is_csv = |path: &&PathBuf| path.extension().is_some_and(|end| end == "csv");
    let mut whole: Option<Schema> = None;
    let mut parts: Vec<String> = Vec::new();
    for path in all.iter().filter(is_csv) {
        let wrong = |error: String| format!("{}: {error}", path.display());
        let file = File::open(path).map_err(|error| wrong(error.to_string()))?;
        let format = Format::default().with_header(true).with_comment(b'#');
        let (own, _) = format.infer_schema(file, None).map_err(|error| wrong(error.to_string()))?;
        parts = partitions(folder, path);
        whole = Some(match whole {
            None => own,
            Some(whole) => joined(&whole, &own).map_err(wrong)?,
        });
    }
    let quoted = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
    let whole = whole.unwrap_or_else(Schema::empty);
    let fields = whole.fields().iter().map(|field| {
        let kind = match field.data_type() {
            DataType::Int64 => "BIGINT",
            DataType::Float64 => "DOUBLE",
            DataType::Boolean => "BOOLEAN",
            _ => "VARCHAR",
        };
        format!("{} {kind}", quoted(field.name()))
    });
    let of_folders = parts.iter().map(|name| format!("{} VARCHAR", quoted(name)));
    let columns = fields.chain(of_folders).collect::<Vec<_>>().join(", ");
    // There a name stands as it is, without quotation marks.
    let by = match parts.is_empty() {
        true => String::new(),
        false => format!("PARTITIONED BY ({})", parts.join(", ")),
    };
    Ok([format!("({columns})"), by])
}

/// The names of the folders `name=value` on the way to a file.
fn partitions(folder: &Path, file: &Path) -> Vec<String> {
    let way = file.strip_prefix(folder).ok().and_then(Path::parent);
    let steps = way.into_iter().flat_map(Path::iter).filter_map(|step| step.to_str());
    steps.filter_map(|step| step.split_once('=')).map(|(name, _)| name.to_owned()).collect()
}

/// The same columns, each of a type that holds both.
fn joined(a: &Schema, b: &Schema) -> Result<Schema, String> {
    let names = |schema: &Schema| -> Vec<String> {
        schema.fields().iter().map(|field| field.name().clone()).collect()
    };
    if names(a) != names(b) {
        let (found, expected) = (names(b).join(","), names(a).join(","));
        return Err(format!(
            "found the columns {found}, expected those of the files before: {expected}"
        ));
    }
    let each = a.fields().iter().zip(b.fields()).map(|(a, b)| {
        let kind = match (a.data_type(), b.data_type()) {
            (one, other) if one == other => one.clone(),
            (DataType::Null, other) | (other, DataType::Null) => other.clone(),
            (DataType::Int64 | DataType::Float64, DataType::Int64 | DataType::Float64) => {
                DataType::Float64
            }
            _ => DataType::Utf8,
        };
        a.as_ref().clone().with_data_type(kind)
    });
    Ok(Schema::new(each.collect::<Vec<_>>()))
}
