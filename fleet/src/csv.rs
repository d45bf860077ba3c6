//! The columns of a folder of CSV files: types wide enough for all of them, which the engine, file by file, would not
//! find.

use std::io::Cursor;

use arrow::csv::reader::Format;
use arrow::datatypes::{DataType, Schema};
use object_store::{GetResultPayload, ObjectMeta, ObjectStore, ObjectStoreExt};

use crate::files::Files;

/// The columns as a table's definition has them: `("x[m]" DOUBLE, arm VARCHAR)` and `PARTITIONED BY (arm)`.
///
/// # Errors
/// A sentence: a file that cannot be read, or has other columns than the first.
pub async fn columns(files: &Files) -> Result<[String; 2], String> {
    let mut whole: Option<Schema> = None;
    for file in &files.all {
        let wrong = |error: String| format!("{}: {error}", file.location);
        let own = schema(files.store.as_ref(), file).await.map_err(wrong)?;
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
    let parts = files.partitions();
    let of_folders = parts.iter().map(|name| format!("{} VARCHAR", quoted(name)));
    let columns = fields.chain(of_folders).collect::<Vec<_>>().join(", ");
    // There a name stands as it is, without quotation marks.
    let by = match parts.is_empty() {
        true => String::new(),
        false => format!("PARTITIONED BY ({})", parts.join(", ")),
    };
    Ok([format!("({columns})"), by])
}

async fn schema(store: &dyn ObjectStore, file: &ObjectMeta) -> Result<Schema, String> {
    let format = Format::default().with_header(true).with_comment(b'#');
    let got = store.get(&file.location).await.map_err(|error| error.to_string())?;
    let found = match got.payload {
        GetResultPayload::File(file, _) => format.infer_schema(file, None),
        GetResultPayload::Stream(_) => {
            let text = got.bytes().await.map_err(|error| error.to_string())?;
            format.infer_schema(Cursor::new(text), None)
        }
    };
    found.map(|(schema, _)| schema).map_err(|error| error.to_string())
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
