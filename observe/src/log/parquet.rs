//! Logs in Parquet files: a row group after the other, only the columns that are read.

use std::fs::File;
use std::path::Path;

use parquet::basic::{LogicalType, TimeUnit, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::metadata::FileMetaData;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;
use stiffarm_kernels::Motion;

use super::column::Signal;
use super::table::{Cell, Header, Table};
use super::{Log, Names, TorqueSide, unreadable};
use crate::io::ReadError;
use crate::io::cell::Decimals;
use crate::io::columns::split;

/// What the cells of a row group are, row by row.
enum Cells {
    Numbers(Vec<f64>),
    Texts(Vec<Vec<u8>>),
}

/// A column of the file.
struct Leaf {
    index: usize,
    /// Cells in each row: more than one of a list.
    width: usize,
    /// What its numbers are multiplied with: stamps are whole numbers of something.
    factor: f64,
    /// The level at which a value is there.
    whole: i16,
}

pub(super) fn read(
    file: &str,
    path: &Path,
    motions: &[Motion],
    names: &Names,
) -> Result<Log, ReadError> {
    let broken = |error: ParquetError| unreadable(file, "a Parquet file", error);
    let source = File::open(path).map_err(|e| broken(e.into()))?;
    let reader = SerializedFileReader::new(source).map_err(broken)?;
    let side = side(file, reader.metadata().file_metadata())?;
    let (leaves, header) = columns(&reader, side).map_err(broken)?;
    let mut table = Table::new(file, &header, motions, names)?;
    // Where the cells of each leaf begin among those of a row.
    let starts: Vec<usize> = leaves
        .iter()
        .scan(0, |next, leaf| Some(core::mem::replace(next, *next + leaf.width)))
        .collect();
    let total: usize = leaves.iter().map(|leaf| leaf.width).sum();
    let mut before = 0;
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group).map_err(broken)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        let read = |(leaf, start): (&Leaf, &usize)| {
            let wanted = (*start..start + leaf.width).any(|column| table.reads(column));
            wanted.then(|| cells(&*group, leaf, rows)).transpose()
        };
        let found: Result<Vec<Option<Cells>>, ParquetError> =
            leaves.iter().zip(&starts).map(read).collect();
        let found = found.map_err(broken)?;
        // Of each cell of a row, the leaf and which of its own.
        let places: Vec<(usize, usize)> = leaves
            .iter()
            .enumerate()
            .flat_map(|(l, leaf)| (0..leaf.width).map(move |k| (l, k)))
            .collect();
        for row in 0..rows {
            let cell = |c: usize| {
                let (leaf, k) = places[c];
                let at = row * leaves[leaf].width + k;
                match &found[leaf] {
                    Some(Cells::Numbers(numbers)) => Cell::Number(numbers[at]),
                    Some(Cells::Texts(texts)) => Cell::Text(&texts[at]),
                    None => Cell::Number(0.0),
                }
            };
            table.push((before + row + 1) as u64, (0..total).map(cell));
        }
        before += rows;
    }
    table.end()
}

/// `torque_side` may stand among what the file says of itself.
fn side(file: &str, about: &FileMetaData) -> Result<Option<TorqueSide>, ReadError> {
    let mut said = about.key_value_metadata().into_iter().flatten();
    let Some(entry) = said.find(|entry| entry.key == "torque_side") else { return Ok(None) };
    let found = entry.value.clone().unwrap_or_default();
    TorqueSide::said(&found).map(Some).map_err(|fault| fault.of(file))
}

/// The columns that have numbers or texts, and what they are called.
fn columns(
    reader: &SerializedFileReader<File>,
    side: Option<TorqueSide>,
) -> Result<(Vec<Leaf>, Header), ParquetError> {
    let about = reader.metadata().file_metadata();
    let (mut leaves, mut names) = (Vec::new(), Vec::new());
    for (index, column) in about.schema_descr().columns().iter().enumerate() {
        // Deeper than a list no column of ours is.
        if column.max_rep_level() > 1 || column.physical_type() == Physical::INT96 {
            continue;
        }
        let name = column.path().parts().first().cloned().unwrap_or_default();
        let is_list = column.max_rep_level() == 1;
        let width = if is_list { width(reader, index)? } else { 1 };
        leaves.push(Leaf { index, width, factor: factor(column), whole: column.max_def_level() });
        let (stem, unit) = split(&name);
        let own = Signal::ALL.iter().any(|signal| signal.name() == stem);
        let unit = unit.map_or_else(String::new, |unit| format!("[{unit}]"));
        names.extend((0..width).map(|k| match (is_list, own) {
            (false, _) => name.clone(),
            (true, true) => format!("{stem}{}{unit}", k + 1),
            (true, false) => format!("{name}[{k}]"),
        }));
    }
    let header = Header { names, line: None, row: "row", side, decimals: Decimals::default() };
    Ok((leaves, header))
}

/// How many entries the lists of a column have, by the first.
fn width(reader: &SerializedFileReader<File>, index: usize) -> Result<usize, ParquetError> {
    for group in 0..reader.num_row_groups() {
        let first = Levels::read(&*reader.get_row_group(group)?, index, 1)?;
        if !first.repeated.is_empty() {
            return Ok(first.repeated.len());
        }
    }
    Ok(1)
}

