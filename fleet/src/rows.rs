//! The rows of one campaign, gathered from wherever the engine has them, as a measurement file.
//!
//! The file is the same however the rows were spread and came: they stand in the order of the column `row`, or
//! without one in the order of their text. Numbers are written with as few digits as give them back.

use arrow::array::{Array, ArrayRef, AsArray, StructArray};
use arrow::compute::cast;
use arrow::datatypes::{DataType, FieldRef, Float64Type, Int64Type};
use datafusion::common::{Result, exec_err};
use stiffarm_gap::io::{number, quoted};

/// The column that says where a row stands in its file, and is no part of it.
pub const ORDER: &str = "row";

/// A row of the file, and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The value of the column [`ORDER`].
    pub order: f64,
    /// The row as it is written.
    pub line: String,
}

/// The cells of some rows.
struct Column {
    name: String,
    cells: ArrayRef,
}

/// The columns of a batch, of which those of a struct count as columns of their own.
fn columns(fields: &[FieldRef], values: &[ArrayRef]) -> Vec<Column> {
    let each = fields.iter().zip(values).flat_map(|(field, array)| match array.as_struct_opt() {
        Some(whole) => within(whole),
        None => vec![Column { name: field.name().clone(), cells: ArrayRef::clone(array) }],
    });
    each.collect()
}

fn within(whole: &StructArray) -> Vec<Column> {
    let each = whole.fields().iter().zip(whole.columns());
    each.map(|(field, array)| Column { name: field.name().clone(), cells: ArrayRef::clone(array) })
        .collect()
}

/// The names of the file's columns.
pub fn header(fields: &[FieldRef]) -> Vec<String> {
    let each = fields.iter().flat_map(|field| match field.data_type() {
        DataType::Struct(within) => within.iter().map(|field| field.name().clone()).collect(),
        _ => vec![field.name().clone()],
    });
    each.filter(|name| name != ORDER).collect()
}

/// The rows of a batch, in its order.
///
/// # Errors
/// A column of which no cell of a file can be made.
pub fn rows(fields: &[FieldRef], values: &[ArrayRef]) -> Result<Vec<Row>> {
    let columns = columns(fields, values);
    let count = values.first().map_or(0, |array| array.len());
    let mut rows = vec![Row { order: 0.0, line: String::new() }; count];
    let mut is_first = true;
    for column in columns {
        if column.name == ORDER {
            let order = cast(&column.cells, &DataType::Float64)?;
            let order = order.as_primitive::<Float64Type>();
            rows.iter_mut()
                .zip(order)
                .for_each(|(row, at)| row.order = at.unwrap_or(f64::INFINITY));
            continue;
        }
        for (row, cell) in rows.iter_mut().zip(cells(&column)?) {
            if !is_first {
                row.line.push(',');
            }
            row.line.push_str(&cell);
        }
        is_first = false;
    }
    Ok(rows)
}

/// A column's cells; what is null is empty.
fn cells(column: &Column) -> Result<Vec<String>> {
    let array = &column.cells;
    let kind = match array.data_type() {
        DataType::Dictionary(_, values) => values,
        kind => kind,
    };
    if kind.is_floating() || matches!(kind, DataType::Decimal128(..)) {
        let array = cast(array, &DataType::Float64)?;
        let numbers = array.as_primitive::<Float64Type>();
        return Ok(numbers.iter().map(|x| x.map_or_else(String::new, number)).collect());
    }
    if kind.is_integer() {
        let array = cast(array, &DataType::Int64)?;
        let numbers = array.as_primitive::<Int64Type>();
        return Ok(numbers.iter().map(|x| x.map_or_else(String::new, |x| x.to_string())).collect());
    }
    if kind.is_string() || *kind == DataType::Null {
        let array = cast(array, &DataType::Utf8)?;
        let texts = array.as_string::<i32>();
        return Ok(texts.iter().map(quoted).collect());
    }
    exec_err!("column {}: found {kind}, expected numbers or text", column.name)
}

/// The measurement file of these rows.
pub fn file(header: &[String], mut rows: Vec<Row>) -> String {
    rows.sort_by(|a, b| a.order.total_cmp(&b.order).then_with(|| a.line.cmp(&b.line)));
    let head = header.iter().map(|name| quoted(Some(name))).collect::<Vec<_>>().join(",");
    let lines = std::iter::once(head).chain(rows.into_iter().map(|row| row.line));
    lines.map(|line| line + "\n").collect()
}