/// Stamps of a calendar are counted in parts of a second.
fn factor(column: &ColumnDescriptor) -> f64 {
    match column.logical_type_ref() {
        Some(LogicalType::Timestamp(of)) => match of.unit {
            TimeUnit::MILLIS => 1e-3,
            TimeUnit::MICROS => 1e-6,
            TimeUnit::NANOS => 1e-9,
        },
        _ => 1.0,
    }
}

/// A column as it is stored: the values that are there, and where they belong.
struct Levels {
    /// How much of each cell is there; empty where nothing can lack.
    defined: Vec<i16>,
    /// 0 where a row begins; empty of what is no list.
    repeated: Vec<i16>,
    cells: Cells,
}

impl Levels {
    /// Of so many rows from the first.
    fn read(group: &dyn RowGroupReader, index: usize, rows: usize) -> Result<Levels, ParquetError> {
        let numbers = |of: Stored<f64>| Levels {
            defined: of.defined,
            repeated: of.repeated,
            cells: Cells::Numbers(of.values),
        };
        Ok(match group.get_column_reader(index)? {
            ColumnReader::BoolColumnReader(r) => {
                numbers(stored(r, rows, |x| f64::from(u8::from(x)))?)
            }
            ColumnReader::Int32ColumnReader(r) => numbers(stored(r, rows, f64::from)?),
            ColumnReader::Int64ColumnReader(r) => numbers(stored(r, rows, |x| x as f64)?),
            ColumnReader::FloatColumnReader(r) => numbers(stored(r, rows, f64::from)?),
            ColumnReader::DoubleColumnReader(r) => numbers(stored(r, rows, |x| x)?),
            ColumnReader::Int96ColumnReader(r) => numbers(stored(r, rows, |_| f64::NAN)?),
            ColumnReader::ByteArrayColumnReader(r) => {
                let of = stored(r, rows, |x| x.data().to_vec())?;
                Levels {
                    defined: of.defined,
                    repeated: of.repeated,
                    cells: Cells::Texts(of.values),
                }
            }
            ColumnReader::FixedLenByteArrayColumnReader(r) => {
                numbers(stored(r, rows, |_| f64::NAN)?)
            }
        })
    }
}

struct Stored<V> {
    defined: Vec<i16>,
    repeated: Vec<i16>,
    values: Vec<V>,
}

fn stored<T: DataType, V>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    value: impl Fn(T::T) -> V,
) -> Result<Stored<V>, ParquetError> {
    let (mut defined, mut repeated, mut values) = (Vec::new(), Vec::new(), Vec::new());
    let mut read = 0;
    while read < rows {
        let levels = (Some(&mut defined), Some(&mut repeated));
        let (more, ..) = reader.read_records(rows - read, levels.0, levels.1, &mut values)?;
        if more == 0 {
            break;
        }
        read += more;
    }
    Ok(Stored { defined, repeated, values: values.into_iter().map(value).collect() })
}

/// The cells of a column in a row group, as many of each row as its lists have. What is not there is no
/// number, nor is anything of a list of another length: the row is damaged.
fn cells(group: &dyn RowGroupReader, leaf: &Leaf, rows: usize) -> Result<Cells, ParquetError> {
    let Levels { defined, repeated, cells } = Levels::read(group, leaf.index, rows)?;
    Ok(match cells {
        Cells::Numbers(numbers) => {
            let numbers = numbers.into_iter().map(|x| x * leaf.factor).collect();
            Cells::Numbers(spread(numbers, &f64::NAN, leaf, rows, (&defined, &repeated)))
        }
        Cells::Texts(texts) => {
            Cells::Texts(spread(texts, &Vec::new(), leaf, rows, (&defined, &repeated)))
        }
    })
}

/// Values to where they belong.
fn spread<V: Clone>(
    values: Vec<V>,
    none: &V,
    leaf: &Leaf,
    rows: usize,
    (defined, repeated): (&[i16], &[i16]),
) -> Vec<V> {
    if defined.is_empty() && repeated.is_empty() && values.len() == rows {
        return values;
    }
    let mut there = values.into_iter();
    let mut spread = Vec::with_capacity(rows * leaf.width);
    let mut row: Vec<V> = Vec::with_capacity(leaf.width);
    for k in 0..defined.len().max(repeated.len()) {
        if k > 0 && repeated.get(k).is_none_or(|level| *level == 0) {
            end(&mut row, &mut spread, none, leaf.width);
        }
        let is_there = defined.get(k).is_none_or(|level| *level == leaf.whole);
        row.push(is_there.then(|| there.next()).flatten().unwrap_or_else(|| none.clone()));
    }
    end(&mut row, &mut spread, none, leaf.width);
    // A file that ends early has rows without cells.
    spread.resize(rows * leaf.width, none.clone());
    spread
}

/// A row is as wide as all are, or nothing.
fn end<V: Clone>(row: &mut Vec<V>, rows: &mut Vec<V>, none: &V, width: usize) {
    if row.len() == width {
        rows.append(row);
    } else {
        row.clear();
        rows.extend(core::iter::repeat_n(none.clone(), width));
    }
}
